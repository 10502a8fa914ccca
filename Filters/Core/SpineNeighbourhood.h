// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SpineNeighbourhood_h
#define isodiamond_SpineNeighbourhood_h

#include "RefinedSet.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace isodiamond
{

/** A tetrahedron of the hierarchy: one of the halves that its youngest vertex's diamond makes. */
struct HalfPlace
{
  Place Parent; ///< a stored diamond
  std::uint32_t Rank = 0;
  const HalfTetrahedron* Half = nullptr;

  const TypeTable& Shape() const { return ShapeOf(this->Parent.Position); }
  Place Child() const { return ChildPlace(this->Shape(), this->Parent, this->Half->Child); }

  /** Whether it has samples at all of its vertices. */
  bool IsSampled(const Grid& grid) const
  {
    return (this->Half->Mask & ~SampledVertices(grid, this->Parent, this->Shape())) == 0 &&
      grid.IsSampled(Centre(this->Parent));
  }
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

  /** Calls body(tetrahedron) for the tetrahedra of a diamond.
   *  @param onlySampled those that have samples at all of their vertices */
  template <typename Body>
  void ForEachTetrahedron(const Place& diamond, bool onlySampled, Body&& body) const
  {
    const Grid& grid = this->Hierarchy.Domain();
    const TypeTable& shape = ShapeOf(diamond.Position);
    const int h = 1 << diamond.Scale;
    const bool allSampled = grid.IsSampled(Centre(diamond) + Point{ -h, -h, -h }) &&
      grid.IsSampled(Centre(diamond) + Point{ h, h, h });
    for (int i = 0; i < shape.ParentCount; ++i)
    {
      const Place parent = ParentPlace(shape, diamond, i);
      const std::int64_t rank = grid.IsValid(parent.Position, parent.Scale)
        ? this->Hierarchy.Diamonds().Rank(parent)
        : DiamondSet::None;
      if (rank == DiamondSet::None)
      {
        continue;
      }
      const TypeTable& parentShape = ShapeOf(parent.Position);
      const Point offset = diamond.Position + -(1 << parentShape.ChildStep) * parent.Position;
      const auto* const children = parentShape.ChildOffsets.data();
      const std::int64_t child =
        std::find(children, children + parentShape.ChildCount, offset) - children;
      for (int j = 0; j < parentShape.HalfTetrahedraPerChild; ++j)
      {
        const HalfTetrahedron& half =
          parentShape.HalfTetrahedra[child * parentShape.HalfTetrahedraPerChild + j];
        const HalfPlace tetrahedron{ parent, static_cast<std::uint32_t>(rank), &half };
        if (!onlySampled || allSampled || tetrahedron.IsSampled(grid))
        {
          body(tetrahedron);
        }
      }
    }
  }

  /** Replaces a tetrahedron by the one that it is half of. @return false if that is in no mesh with
   *  the diamond's spine */
  bool Coarsen(HalfPlace& tetrahedron, const Place& diamond) const
  {
    const Place& parent = tetrahedron.Parent;
    const Point centre = Centre(parent);
    if (parent.Scale == this->Hierarchy.Domain().Depth() || IsSpineEnd(diamond, centre))
    {
      return false;
    }
    // The other end of the parent's spine instead of its centre.
    const TypeTable& shape = tetrahedron.Shape();
    const bool hasFirst = ((tetrahedron.Half->Mask >> shape.Spine[0]) & 1U) != 0;
    std::array<Point, 4> corners;
    for (int i = 0; i < 3; ++i)
    {
      corners[i] = VertexOf(parent, shape, tetrahedron.Half->Vertices[i]);
    }
    corners[3] = VertexOf(parent, shape, shape.Spine[hasFirst ? 1 : 0]);
    return this->Identify(corners, tetrahedron);
  }

private:
  static Point VertexOf(const Place& place, const TypeTable& shape, int vertex)
  {
    return (1 << place.Scale) * (place.Position + shape.Offsets[vertex]);
  }

  static bool IsSpineEnd(const Place& diamond, const Point& point)
  {
    const TypeTable& shape = ShapeOf(diamond.Position);
    return VertexOf(diamond, shape, shape.Spine[0]) == point ||
      VertexOf(diamond, shape, shape.Spine[1]) == point;
  }

  /** The place of the diamond centred at a lattice point. */
  Place PlaceAt(const Point& point) const
  {
    const int scale = this->Hierarchy.Domain().Scale(point);
    return { scale, { point[0] >> scale, point[1] >> scale, point[2] >> scale } };
  }

  /** Finds the half-tetrahedron that has four given corners. */
  bool Identify(const std::array<Point, 4>& corners, HalfPlace& tetrahedron) const
  {
    const auto age = [&](const Point& corner)
    {
      const Place place = this->PlaceAt(corner);
      return 3 * place.Scale - tables::Parities[Parity(place.Position)].DiamondClass;
    };
    const Point& youngest = *std::min_element(corners.begin(), corners.end(),
      [&](const Point& a, const Point& b) { return age(a) < age(b); });
    tetrahedron.Parent = this->PlaceAt(youngest);
    const std::int64_t rank = this->Hierarchy.Diamonds().Rank(tetrahedron.Parent);
    if (rank == DiamondSet::None)
    {
      return false;
    }
    tetrahedron.Rank = static_cast<std::uint32_t>(rank);
    const TypeTable& shape = tetrahedron.Shape();
    std::uint32_t mask = 0;
    for (int i = 0; i < shape.VertexCount; ++i)
    {
      const Point vertex = VertexOf(tetrahedron.Parent, shape, i);
      mask |= static_cast<std::uint32_t>(
                std::find(corners.begin(), corners.end(), vertex) != corners.end())
        << i;
    }
    const auto* end = shape.HalfTetrahedra.data() + shape.HalfTetrahedronCount;
    tetrahedron.Half = std::find_if(shape.HalfTetrahedra.data(), end,
      [mask](const HalfTetrahedron& half) { return half.Mask == mask; });
    return tetrahedron.Half != end && tetrahedron.IsSampled(this->Hierarchy.Domain());
  }

  const IsodiamondHierarchy& Hierarchy;
};

}

#endif
