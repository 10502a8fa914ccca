// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/IntervalPatches.h"

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
void AddCrossings(const PatchStates& states, int from, int to, std::vector<PatchPoint>& points)
{
  const bool rises = states[from] < states[to];
  for (const int surface : { rises ? 0 : 1, rises ? 1 : 0 })
  {
    const int on = StateOn(surface);
    if ((states[from] < on && states[to] > on) || (states[from] > on && states[to] < on))
    {
      points.push_back(PatchPoint::Isovertex(from, to, surface));
    }
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

/** The polygon on a surface: the edges there that only one face's polygon has, reversed. */
std::vector<PatchPoint> SurfacePolygon(const PatchStates& states, int surface)
{
  using Edge = std::array<PatchPoint, 2>;
  std::vector<Edge> all;
  for (int opposite = 0; opposite < 4; ++opposite)
  {
    const std::vector<PatchPoint> face = FacePolygon(states, opposite);
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      all.push_back({ face[i], face[(i + 1) % face.size()] });
    }
  }
  const auto isOnSurface = [&](const PatchPoint& point)
  {
    return point.IsVertex() ? states[point.Younger()] == StateOn(surface)
                            : point.Surface() == surface;
  };
  std::vector<Edge> edges;
  for (const Edge& edge : all)
  {
    const bool isShared = std::find(all.begin(), all.end(), Edge{ edge[1], edge[0] }) != all.end();
    if (!isShared && isOnSurface(edge[0]) && isOnSurface(edge[1]))
    {
      edges.push_back({ edge[1], edge[0] });
    }
  }
  std::vector<PatchPoint> polygon;
  while (!edges.empty() && polygon.size() < edges.size())
  {
    const PatchPoint last = polygon.empty() ? edges[0][0] : polygon.back();
    const auto edge = std::find_if(
      edges.begin(), edges.end(), [&](const Edge& candidate) { return candidate[0] == last; });
    polygon.push_back((*edge)[1]);
  }
  return polygon;
}

/** Fills a closed surface of oriented triangles with safe tetrahedra. */
class PatchSearch
{
public:
  PatchSearch(const PatchStates& states, const std::vector<Triangle>& boundary)
    : States(states)
    , Front(boundary)
  {
    for (const Triangle& triangle : boundary)
    {
      this->Points.insert(this->Points.end(), triangle.begin(), triangle.end());
    }
    std::sort(this->Points.begin(), this->Points.end());
    this->Points.erase(std::unique(this->Points.begin(), this->Points.end()), this->Points.end());
  }

  /** Looks for a filling of at most this many tetrahedra. */
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
      if (SafeOrientation(this->States, tetrahedron) == 1)
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

  /** Removes a tetrahedron: its faces on the front go, its others join the front. */
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

  const PatchStates& States;
  std::vector<PatchPoint> Points;
  std::vector<Triangle> Front;
  std::vector<PatchTetrahedron> Tetrahedra;
};

/** The faces, and the polygons on the surfaces as fans from their first or second points. */
std::vector<Triangle> BoundaryOf(const PatchStates& states, int diagonals)
{
  std::vector<Triangle> boundary;
  for (int opposite = 0; opposite < 4; ++opposite)
  {
    AddFan(FacePolygon(states, opposite), boundary);
  }
  for (int surface = 0; surface < 2; ++surface)
  {
    const std::vector<PatchPoint> polygon = SurfacePolygon(states, surface);
    const int first = (diagonals >> surface) & 1;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    {
      boundary.push_back({ polygon[first], polygon[(first + i) % polygon.size()],
        polygon[(first + i + 1) % polygon.size()] });
    }
  }
  return boundary;
}

/** Whether there is a choice of diagonals on a surface. */
bool HasDiagonals(const PatchStates& states, int surface)
{
  return SurfacePolygon(states, surface).size() > 3;
}

/** The fewest safe tetrahedra, over both diagonals of every quadrilateral on a surface: all choices
 *  that need no more, in order. */
std::vector<std::vector<PatchTetrahedron>> FindPatches(const PatchStates& states)
{
  const auto [low, high] = std::minmax_element(states.begin(), states.end());
  if (*low >= OnUpper || *high <= OnLower)
  {
    return {}; // nothing, or flat
  }
  constexpr int most = 6;
  std::vector<std::vector<PatchTetrahedron>> found;
  for (int size = 1; size <= most && found.empty(); ++size)
  {
    for (int diagonals = 0; diagonals < 4; ++diagonals)
    {
      const bool isAnother = ((diagonals & 1) == 0 || HasDiagonals(states, 0)) &&
        ((diagonals & 2) == 0 || HasDiagonals(states, 1));
      if (!isAnother)
      {
        continue;
      }
      PatchSearch search(states, BoundaryOf(states, diagonals));
      if (search.Run(size))
      {
        found.push_back(search.Result());
      }
    }
  }
  if (found.empty())
  {
    throw std::logic_error("an interval patch has no safe triangulation");
  }
  return found;
}

}

int SafeOrientation(const PatchStates& states, const PatchTetrahedron& points)
{
  // The orientation is linear in the place of every isovertex on its edge, so its sign is constant
  // if it is the same at all combinations of the edges' ends; there the points are vertices, and it
  // is that of a permutation. Two points of one edge leave only its direction, which is constant.
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
          // The lower isovertex goes to the end that lies lower, the upper one to the other.
          const bool oldIsLower = states[point.Older()] < states[point.Younger()];
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

std::vector<PatchPoint> FacePolygon(const PatchStates& states, int opposite)
{
  std::vector<PatchPoint> polygon;
  for (int i = 0; i < 3; ++i)
  {
    const int from = FacesOfTetrahedron[opposite][i];
    const int to = FacesOfTetrahedron[opposite][(i + 1) % 3];
    if (IsInRange(states[from]))
    {
      polygon.push_back(PatchPoint::Vertex(from));
    }
    AddCrossings(states, from, to, polygon);
  }
  // Vertices on a surface alone make no polygon.
  return polygon.size() < 3 ? std::vector<PatchPoint>{} : polygon;
}

const std::array<std::vector<PatchTetrahedron>, 81>& IntervalPatches()
{
  static const std::array<std::vector<PatchTetrahedron>, 81> patches = []
  {
    std::array<std::vector<PatchTetrahedron>, 81> all;
    for (int code = 0; code < 81; ++code)
    {
      const auto found = FindPatches(StatesOf({ code % 3, code / 3 % 3, code / 9 % 3, code / 27 }));
      if (!found.empty())
      {
        all[code] = found.front();
      }
    }
    return all;
  }();
  return patches;
}

const std::array<std::vector<std::vector<PatchTetrahedron>>, 625>& MovedPatches()
{
  static const std::array<std::vector<std::vector<PatchTetrahedron>>, 625> patches = []
  {
    std::array<std::vector<std::vector<PatchTetrahedron>>, 625> all;
    for (int code = 0; code < 625; ++code)
    {
      all[code] = FindPatches({ code % 5, code / 5 % 5, code / 25 % 5, code / 125 });
    }
    return all;
  }();
  return patches;
}

}
