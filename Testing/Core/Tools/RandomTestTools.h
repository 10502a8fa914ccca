// SPDX-License-Identifier: BSD-3-Clause
#ifndef RandomTestTools_h
#define RandomTestTools_h

#include "Field/HiddenCells.h"
#include "Tools/IntervalTestTools.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

/** Random samples, regions and queries for the core's tests. */
namespace test
{

using Random = std::mt19937;

double Uniform(Random& random, double low, double high);
/** From 0 to count - 1. */
int Pick(Random& random, int count);

/** Samples of a random type: waves, plateaus, noise, single samples, all magnitudes; with or
 *  without special values, such as NaN, among them. */
struct RandomSamples
{
  std::array<int, 3> Dimensions{};
  isodiamond::AnyValues Values;

  /** At least 2 samples on each axis. @param longest the most on an axis @param most in all */
  RandomSamples(Random& random, int longest, int most);

  isodiamond::AnySamples View() const;
  double At(std::size_t index) const;
  std::size_t Size() const;
};

/** A sample's value, or the mean of two; never NaN. */
double RandomValue(Random& random, const RandomSamples& samples);

isodiamond::Isoregion RandomRegion(Random& random, const RandomSamples& samples);

/** Options, with the positions that a curvilinear world looks at. */
struct OwningOptions : isodiamond::BuildOptions
{
  std::shared_ptr<const std::vector<double>> Positions;
};

/** Random options but for hidden cells: either metric, affine, uneven and curvilinear worlds, and
 * so on. */
OwningOptions RandomOptions(Random& random, const std::array<int, 3>& dimensions);

/** Single cells, one block of them, or none. */
isodiamond::HiddenCells RandomHidden(Random& random, const std::array<int, 3>& dimensions);

/** Two tolerances, perhaps a region of interest and, if errors are distances, perhaps a viewpoint.
 */
isodiamond::Query RandomQuery(Random& random, const isodiamond::IsodiamondHierarchy& hierarchy,
  const isodiamond::GridGeometry& world);

/** The samples and the region in words. */
std::string Describe(const RandomSamples& samples, const isodiamond::Isoregion& region);

/** The mesh of a query: triangles of a surface, or tetrahedra of a volume. */
struct AnyMesh
{
  Mesh Surface;
  Volume Interval;

  AnyMesh(const isodiamond::IsodiamondHierarchy& hierarchy, const isodiamond::Query& query,
    const isodiamond::ParallelFor& parallelFor = isodiamond::SerialFor);

  bool operator==(const AnyMesh& other) const
  {
    return this->Surface == other.Surface && this->Interval == other.Interval;
  }
  bool IsSameInAnyOrder(const AnyMesh& other) const;
  std::size_t CellCount() const
  {
    return this->Surface.Triangles.size() + this->Interval.Tetrahedra.size();
  }
  std::string Fault(const std::array<int, 3>& dimensions) const;
};

/** Calls check(seed) for ISODIAMONDS_CASES seeds, 200 by default, until one fails. They count up
 *  from ISODIAMONDS_SEED; without it, half of them from 1, so that no test depends on luck alone,
 *  and the others from a random seed, which is printed. @return how many were checked */
int ForRandomSeeds(const std::function<void(std::uint32_t)>& check);

}

#endif
