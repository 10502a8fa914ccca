// SPDX-License-Identifier: BSD-3-Clause
#include "Activation.h"

namespace isodiamond
{
namespace
{

/** The walk with a falling tolerance. */
class FallingWalk
{
public:
  FallingWalk(
    const Grid& grid, const DiamondSet& members, const std::vector<ErrorCode::Type>& triggers)
    : Domain(grid)
    , Members(members)
    , Triggers(triggers)
    , Thresholds(members.Size(), 0)
    , Queued(members.Size(), false)
    , Buckets(ErrorCode::Always + 1)
  {
  }

  std::vector<ErrorCode::Type> Run()
  {
    const int rootScale = this->Domain.Depth() - 1;
    this->Queue(Place{ rootScale, { 1, 1, 1 } });
    for (this->Current = ErrorCode::Always; this->Current >= ErrorCode::Least; --this->Current)
    {
      std::vector<Place>& bucket = this->Buckets[this->Current];
      while (!bucket.empty())
      {
        const Place place = bucket.back();
        bucket.pop_back();
        this->Subdivide(place);
      }
      std::vector<Place>().swap(bucket);
    }
    return std::move(this->Thresholds);
  }

private:
  /** Puts a diamond of the front where the tolerance will meet its own error. */
  void Queue(const Place& place)
  {
    const std::int64_t rank = this->Members.Rank(place);
    if (rank == DiamondSet::None || this->Queued[rank] || this->Triggers[rank] == 0)
    {
      return;
    }
    this->Queued[rank] = true;
    const ErrorCode::Type code = this->Triggers[rank];
    this->Buckets[code < this->Current ? code : this->Current].push_back(place);
  }

  /** Subdivides a diamond after its parents, at the current tolerance. */
  void Subdivide(const Place& first)
  {
    this->Stack.assign(1, first);
    while (!this->Stack.empty())
    {
      const Place place = this->Stack.back();
      const std::int64_t rank = this->Members.Rank(place);
      const TypeTable& shape = ShapeOf(place.Position);
      if (this->Thresholds[rank] != 0 || !this->PushMissingParents(place, shape))
      {
        this->Stack.pop_back();
        if (this->Thresholds[rank] == 0)
        {
          this->Thresholds[rank] = this->Current;
          this->QueueChildren(place, shape);
        }
      }
    }
  }

  bool PushMissingParents(const Place& place, const TypeTable& shape)
  {
    bool missing = false;
    for (int i = 0; i < shape.ParentCount; ++i)
    {
      const Place parent = ParentPlace(shape, place, i);
      if (parent.Scale < this->Domain.Depth() &&
        this->Domain.IsValid(parent.Position, parent.Scale) &&
        this->Thresholds[this->Members.Rank(parent)] == 0)
      {
        this->Stack.push_back(parent);
        missing = true;
      }
    }
    return missing;
  }

  void QueueChildren(const Place& place, const TypeTable& shape)
  {
    for (int i = 0; i < shape.ChildCount; ++i)
    {
      const Place child = ChildPlace(shape, place, i);
      if (child.Scale >= 0)
      {
        this->Queue(child);
      }
    }
  }

  const Grid& Domain;
  const DiamondSet& Members;
  const std::vector<ErrorCode::Type>& Triggers;
  std::vector<ErrorCode::Type> Thresholds;
  std::vector<bool> Queued;
  std::vector<std::vector<Place>> Buckets;
  std::vector<Place> Stack;
  ErrorCode::Type Current = ErrorCode::Always;
};

}

std::vector<ErrorCode::Type> ActivationThresholds(
  const Grid& grid, const DiamondSet& members, const std::vector<ErrorCode::Type>& triggers)
{
  return FallingWalk(grid, members, triggers).Run();
}

}
