// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_AllWaysBack_h
#define isodiamond_AllWaysBack_h

#include "DistanceError/WayBack.h"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace isodiamond
{

/**
 * Raises the errors of all diamonds to the way back.
 *
 * Takes a few slices at a time, with the triangles in them and next to them: all of these at once
 * would take more memory than everything else. The few diamonds, most of them large, that need
 * triangles from elsewhere are left for the end, and measured once these have been brought.
 */
template <typename Lengths>
class AllWaysBack
{
public:
  /** All must outlive it. */
  AllWaysBack(const IsodiamondHierarchy& relevant, const Lengths& lengths,
    const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
    const Loops& loops)
    : Relevant(relevant)
    , InWorld(lengths)
    , Known(known)
    , Hidden(known.Hidden != nullptr && known.Hidden->Any() ? known.Hidden : nullptr)
    , Code(code)
    , Codes(codes)
    , For(known.Portion != nullptr ? Loops(loops.Whole) : loops)
    , Others(known.Portion != nullptr ? &known.Portion->Others() : nullptr)
  {
  }

  void Run()
  {
    for (int surface = 0; surface < this->Relevant.Region().SurfaceCount(); ++surface)
    {
      std::optional<FineSurface> fine;
      InStep(this->Others,
        [&] {
          fine.emplace(this->Relevant, surface, this->Hidden, this->For.Whole, this->Known.Portion);
        });
      const std::vector<SliceRange> windows = this->Windows();
      for (std::size_t i = 0; IsAnywhere(this->Others, i < windows.size()); ++i)
      {
        const SliceRange slices = i < windows.size() ? windows[i] : SliceRange();
        fine->Make(slices);
        InStep(this->Others, [&] { this->Measure(surface, slices, *fine); });
        fine->Forget();
      }
      this->MeasureLeft(surface, *fine);
    }
  }

private:
  struct Member
  {
    Place Diamond;
    std::uint32_t Rank = 0;
  };

  /** Cuts the slices of the centres measured here into parts with about as much in each: an eighth,
   *  but not fewer slices than the triangles next to them have. */
  std::vector<SliceRange> Windows() const
  {
    constexpr int layer = DiamondPortion::Step;
    const BrickLevel& level = this->Relevant.Diamonds().Level(0);
    const DiamondPortion all({ 0 }, 0);
    const DiamondPortion& own =
      this->Known.Portion != nullptr ? this->Known.Portion->Diamonds() : all;
    const int first = own.Begin() / layer;
    const int end = std::min((own.End() - 1) / layer + 1, level.Box.Count[2]);
    std::vector<std::int64_t> sizes(std::max(end - first, 0), 0);
    for (const Brick& brick : level.Bricks)
    {
      const int at = level.Box.Origin(brick.BoxIndex)[2] / layer;
      if (at >= first && at < end)
      {
        sizes[at - first] += brick.Size();
      }
    }
    std::vector<SliceRange> windows;
    for (const int cut : EvenCuts(sizes, std::clamp((end - first) / 2, 1, 8)))
    {
      const int begin = windows.empty() ? own.Begin() : layer * (first + cut);
      if (!windows.empty())
      {
        windows.back().End = begin;
      }
      windows.push_back({ begin, own.End() }); // centres beyond the last sample, too
    }
    return windows;
  }

  void Measure(int surface, const SliceRange& slices, const FineSurface& fine)
  {
    const DiamondSet& set = this->Relevant.Diamonds();
    const std::vector<BrickPlace> bricks = AllBricks(set);
    this->For.Share(static_cast<std::int64_t>(bricks.size()), 4,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::optional<WayBack<Lengths>> wayBack; // once there is something in these slices
        for (std::int64_t i = begin; i < end; ++i)
        {
          const int scale = bricks[i].Scale;
          const BrickLevel& level = set.Level(scale);
          const Brick& brick = level.Bricks[bricks[i].Index];
          const int first = level.Box.Origin(brick.BoxIndex)[2];
          for (int z = 0; z < 8; ++z)
          {
            const int slice = (first + z) << scale;
            if (slice < slices.Begin || slice >= slices.End || brick.Occupancy[z] == 0)
            {
              continue;
            }
            if (!wayBack)
            {
              wayBack.emplace(this->Relevant, this->InWorld, surface, fine, this->Code);
            }
            set.ForEachInWord(scale, brick, z,
              [&](const Place& place, std::uint32_t rank) {
                this->Measure(surface, { place, rank }, *wayBack);
              });
          }
        }
      });
  }

  /** Measures what has been left, some at a time: what these need is then forgotten. */
  void MeasureLeft(int surface, FineSurface& fine)
  {
    const auto some = static_cast<std::size_t>(this->Known.MostAtOnce);
    std::vector<Member> left = std::exchange(this->Left, {});
    std::sort(
      left.begin(), left.end(), [](const Member& a, const Member& b) { return a.Rank > b.Rank; });
    while (IsAnywhere(this->Others, !left.empty()))
    {
      const auto first = left.end() - static_cast<std::ptrdiff_t>(std::min(some, left.size()));
      this->Left.assign(first, left.end());
      left.erase(first, left.end());
      while (IsAnywhere(this->Others, !this->Left.empty()))
      {
        InStep(this->Others, [&] { this->Measure(surface, std::exchange(this->Left, {}), fine); });
        fine.Bring();
      }
      fine.Forget();
    }
  }

  void Measure(int surface, const std::vector<Member>& members, const FineSurface& fine)
  {
    this->For.Whole(static_cast<std::int64_t>(members.size()), 4,
      [&](std::int64_t begin, std::int64_t end)
      {
        WayBack<Lengths> wayBack(this->Relevant, this->InWorld, surface, fine, this->Code);
        for (std::int64_t i = begin; i < end; ++i)
        {
          this->Measure(surface, members[i], wayBack);
        }
      });
  }

  void Measure(int surface, const Member& member, WayBack<Lengths>& wayBack)
  {
    const std::uint32_t rank = member.Rank;
    const ErrorCode::Type before = this->Codes[rank];
    if (before == 0 || before == ErrorCode::Always)
    {
      return;
    }
    const MapBounds& bounds = this->Known.Bounds != nullptr ? *this->Known.Bounds : this->NoBounds;
    const bool isWhole = this->Hidden == nullptr || !this->Hidden->Touch(member.Diamond);
    const double error = this->Code.Decode(before) / DistanceMargin;
    try
    {
      const double greater =
        wayBack.Measure(member.Diamond, bounds.Of(surface, rank), error, isWhole);
      if (greater > error)
      {
        this->Codes[rank] = this->Code.Encode(greater * DistanceMargin);
      }
    }
    catch (const FineSurface::Elsewhere&)
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Left.push_back(member);
    }
  }

  const IsodiamondHierarchy& Relevant;
  const Lengths& InWorld;
  const BeforeWayBack& Known;
  const HiddenCells* Hidden;
  const MapBounds NoBounds;
  const ErrorCode& Code;
  std::vector<ErrorCode::Type>& Codes;
  Loops For;
  Peers* Others;            ///< of a portion; null for none
  std::vector<Member> Left; ///< to be measured when what they need has been brought
  std::mutex Mutex;         ///< guards what is left
};

}

#endif
