// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PatchDistance_h
#define isodiamond_PatchDistance_h

#include "SurfacePatch.h"
#include "TriangleDistance.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace isodiamond
{

/** Squared distances to the patch of a tetrahedron. */
class PatchDistance
{
public:
  /** @param cornerAt gives the isovertex on an edge of the patch's half-tetrahedron, in the world
   */
  template <typename CornerAt>
  void Reset(const SurfacePatch& patch, CornerAt&& cornerAt)
  {
    this->Count = patch.TriangleCount;
    std::array<Vector, 6> corners;
    std::uint32_t known = 0; // the edges whose isovertex is in corners
    for (int i = 0; i < patch.TriangleCount; ++i)
    {
      for (const std::uint8_t edge : patch.Triangles[i])
      {
        if (((known >> edge) & 1U) == 0)
        {
          known |= 1U << edge;
          corners[edge] = cornerAt(edge);
        }
      }
      const std::array<std::uint8_t, 3>& edges = patch.Triangles[i];
      this->Triangles[i] = { corners[edges[0]], corners[edges[1]], corners[edges[2]] };
    }
  }

  bool IsEmpty() const { return this->Count == 0; }

  /** @pre the patch is not empty */
  double Squared(const Vector& point) const
  {
    const double first = this->Triangles[0].Squared(point);
    return this->Count == 1 ? first : std::min(first, this->Triangles[1].Squared(point));
  }

private:
  int Count = 0;
  std::array<TriangleDistance, 2> Triangles;
};

}

#endif
