// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Bisection_h
#define isodiamond_Bisection_h

#include "DistanceError/SpineNeighbourhood.h"
#include "Patches/ExactPlane.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/**
 * @file Bisection.h
 * The tree of bisected tetrahedra, and what lies in which of them, exactly.
 */
namespace isodiamond
{

/** Whether a tetrahedron belongs to the grid: its bounding box shares volume with the grid's. */
inline bool IsInGrid(const Grid& grid, const HalfPlace& tetrahedron)
{
  const int h = 1 << tetrahedron.Parent.Scale;
  const TypeTable& shape = tetrahedron.Shape();
  for (int axis = 0; axis < 3; ++axis)
  {
    int low = 0; // offsets from the centre, which is a corner
    int high = 0;
    for (const std::uint8_t vertex : tetrahedron.Half->Vertices)
    {
      low = std::min(low, shape.Offsets[vertex][axis]);
      high = std::max(high, shape.Offsets[vertex][axis]);
    }
    const int centre = h * tetrahedron.Parent.Position[axis];
    if (centre + h * low >= grid.Last(axis) || centre + h * high <= 0)
    {
      return false;
    }
  }
  return true;
}

/** Some positions as rows of coordinates, for loops that compilers vectorize. They are relative to
 * a place nearer to them than 2^20 units: so 32-bit numbers are exact where a plane is near, and
 * have the right sign where it is far. */
class PositionRows
{
public:
  void Fill(const std::vector<FinePosition>& positions, const FinePosition& from)
  {
    this->Origin = from;
    this->Count = positions.size();
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Rows[axis].resize(this->Count);
      for (std::size_t i = 0; i < this->Count; ++i)
      {
        this->Rows[axis][i] = static_cast<float>(positions[i][axis] - from[axis]);
      }
    }
  }

  std::size_t Size() const { return this->Count; }

  /** Lowers numbers, one per position, to how far that is on the positive side of a plane. */
  void LowerToSide(const ExactPlane& plane, float* least) const
  {
    const float* const x = this->Rows[0].data();
    const float* const y = this->Rows[1].data();
    const float* const z = this->Rows[2].data();
    const auto [a, b, c] = plane.Across();
    const auto nx = static_cast<float>(a);
    const auto ny = static_cast<float>(b);
    const auto nz = static_cast<float>(c);
    const auto offset = static_cast<float>(plane.Side(this->Origin));
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      const float side = nx * x[i] + ny * y[i] + nz * z[i] + offset;
      least[i] = side < least[i] ? side : least[i];
    }
  }

private:
  FinePosition Origin{};
  std::size_t Count = 0;
  std::array<std::vector<float>, 3> Rows;
};

/** A closed tetrahedron; tells exactly what lies in it. */
class ClosedTetrahedron
{
public:
  ClosedTetrahedron() = default;

  explicit ClosedTetrahedron(const HalfPlace& tetrahedron)
  {
    const TypeTable& shape = tetrahedron.Shape();
    const Point centre = Centre(tetrahedron.Parent);
    const int h = 1 << tetrahedron.Parent.Scale;
    std::array<Point, 4> corners{}; // as offsets from the centre
    for (int i = 0; i < 3; ++i)
    {
      corners[i + 1] = shape.Offsets[tetrahedron.Half->Vertices[i]];
    }
    for (int opposite = 0; opposite < 4; ++opposite)
    {
      const Point& origin = corners[(opposite + 1) % 4];
      ExactPlane& face = this->Faces[opposite];
      face = ExactPlane(centre + h * origin, corners[(opposite + 2) % 4] + -1 * origin,
        corners[(opposite + 3) % 4] + -1 * origin);
      face.TurnTo(centre + h * corners[opposite]);
    }
  }

  bool Holds(const FinePosition& position) const
  {
    return std::all_of(this->Faces.begin(), this->Faces.end(),
      [&](const ExactPlane& face) { return face.Side(position) >= 0; });
  }

  /** The corners of the tetrahedron's smallest face, edge or vertex that a position in it lies on,
   *  as a mask: bit 0 for the centre, then the vertices. For eight positions or fewer, in short
   *  loops that compilers vectorize. @pre the scale is 8 at most: 32-bit numbers are exact then */
  std::array<std::uint32_t, 8> CornersAround(const FinePosition* positions, int count) const
  {
    std::array<float, 8> x{};
    std::array<float, 8> y{};
    std::array<float, 8> z{};
    const FinePosition& origin = this->Faces[0].Start();
    for (int i = 0; i < count; ++i)
    {
      x[i] = static_cast<float>(positions[i][0] - origin[0]);
      y[i] = static_cast<float>(positions[i][1] - origin[1]);
      z[i] = static_cast<float>(positions[i][2] - origin[2]);
    }
    std::array<std::uint32_t, 8> corners{};
    for (int opposite = 0; opposite < 4; ++opposite)
    {
      const ExactPlane& face = this->Faces[opposite];
      const std::array<float, 3> normal = { static_cast<float>(face.Across()[0]),
        static_cast<float>(face.Across()[1]), static_cast<float>(face.Across()[2]) };
      const auto offset = static_cast<float>(face.Side(origin));
      for (int i = 0; i < 8; ++i)
      {
        const float side = normal[0] * x[i] + normal[1] * y[i] + normal[2] * z[i] + offset;
        corners[i] |= (side != 0.0F ? 1U : 0U) << opposite;
      }
    }
    return corners;
  }

  /** Sets numbers, one per position: not negative where the tetrahedron holds that. */
  void FindHeld(const PositionRows& rows, std::vector<float>& sides) const
  {
    sides.assign(rows.Size(), std::numeric_limits<float>::max());
    for (const ExactPlane& face : this->Faces)
    {
      rows.LowerToSide(face, sides.data());
    }
  }

  /** Whether all of a box lies in it. */
  bool HoldsAll(const FineBox& box) const
  {
    return std::all_of(this->Faces.begin(), this->Faces.end(),
      [&](const ExactPlane& face) { return face.Sides(box)[0] >= 0; });
  }

  /** False only if no part of a box lies in it. */
  bool MayHold(const FineBox& box) const
  {
    return std::all_of(this->Faces.begin(), this->Faces.end(),
      [&](const ExactPlane& face) { return face.Sides(box)[1] >= 0; });
  }

private:
  std::array<ExactPlane, 4> Faces; ///< positive inside
};

/** The edges of a tetrahedron between two or three of its corners, as a mask. */
inline std::uint32_t EdgesBetween(std::uint32_t corners)
{
  // The edges by their ends, in the order of a half-tetrahedron's edges.
  constexpr std::array<std::uint32_t, 6> ends = { 0b0011, 0b0101, 0b1001, 0b1100, 0b1010, 0b0110 };
  std::uint32_t edges = 0;
  for (std::size_t i = 0; i < ends.size() && corners != 0b1111; ++i)
  {
    edges |= ((ends[i] & ~corners) == 0 ? 1U : 0U) << i;
  }
  return edges;
}

/**
 * Bisects a tetrahedron: calls body(half, plane) for those of its halves that lie in the grid, with
 * the plane between them, whose positive side is the half's.
 *
 * @param diamond,rank the diamond that the tetrahedron lies in; its centre is the halves' youngest
 *        vertex
 */
template <typename Body>
void ForEachHalf(const Grid& grid, const HalfPlace& tetrahedron, const Place& diamond,
  std::uint32_t rank, Body&& body)
{
  // The corners of the tetrahedron among the diamond's vertices.
  const TypeTable& shape = ShapeOf(diamond.Position);
  const int ratio = 1 << (tetrahedron.Parent.Scale - diamond.Scale);
  const Point toParent = ratio * tetrahedron.Parent.Position + -1 * diamond.Position;
  const auto vertexAt = [&](const Point& offset)
  { return 1U << VertexIndex(diamond.Position, offset); };
  std::uint32_t corners = vertexAt(toParent);
  for (int i = 0; i < 3; ++i)
  {
    const Point& offset = tetrahedron.Shape().Offsets[tetrahedron.Half->Vertices[i]];
    corners |= vertexAt(toParent + ratio * offset);
  }
  const std::uint32_t ends = (1U << shape.Spine[0]) | (1U << shape.Spine[1]);
  const std::uint32_t ring = corners & ~ends;
  ExactPlane plane(
    Centre(diamond), shape.Offsets[LowestBit(ring)], shape.Offsets[LowestBit(ring & (ring - 1))]);
  for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
  {
    const HalfTetrahedron& half = shape.HalfTetrahedra[i];
    if ((half.Mask & ring) == ring)
    {
      const int end = (half.Mask >> shape.Spine[0] & 1U) != 0 ? 0 : 1;
      const Point at = Centre(diamond) + (1 << diamond.Scale) * shape.Offsets[shape.Spine[end]];
      const HalfPlace place{ diamond, rank, &half };
      if (IsInGrid(grid, place))
      {
        plane.TurnTo(at);
        body(place, plane);
      }
    }
  }
}

}

#endif
