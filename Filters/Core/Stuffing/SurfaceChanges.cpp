// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/SurfaceChanges.h"

#include "Patches/PatchDistance.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{
namespace
{

/** The least cosine between the normals of a surface's triangles whose common edge is flipped. */
constexpr double LeastCosine = 0.5;

/** The tangent of less than half of the least angle between two edges at a vertex of the lattice,
 *  35.26 degrees. */
constexpr double SpindleSlope = 0.3;

Vector NormalOf(const std::array<Vector, 3>& corners)
{
  return Cross(corners[1] - corners[0], corners[2] - corners[0]);
}

}

bool StaysNear(const LocalMesh& mesh, std::uint32_t from, std::uint32_t to, double distance)
{
  if (mesh.Mesh().Surfaces[from] == 0)
  {
    return true;
  }
  using Sides = std::array<Vector, 3>;
  std::vector<Sides> before;
  std::vector<Sides> after;
  for (const std::uint32_t tetrahedron : mesh.StarOf(from))
  {
    const Corners& corners = mesh.CornersOf(tetrahedron);
    for (const std::uint32_t apex : corners)
    {
      Face face = Without(corners, apex);
      if (apex == from || mesh.PlaceOfFace(face[0], face[1], face[2]) < Walls::Fixed ||
        mesh.CountAt(face[0], face[1], face[2]) != 1)
      {
        continue;
      }
      const bool stays = std::find(face.begin(), face.end(), to) == face.end();
      before.push_back({ mesh.At(face[0]), mesh.At(face[1]), mesh.At(face[2]) });
      std::replace(face.begin(), face.end(), from, to);
      if (stays)
      {
        after.push_back({ mesh.At(face[0]), mesh.At(face[1]), mesh.At(face[2]) });
        if (Dot(NormalOf(before.back()), NormalOf(after.back())) <= 0.0)
        {
          return false;
        }
      }
    }
  }
  const auto isNear = [&](const Vector& point, const std::vector<Sides>& triangles)
  {
    return std::any_of(triangles.begin(), triangles.end(),
      [&](const Sides& corners)
      {
        return TriangleDistance(corners[0], corners[1], corners[2]).Squared(point) <=
          distance * distance;
      });
  };
  return isNear(mesh.At(from), after) &&
    std::all_of(after.begin(), after.end(),
      [&](const Sides& corners)
      { return isNear((1.0 / 3.0) * (corners[0] + corners[1] + corners[2]), before); });
}

bool CanTurn(const LocalMesh& mesh, std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring,
  double distance)
{
  const std::uint32_t c = ring.Points.front();
  const std::uint32_t d = ring.Points.back();
  const int place = mesh.PlaceOfFace(a, b, c);
  if (place == 0 || (place & Walls::Fixed) != 0 || place != mesh.PlaceOfFace(a, b, d) ||
    place != mesh.PlaceOfFace(a, c, d) || place != mesh.PlaceOfFace(b, c, d))
  {
    return false;
  }
  if (place < Walls::Fixed)
  {
    return true;
  }
  const Vector first = NormalOf({ mesh.At(a), mesh.At(b), mesh.At(c) });
  const Vector second = NormalOf({ mesh.At(b), mesh.At(a), mesh.At(d) });
  const Vector across = Cross(mesh.At(b) - mesh.At(a), mesh.At(d) - mesh.At(c));
  const double height =
    std::abs(Dot(across, mesh.At(c) - mesh.At(a))) / std::sqrt(Dot(across, across));
  return height <= distance &&
    Dot(first, second) > LeastCosine * std::sqrt(Dot(first, first) * Dot(second, second));
}

bool IsBeside(const CutSide& edge, const Vector& from, const Vector& to)
{
  const Vector along = edge.Beyond - edge.Inside;
  const double squared = Dot(along, along);
  const double before = Dot(from - edge.Inside, along) / squared;
  const double after = Dot(to - edge.Inside, along) / squared;
  const Vector aside = to - edge.Inside - after * along;
  const double widest = SpindleSlope * std::min(after, 1.0 - after);
  return widest >= 0.0 && after <= std::max(before, 0.5) &&
    Dot(aside, aside) <= widest * widest * squared;
}

bool CanShift(const LocalMesh& mesh, std::uint32_t point, const Vector& to)
{
  for (const std::uint32_t tetrahedron : mesh.StarOf(point))
  {
    const Face others = Without(mesh.CornersOf(tetrahedron), point);
    for (int i = 0; i < 3; ++i)
    {
      const std::uint32_t a = others[i];
      const std::uint32_t b = others[(i + 1) % 3];
      if (mesh.CountAt(point, a, b) == 1 &&
        Dot(NormalOf({ mesh.At(point), mesh.At(a), mesh.At(b) }),
          NormalOf({ to, mesh.At(a), mesh.At(b) })) <= 0.0)
      {
        return false;
      }
    }
  }
  return true;
}

}
