// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DistanceMeasures_h
#define isodiamond_DistanceMeasures_h

#include "DistanceError/DistanceError.h"
#include "DistanceError/DistanceTests.h"
#include "DistanceError/ErrorMaxima.h"
#include "DistanceError/IsovertexClusters.h"
#include "Field/Parallel.h"

/**
 * @file DistanceMeasures.h
 * What takes the time of the distance metric, for each kind of lengths.
 *
 * Time is spent in small functions, and the more of these a file has, the fewer compilers inline:
 * so each kind has a file of its own, and the frequent one, affine, one for each member. These
 * include the members' definitions, DistanceMeasuresOf.h; who calls them does not.
 */
namespace isodiamond
{

template <typename Lengths>
struct DistanceMeasures
{
  ///@{
  /** Raise the distance errors of all diamonds: of scale 1 and above (DistanceWalk.h), and of scale
   * 0 (ScaleZeroDistances.h). */
  static void Coarse(const IsovertexClusters& clusters, const Lengths& lengths, ErrorMaxima& errors,
    const Loops& loops);
  static void ScaleZero(const IsovertexClusters& clusters, const Lengths& lengths,
    ErrorMaxima& errors, const Loops& loops);
  ///@}

  /** Raises errors to the way back (WayBack.h), each diamond by itself.
   *  @param codes by rank, of the way forth */
  static void Back(const IsodiamondHierarchy& relevant, const Lengths& lengths,
    const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
    const Loops& loops);

  /** Tells whether diamonds exceed what is tolerated of them, on one surface (ToleranceTest.h).
   *  @param exceeds one entry per diamond, to be set where it does */
  static void Test(const TestedSurface& surface, const TestedHierarchy& tested,
    const Lengths& lengths, const std::vector<TestedDiamond>& diamonds,
    std::vector<std::uint8_t>& exceeds, const ParallelFor& parallelFor);
};

}

#endif
