// SPDX-License-Identifier: BSD-3-Clause
#ifndef IntervalTestTools_h
#define IntervalTestTools_h

#include "Mesh/IntervalExtraction.h"
#include "Tools/CoreTestTools.h"

#include "ReferenceInterval.h"

#include <algorithm>
#include <cmath>
#include <limits>

/** Interval volumes for the core's tests. */
namespace test
{

/** An extracted interval volume in index space. */
struct Volume
{
  std::vector<std::array<double, 3>> Points;
  std::vector<double> Values;
  std::vector<std::int8_t> Surfaces;
  std::vector<std::array<std::int32_t, 4>> Tetrahedra;
  std::vector<std::int16_t> Levels;

  bool operator==(const Volume& other) const
  {
    const auto isSame = [](double a, double b)
    { return a == b || (std::isnan(a) && std::isnan(b)); };
    return this->Points == other.Points && this->Values.size() == other.Values.size() &&
      std::equal(this->Values.begin(), this->Values.end(), other.Values.begin(), isSame) &&
      this->Surfaces == other.Surfaces && this->Tetrahedra == other.Tetrahedra &&
      this->Levels == other.Levels;
  }
};
Volume ExtractVolume(const isodiamond::IsodiamondHierarchy& hierarchy,
  const isodiamond::Query& query,
  const isodiamond::ParallelFor& parallelFor = isodiamond::SerialFor);
Volume ExtractVolume(const isodiamond::IsodiamondHierarchy& hierarchy, double tolerance,
  double interiorTolerance = std::numeric_limits<double>::infinity(),
  const isodiamond::ParallelFor& parallelFor = isodiamond::SerialFor);

/** Six times the signed volume of a tetrahedron. */
double Determinant(const Volume& volume, const std::array<std::int32_t, 4>& tetrahedron);
double TotalVolume(const Volume& volume);

/**
 * What must hold of a mesh fit for a solver: every tetrahedron has positive volume, every point is
 * used, every face belongs to two tetrahedra or lies on the lower surface, the upper surface or the
 * grid's boundary. @return the first fault in words, empty if there is none
 */
std::string FindFault(const Volume& volume, const std::array<int, 3>& dims);

/** The faces on the lower (-1) or upper (1) surface that belong to only one tetrahedron. */
std::vector<std::array<std::int32_t, 3>> SurfaceFaces(const Volume& volume, int surface);
inline std::size_t CountSurfaceFaces(const Volume& volume, int surface)
{
  return SurfaceFaces(volume, surface).size();
}

/** Tetrahedra as the sorted positions of their corners, with their level: equal for equal meshes,
 *  whatever their order. */
std::vector<std::pair<std::array<std::array<double, 3>, 4>, int>> PlacedTetrahedra(
  const Volume& volume);

/** Ranges worth trying on a field: the middle of its values, a narrow one with ends between small
 *  integers, two that are open on one side, and one that is open on both. */
std::vector<reference::Isorange> RangesOf(const Field& field);

inline isodiamond::Isoregion RegionOf(const reference::Isorange& range)
{
  return { range.Lower, range.Upper };
}

}

#endif
