// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ScalarHierarchy_h
#define isodiamond_ScalarHierarchy_h

#include "Field/Isoregion.h"
#include "Field/Parallel.h"
#include "Hierarchy/ErrorCode.h"
#include "Lattice/DiamondSet.h"

#include <vector>

/**
 * @file ScalarHierarchy.h
 * HD, the hierarchy of diamonds over a scalar field, for any isovalue or isorange at query time.
 *
 * Every diamond has a sample (that of its central vertex), a field error and a value range. The
 * arrays are dense, x fastest, one box of positions per scale, scales from N - 1 down to 0. Ranges
 * are kept from scale 1 up only: those of scale 0, 7/8 of all, are read from the samples.
 *
 * Weiss & De Floriani, TVCG 2010, section 4.
 */
namespace isodiamond
{

/** A read-only HD. The arrays it views must outlive it. */
class ScalarHierarchy
{
public:
  /**
   * @param codes error codes of all scales; 0 at positions without a diamond
   * @param minima,maxima value ranges of scales >= 1, arrays of the samples' type
   * @throws std::invalid_argument if sizes or types do not match the samples' dimensions
   */
  ScalarHierarchy(const AnySamples& samples, double errorScale, const ErrorCode::Type* codes,
    std::int64_t codeCount, const AnySamples& minima, const AnySamples& maxima);

  const Grid& SampleGrid() const { return this->TheGrid; }
  const AnySamples& Samples() const { return this->Values; }
  const ErrorCode& Codes() const { return this->Code; }

  /** The code of a diamond's own field error. */
  ErrorCode::Type Error(const Place& place) const { return this->ErrorCodes[this->Offset(place)]; }

  /** Value range of the sampled lattice points in a diamond's closed domain. */
  ValueRange Range(const Place& place) const;

  /** Number of entries of the codes, and of the minima and maxima. */
  static std::int64_t CodeCount(const Grid& grid);
  static std::int64_t RangeCount(const Grid& grid);

  /** What a query did. */
  struct WalkResult
  {
    DiamondMask Subdivided;
    std::int64_t Visited = 0; ///< diamonds whose error and range were looked at
  };

  /**
   * The paper's selective refinement: the smallest closed set of diamonds that holds every diamond
   * of the front whose own error code exceeds `accepted` and whose domain a surface crosses. The
   * cost falls as the tolerance grows: only the front is visited.
   *
   * @param acceptedInside if less than Always - 1, the set also holds the diamonds, on the front or
   *        not, that have all vertices inside the interval volume and a greater code; then every
   *        diamond is visited
   * @param always what the set holds in any case, with all ancestors; null for nothing
   */
  WalkResult Refine(const Isoregion& region, ErrorCode::Type accepted,
    ErrorCode::Type acceptedInside = ErrorCode::Always - 1,
    const DiamondMask* always = nullptr) const;

private:
  std::int64_t Offset(const Place& place) const;

  Grid TheGrid;
  AnySamples Values;
  ErrorCode Code;
  const ErrorCode::Type* ErrorCodes = nullptr;
  AnySamples Minima;
  AnySamples Maxima;
  std::vector<std::int64_t> FirstOfScale;
};

/** The arrays of an HD except the samples. */
struct ScalarEncoding
{
  double ErrorScale = 1.0;
  std::vector<ErrorCode::Type> Codes;
  AnyValues Minima;
  AnyValues Maxima;
};

/** The scale of field error codes: the extent of the finite samples. */
double FieldErrorScale(const AnySamples& samples, const ParallelFor& parallelFor);

/** Builds an HD: visits every sample once per class and scale. */
ScalarEncoding BuildScalarHierarchy(const AnySamples& samples, const ParallelFor& parallelFor);

}

#endif
