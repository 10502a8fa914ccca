// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/RegionOfInterest.h"

#include "Field/Vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace isodiamond
{
namespace
{

/** The smallest box in the world around a box of lattice points. Each coordinate grows or falls
 * with each index, and the sign tells at which corners it is least and greatest; also if rounded.
 */
Box BoundsOf(const Point& minimum, const Point& maximum, const AffineMap& world)
{
  Box bounds;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::array<double, 4>& row = world.Rows[axis];
    Point least{};
    Point greatest{};
    for (int i = 0; i < 3; ++i)
    {
      least[i] = row[i] < 0.0 ? maximum[i] : minimum[i];
      greatest[i] = row[i] < 0.0 ? minimum[i] : maximum[i];
    }
    bounds.Minimum[axis] = world.At(axis, least[0], least[1], least[2]);
    bounds.Maximum[axis] = world.At(axis, greatest[0], greatest[1], greatest[2]);
  }
  return bounds;
}

/** For each side of the box, whether a point lies beyond it: if all corners of a cell lie beyond
 *  the same side, the box is apart from the cell. */
unsigned SidesBeyond(const Box& box, const Vector& point)
{
  unsigned sides = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    sides |= (point[axis] < box.Minimum[axis] ? 1U : 0U) << (2 * axis);
    sides |= (point[axis] > box.Maximum[axis] ? 2U : 0U) << (2 * axis);
  }
  return sides;
}

}

Box IndexBoxOf(const Box& box, const GridGeometry& world)
{
  const Point size = world.Dimensions() + 2 * world.Padding() * Point{ 1, 1, 1 };
  const auto row = static_cast<std::size_t>(size[0]);
  const auto slice = row * size[1];
  std::vector<unsigned> sides(2 * slice); // of two slices in turn
  Box result{ { HUGE_VAL, HUGE_VAL, HUGE_VAL }, { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL } };
  for (int z = 0; z < size[2]; ++z)
  {
    unsigned* above = sides.data() + (z & 1) * slice;
    const unsigned* below = sides.data() + (1 - (z & 1)) * slice;
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        const Point end = { x, y, z };
        const std::size_t i = y * row + x;
        above[i] = SidesBeyond(box, world.PaddedAt(end));
        // The cell that ends here.
        if (x == 0 || y == 0 || z == 0 ||
          (above[i] & above[i - 1] & above[i - row] & above[i - row - 1] & below[i] & below[i - 1] &
            below[i - row] & below[i - row - 1]) != 0)
        {
          continue;
        }
        for (int axis = 0; axis < 3; ++axis)
        {
          result.Minimum[axis] = std::min(result.Minimum[axis], end[axis] - 1.0);
          result.Maximum[axis] = std::max(result.Maximum[axis], 1.0 * end[axis]);
        }
      }
    }
  }
  return result;
}

RegionOfInterest::RegionOfInterest(const Box& box, const Grid& grid, const AffineMap& world)
  : Domain(grid)
  , World(world)
  , Bounds(box)
  , Empty(box.IsEmpty())
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::isnan(box.Minimum[axis]) || std::isnan(box.Maximum[axis]))
    {
      throw std::invalid_argument("The region of interest has a bound that is not a number.");
    }
  }
  // Bounds beyond the base cube, even infinite ones, become the cube's: no diamond is outside.
  const int last = 1 << grid.Depth();
  const Box cube = BoundsOf({ 0, 0, 0 }, { last, last, last }, world);
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Bounds.Minimum[axis] = std::max(box.Minimum[axis], cube.Minimum[axis]);
    this->Bounds.Maximum[axis] = std::min(box.Maximum[axis], cube.Maximum[axis]);
    this->Slack =
      std::max({ this->Slack, std::fabs(cube.Minimum[axis]), std::fabs(cube.Maximum[axis]) });
  }
  this->Slack *= 1e-14;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Bounds.Minimum[axis] -= this->Slack;
    this->Bounds.Maximum[axis] += this->Slack;
  }
  this->Empty = this->Empty || this->Bounds.IsEmpty();
}

RegionOfInterest::Relation RegionOfInterest::Compare(
  const Point& minimum, const Point& maximum) const
{
  const Box bounds = BoundsOf(minimum, maximum, this->World);
  bool within = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (this->Empty || bounds.Minimum[axis] > this->Bounds.Maximum[axis] ||
      bounds.Maximum[axis] < this->Bounds.Minimum[axis])
    {
      return Relation::Apart;
    }
    within = within && bounds.Minimum[axis] >= this->Bounds.Minimum[axis] &&
      bounds.Maximum[axis] <= this->Bounds.Maximum[axis];
  }
  return within ? Relation::Within : Relation::Unclear;
}

RegionOfInterest::Relation RegionOfInterest::OfBrick(int scale, const Point& origin) const
{
  return this->Compare(
    (1 << scale) * (origin + Point{ -1, -1, -1 }), (1 << scale) * (origin + Point{ 8, 8, 8 }));
}

bool RegionOfInterest::Touches(const Place& place) const
{
  const int h = 1 << place.Scale;
  const Point centre = Centre(place);
  const Relation relation = this->Compare(centre + Point{ -h, -h, -h }, centre + Point{ h, h, h });
  if (relation != Relation::Unclear)
  {
    return relation == Relation::Within;
  }
  // The tetrahedra: a half of each, with the other end of the spine instead of the centre.
  const TypeTable& shape = ShapeOf(place.Position);
  const auto vertexAt = [&](int vertex) { return centre + h * shape.Offsets[vertex]; };
  for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
  {
    const HalfTetrahedron& half = shape.HalfTetrahedra[i];
    if (((half.Mask >> shape.Spine[0]) & 1U) != 0 &&
      this->TouchesTetrahedron({ vertexAt(shape.Spine[1]), vertexAt(half.Vertices[0]),
        vertexAt(half.Vertices[1]), vertexAt(half.Vertices[2]) }))
    {
      return true;
    }
  }
  return false;
}

/** By separating axes: two convex polyhedra are apart if and only if they are so along a normal of
 *  a face of one of them, or along the cross product of an edge of one and an edge of the other. */
bool RegionOfInterest::TouchesTetrahedron(const std::array<Point, 4>& corners) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] =
      std::minmax({ corners[0][axis], corners[1][axis], corners[2][axis], corners[3][axis] });
    if (high <= 0 || low >= this->Domain.Last(axis))
    {
      return false; // not in the grid
    }
  }
  std::array<Vector, 4> points{};
  for (int i = 0; i < 4; ++i)
  {
    points[i] = this->World(corners[i][0], corners[i][1], corners[i][2]);
    if (SidesBeyond(this->Bounds, points[i]) == 0)
    {
      return true; // as do most that touch it
    }
  }
  const auto isSeparating = [&](const Vector& axis)
  {
    double regionLow = 0.0;
    double regionHigh = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      regionLow += axis[i] * (axis[i] < 0.0 ? this->Bounds.Maximum[i] : this->Bounds.Minimum[i]);
      regionHigh += axis[i] * (axis[i] < 0.0 ? this->Bounds.Minimum[i] : this->Bounds.Maximum[i]);
    }
    const auto [low, high] = std::minmax(
      { Dot(axis, points[0]), Dot(axis, points[1]), Dot(axis, points[2]), Dot(axis, points[3]) });
    return low > regionHigh || high < regionLow;
  };
  constexpr std::array<Vector, 3> boxAxes = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  for (const Vector& axis : boxAxes)
  {
    if (isSeparating(axis))
    {
      return false;
    }
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        if (isSeparating(Cross(axis, points[i] - points[j])))
        {
          return false;
        }
      }
    }
  }
  for (int opposite = 0; opposite < 4; ++opposite)
  {
    const Vector& a = points[(opposite + 1) % 4];
    if (isSeparating(Cross(points[(opposite + 2) % 4] - a, points[(opposite + 3) % 4] - a)))
    {
      return false;
    }
  }
  return true;
}

}
