// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SurfaceExtraction_h
#define isodiamond_SurfaceExtraction_h

#include "AffineMap.h"
#include "ExtractionPasses.h"

#include <vector>

namespace isodiamond
{

/**
 * The isosurface of a refined set: marching tetrahedra over the leaves of the current mesh.
 *
 * Point ids need no locator: an isovertex belongs to the diamond that owns its edge, is alive
 * while that diamond is refined and the one centred at the edge's midpoint is not, and ids are a
 * prefix sum over owners. The constructor counts; the caller allocates and has the arrays
 * written. Order and values of the output do not depend on threads. Paper, section 6.
 */
class SurfaceExtraction
{
public:
  /** The refined set must outlive the extraction. @throws std::length_error beyond 2^32 - 1
   *  points. */
  SurfaceExtraction(const RefinedSet& refined, const ParallelFor& parallelFor);

  std::int64_t PointCount() const { return this->Passes.Total().Points; }
  std::int64_t TriangleCount() const { return this->Passes.Total().Cells; }

  /** Writes 3 coordinates a point. */
  void WritePoints(const AffineMap& world, float* points) const;

  /**
   * Writes the triangles.
   *
   * @param mirrored of the map that places the points; normals then point to lower values
   * @param connectivity receives 3 point ids a triangle (32 bits, or long long)
   * @param levels receives the level of the diamond that each triangle lies in: 0 for the root, N
   *        at full resolution
   */
  template <typename Id>
  void WriteTriangles(bool mirrored, Id* connectivity, std::int8_t* levels) const;

private:
  /** The points of one refined diamond: its alive isovertices have consecutive ids. */
  struct Slot
  {
    std::uint32_t First = 0;
    std::uint32_t Alive = 0;

    /** The id of a point that there is not, which only a damaged file asks for, is 0. */
    std::uint32_t Id(int edge) const
    {
      const std::uint32_t before = this->Alive & ((1U << edge) - 1U);
      return ((this->Alive >> edge) & 1U) != 0
        ? this->First + static_cast<std::uint32_t>(PopCount(before))
        : 0;
    }
  };

  ExtractionPasses::Counts CountBrick(std::int64_t brick);

  /** Whether a brick has nothing to do with the surface. */
  bool IsIdle(const BrickPlace& place) const { return this->Refined.IsFull() && place.Scale > 0; }

  /** Calls body(leaf) for the leaves of a brick that carry the surface. */
  template <typename Body>
  void ForEachCrossedLeaf(const BrickPlace& place, Body&& body) const;

  template <typename Id>
  class TriangleWriter;

  const RefinedSet& Refined;
  const IsodiamondHierarchy& Source;
  ExtractionPasses Passes;
  BrickMask Among;         ///< the positions that can have leaves
  std::vector<Slot> Slots; ///< by rank
};

}

#endif
