// SPDX-License-Identifier: BSD-3-Clause
#ifndef StuffingTestTools_h
#define StuffingTestTools_h

#include "IntervalTestTools.h"
#include "RandomTestTools.h"
#include "TopologyTestTools.h"

#include "Stuffing/MeasuredSurfaces.h"
#include "Stuffing/Stuffing.h"

#include <array>
#include <functional>

/**
 * @file StuffingTestTools.h
 * Tetrahedra for simulations, and fields to make them of.
 */
namespace test
{

/** The directions of a grid's axes in index space. */
inline constexpr std::array<isodiamond::Vector, 3> UnitAxes = { { { 1.0, 0.0, 0.0 },
  { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } } };

/** The mesh of a query, and what is made of it for simulations. */
struct Stuffed
{
  Volume Plain; ///< in index space
  isodiamond::TetrahedronMesh Mesh;
  std::size_t LeafCount = 0;
  std::vector<std::uint32_t> PlainOrigins; ///< by tetrahedron of the volume's mesh: its leaf
  double SurfaceMove = 0.0;

  Stuffed(const isodiamond::IsodiamondHierarchy& hierarchy, const isodiamond::Query& query,
    const isodiamond::GridGeometry& world = isodiamond::AffineMap(),
    const isodiamond::HiddenCells* hidden = nullptr,
    const isodiamond::ParallelFor& parallelFor = isodiamond::SerialFor);

  /** The volume's mesh, of the same points and leaves. @pre nothing is hidden */
  isodiamond::TetrahedronMesh PlainMesh() const;

  /** As a volume with the points that are used. */
  Volume AsVolume() const;

  /** The points on surfaces that are not where they were. */
  std::vector<isodiamond::BlendedPoint> Shifted() const;

  /** Tetrahedra with an angle below 15 or above 165 degrees. */
  std::size_t CountBad() const;
};

/** The topology of a volume, and of its surfaces. */
Topology TopologyOf(const Volume& volume, AnyMesh mesh);

/** Whether anything of the surfaces of a mesh is farther from those of a plain one than allowed, as
 *  it is measured, or the other way. */
bool IsFar(const isodiamond::TetrahedronMesh& plain, const isodiamond::TetrahedronMesh& mesh,
  double allowance);

/** The same, by brute force; both are volumes in index space. */
std::string FarByForce(const Volume& plain, const Volume& mesh, double allowance);

/** A smooth field with tunnels. */
Field GyroidField(int size, double periods);

/** Calls check with random samples, how they are built, and the volume between two values, or above
 *  one, for as many seeds as ForRandomSeeds(). */
void ForRandomVolumes(const std::function<void(Random& random, const RandomSamples& samples,
    const isodiamond::BuildOptions& options, const Built& built)>& check);

Built BuildVolume(const Field& field, const isodiamond::Isoregion& region);

}

#endif
