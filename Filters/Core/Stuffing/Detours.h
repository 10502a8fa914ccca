// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Detours_h
#define isodiamond_Detours_h

#include "Field/Parallel.h"
#include "Stuffing/Improvement.h"
#include "Stuffing/LocalMesh.h"

namespace isodiamond
{

/**
 * Improves bad tetrahedra that no single change improves: by several, of which the first ones make
 * things worse.
 *
 * On a copy of what is around it one to three changes are made by chance, and then what
 * Improvement.h would do next, until it finds no more. The best of many such attempts, each from
 * the best one before, is done to the mesh, if it leaves less to be wished for and the worst one no
 * worse. It ends where attempts have not helped for too long. Chance is the same each time: the
 * result depends on nothing but the mesh.
 */
void TakeDetours(
  LocalMesh& mesh, const ImprovementOptions& options, const ParallelFor& parallelFor);

}

#endif
