// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SimplerPart_h
#define isodiamond_SimplerPart_h

#include "Field/Parallel.h"
#include "Simplification/MeshPart.h"

#include <vector>

namespace isodiamond
{

class EdgeCollapses;
class PartDistance;
class SelfIntersections;

/**
 * Undoes collapses and flips until nothing that they have made intersects anything or is too far
 * away: at the latest when all is as it was.
 *
 * @param intersections, distance of the part that edges collapse in
 * @param isTouched by number: which triangles have changed since the part was sound
 * @return whether nothing is wrong any more; else that was so before
 */
bool UndoWhatIsWrong(const SelfIntersections& intersections, PartDistance& distance,
  std::vector<bool> isTouched, EdgeCollapses& collapses, const ParallelFor& parallelFor);

/**
 * Makes a part simpler: collapses edges and flips others, and undoes what leads too far or through
 * something else. If much has to be undone, once more, with less of what is allowed. The part's
 * triangles, near lists and samples become those of the result.
 *
 * @param usedPart see EdgeCollapses
 */
void Simplify(MeshPart& part, double usedPart);

}

#endif
