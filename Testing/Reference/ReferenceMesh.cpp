// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceMesh.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace reference
{

namespace
{

using Vector = std::array<long long, 3>;

Vector Difference(const Point& a, const Point& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/** The determinant of three vectors: positive if they form a right-handed system. */
long long Determinant(const Vector& a, const Vector& b, const Vector& c)
{
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/** The middle of the edge of an isovertex, in doubled coordinates. */
Point DoubledMiddle(const Isovertex& isovertex)
{
  return Sum(isovertex.Younger, isovertex.Older);
}

/**
 * Orders the corners so that the normal points from an upper to a lower vertex. With the
 * isovertices at the middles of their edges the patch is planar and all upper vertices are on one
 * side of it; moving isovertices along their edges does not turn it over.
 */
void Orient(std::vector<Isovertex>& corners, const Point& upper, const Point& lower)
{
  const Point origin = DoubledMiddle(corners[0]);
  const Vector first = Difference(DoubledMiddle(corners[1]), origin);
  const Vector second = Difference(DoubledMiddle(corners[2]), origin);
  if (Determinant(first, second, Difference(lower, upper)) < 0)
  {
    std::reverse(corners.begin(), corners.end());
  }
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
}

void CollectLeaves(const Hierarchy& hierarchy, const DiamondSet& subdivided,
  const Tetrahedron& tetrahedron, std::vector<Tetrahedron>& leaves)
{
  if (!hierarchy.BelongsToGrid(tetrahedron))
  {
    return;
  }
  const int diamond = hierarchy.DiamondOf(tetrahedron);
  if (diamond < 0 || !subdivided[diamond])
  {
    leaves.push_back(tetrahedron);
    return;
  }
  for (const Tetrahedron& half : Hierarchy::Bisect(tetrahedron))
  {
    CollectLeaves(hierarchy, subdivided, half, leaves);
  }
}

}

bool operator==(const Isovertex& a, const Isovertex& b)
{
  return a.Younger == b.Younger && a.Older == b.Older;
}

bool operator<(const Isovertex& a, const Isovertex& b)
{
  return std::tie(a.Younger, a.Older) < std::tie(b.Younger, b.Older);
}

bool operator==(const Patch& a, const Patch& b)
{
  return a.Corners == b.Corners && a.DoubledCenter == b.DoubledCenter && a.Level == b.Level;
}

bool operator<(const Patch& a, const Patch& b)
{
  return std::tie(a.Corners, a.DoubledCenter, a.Level) <
    std::tie(b.Corners, b.DoubledCenter, b.Level);
}

int Coefficient(const ScalarField& field, double isovalue, const Isovertex& isovertex)
{
  const double younger = field.At(isovertex.Younger);
  const double older = field.At(isovertex.Older);
  if (!std::isfinite(younger) || !std::isfinite(older))
  {
    return 128;
  }
  const double fraction = (isovalue - younger) / (older - younger);
  return static_cast<int>(std::clamp(std::floor(256.0 * fraction + 0.5), 1.0, 255.0));
}

std::array<double, 3> Position(const Isovertex& isovertex, int coefficient)
{
  std::array<double, 3> position;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double from = isovertex.Younger[axis];
    const double to = isovertex.Older[axis];
    position[axis] = from + (to - from) * coefficient / 256.0;
  }
  return position;
}

Patch PatchOf(
  const Hierarchy& hierarchy, const Tetrahedron& tetrahedron, const std::array<int, 4>& signs)
{
  std::vector<Point> upper;
  std::vector<Point> lower;
  for (int i = 0; i < 4; ++i)
  {
    (signs[i] == 1 ? upper : lower).push_back(tetrahedron.Vertices[i]);
  }
  const auto cut = [&hierarchy](const Point& a, const Point& b)
  {
    const std::array<Point, 2> edge = hierarchy.YoungerFirst(a, b);
    return Isovertex{ edge[0], edge[1] };
  };

  const std::array<Point, 2> spine = tetrahedron.LongestEdge();
  const int diamond = hierarchy.DiamondOf(tetrahedron);
  Patch patch;
  patch.DoubledCenter = Sum(spine[0], spine[1]);
  patch.Level = diamond < 0 ? hierarchy.BaseExponent() : hierarchy.At(diamond).Level();
  if (upper.empty() || lower.empty())
  {
    return patch;
  }
  if (upper.size() == 2)
  {
    patch.Corners = { cut(upper[0], lower[0]), cut(upper[0], lower[1]), cut(upper[1], lower[1]),
      cut(upper[1], lower[0]) };
  }
  else
  {
    for (const Point& above : upper)
    {
      for (const Point& below : lower)
      {
        patch.Corners.push_back(cut(above, below));
      }
    }
  }
  Orient(patch.Corners, upper[0], lower[0]);
  return patch;
}

std::vector<Tetrahedron> LeafTetrahedra(const Hierarchy& hierarchy, const DiamondSet& subdivided)
{
  std::vector<Tetrahedron> leaves;
  for (const Tetrahedron& tetrahedron : hierarchy.BaseTetrahedra())
  {
    CollectLeaves(hierarchy, subdivided, tetrahedron, leaves);
  }
  return leaves;
}

std::vector<Patch> LeafPatches(const Hierarchy& hierarchy, const ScalarField& field,
  double isovalue, const DiamondSet& subdivided)
{
  std::vector<Patch> patches;
  for (const Tetrahedron& leaf : LeafTetrahedra(hierarchy, subdivided))
  {
    const bool isSampled = std::all_of(leaf.Vertices.begin(), leaf.Vertices.end(),
      [&hierarchy](const Point& vertex) { return hierarchy.IsSampled(vertex); });
    if (!isSampled)
    {
      continue;
    }
    std::array<int, 4> signs;
    for (int i = 0; i < 4; ++i)
    {
      signs[i] = SignOf(field.At(leaf.Vertices[i]), isovalue);
    }
    const Patch patch = PatchOf(hierarchy, leaf, signs);
    if (!patch.Corners.empty())
    {
      patches.push_back(patch);
    }
  }
  std::sort(patches.begin(), patches.end());
  return patches;
}

std::vector<Patch> FullResolutionPatches(
  const Hierarchy& hierarchy, const ScalarField& field, double isovalue)
{
  return LeafPatches(hierarchy, field, isovalue, DiamondSet(hierarchy.Size(), true));
}

int CountTriangles(const std::vector<Patch>& patches)
{
  int count = 0;
  for (const Patch& patch : patches)
  {
    count += static_cast<int>(patch.Corners.size()) - 2;
  }
  return count;
}

std::vector<Isovertex> IsoverticesOf(const std::vector<Patch>& patches)
{
  std::set<Isovertex> isovertices;
  for (const Patch& patch : patches)
  {
    isovertices.insert(patch.Corners.begin(), patch.Corners.end());
  }
  return std::vector<Isovertex>(isovertices.begin(), isovertices.end());
}

}
