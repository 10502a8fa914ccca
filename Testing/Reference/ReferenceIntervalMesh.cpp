// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceIntervalMesh.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

namespace reference
{

namespace
{

using Vector = std::array<double, 3>;

Vector Difference(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/** The determinant of three vectors: positive if they form a right-handed system. */
double Determinant(const Vector& a, const Vector& b, const Vector& c)
{
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Vector ToVector(const Point& point)
{
  return { double(point[0]), double(point[1]), double(point[2]) };
}

double SurfaceValue(const Isorange& range, int surface)
{
  return surface < 0 ? range.Lower : range.Upper;
}

/** Whether a surface separates two signs. */
bool IsCut(int signA, int signB, int surface)
{
  return surface < 0 ? (signA < 0) != (signB < 0) : (signA > 0) != (signB > 0);
}

IntervalPoint LatticeVertex(const Point& vertex)
{
  return { vertex, vertex, 0 };
}

/** The surfaces crossed on the way from one vertex to another, in order. */
std::vector<int> SurfacesBetween(int signFrom, int signTo)
{
  std::vector<int> surfaces;
  for (const int surface : { -1, 1 })
  {
    if (IsCut(signFrom, signTo, surface))
    {
      surfaces.push_back(surface);
    }
  }
  if (signFrom > signTo)
  {
    std::reverse(surfaces.begin(), surfaces.end());
  }
  return surfaces;
}

void SmallestFirst(const Hierarchy& hierarchy, IntervalPolygon& polygon)
{
  const auto isBefore = [&hierarchy](const IntervalPoint& a, const IntervalPoint& b)
  { return ComesBefore(hierarchy, a, b); };
  std::rotate(
    polygon.begin(), std::min_element(polygon.begin(), polygon.end(), isBefore), polygon.end());
}

/** Appends the triangles of a fan around one corner of a polygon. */
void AppendFan(
  const IntervalPolygon& polygon, std::size_t hub, std::vector<IntervalTriangle>& triangles)
{
  const std::size_t size = polygon.size();
  for (std::size_t i = 1; i + 1 < size; ++i)
  {
    triangles.push_back({ polygon[hub], polygon[(hub + i) % size], polygon[(hub + i + 1) % size] });
  }
}

}

bool operator==(const IntervalPoint& a, const IntervalPoint& b)
{
  return a.Younger == b.Younger && a.Older == b.Older && a.Surface == b.Surface;
}

bool operator<(const IntervalPoint& a, const IntervalPoint& b)
{
  return std::tie(a.Younger, a.Older, a.Surface) < std::tie(b.Younger, b.Older, b.Surface);
}

int Coefficient(const ScalarField& field, const Isorange& range, const IntervalPoint& point)
{
  if (point.Surface == 0)
  {
    return 0;
  }
  const Isovertex edge{ point.Younger, point.Older };
  const std::vector<int> surfaces =
    SurfacesBetween(SignOf(field.At(point.Younger), range), SignOf(field.At(point.Older), range));
  std::vector<int> coefficients;
  for (const int surface : surfaces)
  {
    coefficients.push_back(Coefficient(field, SurfaceValue(range, surface), edge));
  }
  if (coefficients.size() == 2 && coefficients[1] <= coefficients[0])
  {
    if (coefficients[0] < 255)
    {
      coefficients[1] = coefficients[0] + 1;
    }
    else
    {
      coefficients = { 254, 255 };
    }
  }
  const auto place = std::find(surfaces.begin(), surfaces.end(), point.Surface);
  if (place == surfaces.end())
  {
    throw std::invalid_argument("the surface does not cut this edge");
  }
  return coefficients[place - surfaces.begin()];
}

std::array<double, 3> Position(
  const ScalarField& field, const Isorange& range, const IntervalPoint& point)
{
  return Position(Isovertex{ point.Younger, point.Older }, Coefficient(field, range, point));
}

bool ComesBefore(const Hierarchy& hierarchy, const IntervalPoint& a, const IntervalPoint& b)
{
  // The larger the age, the younger the vertex.
  const auto rank = [&hierarchy](const IntervalPoint& point)
  {
    return std::make_tuple(point.Surface != 0, -hierarchy.Age(point.Younger),
      -hierarchy.Age(point.Older), point.Surface);
  };
  return rank(a) < rank(b);
}

std::vector<Tetrahedron> SampledLeaves(const Hierarchy& hierarchy, const DiamondSet& subdivided)
{
  std::vector<Tetrahedron> leaves;
  for (const Tetrahedron& leaf : LeafTetrahedra(hierarchy, subdivided))
  {
    if (std::all_of(leaf.Vertices.begin(), leaf.Vertices.end(),
          [&hierarchy](const Point& vertex) { return hierarchy.IsSampled(vertex); }))
    {
      leaves.push_back(leaf);
    }
  }
  return leaves;
}

int LevelOf(const Hierarchy& hierarchy, const Tetrahedron& tetrahedron)
{
  const int diamond = hierarchy.DiamondOf(tetrahedron);
  return diamond < 0 ? hierarchy.BaseExponent() : hierarchy.At(diamond).Level();
}

std::array<int, 4> SignsOf(const ScalarField& field, const Isorange& range, const Tetrahedron& leaf)
{
  std::array<int, 4> signs;
  for (int i = 0; i < 4; ++i)
  {
    signs[i] = SignOf(field.At(leaf.Vertices[i]), range);
  }
  return signs;
}

std::vector<IntervalPoint> PointsOf(const Hierarchy& hierarchy, const ScalarField& field,
  const Isorange& range, const std::vector<Tetrahedron>& leaves)
{
  std::set<IntervalPoint> points;
  for (const Tetrahedron& leaf : leaves)
  {
    for (const IntervalPolygon& face : InsideFaces(hierarchy, leaf, SignsOf(field, range, leaf)))
    {
      points.insert(face.begin(), face.end());
    }
  }
  return std::vector<IntervalPoint>(points.begin(), points.end());
}

std::array<IntervalPolygon, 4> InsideFaces(
  const Hierarchy& hierarchy, const Tetrahedron& leaf, const std::array<int, 4>& signs)
{
  std::array<IntervalPolygon, 4> faces;
  for (int opposite = 0; opposite < 4; ++opposite)
  {
    std::array<int, 3> around{ (opposite + 1) % 4, (opposite + 2) % 4, (opposite + 3) % 4 };
    const Vector origin = ToVector(leaf.Vertices[around[0]]);
    const auto edgeTo = [&](int vertex)
    { return Difference(ToVector(leaf.Vertices[vertex]), origin); };
    if (Determinant(edgeTo(around[1]), edgeTo(around[2]), edgeTo(opposite)) > 0.0)
    {
      std::swap(around[1], around[2]);
    }

    // Once around the face, picking up what is inside the range or on a surface.
    for (int i = 0; i < 3; ++i)
    {
      const int from = around[i];
      const int to = around[(i + 1) % 3];
      if (signs[from] == 0)
      {
        faces[opposite].push_back(LatticeVertex(leaf.Vertices[from]));
      }
      for (const int surface : SurfacesBetween(signs[from], signs[to]))
      {
        const std::array<Point, 2> edge =
          hierarchy.YoungerFirst(leaf.Vertices[from], leaf.Vertices[to]);
        faces[opposite].push_back({ edge[0], edge[1], surface });
      }
    }
    SmallestFirst(hierarchy, faces[opposite]);
  }
  return faces;
}

std::vector<IntervalTriangle> FaceTriangles(
  const Hierarchy& hierarchy, const Tetrahedron& leaf, const std::array<int, 4>& signs)
{
  std::vector<IntervalTriangle> triangles;
  for (const IntervalPolygon& face : InsideFaces(hierarchy, leaf, signs))
  {
    AppendFan(face, 0, triangles);
  }
  return triangles;
}

IntervalPolygon SurfacePolygon(
  const Hierarchy& hierarchy, const Tetrahedron& leaf, const std::array<int, 4>& signs, int surface)
{
  // The surface is the isosurface between the signs below it and those above.
  std::array<int, 4> sides;
  for (int i = 0; i < 4; ++i)
  {
    sides[i] = IsCut(-1, signs[i], surface) ? 1 : 0;
  }
  IntervalPolygon polygon;
  for (const Isovertex& corner : PatchOf(hierarchy, leaf, sides).Corners)
  {
    polygon.push_back({ corner.Younger, corner.Older, surface });
  }
  if (surface > 0)
  {
    // An isosurface is anticlockwise as seen from below, but here the outside is above.
    std::reverse(polygon.begin(), polygon.end());
  }
  SmallestFirst(hierarchy, polygon);
  return polygon;
}

std::vector<IntervalTriangle> BoundaryTriangles(const Hierarchy& hierarchy, const Tetrahedron& leaf,
  const std::array<int, 4>& signs, const Diagonals& diagonals)
{
  std::vector<IntervalTriangle> triangles = FaceTriangles(hierarchy, leaf, signs);
  for (const int surface : { -1, 1 })
  {
    const IntervalPolygon polygon = SurfacePolygon(hierarchy, leaf, signs, surface);
    const bool isOtherDiagonal = surface < 0 ? diagonals.Lower : diagonals.Upper;
    AppendFan(polygon, polygon.size() == 4 && isOtherDiagonal ? 1 : 0, triangles);
  }
  return triangles;
}

double LeafVolume(const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range,
  const Tetrahedron& leaf, const Diagonals& diagonals)
{
  const Vector apex = ToVector(leaf.Vertices[0]);
  double sixfoldVolume = 0.0;
  for (const IntervalTriangle& triangle :
    BoundaryTriangles(hierarchy, leaf, SignsOf(field, range, leaf), diagonals))
  {
    std::array<Vector, 3> edges;
    for (int i = 0; i < 3; ++i)
    {
      edges[i] = Difference(Position(field, range, triangle[i]), apex);
    }
    sixfoldVolume += Determinant(edges[0], edges[1], edges[2]);
  }
  return sixfoldVolume / 6.0;
}

ValueRange LeafVolumes(const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range,
  const Tetrahedron& leaf)
{
  std::vector<double> volumes;
  for (const bool diagonal : { false, true })
  {
    volumes.push_back(LeafVolume(hierarchy, field, range, leaf, { diagonal, diagonal }));
  }
  const auto extremes = std::minmax_element(volumes.begin(), volumes.end());
  return { *extremes.first, *extremes.second };
}

ValueRange VolumesOf(const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range,
  const std::vector<Tetrahedron>& leaves)
{
  ValueRange sum{ 0.0, 0.0 };
  for (const Tetrahedron& leaf : leaves)
  {
    const ValueRange volumes = LeafVolumes(hierarchy, field, range, leaf);
    sum.Minimum += volumes.Minimum;
    sum.Maximum += volumes.Maximum;
  }
  return sum;
}

int CountTetrahedra(const std::array<int, 4>& signs)
{
  const auto count = [&signs](int sign)
  { return static_cast<int>(std::count(signs.begin(), signs.end(), sign)); };
  // By the number of vertices inside, and the smaller of the numbers below and above.
  const std::map<std::array<int, 2>, int> tetrahedra{ { { 4, 0 }, 1 }, { { 3, 0 }, 3 },
    { { 2, 0 }, 3 }, { { 1, 0 }, 1 }, { { 0, 0 }, 0 }, { { 2, 1 }, 5 }, { { 1, 1 }, 5 },
    { { 0, 1 }, 3 }, { { 0, 2 }, 6 } };
  return tetrahedra.at({ count(0), std::min(count(-1), count(1)) });
}

}
