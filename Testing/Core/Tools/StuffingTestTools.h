// SPDX-License-Identifier: BSD-3-Clause
#ifndef StuffingTestTools_h
#define StuffingTestTools_h

#include "Tools/IntervalTestTools.h"
#include "Tools/RandomTestTools.h"
#include "Tools/TopologyTestTools.h"

#include "Mesh/CutMesh.h"
#include "Stuffing/Improvement.h"
#include "Stuffing/MeasuredSurfaces.h"
#include "Stuffing/Stuffing.h"

#include <array>
#include <functional>
#include <set>
#include <vector>

/**
 * @file StuffingTestTools.h
 * Tetrahedra for simulations, and fields to make them from.
 */
namespace test
{

/** The directions of a grid's axes in index space. */
inline constexpr std::array<isodiamond::Vector, 3> UnitAxes = { { { 1.0, 0.0, 0.0 },
  { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } } };

/** The mesh of a query, and the mesh for simulations that is made from it. */
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

  /** The volume's mesh, with the same points and leaves. @pre nothing is hidden */
  isodiamond::TetrahedronMesh PlainMesh() const;

  /** The mesh for simulations as a volume, with only the points that are used. */
  Volume AsVolume() const;

  /** The points on surfaces that have moved. */
  std::vector<isodiamond::BlendedPoint> Shifted() const;

  /** Counts tetrahedra with a dihedral angle below 15 or above 165 degrees. */
  std::size_t CountBad() const;
};

/** How many pairs of triangles of a mesh's surfaces intersect. */
std::size_t CountIntersections(const isodiamond::TetrahedronMesh& mesh);

/** The leaves of an interval volume at a tolerance, in index space, and the points of its mesh. */
struct Leaves
{
  /** @param also diamonds that are refined whatever is tolerated */
  Leaves(const isodiamond::IsodiamondHierarchy& hierarchy, double tolerance,
    const std::vector<isodiamond::Place>& also = {});

  /** The diamonds that some leaves lie in: one in so many. */
  std::vector<isodiamond::Place> Diamonds(std::size_t step) const;

  /** As tetrahedra, with vertices moved onto the surfaces, and not improved.
   *  @param mostPush how far isovertices may be pushed @param mostMoves by vertex, or none */
  isodiamond::TetrahedronMesh Moved(
    double mostPush = 0.0, const std::vector<double>& mostMoves = {}) const;

  const isodiamond::Grid& SampleGrid;
  std::vector<isodiamond::Vector> Points;
  isodiamond::CutMesh Mesh;
};

/** What may be done to any mesh. As edges that surfaces cut any will do, as long as a point on a
 *  surface lies on its edge. */
isodiamond::ImprovementOptions OptionsFor(
  const isodiamond::TetrahedronMesh& mesh, double wantedAngle = 15.0);

/** The positions of the corners of each tetrahedron that is alive. */
std::multiset<std::set<isodiamond::Vector>> PlacesOf(const isodiamond::LocalMesh& mesh);

/** The topology of a volume, and of its surfaces. */
Topology TopologyOf(const Volume& volume, AnyMesh mesh);

/** Whether the surfaces of a mesh are anywhere farther from those of a plain one than allowed, or
 *  the other way round, as the library measures it. */
bool IsFar(const isodiamond::TetrahedronMesh& plain, const isodiamond::TetrahedronMesh& mesh,
  double allowance);

/** The same by brute force, in words; empty if nothing is. Both are volumes in index space. */
std::string FarByForce(const Volume& plain, const Volume& mesh, double allowance);

/** A smooth field with tunnels. */
Field GyroidField(int size, double periods);

/** Calls check with random samples, random options, and the volume that these make, between two
 *  values or above one, for as many seeds as ForRandomSeeds(). */
void ForRandomVolumes(const std::function<void(Random& random, const RandomSamples& samples,
    const isodiamond::BuildOptions& options, const Built& built)>& check);

Built BuildVolume(const Field& field, const isodiamond::Isoregion& region);

}

#endif
