// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeasuredSurfaces_h
#define isodiamond_MeasuredSurfaces_h

#include "Field/Parallel.h"
#include "Simplification/MeshPart.h"
#include "Stuffing/TetrahedronMesh.h"

namespace isodiamond
{

/** The triangles of a mesh's surfaces, seen from outside, and the origins of their tetrahedra. */
struct Surfaces
{
  std::vector<Triangle> Triangles;
  std::vector<std::uint32_t> Origins;
};
Surfaces SurfacesOf(const TetrahedronMesh& mesh);

/**
 * The surfaces of a volume's mesh, and of the mesh that was made of it, for comparison.
 *
 * The second mesh has some points of the first, and a few of its own; samples of the first lie over
 * the nearest triangle of the second, as far as walking over the surface can tell.
 */
struct MeasuredSurfaces
{
  /** @param allowances by origin, of either mesh: how far from its triangles of the first mesh the
   * second one may be */
  MeasuredSurfaces(const TetrahedronMesh& plain, const TetrahedronMesh& stuffed,
    const std::vector<double>& allowances, const ParallelFor& parallelFor);

  /** By sample: the triangle of the second mesh that it lies over. */
  std::vector<std::uint32_t> Homes() const;

  /** Whether both can be walked over: no edge has more than two triangles. */
  bool AreSound = false;
  MeshPart Part;                            ///< with the first one as original; if they are sound
  std::vector<std::uint32_t> Origins;       ///< by triangle of the first mesh
  std::vector<std::uint32_t> SimpleOrigins; ///< of the second

private:
  std::vector<std::uint32_t> AnyInLeaves(
    const std::vector<std::int8_t>& surfaces, std::size_t leafCount) const;
};

}

#endif
