// SPDX-License-Identifier: BSD-3-Clause
#include "Build/ActivationThresholds.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <queue>
#include <utility>

namespace isodiamond
{
namespace
{

/** The ranks of a diamond's parents below scale N. */
class ParentRanks
{
public:
  /** @param window of bricks of the parents' scale, around the parents */
  ParentRanks(const BrickWindow& window, const Place& place)
  {
    const TypeTable& shape = ShapeOf(place.Position);
    for (int i = 0; i < shape.ParentCount; ++i)
    {
      const std::int64_t rank = window.Rank(ParentPlace(shape, place, i).Position);
      if (rank != DiamondSet::None) // otherwise it lies outside the grid
      {
        this->Ranks[this->Count++] = static_cast<std::uint32_t>(rank);
      }
    }
  }

  const std::uint32_t* begin() const { return this->Ranks.data(); }
  const std::uint32_t* end() const { return this->Ranks.data() + this->Count; }

private:
  std::array<std::uint32_t, 4> Ranks;
  int Count = 0;
};

/** A diamond that a sweep visits. */
struct Visit
{
  std::int64_t BrickIndex = 0; ///< in the list of the level
  Place Diamond;
  std::uint32_t Rank = 0;
  const BrickWindow& ParentWindow;

  /** Takes most of the run time. */
  ParentRanks Parents() const { return ParentRanks(this->ParentWindow, this->Diamond); }
};

/** A diamond whose code rises. */
struct Rise
{
  ErrorCode::Type Code = 0;
  Place Diamond;

  bool operator<(const Rise& other) const { return this->Code < other.Code; }
};

/**
 * Codes that rise to the least solution.
 *
 * A sweep down gives each diamond the code due to its parents alone, one up raises the ancestors of
 * those that got ahead of one of their parents.
 * Then only the few diamonds are left whose parents were raised by a sibling's descendants; from
 * these the paper's own walk goes on, with a falling tolerance. If few diamonds have a code due to
 * their parents, the sweep down is not needed before the walk.
 */
class RisingCodes
{
public:
  RisingCodes(const Grid& grid, const DiamondSet& members, std::vector<ErrorCode::Type> own,
    const ParallelFor& parallelFor)
    : Depth(grid.Depth())
    , Members(members)
    , Own(std::move(own))
    , Parallel(parallelFor)
    , Codes(members.Size())
    , Ahead((members.Size() + 63) / 64)
  {
  }

  /** Starts from codes that count whatever the parents' codes are. */
  RisingCodes(const Grid& grid, const DiamondSet& members, std::vector<ErrorCode::Type> own,
    const std::vector<ErrorCode::Type>& least, const ParallelFor& parallelFor)
    : RisingCodes(grid, members, std::move(own), parallelFor)
  {
    std::copy(least.begin(), least.end(), this->Codes.begin());
    std::fill(this->Ahead.begin(), this->Ahead.end(), ~std::uint64_t{ 0 });
  }

  std::vector<ErrorCode::Type> Thresholds()
  {
    const std::int64_t root = this->Members.Rank({ this->Depth - 1, { 1, 1, 1 } });
    if (root != DiamondSet::None)
    {
      this->Raise(root, this->Own[root]);
      this->SweepDown();
      this->SweepUp();
      this->FindRising();
      this->Walk();
    }
    return this->Result();
  }

  std::vector<ErrorCode::Type> Saturated()
  {
    this->SweepUp();
    this->FindRising();
    this->Walk();
    return this->Result();
  }

private:
  // Diamonds of one class raise shared parents in any order: the maximum is the same.
  ErrorCode::Type Code(std::int64_t rank) const
  {
    return this->Codes[rank].load(std::memory_order_relaxed);
  }

  void Raise(std::int64_t rank, ErrorCode::Type code)
  {
    ErrorCode::Type current = this->Code(rank);
    while (current < code &&
      !this->Codes[rank].compare_exchange_weak(current, code, std::memory_order_relaxed))
    {
    }
  }

  bool IsAhead(std::uint32_t rank) const
  {
    return ((this->Ahead[rank / 64].load(std::memory_order_relaxed) >> (rank % 64)) & 1U) != 0;
  }

  void SetAhead(std::uint32_t rank)
  {
    this->Ahead[rank / 64].fetch_or(std::uint64_t{ 1 } << (rank % 64), std::memory_order_relaxed);
  }

  /** The code that a diamond has from its own error, once a parent is subdivided. */
  ErrorCode::Type CodeBelow(const ParentRanks& parents, std::uint32_t rank) const
  {
    ErrorCode::Type highest = 0;
    for (const std::uint32_t parent : parents)
    {
      highest = std::max(highest, this->Code(parent));
    }
    return std::min(highest, this->Own[rank]);
  }

  /** Calls body(visit) for the members of one scale and class. */
  template <typename Body>
  void ForEachOfClass(int scale, int diamondClass, const Body& body) const
  {
    const int step = diamondClass == 0 ? 1 : 0;
    if (scale + step == this->Depth)
    {
      return; // the root: its parents, the corners of the base cube, are always subdivided
    }
    const BrickLevel& level = this->Members.Level(scale);
    const BrickLevel& parentLevel = this->Members.Level(scale + step);
    ForEachIndex(this->Parallel, level.Bricks.size(), 16,
      [&](std::int64_t index)
      {
        const Brick& brick = level.Bricks[index];
        const Point origin = level.Box.Origin(brick.BoxIndex);
        const BrickWindow window(
          parentLevel, Point{ origin[0] >> step, origin[1] >> step, origin[2] >> step });
        for (int z = 0; z < 8; ++z)
        {
          ForEachBit(brick.Occupancy[z] & tables::ClassBits[diamondClass][z & 1],
            [&](int bit)
            {
              const Place place{ scale, PositionOf(origin, z, bit) };
              body(Visit{ index, place, brick.Rank(z, bit), window });
            });
        }
      });
  }

  /** From old to young: parents are of an older class or of the next coarser scale. */
  void SweepDown()
  {
    for (int scale = this->Depth - 1; scale >= 0; --scale)
    {
      for (int diamondClass = 0; diamondClass < 3; ++diamondClass)
      {
        this->ForEachOfClass(scale, diamondClass,
          [&](const Visit& visit)
          {
            if (this->Own[visit.Rank] != 0)
            {
              const ParentRanks parents = visit.Parents();
              const ErrorCode::Type code = this->CodeBelow(parents, visit.Rank);
              this->Raise(visit.Rank, code);
              if (std::any_of(parents.begin(), parents.end(),
                    [&](std::uint32_t parent) { return this->Code(parent) < code; }))
              {
                this->SetAhead(visit.Rank);
              }
            }
          });
      }
    }
  }

  /** From young to old. */
  void SweepUp()
  {
    for (int scale = 0; scale < this->Depth; ++scale)
    {
      for (int diamondClass = 2; diamondClass >= 0; --diamondClass)
      {
        this->ForEachOfClass(scale, diamondClass,
          [&](const Visit& visit)
          {
            const ErrorCode::Type code = this->Code(visit.Rank);
            if (code != 0 && this->IsAhead(visit.Rank))
            {
              for (const std::uint32_t parent : visit.Parents())
              {
                if (this->Code(parent) < code)
                {
                  this->Raise(parent, code);
                  this->SetAhead(parent);
                }
              }
            }
          });
      }
    }
  }

  /** Queues the diamonds that do not yet have the code due to their parents. */
  void FindRising()
  {
    for (int scale = 0; scale < this->Depth; ++scale)
    {
      std::vector<std::vector<Rise>> found(this->Members.Level(scale).Bricks.size());
      for (int diamondClass = 0; diamondClass < 3; ++diamondClass)
      {
        this->ForEachOfClass(scale, diamondClass,
          [&](const Visit& visit)
          {
            const ErrorCode::Type code = this->Code(visit.Rank);
            if (code < this->Own[visit.Rank])
            {
              const ErrorCode::Type due = this->CodeBelow(visit.Parents(), visit.Rank);
              if (code < due)
              {
                found[visit.BrickIndex].push_back({ due, visit.Diamond });
              }
            }
          });
      }
      for (const std::vector<Rise>& ofBrick : found)
      {
        for (const Rise& rise : ofBrick)
        {
          this->Queue.push(rise);
        }
      }
    }
  }

  void Walk()
  {
    while (!this->Queue.empty())
    {
      const Rise rise = this->Queue.top();
      this->Queue.pop();
      const std::int64_t rank = this->Members.Rank(rise.Diamond);
      if (this->Code(rank) >= rise.Code)
      {
        continue;
      }
      this->Raise(rank, rise.Code);
      const TypeTable& shape = ShapeOf(rise.Diamond.Position);
      for (int i = 0; i < shape.ParentCount; ++i)
      {
        this->Reach(ParentPlace(shape, rise.Diamond, i), rise.Code, true);
      }
      for (int i = 0; i < shape.ChildCount; ++i)
      {
        this->Reach(ChildPlace(shape, rise.Diamond, i), rise.Code, false);
      }
    }
  }

  /** Queues a parent, needed for closure, or a child, which its own error may require to refine. */
  void Reach(const Place& place, ErrorCode::Type code, bool needed)
  {
    const bool isDiamond = place.Scale >= 0 && place.Scale < this->Depth;
    const std::int64_t rank = isDiamond ? this->Members.Rank(place) : DiamondSet::None;
    if (rank != DiamondSet::None)
    {
      code = needed ? code : std::min(code, this->Own[rank]);
      if (this->Code(rank) < code)
      {
        this->Queue.push({ code, place });
      }
    }
  }

  std::vector<ErrorCode::Type> Result()
  {
    std::copy(this->Codes.begin(), this->Codes.end(), this->Own.begin());
    return std::move(this->Own);
  }

  int Depth;
  const DiamondSet& Members;
  std::vector<ErrorCode::Type> Own; ///< holds the result in the end, to save memory
  const ParallelFor& Parallel;
  std::vector<std::atomic<ErrorCode::Type>> Codes;
  std::vector<std::atomic<std::uint64_t>> Ahead; ///< whose code may exceed one of a parent: a bit
                                                 ///< each, by rank
  std::priority_queue<Rise> Queue;
};

/** Whether no diamond's threshold is higher than those of its parents below scale N. */
[[maybe_unused]] bool AreClosed(
  const Grid& grid, const DiamondSet& members, const std::vector<ErrorCode::Type>& thresholds)
{
  bool closed = true;
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    for (const Brick& brick : members.Level(scale).Bricks)
    {
      members.ForEachInBrick(scale, brick,
        [&](const Place& place, std::uint32_t rank)
        {
          const TypeTable& shape = ShapeOf(place.Position);
          for (int i = 0; i < shape.ParentCount; ++i)
          {
            const Place parent = ParentPlace(shape, place, i);
            const std::int64_t parentRank =
              parent.Scale < grid.Depth() ? members.Rank(parent) : DiamondSet::None;
            closed = closed &&
              (parentRank == DiamondSet::None || thresholds[parentRank] >= thresholds[rank]);
          }
        });
    }
  }
  return closed;
}

/**
 * The codes that all portions of a hierarchy arrive at. Each finds what its own diamonds lead to;
 * then diamonds that several portions have rise to the greatest of their codes, and each portion
 * goes on from there, until none rises any more. No code is ever higher than in the whole
 * hierarchy, and in the end the same conditions hold as there: a diamond and its parents are in one
 * portion, whichever way a code travels.
 */
std::vector<ErrorCode::Type> InRounds(const Grid& grid, const DiamondSet& members,
  const std::vector<ErrorCode::Type>& own, std::vector<ErrorCode::Type> codes,
  const ParallelFor& parallelFor, const PeerPortion& portion)
{
  while (portion.Others().Any(portion.Max(codes)))
  {
    portion.Others().Together(
      [&] { codes = RisingCodes(grid, members, own, codes, parallelFor).Saturated(); });
  }
  return codes;
}

}

std::vector<ErrorCode::Type> ActivationThresholds(const Grid& grid, const DiamondSet& members,
  std::vector<ErrorCode::Type> own, const ParallelFor& parallelFor, const PeerPortion* portion)
{
  if (portion != nullptr)
  {
    std::vector<ErrorCode::Type> codes;
    portion->Others().Together(
      [&] { codes = RisingCodes(grid, members, own, parallelFor).Thresholds(); });
    return InRounds(grid, members, own, std::move(codes), parallelFor, *portion);
  }
  std::vector<ErrorCode::Type> thresholds =
    RisingCodes(grid, members, std::move(own), parallelFor).Thresholds();
  assert(AreClosed(grid, members, thresholds) && "every refined set has its diamonds' parents");
  return thresholds;
}

std::vector<std::uint32_t> FindFollowers(
  const std::vector<ErrorCode::Type>& own, const std::vector<ErrorCode::Type>& thresholds)
{
  std::vector<std::uint32_t> followers;
  for (std::size_t rank = 0; rank < own.size(); ++rank)
  {
    if (own[rank] > thresholds[rank])
    {
      followers.push_back(static_cast<std::uint32_t>(rank));
    }
  }
  return followers;
}

void RaiseToThresholds(const Grid& grid, const DiamondSet& members,
  std::vector<ErrorCode::Type>& own, const ParallelFor& parallelFor, const PeerPortion* portion)
{
  std::vector<ErrorCode::Type> thresholds;
  const auto copy = [&] { thresholds = own; };
  InStep(portion != nullptr ? &portion->Others() : nullptr, copy);
  thresholds = ActivationThresholds(grid, members, std::move(thresholds), parallelFor, portion);
  for (std::size_t rank = 0; rank < own.size(); ++rank)
  {
    own[rank] = own[rank] != 0 ? std::max(own[rank], thresholds[rank]) : own[rank];
  }
}

std::vector<ErrorCode::Type> SaturateUpward(const Grid& grid, const DiamondSet& members,
  const std::vector<ErrorCode::Type>& codes, const std::vector<std::uint32_t>& followers,
  const ParallelFor& parallelFor, const PeerPortion* portion)
{
  std::vector<ErrorCode::Type> own;
  const auto setOwn = [&]
  {
    own.assign(members.Size(), 0);
    for (const std::uint32_t rank : followers)
    {
      own[rank] = ErrorCode::Always; // gets the greatest code of its parents, however great
    }
  };
  if (portion != nullptr)
  {
    std::vector<ErrorCode::Type> risen;
    portion->Others().Together(
      [&]
      {
        setOwn();
        risen = RisingCodes(grid, members, own, codes, parallelFor).Saturated();
      });
    return InRounds(grid, members, own, std::move(risen), parallelFor, *portion);
  }
  setOwn();
  std::vector<ErrorCode::Type> saturated =
    RisingCodes(grid, members, std::move(own), codes, parallelFor).Saturated();
  assert(AreClosed(grid, members, saturated) && "every refined set has its diamonds' parents");
  return saturated;
}

}
