// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SurfaceDistance_h
#define isodiamond_SurfaceDistance_h

#include "Stuffing/TetrahedronMesh.h"

namespace isodiamond
{

/**
 * Where the surfaces of a stuffed mesh are too far from those of the volume's mesh: measured both
 * ways, all of every triangle (Simplification/Covering.h).
 *
 * @param plain the volume's mesh, with its leaves as origins
 * @param allowances by leaf: how far its part of the surfaces may be away; infinite to not ask
 * @return leaves where it is farther, sorted
 */
std::vector<std::uint32_t> FindFarLeaves(const TetrahedronMesh& plain,
  const TetrahedronMesh& stuffed, const std::vector<double>& allowances);

}

#endif
