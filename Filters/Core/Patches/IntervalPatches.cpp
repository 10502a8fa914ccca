// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/IntervalPatches.h"

#include "Field/Isoregion.h"

#include <algorithm>
#include <stdexcept>

namespace isodiamond
{
namespace
{

using Triangle = std::array<PatchPoint, 3>;

/** The sign of the permutation that puts four different vertices in order; 0 if two are equal. */
int PermutationSign(const std::array<int, 4>& vertices)
{
  int sign = 1;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      if (vertices[i] == vertices[j])
      {
        return 0;
      }
      sign = vertices[i] > vertices[j] ? -sign : sign;
    }
  }
  return sign;
}

/** Appends the isovertices on the way from one vertex to another. */
void AddCrossings(const PatchSigns& signs, int from, int to, std::vector<PatchPoint>& points)
{
  for (int surface = signs[from]; surface < signs[to]; ++surface)
  {
    points.push_back(PatchPoint::Isovertex(from, to, surface));
  }
  for (int surface = signs[from] - 1; surface >= signs[to]; --surface)
  {
    points.push_back(PatchPoint::Isovertex(from, to, surface));
  }
}

/** A polygon as a fan from its smallest point. */
void AddFan(std::vector<PatchPoint> polygon, std::vector<Triangle>& triangles)
{
  if (polygon.empty())
  {
    return;
  }
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
  {
    triangles.push_back({ polygon[0], polygon[i], polygon[i + 1] });
  }
}

/** The polygon on a surface: its edges are the ends of the faces' polygons, turned round. */
std::vector<PatchPoint> SurfacePolygon(const PatchSigns& signs, int surface)
{
  std::vector<std::array<PatchPoint, 2>> edges;
  const auto isOnSurface = [surface](const PatchPoint& point)
  { return !point.IsVertex() && point.Surface() == surface; };
  for (int opposite = 0; opposite < 4; ++opposite)
  {
    const std::vector<PatchPoint> face = FacePolygon(signs, opposite);
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      const PatchPoint& next = face[(i + 1) % face.size()];
      const bool sameEdge = face[i].Younger() == next.Younger() && face[i].Older() == next.Older();
      if (isOnSurface(face[i]) && isOnSurface(next) && !sameEdge)
      {
        edges.push_back({ next, face[i] });
      }
    }
  }
  std::vector<PatchPoint> polygon;
  while (!edges.empty() && polygon.size() < edges.size())
  {
    const PatchPoint last = polygon.empty() ? edges[0][0] : polygon.back();
    const auto edge = std::find_if(edges.begin(), edges.end(),
      [&](const std::array<PatchPoint, 2>& candidate) { return candidate[0] == last; });
    polygon.push_back((*edge)[1]);
  }
  return polygon;
}

/** Fills a closed surface of oriented triangles with safe tetrahedra. */
class PatchSearch
{
public:
  PatchSearch(const PatchSigns& signs, const std::vector<Triangle>& boundary)
    : Signs(signs)
    , Front(boundary)
  {
    for (const Triangle& triangle : boundary)
    {
      this->Points.insert(this->Points.end(), triangle.begin(), triangle.end());
    }
    std::sort(this->Points.begin(), this->Points.end());
    this->Points.erase(std::unique(this->Points.begin(), this->Points.end()), this->Points.end());
  }

  /** Looks for a filling of at most so many tetrahedra. */
  bool Run(int most) { return this->Fill(most); }

  const std::vector<PatchTetrahedron>& Result() const { return this->Tetrahedra; }

private:
  bool Fill(int most)
  {
    if (this->Front.empty())
    {
      return true;
    }
    if (most == 0)
    {
      return false;
    }
    const std::vector<Triangle> front = this->Front;
    const Triangle base = front.back();
    for (const PatchPoint& apex : this->Points)
    {
      // Triangles of the front point outward, so the tetrahedron lies on the other side.
      const PatchTetrahedron tetrahedron = { base[0], base[2], base[1], apex };
      if (SafeOrientation(this->Signs, tetrahedron) == 1)
      {
        this->Front = front;
        this->Remove(base, apex);
        this->Tetrahedra.push_back(tetrahedron);
        if (this->Fill(most - 1))
        {
          return true;
        }
        this->Tetrahedra.pop_back();
      }
    }
    this->Front = front;
    return false;
  }

  /** Takes a tetrahedron off: its faces on the front go, the others become the front. */
  void Remove(const Triangle& base, const PatchPoint& apex)
  {
    this->Front.pop_back();
    for (int i = 0; i < 3; ++i)
    {
      const Triangle inner = { base[i], base[(i + 1) % 3], apex };
      const Triangle outer = { inner[1], inner[0], inner[2] };
      const auto same = std::find_if(this->Front.begin(), this->Front.end(),
        [&](const Triangle& triangle) { return IsSame(triangle, outer); });
      if (same != this->Front.end())
      {
        this->Front.erase(same);
      }
      else
      {
        this->Front.push_back(inner);
      }
    }
  }

  /** Whether two triangles have the same points in the same sense. */
  static bool IsSame(const Triangle& a, const Triangle& b)
  {
    for (int turn = 0; turn < 3; ++turn)
    {
      if (a[0] == b[turn] && a[1] == b[(turn + 1) % 3] && a[2] == b[(turn + 2) % 3])
      {
        return true;
      }
    }
    return false;
  }

  const PatchSigns& Signs;
  std::vector<PatchPoint> Points;
  std::vector<Triangle> Front;
  std::vector<PatchTetrahedron> Tetrahedra;
};

/** The fewest safe tetrahedra, over both diagonals of every quadrilateral on a surface. */
std::vector<PatchTetrahedron> FindPatch(const PatchSigns& signs)
{
  std::vector<Triangle> faces;
  for (int opposite = 0; opposite < 4; ++opposite)
  {
    AddFan(FacePolygon(signs, opposite), faces);
  }
  if (faces.empty())
  {
    return {};
  }
  constexpr int most = 6;
  for (int size = 1; size <= most; ++size)
  {
    for (int diagonals = 0; diagonals < 4; ++diagonals)
    {
      std::vector<Triangle> boundary = faces;
      for (int surface = 0; surface < 2; ++surface)
      {
        const std::vector<PatchPoint> polygon = SurfacePolygon(signs, surface);
        const int first = (diagonals >> surface) & 1;
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        {
          boundary.push_back({ polygon[first], polygon[(first + i) % polygon.size()],
            polygon[(first + i + 1) % polygon.size()] });
        }
      }
      PatchSearch search(signs, boundary);
      if (search.Run(size))
      {
        return search.Result();
      }
    }
  }
  throw std::logic_error("an interval patch has no safe triangulation");
}

}

int SafeOrientation(const PatchSigns& signs, const PatchTetrahedron& points)
{
  // The orientation is linear in the place of every isovertex on its edge, so its sign is constant
  // if it is at all combinations of the edges' ends, where the points are vertices again and it is
  // that of a permutation. Two points of one edge leave only its direction, which is constant.
  int orientation = 0;
  for (int ends = 0; ends < 16; ++ends)
  {
    std::array<int, 4> vertices{};
    bool valid = true;
    for (int i = 0; i < 4; ++i)
    {
      const PatchPoint& point = points[i];
      const bool old = ((ends >> i) & 1) != 0;
      vertices[i] = old ? point.Older() : point.Younger();
      valid = valid && !(point.IsVertex() && old);
      for (int j = 0; j < 4; ++j)
      {
        const PatchPoint& other = points[j];
        if (!point.IsVertex() && point.Younger() == other.Younger() &&
          point.Older() == other.Older() && point.Surface() < other.Surface())
        {
          // The lower isovertex at the end with the lower sign, the upper one at the other.
          const bool oldIsLower = signs[point.Older()] < signs[point.Younger()];
          valid = valid && old == oldIsLower && (((ends >> j) & 1) != 0) == !oldIsLower;
        }
      }
    }
    const int sign = valid ? PermutationSign(vertices) : 0;
    if (sign * orientation < 0)
    {
      return 0;
    }
    orientation = sign != 0 ? sign : orientation;
  }
  return orientation;
}

std::vector<PatchPoint> FacePolygon(const PatchSigns& signs, int opposite)
{
  // Anticlockwise from outside of a positive tetrahedron.
  constexpr std::array<std::array<int, 3>, 4> faces = { { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 },
    { 0, 2, 1 } } };
  std::vector<PatchPoint> polygon;
  for (int i = 0; i < 3; ++i)
  {
    const int from = faces[opposite][i];
    const int to = faces[opposite][(i + 1) % 3];
    if (signs[from] == InsideSign)
    {
      polygon.push_back(PatchPoint::Vertex(from));
    }
    AddCrossings(signs, from, to, polygon);
  }
  return polygon;
}

const std::array<std::vector<PatchTetrahedron>, 81>& IntervalPatches()
{
  static const std::array<std::vector<PatchTetrahedron>, 81> patches = []
  {
    std::array<std::vector<PatchTetrahedron>, 81> all;
    for (int code = 0; code < 81; ++code)
    {
      all[code] = FindPatch({ code % 3, code / 3 % 3, code / 9 % 3, code / 27 });
    }
    return all;
  }();
  return patches;
}

}
