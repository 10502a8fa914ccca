// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ReturnedPoints_h
#define isodiamond_ReturnedPoints_h

#include "Stuffing/TetrahedronMesh.h"

namespace isodiamond
{

/** Puts points that were pushed or moved off a surface back to where they were, if that folds no
 *  surface, and all tetrahedra around them are as wanted there, too.
 *  @param wanted the least sine of a dihedral angle */
TetrahedronMesh ReturnPoints(TetrahedronMesh mesh, double wanted);

}

#endif
