// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondPatches_h
#define isodiamond_DiamondPatches_h

#include "PatchDistance.h"

#include <algorithm>
#include <array>
#include <limits>

namespace isodiamond
{

/**
 * The patches that can be in a mesh around the spine of one diamond, while the diamond itself is
 * not subdivided: those of its tetrahedra, and those of the coarser ones that stand in for them.
 * Each is made when it is first asked for; the object is used for one diamond after the other.
 */
class DiamondPatches
{
public:
  DiamondPatches(const IsodiamondHierarchy& hierarchy, const WorldMetric& metric, int surface)
    : Hierarchy(hierarchy)
    , Neighbourhood(hierarchy)
    , Metric(metric)
    , Surface(surface)
  {
  }

  /** Goes on to another diamond. */
  void Reset(const Place& diamond)
  {
    this->Diamond = diamond;
    this->Count = 0;
    this->Neighbourhood.ForEachTetrahedron(diamond, true,
      [&](int number, const HalfPlace& tetrahedron)
      {
        for (; this->Count < number; ++this->Count)
        {
          this->Entries[this->Count].Tetrahedron.Half = nullptr; // is not there
        }
        Entry& entry = this->Entries[this->Count++];
        entry.Tetrahedron = tetrahedron;
        entry.HasOwn = false;
        entry.HasCoarser = false;
      });
  }

  /** The number of one of the diamond's tetrahedra. */
  int Find(const HalfPlace& tetrahedron) const
  {
    int i = 0;
    while (this->Entries[i].Tetrahedron.Rank != tetrahedron.Rank ||
      this->Entries[i].Tetrahedron.Half != tetrahedron.Half)
    {
      ++i;
    }
    return i;
  }

  /** Whether the diamond has a tetrahedron of a number, with samples at all of its vertices. */
  bool IsThere(int tetrahedron) const
  {
    return tetrahedron < this->Count && this->Entries[tetrahedron].Tetrahedron.Half != nullptr;
  }

  /** The squared distance to the patch of a tetrahedron; infinite if it has none. */
  double SquaredTo(int tetrahedron, const Vector& point)
  {
    return SquaredTo(this->Own(this->Entries[tetrahedron]), point);
  }

  /**
   * The squared distance to the nearest patch that is in every mesh that a tetrahedron is in; or to
   * some that is near enough.
   *
   * @param own the squared distance to the tetrahedron's own patch
   */
  double SquaredToNearest(int tetrahedron, const Vector& point, double own, double enough)
  {
    const std::uint32_t parent = this->Entries[tetrahedron].Tetrahedron.Rank;
    double nearest = own;
    for (int i = 0; i < this->Count && nearest > enough; ++i) // the mate: in the mesh as well
    {
      if (this->IsThere(i) && this->Entries[i].Tetrahedron.Rank == parent && i != tetrahedron)
      {
        nearest = std::min(nearest, this->SquaredTo(i, point));
      }
    }
    for (int i = 0; i < this->Count && nearest > enough; ++i)
    {
      if (this->IsThere(i) && this->Entries[i].Tetrahedron.Rank != parent)
      {
        nearest = std::min(nearest, this->SquaredToFarthest(this->Entries[i], point, nearest));
      }
    }
    return nearest;
  }

private:
  /** Edges are as long as the spine for at most three generations. */
  static constexpr int MostCoarser = 3;

  struct Entry
  {
    HalfPlace Tetrahedron;
    bool HasOwn = false;
    bool HasCoarser = false;
    int CoarserCount = 0;
    PatchDistance Own;
    std::array<PatchDistance, MostCoarser> Coarser; ///< what can be in its place
  };

  static double SquaredTo(const PatchDistance& patch, const Vector& point)
  {
    return patch.IsEmpty() ? std::numeric_limits<double>::infinity() : patch.Squared(point);
  }

  const PatchDistance& Own(Entry& entry)
  {
    if (!entry.HasOwn)
    {
      entry.HasOwn = true;
      entry.Own.Reset(this->Hierarchy, this->Metric, entry.Tetrahedron, this->Surface);
    }
    return entry.Own;
  }

  /** To the farthest of what can be in a tetrahedron's place; or some that is not nearer than
   *  others. */
  double SquaredToFarthest(Entry& entry, const Vector& point, double others)
  {
    double farthest = SquaredTo(this->Own(entry), point);
    if (farthest < others && !entry.HasCoarser)
    {
      this->MakeCoarser(entry);
    }
    for (int i = 0; farthest < others && i < entry.CoarserCount; ++i)
    {
      farthest = std::max(farthest, SquaredTo(entry.Coarser[i], point));
    }
    return farthest;
  }

  void MakeCoarser(Entry& entry)
  {
    entry.HasCoarser = true;
    entry.CoarserCount = 0;
    HalfPlace coarser = entry.Tetrahedron;
    while (entry.CoarserCount < MostCoarser && this->Neighbourhood.Coarsen(coarser, this->Diamond))
    {
      entry.Coarser[entry.CoarserCount++].Reset(
        this->Hierarchy, this->Metric, coarser, this->Surface);
    }
  }

  const IsodiamondHierarchy& Hierarchy;
  SpineNeighbourhood Neighbourhood;
  const WorldMetric& Metric;
  int Surface;
  Place Diamond;
  int Count = 0;
  std::array<Entry, 8> Entries;
};

}

#endif
