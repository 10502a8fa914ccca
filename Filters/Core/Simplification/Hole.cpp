// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/Hole.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{

bool Hole::SeeFromAbove(
  const std::vector<Vector>& positions, const std::vector<Vector>& normals, std::uint32_t vertex)
{
  const Vector& origin = positions[vertex];
  std::array<Vector, MostPoints> relative;
  for (int i = 0; i < this->Count; ++i)
  {
    relative[i] = positions[this->Points[i]] - origin;
  }
  Vector across{};
  for (int i = 0; i < this->Count; ++i)
  {
    if (this->Triangles[i] == None)
    {
      continue;
    }
    across = across + Cross(relative[i], relative[i + 1 < this->Count ? i + 1 : 0]);
  }
  const double length = std::sqrt(Dot(across, across));
  if (!(length > 0.0))
  {
    return false;
  }
  this->Normal = (1.0 / length) * across;
  // Two axes across the normal.
  const Vector& n = this->Normal;
  const Vector other = std::abs(n[0]) < 0.6 ? Vector{ 1.0, 0.0, 0.0 } : Vector{ 0.0, 1.0, 0.0 };
  const Vector scaled = Cross(n, other);
  const Vector x = (1.0 / std::sqrt(Dot(scaled, scaled))) * scaled;
  const Vector y = Cross(n, x);
  this->AxisX = x;
  this->AxisY = y;
  const auto hasArea = [&](int i)
  { return this->Triangles[i] != None && normals[this->Triangles[i]] != Vector{}; };
  this->LeastCosine = UsualCosine;
  for (int i = 0; i < this->Count; ++i)
  {
    this->Places[i] = { Dot(relative[i], x), Dot(relative[i], y) };
    if (hasArea(i))
    {
      this->LeastCosine = std::min(this->LeastCosine, Dot(n, normals[this->Triangles[i]]));
    }
  }
  if (!(this->LeastCosine > 0.0))
  {
    return false;
  }
  for (int i = 0; i < this->Count; ++i)
  {
    const int next = i + 1 < this->Count ? i + 1 : 0;
    if (hasArea(i) && !(Cross2(this->Places[i], this->Places[next]) > 0.0))
    {
      return false;
    }
  }
  return true;
}

int Hole::TriangleAt(const Place& place) const
{
  for (int i = 0; i < this->Count; ++i)
  {
    const Place& next = this->Places[i + 1 < this->Count ? i + 1 : 0];
    if (this->Triangles[i] != None && Cross2(this->Places[i], place) >= 0.0 &&
      Cross2(place, next) >= 0.0)
    {
      return i;
    }
  }
  return 1; // is never missing
}

bool Hole::IsOver(int point, const Place& place) const
{
  const std::array<const Place*, 3> corners = { &this->Places[0], &this->Places[point],
    &this->Places[point + 1] };
  for (int i = 0; i < 3; ++i)
  {
    const Place& from = *corners[i];
    const Place& to = *corners[(i + 1) % 3];
    if (Cross2({ to[0] - from[0], to[1] - from[1] }, { place[0] - from[0], place[1] - from[1] }) <
      0.0)
    {
      return false;
    }
  }
  return true;
}

}
