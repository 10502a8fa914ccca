// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/TetrahedronMesh.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{

double SmallestSine(const Vector& a, const Vector& b, const Vector& c, const Vector& d)
{
  const Vector ab = b - a;
  const Vector ac = c - a;
  const Vector ad = d - a;
  const Vector bc = c - b;
  const Vector bd = d - b;
  const Vector cd = d - c;
  const Vector toA = Cross(bc, bd); // normals of the faces opposite to a, b, c, d: twice the area
  const Vector toB = Cross(ad, ac);
  const Vector toC = Cross(ab, ad);
  const Vector toD = Cross(ac, ab);
  return SmallestSine(Dot(Cross(ab, ac), ad),
    { Dot(ab, ab), Dot(ac, ac), Dot(ad, ad), Dot(bc, bc), Dot(bd, bd), Dot(cd, cd) },
    { Dot(toA, toA), Dot(toB, toB), Dot(toC, toC), Dot(toD, toD) });
}

std::array<double, 2> DihedralAngles(
  const Vector& a, const Vector& b, const Vector& c, const Vector& d)
{
  std::array<Vector, 4> normals = { Cross(c - b, d - b), Cross(d - a, c - a), Cross(b - a, d - a),
    Cross(c - a, b - a) };
  for (Vector& normal : normals)
  {
    const double length = std::sqrt(Dot(normal, normal));
    normal = (length > 0.0 ? 1.0 / length : 0.0) * normal;
  }
  std::array<double, 2> range = { 1.0, -1.0 }; // of cosines
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      const double cosine = std::clamp(-Dot(normals[i], normals[j]), -1.0, 1.0);
      range = { std::min(range[0], cosine), std::max(range[1], cosine) };
    }
  }
  return { DegreesOfRadian * std::acos(range[1]), DegreesOfRadian * std::acos(range[0]) };
}

std::array<double, 2> DihedralAngles(const TetrahedronMesh& mesh)
{
  std::array<double, 2> all = { 180.0, 0.0 };
  for (const Corners& corners : mesh.Tetrahedra)
  {
    const std::array<double, 2> angles = DihedralAngles(mesh.Positions[corners[0]],
      mesh.Positions[corners[1]], mesh.Positions[corners[2]], mesh.Positions[corners[3]]);
    all = { std::min(all[0], angles[0]), std::max(all[1], angles[1]) };
  }
  return all;
}

void Scatter(std::vector<std::uint32_t>& points)
{
  const auto hash = [](std::uint32_t point) { return point * 2654435761U; };
  std::sort(points.begin(), points.end(),
    [&](std::uint32_t a, std::uint32_t b) { return hash(a) < hash(b); });
}

}
