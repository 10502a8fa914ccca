// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Builder_h
#define isodiamond_Builder_h

#include "Field/GridGeometry.h"
#include "Field/HiddenCells.h"
#include "Field/Peers.h"
#include "Hierarchy/IsodiamondHierarchy.h"
#include "Hierarchy/ScalarHierarchy.h"

#include <cstdint>

namespace isodiamond
{

/** How a hierarchy is built. */
struct BuildOptions
{
  ErrorMetric Metric = ErrorMetric::Field;
  /** Isovertices on the full-resolution surface, instead of the paper's linear ones; see
   *  IsovertexPlacement.h. */
  bool ExactIsovertices = true;
  /** With the distance metric, whether every feature is kept at any tolerance. */
  bool PreserveFeatures = true;
  /** Whether the mesh at every tolerance is homeomorphic to that of full resolution: critical
   *  diamonds are always subdivided; see CriticalDiamonds.h. */
  bool PreserveTopology = false;
  /** Solids and cavities of fewer connected samples are removed before anything else; see
   *  SmallPieces.h. Not from an HD: it holds samples, and its errors are theirs. 0 keeps all. */
  std::int64_t MinimumPieceSize = 0;
  /** For an interval volume: keep every diamond that has all vertices inside, with its field error,
   *  so that queries can have an interior tolerance. */
  bool RefineInterior = false;
  /** From index space to the world, where distances are measured; not for a curvilinear grid. */
  GridGeometry World = AffineMap();
  /** Cells that count as absent, if there are any. What carries something and touches one is always
   *  subdivided, so that users of the mesh can leave out what lies in the cell. */
  const HiddenCells* Hidden = nullptr;
  /** Processes that build it with this one, from a volume in slabs; null if there are none. */
  Peers* Together = nullptr;
  /** Whether each peer has only a portion of the diamonds until the hierarchy is complete: takes
   *  less memory, but there is no mesh before that. */
  bool InPortions = false;
  /** Called with what is being done; may throw to stop the build. */
  Progress Report = nullptr;
};

/**
 * Builds an RI or MI hierarchy from the samples:
 * samples -> signs -> isodiamonds -> own errors -> activation thresholds -> encoding.
 *
 * @param model Model::Relevant or Model::Minimal
 * @throws std::invalid_argument if the minimum size of pieces is negative
 */
Encoding BuildIsodiamonds(Model model, const AnySamples& samples, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options = {});

/** The same from an HD, which has the field errors already; the result is the same to the bit.
 *  @throws std::invalid_argument if small pieces are to be removed */
Encoding BuildIsodiamonds(Model model, const ScalarHierarchy& hierarchy, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options = {});

}

#endif
