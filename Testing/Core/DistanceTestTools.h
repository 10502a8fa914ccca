// SPDX-License-Identifier: BSD-3-Clause
#ifndef DistanceTestTools_h
#define DistanceTestTools_h

#include "IntervalTestTools.h"

#include "ReferenceDistance.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/** Distances between surfaces by brute force, and worlds to measure them in. */
namespace test
{

using Positions = std::vector<std::array<double, 3>>;
using SurfaceTriangles = std::vector<reference::SurfaceTriangle>;

/** A spacing that is not the same on all axes, or any. */
isodiamond::AffineMap Spacing(double x, double y, double z);

/** Cells that grow on one axis, fall on another, and have all sizes on the third: of the largest
 *  ratio of their lengths that is given. Multiples of a power of 2, so that little is rounded. */
isodiamond::AxisCoordinates UnevenCoordinates(const std::array<int, 3>& dims, double ratio);

/** Triangles with their corners moved to the world. */
SurfaceTriangles Placed(const SurfaceTriangles& triangles, const isodiamond::GridGeometry& world);
/** A mesh's triangles in the world; of a volume those of one surface, -1 or 1. */
SurfaceTriangles Placed(const Mesh& mesh, const isodiamond::GridGeometry& world);
SurfaceTriangles Placed(const Volume& volume, int surface, const isodiamond::GridGeometry& world);

/** The distances of points to the nearest of many triangles, by a tree of boxes around halves of
 *  them: large fields have millions, and a look at each box for each point takes hours. */
class NearestTriangle
{
public:
  explicit NearestTriangle(SurfaceTriangles triangles);

  /** Infinite without triangles. @param enough any distance that is not greater will do, too */
  double Distance(const std::array<double, 3>& point, double enough = 0.0) const;

private:
  struct Box
  {
    std::array<double, 3> Low{};
    std::array<double, 3> High{};

    void Add(const std::array<double, 3>& point);
    double SquaredDistance(const std::array<double, 3>& point) const;
  };

  /** The triangles from first to end; its halves have the numbers 2 n + 1 and 2 n + 2. */
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

  SurfaceTriangles Triangles; ///< each half of a part is beside the other
  std::vector<Box> Boxes;     ///< by the numbers of parts
  mutable std::size_t Last = 0;
};

/** Calls body(point) for the corners of a triangle and for points of it at most a step apart.
 *  @return nothing of the triangle is farther from all of them */
double ForEachSample(const reference::SurfaceTriangle& triangle, double step,
  const std::function<void(const std::array<double, 3>&)>& body);

/** The largest distance that was found, and how much larger there may be one between samples. */
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
  /** Whether full resolution is near to the mesh, too; not if features may vanish. */
  bool Forth = true;
  /** Whether the mesh is near to full resolution. */
  bool Back = true;
  /** Only what lies in a box is looked at, low and high. */
  std::array<std::array<double, 3>, 2> Within = { { { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL },
    { HUGE_VAL, HUGE_VAL, HUGE_VAL } } };
  /** Where there would be more samples, fewer do. */
  double MostSamples = 1e5;
};

/**
 * Whether no sample of a mesh is farther from full resolution than a tolerance, nor any vertex of
 * full resolution from the mesh. All triangles are in the world.
 * @return the farthest one in words, empty if there is none
 */
std::string FaultOf(
  const Promise& promise, const SurfaceTriangles& full, const SurfaceTriangles& mesh);

/** A box of index space in the world, which has no shear. */
std::array<std::array<double, 3>, 2> Placed(
  const isodiamond::Box& box, const isodiamond::GridGeometry& world);

}

#endif
