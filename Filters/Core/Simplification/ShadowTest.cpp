// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/ShadowTest.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{
namespace
{

/** A part of a triangle's longest side that is not distinguished from nothing. */
constexpr double SlackPart = 1e-9;

/** The least cosine of a direction with a triangle's normal. */
constexpr double LeastUp = 0.3;

/** Lengths of grids are far from what std::hypot() cares for, and takes its time for. */
double LengthOf(double x, double y)
{
  return std::sqrt(x * x + y * y);
}

}

ShadowTest::ShadowTest(const std::vector<Vector>& positions, const LinkedTriangles& mesh,
  const std::vector<double>& allowances)
  : Positions(positions)
  , Mesh(mesh)
  , Allowances(allowances)
  , Shadows(positions.size())
  , Chosen(mesh.Triangles.size())
{
}

/** @return whether the triangle can be seen */
bool ShadowTest::Reset(const std::array<Vector, 3>& corners, const Vector& direction)
{
  ++this->Test;
  this->Origin = corners[0];
  const Vector first = corners[1] - corners[0];
  const Vector second = corners[2] - corners[0];
  this->Axes[0] = Unit(first);
  this->Axes[2] = Unit(Cross(first, second));
  this->Axes[1] = Cross(this->Axes[2], this->Axes[0]);
  const double up = Dot(direction, this->Axes[2]);
  this->Way = (1.0 / up) * direction;
  this->WayLength = std::sqrt(Dot(this->Way, this->Way));
  this->Corners = { { { 0.0, 0.0 }, { Dot(first, this->Axes[0]), 0.0 },
    { Dot(second, this->Axes[0]), Dot(second, this->Axes[1]) } } };
  double longest = 0.0;
  double area = 0.0; // twice
  for (int k = 0; k < 3; ++k)
  {
    const Place& from = this->Corners[k];
    const Place& to = this->Corners[(k + 1) % 3];
    const double length = LengthOf(to[0] - from[0], to[1] - from[1]);
    this->Inward[k] = { (from[1] - to[1]) / length, (to[0] - from[0]) / length };
    longest = std::max(longest, length);
    area += from[0] * to[1] - from[1] * to[0];
  }
  this->Middle = { (this->Corners[1][0] + this->Corners[2][0]) / 3.0, this->Corners[2][1] / 3.0 };
  this->Slack = SlackPart * longest;
  // What is beside a side may be in a corner, whose angle has a sine of at least this.
  const double sine = area / (longest * longest);
  this->Strip = 2.0 * this->Slack / sine;
  return sine > 3.0 * SlackPart && up > LeastUp; // the middle is a third of the height away
}

const ShadowTest::Shadow& ShadowTest::Of(std::uint32_t point)
{
  Shadow& shadow = this->Shadows[point];
  if (shadow.Test != this->Test)
  {
    shadow.Test = this->Test;
    const Vector place = this->Positions[point] - this->Origin;
    const double above = Dot(place, this->Axes[2]);
    const Vector below = place - above * this->Way;
    shadow.At = { Dot(below, this->Axes[0]), Dot(below, this->Axes[1]) };
    shadow.Height = above * this->WayLength;
    shadow.Beyond = 0;
    for (int k = 0; k < 3; ++k)
    {
      const double inside = this->Inward[k][0] * (shadow.At[0] - this->Corners[k][0]) +
        this->Inward[k][1] * (shadow.At[1] - this->Corners[k][1]);
      shadow.Beyond |= inside <= this->Slack ? 1U << k : 0U;
    }
  }
  return shadow;
}

/** Whether an edge may enter the triangle. */
bool ShadowTest::Enters(const Shadow& a, const Shadow& b) const
{
  if ((a.Beyond & b.Beyond) != 0)
  {
    return false;
  }
  // Otherwise the edge's own line separates them, or nothing does.
  const Place along = { b.At[0] - a.At[0], b.At[1] - a.At[1] };
  const double slack = this->Slack * LengthOf(along[0], along[1]);
  bool anyLeft = false;
  bool anyRight = false;
  for (const Place& corner : this->Corners)
  {
    const double left = along[0] * (corner[1] - a.At[1]) - along[1] * (corner[0] - a.At[0]);
    anyLeft = anyLeft || left > slack;
    anyRight = anyRight || left < -slack;
  }
  return anyLeft && anyRight;
}

/** Whether an edge crosses the ray from the middle along x: 1 upwards, -1 downwards, 0 not. */
int ShadowTest::CrossesRay(const Shadow& a, const Shadow& b) const
{
  const bool isAbove = a.At[1] > this->Middle[1];
  if (isAbove == (b.At[1] > this->Middle[1]))
  {
    return 0;
  }
  const Shadow& low = isAbove ? b : a;
  const Shadow& high = isAbove ? a : b;
  const double left = (high.At[0] - low.At[0]) * (this->Middle[1] - low.At[1]) -
    (high.At[1] - low.At[1]) * (this->Middle[0] - low.At[0]);
  return left > 0.0 ? (isAbove ? -1 : 1) : 0;
}

/** Whether the part of a triangle over the other one is near to the other's plane. */
bool ShadowTest::IsLow(std::uint32_t triangle)
{
  const Triangle& points = this->Mesh.Triangles[triangle];
  const std::array<const Shadow*, 3> shadows = { &this->Of(points[0]), &this->Of(points[1]),
    &this->Of(points[2]) };
  const double allowance = this->Allowances[triangle] - this->Strip;
  const auto isLow = [&](const Shadow* shadow) { return std::abs(shadow->Height) <= allowance; };
  if ((shadows[0]->Beyond & shadows[1]->Beyond & shadows[2]->Beyond) != 0 ||
    std::all_of(shadows.begin(), shadows.end(), isLow))
  {
    return true; // the region so near is convex: corners decide
  }
  ClippedCorners corners;
  int count = 0;
  for (const Shadow* shadow : shadows)
  {
    corners[count++] = { shadow->At[0], shadow->At[1], shadow->Height };
  }
  for (int side = 0; side < 3; ++side)
  {
    count = this->Clip(side, corners, count);
  }
  return std::all_of(corners.begin(), corners.begin() + count,
    [&](const Clipped& corner) { return std::abs(corner[2]) <= allowance; });
}

/** Keeps what lies inside a side of the triangle. @return how many corners that has */
int ShadowTest::Clip(int side, ClippedCorners& corners, int count) const
{
  const ClippedCorners all = corners;
  const auto inside = [&](const Clipped& corner)
  {
    return this->Inward[side][0] * (corner[0] - this->Corners[side][0]) +
      this->Inward[side][1] * (corner[1] - this->Corners[side][1]);
  };
  int left = 0;
  for (int i = 0; i < count; ++i)
  {
    const Clipped& from = all[i];
    const Clipped& to = all[i + 1 < count ? i + 1 : 0];
    const double here = inside(from);
    const double there = inside(to);
    if (here >= 0.0)
    {
      corners[left++] = from;
    }
    if ((here >= 0.0) != (there >= 0.0))
    {
      corners[left++] = from + (here / (here - there)) * (to - from);
    }
  }
  return left;
}

bool ShadowTest::Covers(const std::array<Vector, 3>& corners, const Vector& direction,
  std::vector<std::uint32_t>& triangles)
{
  if (!this->Reset(corners, direction))
  {
    return false;
  }
  for (const std::uint32_t triangle : triangles)
  {
    this->Chosen[triangle] = this->Test;
  }
  // The triangle beyond an edge that enters has to be one of them, too.
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    if (!this->IsLow(triangles[i]))
    {
      return false;
    }
    const Triangle& points = this->Mesh.Triangles[triangles[i]];
    for (int k = 0; k < 3; ++k)
    {
      const std::uint32_t beyond = this->Mesh.Neighbours[triangles[i]][k];
      if ((beyond == None || this->Chosen[beyond] != this->Test) &&
        this->Enters(this->Of(points[k]), this->Of(points[(k + 1) % 3])))
      {
        if (beyond == None)
        {
          return false;
        }
        this->Chosen[beyond] = this->Test;
        triangles.push_back(beyond);
      }
    }
  }
  int turns = 0;
  for (const std::uint32_t triangle : triangles)
  {
    const Triangle& points = this->Mesh.Triangles[triangle];
    for (int k = 0; k < 3; ++k)
    {
      const std::uint32_t beyond = this->Mesh.Neighbours[triangle][k];
      if (beyond == None || this->Chosen[beyond] != this->Test)
      {
        turns += this->CrossesRay(this->Of(points[k]), this->Of(points[(k + 1) % 3]));
      }
    }
  }
  return turns == 1;
}

}
