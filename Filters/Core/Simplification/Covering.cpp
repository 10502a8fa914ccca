// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/Covering.h"

namespace isodiamond
{

Covering::Covering(const std::vector<Vector>& positions, const LinkedTriangles& mesh)
  : Positions(positions)
  , Mesh(mesh)
  , Recent(MostRecent)
{
}

std::vector<std::uint32_t> Covering::Around(
  const std::array<Vector, 3>& corners, std::uint32_t start, double reach)
{
  constexpr std::size_t most = 400;
  const auto [middle, radius] = BallAround(corners);
  const double far = reach + radius;
  std::vector<std::uint32_t> around = { start };
  this->Looks.resize(this->Mesh.Triangles.size());
  const std::uint32_t look = ++this->LookCount;
  this->Looks[start] = look;
  for (std::size_t i = 0; i < around.size() && around.size() < most; ++i)
  {
    for (const std::uint32_t next : this->Mesh.Neighbours[around[i]])
    {
      if (next == None || this->Looks[next] == look)
      {
        continue;
      }
      this->Looks[next] = look;
      if (this->Of(next).Distance.Squared(middle) <= far * far)
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
