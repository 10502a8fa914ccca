// SPDX-License-Identifier: BSD-3-Clause
#include "Build/ToleratedSet.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace isodiamond
{
namespace
{

class Subdivision
{
public:
  Subdivision(const IsodiamondHierarchy& relevant, const ToleratedBy& by)
    : Depth(relevant.SampleGrid().Depth())
    , Members(relevant.Diamonds())
    , By(by)
    , States(this->Members.Size(), State::Far)
  {
    // The root's parents, the corners of the base cube, are always subdivided.
    std::fill_n(this->States.begin(), 8, State::Subdivided);
    const Place root{ this->Depth - 1, { 1, 1, 1 } };
    this->Meet(root);
    this->SubdivideWaiting();
  }

  /** The diamonds that are to be tested next; none in the end. */
  std::vector<TestedDiamond> TakeMet()
  {
    std::vector<TestedDiamond> met = std::exchange(this->Met, {});
    // Subdividing others has subdivided some of them since.
    met.erase(std::remove_if(met.begin(), met.end(),
                [&](const TestedDiamond& tested)
                { return this->States[this->RankOf(tested.Diamond)] == State::Subdivided; }),
      met.end());
    return met;
  }

  /** Subdivides a diamond, all ancestors, and what they lead to that is always subdivided. */
  void Subdivide(const Place& diamond)
  {
    this->Waiting.push_back(diamond);
    this->SubdivideWaiting();
  }

  std::vector<ErrorCode::Type> Codes() const
  {
    std::vector<ErrorCode::Type> codes(this->States.size());
    std::transform(this->States.begin(), this->States.end(), codes.begin(),
      [](State state)
      { return state == State::Subdivided ? ErrorCode::Always : ErrorCode::Least; });
    return codes;
  }

private:
  enum class State : std::uint8_t
  {
    Far, ///< not met
    Met,
    Subdivided
  };

  void SubdivideWaiting()
  {
    while (!this->Waiting.empty())
    {
      const Place place = this->Waiting.back();
      this->Waiting.pop_back();
      const std::int64_t rank = this->RankOf(place);
      if (rank == DiamondSet::None || this->States[rank] == State::Subdivided)
      {
        continue;
      }
      this->States[rank] = State::Subdivided;
      const TypeTable& shape = ShapeOf(place.Position);
      for (int i = 0; i < shape.ParentCount; ++i)
      {
        this->Waiting.push_back(ParentPlace(shape, place, i));
      }
      for (int i = 0; i < shape.ChildCount; ++i)
      {
        this->Meet(ChildPlace(shape, place, i));
      }
    }
  }

  std::int64_t RankOf(const Place& diamond) const
  {
    const bool isDiamond = diamond.Scale >= 0 && diamond.Scale < this->Depth;
    return isDiamond ? this->Members.Rank(diamond) : DiamondSet::None;
  }

  void Meet(const Place& diamond)
  {
    const std::int64_t rank = this->RankOf(diamond);
    if (rank == DiamondSet::None || this->States[rank] != State::Far)
    {
      return;
    }
    this->States[rank] = State::Met;
    const ErrorCode::Type accepted = this->By.Accepted(diamond);
    if (accepted < ErrorCode::Least || this->By.IsAlways(diamond, static_cast<std::uint32_t>(rank)))
    {
      this->Waiting.push_back(diamond);
    }
    else
    {
      this->Met.push_back({ diamond, accepted });
    }
  }

  int Depth;
  const DiamondSet& Members;
  const ToleratedBy& By;
  std::vector<State> States; ///< by rank
  std::vector<TestedDiamond> Met;
  std::vector<Place> Waiting; ///< to be subdivided
};

}

std::vector<ErrorCode::Type> ToleratedSet(const IsodiamondHierarchy& relevant,
  const DistanceTests& tests, const ToleratedBy& by, const Loops& loops, Peers* peers)
{
  std::optional<Subdivision> subdivision;
  std::vector<TestedDiamond> met;
  std::vector<std::uint8_t> exceed; // one flag each
  InStep(peers, [&] { subdivision.emplace(relevant, by); });
  do
  {
    InStep(peers,
      [&]
      {
        constexpr std::size_t some = 1 << 14;
        InSteps(loops.Whole, met.size(), some,
          [&](std::size_t i)
          {
            if (exceed[i] != 0)
            {
              subdivision->Subdivide(met[i].Diamond);
            }
          });
        met = subdivision->TakeMet();
        exceed = tests.Exceed(met, loops.Share);
      });
    if (peers != nullptr)
    {
      peers->Or(exceed);
    }
  } while (!met.empty());
  std::vector<ErrorCode::Type> codes;
  InStep(peers, [&] { codes = subdivision->Codes(); });
  return codes;
}

}
