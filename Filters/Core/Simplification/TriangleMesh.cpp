// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/TriangleMesh.h"

#include <utility>

namespace isodiamond
{

std::vector<std::uint32_t> AnyTriangleAt(std::size_t points, const LinkedTriangles& mesh)
{
  std::vector<std::uint32_t> any(points, None);
  for (std::uint32_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    for (int k = 0; mesh.IsThere(i) && k < 3; ++k)
    {
      any[mesh.Triangles[i][k]] = i;
    }
  }
  return any;
}

Connectivity::Connectivity(std::size_t pointCount, std::vector<Triangle> triangles)
  : Cells(pointCount, triangles.size(), [&](std::size_t triangle) { return triangles[triangle]; })
  , Links{ std::move(triangles), {} }
{
  const std::vector<Triangle>& all = this->Links.Triangles;
  this->Links.Neighbours.assign(all.size(), { None, None, None });
  const auto count = static_cast<std::uint32_t>(all.size());
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const Triangle& triangle = all[i];
    for (int k = 0; k < 3; ++k)
    {
      const std::uint32_t from = triangle[k];
      const std::uint32_t to = triangle[(k + 1) % 3];
      int along = 0;
      int against = 0;
      for (const std::uint32_t other : this->Cells[from])
      {
        const Triangle& points = all[other];
        const int place = PlaceOf(points, from);
        along += points[(place + 1) % 3] == to ? 1 : 0;
        if (points[(place + 2) % 3] == to)
        {
          ++against;
          this->Links.Neighbours[i][k] = other;
        }
      }
      if (along != 1 || against > 1)
      {
        this->Faulty.push_back(from);
      }
      if (from == to)
      {
        this->Faulty.insert(this->Faulty.end(), triangle.begin(), triangle.end());
      }
    }
  }
}

bool Connectivity::IsPinched(std::uint32_t point) const
{
  if (this->At(point).empty())
  {
    return false;
  }
  const auto beyond = [&](std::uint32_t triangle, int edge)
  {
    const int place = PlaceOf(this->Links.Triangles[triangle], point);
    return this->Links.Neighbours[triangle][(place + edge) % 3];
  };
  // Around it from any of them; if that ends at the border, also the other way.
  const std::uint32_t first = *this->At(point).begin();
  std::size_t seen = 0;
  std::uint32_t at = first;
  do
  {
    ++seen;
    at = beyond(at, 2);
  } while (at != None && at != first);
  for (at = at == None ? beyond(first, 0) : None; at != None; at = beyond(at, 0))
  {
    ++seen;
  }
  return seen < this->At(point).size();
}

}
