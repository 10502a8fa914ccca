// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/TriangleMesh.h"

namespace isodiamond
{

Connectivity::Connectivity(const TriangleMesh& mesh)
  : Cells(mesh.Positions.size(), mesh.Triangles.size(),
      [&](std::size_t triangle) { return mesh.Triangles[triangle]; })
  , Neighbours(mesh.Triangles.size(), Triangle{ None, None, None })
{
  const auto count = static_cast<std::uint32_t>(mesh.Triangles.size());
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const Triangle& triangle = mesh.Triangles[i];
    for (int k = 0; k < 3; ++k)
    {
      const std::uint32_t from = triangle[k];
      const std::uint32_t to = triangle[(k + 1) % 3];
      int along = 0;
      int against = 0;
      for (const std::uint32_t* other = this->begin(from); other != this->end(from); ++other)
      {
        const Triangle& points = mesh.Triangles[*other];
        for (int j = 0; j < 3; ++j)
        {
          along += points[j] == from && points[(j + 1) % 3] == to ? 1 : 0;
          if (points[j] == to && points[(j + 1) % 3] == from)
          {
            ++against;
            this->Neighbours[i][k] = *other;
          }
        }
      }
      if (along != 1 || against > 1 || from == to)
      {
        this->Faulty.push_back(from);
      }
    }
  }
}

}
