// SPDX-License-Identifier: BSD-3-Clause
#ifndef RandomTestTools_h
#define RandomTestTools_h

#include "Field/HiddenCells.h"
#include "IntervalTestTools.h"

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

/** Random samples, regions and queries for the core's tests. */
namespace test
{

using Random = std::mt19937;

double Uniform(Random& random, double low, double high);
/** From 0 on. */
int Pick(Random& random, int count);

/** Samples of a random type: waves, plateaus, noise, single samples, all magnitudes; with values
 *  that are not finite, or without. */
struct RandomSamples
{
  std::array<int, 3> Dimensions{};
  isodiamond::AnyValues Values;

  /** 2 to a number of samples an axis, and no more than another in all. */
  RandomSamples(Random& random, int longest, int most);

  isodiamond::AnySamples View() const;
  double At(std::size_t index) const;
  std::size_t Size() const;
};

/** A sample's value, or one near to it. */
double RandomValue(Random& random, const RandomSamples& samples);

isodiamond::Isoregion RandomRegion(Random& random, const RandomSamples& samples);

/** Both metrics, affine and uneven worlds, and all else but hidden cells. */
isodiamond::BuildOptions RandomOptions(Random& random, const std::array<int, 3>& dimensions);

/** Single cells, blocks of them, or none. */
isodiamond::HiddenCells RandomHidden(Random& random, const std::array<int, 3>& dimensions);

/** Two tolerances, a region of interest or none, and of errors that are distances a viewpoint or
 *  none. */
isodiamond::Query RandomQuery(Random& random, const isodiamond::IsodiamondHierarchy& hierarchy,
  const isodiamond::GridGeometry& world);

/** What of a region is tested, in words. */
std::string Describe(const RandomSamples& samples, const isodiamond::Isoregion& region);

/** The mesh of a query, whatever it is made of. */
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

/** Calls check(seed) for as many seeds as ISODIAMONDS_CASES says, else 200, from ISODIAMONDS_SEED
 *  on; else for one half of them from 1 on, so that no test depends on luck alone, and for the
 * other from a random one, which is printed; until one fails. @return how many were checked */
int ForRandomSeeds(const std::function<void(std::uint32_t)>& check);

}

#endif
