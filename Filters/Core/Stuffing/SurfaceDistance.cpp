// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/SurfaceDistance.h"

#include "Patches/IntervalPatches.h"
#include "Simplification/Covering.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{
namespace
{

/** Pieces that are nearer than this part of what is allowed are not cut any further. */
constexpr double UncutPart = 0.3;

/** A triangle, and the tetrahedron that it is a face of. */
struct OwnedTriangle
{
  Triangle Sorted{};
  Triangle Points{};
  std::uint32_t Owner = 0;
};

/** The triangles of one surface, and the origins of their tetrahedra. */
struct SurfaceMesh
{
  TriangleMesh Mesh;
  std::vector<std::uint32_t> Origins;
  std::vector<Triangle> Known; ///< sorted points, sorted
};

SurfaceMesh SurfaceOf(const TetrahedronMesh& mesh, int surface)
{
  std::vector<OwnedTriangle> all;
  for (std::uint32_t i = 0; i < mesh.Tetrahedra.size(); ++i)
  {
    const Corners& corners = mesh.Tetrahedra[i];
    for (const std::array<int, 3>& face : FacesOfTetrahedron)
    {
      const Triangle points = { corners[face[0]], corners[face[1]], corners[face[2]] };
      if (SurfaceOfFace(mesh, points) == surface && WallsOfFace(mesh, points) == 0)
      {
        all.push_back({ points, points, i });
        std::sort(all.back().Sorted.begin(), all.back().Sorted.end());
      }
    }
  }
  std::sort(all.begin(), all.end(),
    [](const OwnedTriangle& a, const OwnedTriangle& b) { return a.Sorted < b.Sorted; });
  SurfaceMesh result;
  result.Mesh.Positions = mesh.Positions;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    // What two tetrahedra have is inside.
    const bool isShared = (i > 0 && all[i - 1].Sorted == all[i].Sorted) ||
      (i + 1 < all.size() && all[i + 1].Sorted == all[i].Sorted);
    if (!isShared)
    {
      result.Mesh.Triangles.push_back(all[i].Points);
      result.Origins.push_back(mesh.Origins[all[i].Owner]);
      result.Known.push_back(all[i].Sorted);
    }
  }
  return result;
}

bool HasTriangle(const SurfaceMesh& surface, Triangle points)
{
  std::sort(points.begin(), points.end());
  return std::binary_search(surface.Known.begin(), surface.Known.end(), points);
}

/** Triangles of a surface around one, and whether another triangle is near to them. */
class Neighbourhood
{
public:
  /** @param reach how far from a place triangles are of interest */
  Neighbourhood(const SurfaceMesh& surface, const Connectivity& links, std::uint32_t start,
    const Vector& place, double reach)
  {
    // Over the surface: what is near through space alone is not looked at.
    std::vector<std::uint32_t> all = { start };
    for (std::size_t i = 0; i < all.size() && this->Near.size() < MostTriangles; ++i)
    {
      const auto [a, b, c] = surface.Mesh.Corners(all[i]);
      const TriangleDistance distance(a, b, c);
      if (i > 0 && distance.Squared(place) > reach * reach)
      {
        continue;
      }
      this->Near.push_back({ all[i], distance });
      for (int edge = 0; edge < 3; ++edge)
      {
        const std::uint32_t next = links.Neighbour(all[i], edge);
        if (next != None && std::find(all.begin(), all.end(), next) == all.end())
        {
          all.push_back(next);
        }
      }
    }
  }

  /** Whether each part of a triangle lies within what one of these allows: what is so near to a
   *  triangle is convex, so corners tell.
   *  @param allowanceOf (triangle) @param far receives the triangle nearest to a part that is not
   */
  template <typename AllowanceOf>
  bool Covers(const std::array<Vector, 3>& corners, AllowanceOf&& allowanceOf, std::uint32_t& far,
    int depth = 0) const
  {
    const auto covers = [&](const Item& item, const Vector* points, int count)
    {
      const double allowance = allowanceOf(item.Triangle);
      return std::all_of(points, points + count,
        [&](const Vector& point) { return item.Distance.Squared(point) <= allowance * allowance; });
    };
    const auto covered = [&](const Vector* points, int count)
    {
      return std::any_of(this->Near.begin(), this->Near.end(),
        [&](const Item& item) { return covers(item, points, count); });
    };
    if (covered(corners.data(), 3))
    {
      return true;
    }
    const Vector middle = (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]);
    if (depth == MostDepth || !covered(&middle, 1))
    {
      far = this->NearestTo(middle);
      return false;
    }
    const std::array<Vector, 3> sides = { 0.5 * (corners[0] + corners[1]),
      0.5 * (corners[1] + corners[2]), 0.5 * (corners[2] + corners[0]) };
    return this->Covers(sides, allowanceOf, far, depth + 1) &&
      this->Covers({ corners[0], sides[0], sides[2] }, allowanceOf, far, depth + 1) &&
      this->Covers({ corners[1], sides[1], sides[0] }, allowanceOf, far, depth + 1) &&
      this->Covers({ corners[2], sides[2], sides[1] }, allowanceOf, far, depth + 1);
  }

private:
  std::uint32_t NearestTo(const Vector& place) const
  {
    return std::min_element(this->Near.begin(), this->Near.end(),
      [&](const Item& a, const Item& b)
      { return a.Distance.Squared(place) < b.Distance.Squared(place); })
      ->Triangle;
  }

  static constexpr std::size_t MostTriangles = 200;
  static constexpr int MostDepth = 5;

  struct Item
  {
    std::uint32_t Triangle;
    TriangleDistance Distance;
  };
  std::vector<Item> Near;
};

/** Whether a triangle is near to a surface, from a place there on: by walking over it, and where
 * that says no, which may be too much, by looking at all around. */
template <typename AllowanceOf>
bool IsNear(const std::array<Vector, 3>& corners, const SurfaceMesh& surface,
  const Connectivity& links, Covering& cover, std::uint32_t start, AllowanceOf&& allowanceOf,
  std::uint32_t& far)
{
  const double allowance = allowanceOf(start);
  if (cover.Cut(corners, start, UncutPart * allowance,
        [&](std::uint32_t triangle, double distance, const Covering::Piece& /*piece*/)
        { return distance <= allowanceOf(triangle); }))
  {
    return true;
  }
  const Vector middle = (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]);
  double reach = 0.0;
  for (const Vector& corner : corners)
  {
    reach = std::max(reach, std::sqrt(Dot(corner - middle, corner - middle)));
  }
  return std::isfinite(allowance) &&
    Neighbourhood(surface, links, start, middle, reach + allowance)
      .Covers(corners, allowanceOf, far);
}

/**
 * Visits the triangles of a mesh, each with a triangle of another one nearby: those at points that
 * the other mesh has, too, then their neighbours, from where each of them ended.
 *
 * @param links,otherLinks of the mesh, and of the other one, which cover is over
 * @param visit (triangle, triangle of the other mesh)
 */
template <typename Visit>
void ForEachFromPlace(const TriangleMesh& mesh, const Connectivity& links,
  const Connectivity& otherLinks, Covering& cover, Visit&& visit)
{
  std::vector<std::uint32_t> places(mesh.Triangles.size(), None);
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    for (const std::uint32_t point : mesh.Triangles[i])
    {
      if (places[i] == None && otherLinks.IsUsed(point))
      {
        places[i] = cover.NearestOf(otherLinks.At(point), mesh.Middle(i));
        waiting.push_back(i);
      }
    }
  }
  for (std::size_t at = 0; at < waiting.size(); ++at)
  {
    const std::uint32_t i = waiting[at];
    visit(i, places[i]);
    for (int edge = 0; edge < 3; ++edge)
    {
      const std::uint32_t neighbour = links.Neighbour(i, edge);
      if (neighbour != None && places[neighbour] == None)
      {
        places[neighbour] = places[i];
        waiting.push_back(neighbour);
      }
    }
  }
}

/** Compares one surface of two meshes. */
class Comparison
{
public:
  Comparison(const SurfaceMesh& plain, const SurfaceMesh& stuffed,
    const std::vector<double>& allowances, std::vector<std::uint32_t>& far)
    : Plain(plain)
    , Stuffed(stuffed)
    , Allowances(allowances)
    , Far(far)
    , PlainLinks(plain.Mesh.Positions.size(), plain.Mesh.Triangles)
    , StuffedLinks(stuffed.Mesh.Positions.size(), stuffed.Mesh.Triangles)
  {
  }

  void Run()
  {
    // Without a surface, or with one that cannot be walked over, nothing can be said.
    if (this->Plain.Mesh.Triangles.empty() || this->Stuffed.Mesh.Triangles.empty() ||
      !this->PlainLinks.FaultyPoints().empty() || !this->StuffedLinks.FaultyPoints().empty())
    {
      return;
    }
    this->MeasureBack();
    this->MeasureForth();
  }

private:
  double AllowanceAt(std::uint32_t plain) const
  {
    return this->Allowances[this->Plain.Origins[plain]];
  }

  /** From new triangles to those of the volume's mesh, of whose points theirs are some. */
  void MeasureBack()
  {
    Covering cover(this->Plain.Mesh.Positions, this->PlainLinks.Linked());
    const auto count = static_cast<std::uint32_t>(this->Stuffed.Mesh.Triangles.size());
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const Triangle& points = this->Stuffed.Mesh.Triangles[i];
      if (HasTriangle(this->Plain, points))
      {
        continue;
      }
      // From where least is allowed: what begins in a cell that is not asked would all be near.
      std::uint32_t start = None;
      for (const std::uint32_t point : points)
      {
        if (this->PlainLinks.IsUsed(point))
        {
          const std::uint32_t at =
            cover.NearestOf(this->PlainLinks.At(point), this->Stuffed.Mesh.Middle(i));
          const bool isLess = start == None || this->AllowanceAt(at) < this->AllowanceAt(start);
          start = isLess ? at : start;
        }
      }
      if (start == None)
      {
        continue;
      }
      std::uint32_t far = start;
      if (!IsNear(
            this->Stuffed.Mesh.Corners(i), this->Plain, this->PlainLinks, cover, start,
            [&](std::uint32_t plain) { return this->AllowanceAt(plain); }, far))
      {
        this->Mark(far);
      }
    }
  }

  /** From the volume's triangles to the new ones. */
  void MeasureForth()
  {
    Covering cover(this->Stuffed.Mesh.Positions, this->StuffedLinks.Linked());
    ForEachFromPlace(this->Plain.Mesh, this->PlainLinks, this->StuffedLinks, cover,
      [&](std::uint32_t triangle, std::uint32_t place)
      {
        const double allowed = this->AllowanceAt(triangle);
        if (std::isfinite(allowed) &&
          !HasTriangle(this->Stuffed, this->Plain.Mesh.Triangles[triangle]) &&
          !IsNear(
            this->Plain.Mesh.Corners(triangle), this->Stuffed, this->StuffedLinks, cover, place,
            [&](std::uint32_t /*stuffed*/) { return allowed; }, place))
        {
          this->Mark(triangle);
        }
      });
  }

  void Mark(std::uint32_t plain)
  {
    if (std::isfinite(this->AllowanceAt(plain)))
    {
      this->Far.push_back(this->Plain.Origins[plain]);
    }
  }

  const SurfaceMesh& Plain;
  const SurfaceMesh& Stuffed;
  const std::vector<double>& Allowances;
  std::vector<std::uint32_t>& Far;
  Connectivity PlainLinks;
  Connectivity StuffedLinks;
};

}

std::vector<std::uint32_t> FindFarLeaves(const TetrahedronMesh& plain,
  const TetrahedronMesh& stuffed, const std::vector<double>& allowances)
{
  std::vector<std::uint32_t> far;
  for (const int surface : { -1, 1 })
  {
    const SurfaceMesh before = SurfaceOf(plain, surface);
    const SurfaceMesh after = SurfaceOf(stuffed, surface);
    Comparison(before, after, allowances, far).Run();
  }
  std::sort(far.begin(), far.end());
  far.erase(std::unique(far.begin(), far.end()), far.end());
  return far;
}

}
