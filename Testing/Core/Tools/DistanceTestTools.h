// SPDX-License-Identifier: BSD-3-Clause
#ifndef DistanceTestTools_h
#define DistanceTestTools_h

#include "Tools/IntervalTestTools.h"

#include "ReferenceDistance.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/** Distances between surfaces by brute force, and worlds to measure them in. */
namespace test
{

using Positions = std::vector<std::array<double, 3>>;
using SurfaceTriangles = std::vector<reference::SurfaceTriangle>;

/** A world with this spacing on each axis; its origin is not 0. */
isodiamond::AffineMap Spacing(double x, double y, double z);

/** Coordinates that rise in growing steps on x, fall in growing steps on y, and rise in random
 *  steps on z. Steps differ by this ratio at most; they are multiples of a power of 2, so that
 *  little is rounded. */
isodiamond::AxisCoordinates UnevenCoordinates(const std::array<int, 3>& dims, double ratio);

/** A world, with the positions that a curvilinear one looks at. */
struct World : isodiamond::GridGeometry
{
  World(isodiamond::GridGeometry other) // NOLINT(google-explicit-constructor)
    : GridGeometry(std::move(other))
  {
  }
  World(std::vector<double> positions, const std::array<int, 3>& dims)
    : GridGeometry(isodiamond::SamplePositions{ positions.data(), dims })
    , Positions(std::make_shared<std::vector<double>>(std::move(positions)))
  {
  }

  std::shared_ptr<std::vector<double>> Positions;
};

/** A grid that is bent smoothly, and twisted. */
World Bent(const std::array<int, 3>& dims);
/** A grid that is wound around an axis once: all samples of the first column of a slice are on the
 *  axis, and its two ends meet. */
World Wound(const std::array<int, 3>& dims);
/** A spacing, and uneven axes: boxes of index space are boxes in the world. */
std::vector<World> StraightWorldsFor(const std::array<int, 3>& dims);
/** The same, and two curvilinear grids. */
std::vector<World> WorldsFor(const std::array<int, 3>& dims);

/** Triangles with their corners moved to the world. */
SurfaceTriangles Placed(const SurfaceTriangles& triangles, const isodiamond::GridGeometry& world);
/** A mesh's triangles in the world; of a volume, those on one surface, -1 or 1. */
SurfaceTriangles Placed(const Mesh& mesh, const isodiamond::GridGeometry& world);
SurfaceTriangles Placed(const Volume& volume, int surface, const isodiamond::GridGeometry& world);

/** How many tetrahedra of a volume do not have positive volume in a world that does not mirror
 *  everything, or negative volume in one that does. */
int CountOverturned(const Volume& volume, const isodiamond::GridGeometry& world);

/** The distances of points to the nearest of many triangles, by a tree of boxes around halves of
 *  them: large fields have millions, and to look at each of them for each point takes hours. */
class NearestTriangle
{
public:
  explicit NearestTriangle(SurfaceTriangles triangles);

  /** Infinite without triangles. @param enough the search stops at any distance up to this */
  double Distance(const std::array<double, 3>& point, double enough = 0.0) const;

private:
  struct Box
  {
    std::array<double, 3> Low{};
    std::array<double, 3> High{};

    void Add(const std::array<double, 3>& point);
    double SquaredDistance(const std::array<double, 3>& point) const;
  };

  /** The triangles from First to End; the halves of part n are parts 2 n + 1 and 2 n + 2. */
  struct Part
  {
    std::size_t Number;
    std::size_t First;
    std::size_t End;

    bool IsLeaf() const { return this->End - this->First <= 4; }
    std::array<Part, 2> Halves() const;
  };

  Part All() const { return { 0, 0, this->Triangles.size() }; }
  void MakeBoxes(const Part& part);
  void Search(
    const Part& part, const std::array<double, 3>& point, double enough, double& distance) const;

  SurfaceTriangles Triangles; ///< sorted so that each part is a run of them
  std::vector<Box> Boxes;     ///< by the numbers of parts
  mutable std::size_t Last = 0;
};

/** Calls body(point) for the corners of a triangle and for points of it at most a step apart.
 *  @return no point of the triangle is farther than this from the nearest of them */
double ForEachSample(const reference::SurfaceTriangle& triangle, double step,
  const std::function<void(const std::array<double, 3>&)>& body);

/** The largest distance found at samples; between them it may be larger by up to Gap. */
struct SampledDistance
{
  double Largest = 0.0;
  double Gap = 0.0;

  void Add(const reference::SurfaceTriangle& triangle, const NearestTriangle& to, double step);
};

/** What is promised of a mesh. */
struct Promise
{
  double Tolerance = 0.0;
  /** From one sample on the mesh to the next. */
  double Step = 0.125;
  /** Whether full resolution must be near the mesh: not if features may vanish. */
  bool Forth = true;
  /** Whether the mesh must be near full resolution. */
  bool Back = true;
  /** Low and high corner of the box in which points are checked. */
  std::array<std::array<double, 3>, 2> Within = { { { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL },
    { HUGE_VAL, HUGE_VAL, HUGE_VAL } } };
  /** About how many samples to check at most: more are thinned out. */
  double MostSamples = 1e5;
};

/**
 * Checks that no sample of a mesh is farther from full resolution than the tolerance, and no vertex
 * of full resolution farther from the mesh. All triangles are in the world.
 * @return the farthest, of each that are too far away, in words; empty if there are none
 */
std::string FaultOf(
  const Promise& promise, const SurfaceTriangles& full, const SurfaceTriangles& mesh);

/** A box of index space, moved to a world that is not sheared or turned; smaller by rounding. */
std::array<std::array<double, 3>, 2> Placed(
  const isodiamond::Box& box, const isodiamond::GridGeometry& world);

}

#endif
