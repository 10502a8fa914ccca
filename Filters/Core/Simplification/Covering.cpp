// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/Covering.h"

namespace isodiamond
{

Covering::Covering(const TriangleMesh& mesh, const Connectivity& connectivity)
  : Mesh(mesh)
  , Links(connectivity)
{
  this->Normals.reserve(mesh.Triangles.size());
  this->Distances.reserve(mesh.Triangles.size());
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const auto [a, b, c] = mesh.Corners(i);
    this->Normals.push_back(Unit(Cross(b - a, c - a)));
    this->Distances.emplace_back(a, b, c);
  }
}

std::uint32_t Covering::NearestAt(std::uint32_t point, const Vector& place) const
{
  std::uint32_t nearest = *this->Links.begin(point);
  double least = HUGE_VAL;
  for (const std::uint32_t* i = this->Links.begin(point); i != this->Links.end(point); ++i)
  {
    const double squared = this->Distances[*i].Squared(place);
    if (squared < least)
    {
      least = squared;
      nearest = *i;
    }
  }
  return nearest;
}

std::vector<std::uint32_t> Covering::Around(
  const std::array<Vector, 3>& corners, std::uint32_t start, double reach) const
{
  constexpr std::size_t most = 400;
  const auto [middle, radius] = BallAround(corners);
  const double far = reach + radius;
  std::vector<std::uint32_t> around = { start };
  std::vector<bool> isKnown(this->Mesh.Triangles.size());
  isKnown[start] = true;
  for (std::size_t i = 0; i < around.size() && around.size() < most; ++i)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const std::uint32_t next = this->Links.Neighbour(around[i], edge);
      if (next == Connectivity::None || isKnown[next])
      {
        continue;
      }
      isKnown[next] = true;
      if (this->Distances[next].Squared(middle) <= far * far)
      {
        around.push_back(next);
      }
    }
  }
  return around;
}

bool Covering::Split(
  const Piece& piece, const Vector& at, const Vector& normal, Piece& inside, Piece& beyond)
{
  std::array<double, MostCorners> heights;
  bool anyBeyond = false;
  for (int i = 0; i < piece.Count; ++i)
  {
    heights[i] = Dot(piece.Corners[i] - at, normal);
    anyBeyond = anyBeyond || heights[i] < 0.0;
  }
  if (!anyBeyond)
  {
    return false;
  }
  for (int i = 0; i < piece.Count; ++i)
  {
    const int next = i + 1 < piece.Count ? i + 1 : 0;
    (heights[i] < 0.0 ? beyond : inside).Add(piece.Corners[i]);
    if ((heights[i] < 0.0) != (heights[next] < 0.0))
    {
      const double part = heights[i] / (heights[i] - heights[next]);
      const Vector cut = piece.Corners[i] + part * (piece.Corners[next] - piece.Corners[i]);
      inside.Add(cut);
      beyond.Add(cut);
    }
  }
  return true;
}

}
