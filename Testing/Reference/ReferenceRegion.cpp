// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceRegion.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace reference
{

namespace
{

using Vector = std::array<double, 3>;

double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Vector ToVector(const Point& point)
{
  return { double(point[0]), double(point[1]), double(point[2]) };
}

/** The points x with Normal * x <= Offset. */
struct HalfSpace
{
  Vector Normal;
  double Offset;
};

/** The half-space that is bounded by the plane of three points and contains a fourth. */
HalfSpace HalfSpaceOf(const std::array<Point, 3>& face, const Point& inside)
{
  std::array<Vector, 2> edges;
  for (int i = 0; i < 2; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      edges[i][axis] = face[i + 1][axis] - face[0][axis];
    }
  }
  HalfSpace halfSpace{ Cross(edges[0], edges[1]), 0.0 };

  // The components are integers. Dividing by their common divisor keeps all that follows small.
  long long divisor = 0;
  for (const double component : halfSpace.Normal)
  {
    divisor = std::gcd(divisor, static_cast<long long>(component));
  }
  for (double& component : halfSpace.Normal)
  {
    component /= static_cast<double>(divisor);
  }
  halfSpace.Offset = Dot(halfSpace.Normal, ToVector(face[0]));
  if (Dot(halfSpace.Normal, ToVector(inside)) > halfSpace.Offset)
  {
    halfSpace.Normal = { -halfSpace.Normal[0], -halfSpace.Normal[1], -halfSpace.Normal[2] };
    halfSpace.Offset = -halfSpace.Offset;
  }
  return halfSpace;
}

void AppendHalfSpaces(const Tetrahedron& tetrahedron, std::vector<HalfSpace>& halfSpaces)
{
  const std::array<Point, 4>& vertices = tetrahedron.Vertices;
  for (int i = 0; i < 4; ++i)
  {
    halfSpaces.push_back(HalfSpaceOf(
      { vertices[(i + 1) % 4], vertices[(i + 2) % 4], vertices[(i + 3) % 4] }, vertices[i]));
  }
}

void AppendHalfSpaces(const Box& box, std::vector<HalfSpace>& halfSpaces)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    Vector normal{ 0.0, 0.0, 0.0 };
    normal[axis] = 1.0;
    halfSpaces.push_back({ normal, box.Maximum[axis] });
    normal[axis] = -1.0;
    halfSpaces.push_back({ normal, -box.Minimum[axis] });
  }
}

/**
 * Whether the planes of three half-spaces meet in a single point that all the others contain. The
 * point is left as a fraction, so that nothing is rounded as long as there are enough bits.
 */
bool HaveVertexAt(
  const std::vector<HalfSpace>& halfSpaces, const std::array<std::size_t, 3>& planes)
{
  const HalfSpace& a = halfSpaces[planes[0]];
  const HalfSpace& b = halfSpaces[planes[1]];
  const HalfSpace& c = halfSpaces[planes[2]];
  const std::array<Vector, 3> products{ Cross(b.Normal, c.Normal), Cross(c.Normal, a.Normal),
    Cross(a.Normal, b.Normal) };
  double denominator = Dot(a.Normal, products[0]);
  if (denominator == 0.0)
  {
    return false;
  }
  const double direction = denominator < 0.0 ? -1.0 : 1.0;
  denominator *= direction;
  Vector numerator;
  for (int axis = 0; axis < 3; ++axis)
  {
    numerator[axis] = direction *
      (a.Offset * products[0][axis] + b.Offset * products[1][axis] + c.Offset * products[2][axis]);
  }

  for (std::size_t i = 0; i < halfSpaces.size(); ++i)
  {
    const bool isOnPlane = std::find(planes.begin(), planes.end(), i) != planes.end();
    const HalfSpace& halfSpace = halfSpaces[i];
    if (!isOnPlane && !(Dot(halfSpace.Normal, numerator) <= halfSpace.Offset * denominator))
    {
      return false;
    }
  }
  return true;
}

/**
 * Whether half-spaces whose intersection is bounded have a common point. If there is one, then the
 * intersection is a polytope, perhaps a flat one, and it has a vertex: a point where three of the
 * planes meet. So all such points are tried.
 */
bool HaveCommonPoint(const std::vector<HalfSpace>& halfSpaces)
{
  for (std::size_t i = 0; i < halfSpaces.size(); ++i)
  {
    for (std::size_t j = i + 1; j < halfSpaces.size(); ++j)
    {
      for (std::size_t k = j + 1; k < halfSpaces.size(); ++k)
      {
        if (HaveVertexAt(halfSpaces, { i, j, k }))
        {
          return true;
        }
      }
    }
  }
  return false;
}

}

bool Touches(const Hierarchy& hierarchy, int diamond, const Box& box)
{
  const std::vector<Tetrahedron>& tetrahedra = hierarchy.At(diamond).Tetrahedra;
  return std::any_of(tetrahedra.begin(), tetrahedra.end(),
    [&box](const Tetrahedron& tetrahedron)
    {
      std::vector<HalfSpace> halfSpaces;
      AppendHalfSpaces(tetrahedron, halfSpaces);
      AppendHalfSpaces(box, halfSpaces);
      return HaveCommonPoint(halfSpaces);
    });
}

DiamondSet CloseOverParents(const Hierarchy& hierarchy, DiamondSet diamonds)
{
  bool hasChanged = true;
  while (hasChanged)
  {
    hasChanged = false;
    for (int index = 0; index < hierarchy.Size(); ++index)
    {
      for (const int parent : hierarchy.At(index).Parents)
      {
        if (diamonds[index] && !diamonds[parent])
        {
          diamonds[parent] = true;
          hasChanged = true;
        }
      }
    }
  }
  return diamonds;
}

DiamondSet RefineRegion(const Hierarchy& hierarchy, const DiamondSet& outside,
  const DiamondSet& inside, const std::vector<Kind>& kinds, const Box& region)
{
  DiamondSet diamonds = outside;
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    const bool isCandidate =
      inside[index] && (kinds[index] == Kind::Active || kinds[index] == Kind::Creation);
    if (isCandidate && Touches(hierarchy, index, region))
    {
      diamonds[index] = true;
    }
  }
  return CloseOverParents(hierarchy, diamonds);
}

}
