// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Builder_h
#define isodiamond_Builder_h

#include "IsodiamondHierarchy.h"
#include "ScalarHierarchy.h"

namespace isodiamond
{

/**
 * Builds an RI or MI hierarchy from the samples, with the field metric:
 * samples -> signs -> isodiamonds -> own errors -> activation thresholds -> encoding.
 *
 * @param model Model::Relevant or Model::Minimal
 * @param refineInterior of an interval volume: keep every diamond that has all vertices inside,
 * with its field error, so that queries can have an interior tolerance
 */
Encoding BuildIsodiamonds(Model model, const AnySamples& samples, const Isoregion& region,
  const ParallelFor& parallelFor, bool refineInterior = false);

/** The same from an HD, which has the errors already; the result is the same to the bit. */
Encoding BuildIsodiamonds(Model model, const ScalarHierarchy& hierarchy, const Isoregion& region,
  const ParallelFor& parallelFor, bool refineInterior = false);

/**
 * One HD query: the subdivided diamonds at a tolerance, encoded as an RI whose every diamond is
 * always subdivided. Extracting it, at any tolerance, gives the query's mesh. The set is closed,
 * so all vertices of its diamonds are centres of diamonds of the set.
 */
Encoding EncodeQuery(const ScalarHierarchy& hierarchy, const Isoregion& region, double tolerance,
  const ParallelFor& parallelFor, double interiorTolerance = HUGE_VAL);

}

#endif
