// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SimplerMesh_h
#define isodiamond_SimplerMesh_h

#include "Simplification/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/** A mesh on some of the points of another one, and what has become of the others. */
struct SimplerMesh : TriangleMesh
{
  std::vector<std::uint32_t> Homes; ///< by point: the triangle that it lies over; None if it is in
                                    ///< use, or never was
};

}

#endif
