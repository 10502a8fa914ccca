// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SurfaceExtraction_h
#define isodiamond_SurfaceExtraction_h

#include "Mesh/MeshExtraction.h"

namespace isodiamond
{

/** The number of triangles in a diamond's leaves. */
int CountTriangles(const IsodiamondHierarchy& hierarchy, const LeafParent& parent);

/**
 * The isosurface of a refined set: marching tetrahedra over the leaves of the current mesh.
 *
 * Point ids need no locator: an isovertex belongs to the diamond that owns its edge, it is alive
 * while that diamond is refined and the one centred at the edge's midpoint is not, and ids are a
 * prefix sum over owners. The constructor counts; the caller allocates the arrays and has them
 * written. The order and values of the output do not depend on threads. Paper, section 6.
 */
class SurfaceExtraction : public MeshExtraction
{
public:
  /** The refined set must outlive the extraction. @throws std::length_error beyond 2^32 - 1
   *  points. */
  SurfaceExtraction(
    const RefinedSet& refined, const ParallelFor& parallelFor, const MeshShare& share = {});

  std::int64_t TriangleCount() const { return this->Passes.Total().Cells; }

  /**
   * Writes the triangles.
   *
   * @param mirrored whether the map that places the points mirrors; after it, normals point to
   *        lower values
   * @param connectivity receives 3 point ids per triangle (32 bits, or long long)
   * @param levels receives the level of the diamond that each triangle lies in: 0 for the root, N
   *        at full resolution
   */
  template <typename Id>
  void WriteTriangles(bool mirrored, Id* connectivity, std::int16_t* levels) const
  {
    this->WriteTriangles(this->Passes.AllCells(), mirrored, connectivity, levels);
  }

  /** Writes only a range of the triangles. */
  template <typename Id>
  void WriteTriangles(
    const CellRange& range, bool mirrored, Id* connectivity, std::int16_t* levels) const;

  /** Writes for each triangle the code of the threshold of the diamond that it lies in: a bound of
   *  that diamond's own error, as it is not subdivided. 0 at full resolution. */
  void WriteThresholds(ErrorCode::Type* codes) const;
};

}

#endif
