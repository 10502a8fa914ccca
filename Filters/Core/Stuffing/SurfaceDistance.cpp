// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/SurfaceDistance.h"

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

SurfaceMesh SurfaceOf(const TetrahedronMesh& mesh, std::int8_t surface)
{
  constexpr std::array<std::array<int, 3>, 4> faces = { { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 },
    { 0, 2, 1 } } };
  std::vector<OwnedTriangle> all;
  for (std::uint32_t i = 0; i < mesh.Tetrahedra.size(); ++i)
  {
    const Corners& corners = mesh.Tetrahedra[i];
    for (const std::array<int, 3>& face : faces)
    {
      OwnedTriangle triangle;
      int walls = ~0;
      bool isOn = true;
      for (int k = 0; k < 3; ++k)
      {
        const std::uint32_t point = corners[face[k]];
        triangle.Points[k] = point;
        isOn = isOn && mesh.Surfaces[point] == surface;
        walls &= mesh.OnWalls[point];
      }
      if (isOn && walls == 0)
      {
        triangle.Sorted = triangle.Points;
        std::sort(triangle.Sorted.begin(), triangle.Sorted.end());
        triangle.Owner = i;
        all.push_back(triangle);
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
    , PlainLinks(plain.Mesh)
    , StuffedLinks(stuffed.Mesh)
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
    const Covering cover(this->Plain.Mesh, this->PlainLinks);
    const auto count = static_cast<std::uint32_t>(this->Stuffed.Mesh.Triangles.size());
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const Triangle& points = this->Stuffed.Mesh.Triangles[i];
      if (HasTriangle(this->Plain, points) || !this->PlainLinks.IsUsed(points[0]))
      {
        continue;
      }
      const std::uint32_t start = cover.NearestAt(points[0], this->Stuffed.Mesh.Middle(i));
      bool isMarked = false;
      const bool isCovered =
        cover.Cut(this->Stuffed.Mesh.Corners(i), start, UncutPart * this->AllowanceAt(start),
          [&](std::uint32_t plain, double distance, double /*area*/)
          {
            if (distance > this->AllowanceAt(plain))
            {
              this->Mark(plain);
              isMarked = true;
            }
            return !isMarked;
          });
      if (!isCovered && !isMarked)
      {
        this->Mark(start);
      }
    }
  }

  /** From the volume's triangles to the new ones: those at points that stayed first, then their
   *  neighbours, each beginning where the one before ended. */
  void MeasureForth()
  {
    const Covering cover(this->Stuffed.Mesh, this->StuffedLinks);
    const auto count = static_cast<std::uint32_t>(this->Plain.Mesh.Triangles.size());
    std::vector<std::uint32_t> places(count, Connectivity::None);
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      for (const std::uint32_t point : this->Plain.Mesh.Triangles[i])
      {
        if (places[i] == Connectivity::None && this->StuffedLinks.IsUsed(point))
        {
          places[i] = cover.NearestAt(point, this->Plain.Mesh.Middle(i));
          waiting.push_back(i);
        }
      }
    }
    for (std::size_t at = 0; at < waiting.size(); ++at)
    {
      const std::uint32_t i = waiting[at];
      if (!HasTriangle(this->Stuffed, this->Plain.Mesh.Triangles[i]))
      {
        this->MeasureForth(cover, i, places[i]);
      }
      for (int edge = 0; edge < 3; ++edge)
      {
        const std::uint32_t neighbour = this->PlainLinks.Neighbour(i, edge);
        if (neighbour != Connectivity::None && places[neighbour] == Connectivity::None)
        {
          places[neighbour] = places[i];
          waiting.push_back(neighbour);
        }
      }
    }
  }

  void MeasureForth(const Covering& cover, std::uint32_t triangle, std::uint32_t& place)
  {
    const double allowed = this->AllowanceAt(triangle);
    if (!std::isfinite(allowed))
    {
      return;
    }
    const bool isNear = cover.Cut(this->Plain.Mesh.Corners(triangle), place, UncutPart * allowed,
      [&](std::uint32_t stuffed, double distance, double /*area*/)
      {
        place = stuffed;
        return distance <= allowed;
      });
    if (!isNear)
    {
      this->Mark(triangle);
    }
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
  for (const std::int8_t surface : { std::int8_t{ -1 }, std::int8_t{ 1 } })
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
