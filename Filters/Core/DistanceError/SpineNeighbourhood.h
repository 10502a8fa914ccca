// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SpineNeighbourhood_h
#define isodiamond_SpineNeighbourhood_h

#include "Hierarchy/IsodiamondHierarchy.h"
#include "Lattice/DiamondTetrahedra.h"
#include "Patches/SurfacePatch.h"

#include <array>
#include <cstdint>

namespace isodiamond
{

/** The patch of one of the tetrahedra around a spine. */
struct NumberedPatch
{
  int Number = 0;
  HalfPlace Tetrahedron;
  SurfacePatch Patch; ///< can be empty
};

/** The patches of all tetrahedra that are there. */
class NumberedPatches
{
public:
  void Clear() { this->Count = 0; }
  void Add(const NumberedPatch& patch) { this->All[this->Count++] = patch; }
  bool IsEmpty() const { return this->Count == 0; }
  const NumberedPatch* begin() const { return this->All.data(); }
  const NumberedPatch* end() const { return this->All.data() + this->Count; }

private:
  int Count = 0;
  std::array<NumberedPatch, 8> All;
};

/** The tetrahedra around the spine of a diamond in an RI: its own, and those that can take their
 *  place in a mesh. */
class SpineNeighbourhood
{
public:
  explicit SpineNeighbourhood(const IsodiamondHierarchy& hierarchy)
    : Hierarchy(hierarchy)
  {
  }

  /** Calls body(number, tetrahedron) for those tetrahedra of a diamond that have stored parents,
   *  numbered as by ForEachParentHalf().
   *  @param onlySampled only those that have samples at all of their vertices */
  template <typename Body>
  void ForEachTetrahedron(const Place& diamond, bool onlySampled, Body&& body) const
  {
    const Grid& grid = this->Hierarchy.SampleGrid();
    const int h = 1 << diamond.Scale;
    const bool allSampled = grid.IsSampled(Centre(diamond) + Point{ -h, -h, -h }) &&
      grid.IsSampled(Centre(diamond) + Point{ h, h, h });
    Place last{ -1, {} };
    std::int64_t rank = DiamondSet::None;
    ForEachParentHalf(diamond,
      [&](int number, const Place& parent, const HalfTetrahedron& half)
      {
        if (parent.Scale != last.Scale || parent.Position != last.Position)
        {
          last = parent;
          rank = grid.IsValid(parent.Position, parent.Scale)
            ? this->Hierarchy.Diamonds().Rank(parent)
            : DiamondSet::None;
        }
        const HalfPlace tetrahedron{ parent, static_cast<std::uint32_t>(rank), &half };
        if (rank != DiamondSet::None &&
          (!onlySampled || allSampled || this->IsSampled(tetrahedron)))
        {
          body(number, tetrahedron);
        }
      });
  }

  /** Replaces patches by those of the tetrahedra that have samples at all of their vertices. */
  void FindPatches(const Place& diamond, int surface, NumberedPatches& patches) const
  {
    patches.Clear();
    this->ForEachTetrahedron(diamond, true,
      [&](int number, const HalfPlace& tetrahedron)
      {
        patches.Add({ number, tetrahedron,
          PatchOf(this->Hierarchy, tetrahedron.Rank, *tetrahedron.Half, surface) });
      });
  }

  /** Replaces a tetrahedron by the one that it is half of. @return false if that is in no mesh with
   *  the diamond's spine */
  bool Coarsen(HalfPlace& tetrahedron, const Place& diamond) const
  {
    const Place parent = tetrahedron.Parent;
    if (parent.Scale == this->Hierarchy.SampleGrid().Depth() || IsSpineEnd(diamond, Centre(parent)))
    {
      return false;
    }
    tetrahedron = TetrahedronOf(parent, NumberOfWhole(parent.Position, *tetrahedron.Half));
    const std::int64_t rank =
      this->Hierarchy.SampleGrid().IsValid(tetrahedron.Parent.Position, tetrahedron.Parent.Scale)
      ? this->Hierarchy.Diamonds().Rank(tetrahedron.Parent)
      : DiamondSet::None;
    tetrahedron.Rank = static_cast<std::uint32_t>(rank);
    return rank != DiamondSet::None && this->IsSampled(tetrahedron);
  }

private:
  static bool IsSpineEnd(const Place& diamond, const Point& point)
  {
    const TypeTable& shape = ShapeOf(diamond.Position);
    const auto isAt = [&](int vertex) { return VertexAt(diamond, shape.Offsets[vertex]) == point; };
    return isAt(shape.Spine[0]) || isAt(shape.Spine[1]);
  }

  /** Whether a tetrahedron has samples at all of its vertices. */
  bool IsSampled(const HalfPlace& tetrahedron) const
  {
    const Grid& grid = this->Hierarchy.SampleGrid();
    const std::uint32_t sampled = SampledVertices(grid, tetrahedron.Parent);
    return (tetrahedron.Half->Mask & ~sampled) == 0 && grid.IsSampled(Centre(tetrahedron.Parent));
  }

  const IsodiamondHierarchy& Hierarchy;
};

}

#endif
