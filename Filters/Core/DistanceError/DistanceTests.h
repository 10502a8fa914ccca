// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DistanceTests_h
#define isodiamond_DistanceTests_h

#include "DistanceError/FineSurface.h"
#include "Field/GridGeometry.h"
#include "Field/Samples.h"
#include "Patches/WorldLengths.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace isodiamond
{

/** A diamond, and the greatest code that is tolerated of it, ErrorCode::Least or more. */
struct TestedDiamond
{
  Place Diamond;
  ErrorCode::Type Accepted = 0;
};

/** One of the surfaces of a hierarchy, at full resolution. */
struct TestedSurface
{
  int Number = 0;
  FineSurface Fine;

  /** As for FineSurface. */
  TestedSurface(const IsodiamondHierarchy& hierarchy, int surface, const HiddenCells* hidden,
    const ParallelFor& parallelFor)
    : Number(surface)
    , Fine(hierarchy, surface, hidden, parallelFor)
  {
  }
};

/** What the tests of all diamonds are based on. */
struct TestedHierarchy
{
  const IsodiamondHierarchy& Relevant; ///< an RI, whatever its error codes
  const Finiteness& IsFinite;
  ErrorCode Code;
  bool PreserveFeatures = true;
  const HiddenCells* Hidden = nullptr; ///< null for none
};

/**
 * Tells whether the distance errors of diamonds exceed a tolerance, without measuring what does not
 * matter for that: for meshes of one tolerance, in which most diamonds have no part.
 *
 * The error is that of DistanceErrors() and RaiseByWayBack(), but the way back may count as too
 * long from 8/9 of the tolerance on.
 */
class DistanceTests
{
public:
  /** All of the hierarchy's parts must outlive it.
   *  @throws std::invalid_argument if the world has no distances */
  DistanceTests(
    const TestedHierarchy& tested, const GridGeometry& world, const ParallelFor& parallelFor);

  /** For each diamond, whether it exceeds what is tolerated. */
  std::vector<std::uint8_t> Exceed(
    const std::vector<TestedDiamond>& diamonds, const ParallelFor& parallelFor) const;

private:
  TestedHierarchy Tested;
  WorldLengths InWorld;
  std::deque<TestedSurface> Surfaces; ///< which cannot be moved
};

}

#endif
