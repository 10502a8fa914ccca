// SPDX-License-Identifier: BSD-3-Clause
#ifndef CoreTestTools_h
#define CoreTestTools_h

#include "Build/Builder.h"
#include "Mesh/SurfaceExtraction.h"

#include "ReferenceMesh.h"

#include <array>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

/** Fields, threads and views that the core's tests share. */
namespace test
{

/** A named field of float samples. */
struct Field
{
  std::string Name;
  std::array<int, 3> Dims{};
  std::vector<float> Samples;
  double Isovalue = 0.0;

  isodiamond::AnySamples View() const
  {
    return isodiamond::SampleView<float>(this->Samples.data(), this->Dims);
  }
  reference::ScalarField Reference() const
  {
    return { this->Dims, { this->Samples.begin(), this->Samples.end() } };
  }
};

/** Small integers, many of them equal to the isovalue 4. */
Field NoiseField(const std::array<int, 3>& dims, unsigned seed);
/** A bumpy sphere. */
Field SphereField(const std::array<int, 3>& dims);
/** Zero but for a few isolated samples: creation and relevant diamonds. */
Field SparseField(const std::array<int, 3>& dims, unsigned seed);
/** Noise with NaN and infinities in it. */
Field BrokenField(const std::array<int, 3>& dims, unsigned seed);
/** A smooth field with one sample in the middle that is not finite. */
Field SpikeField(const std::array<int, 3>& dims, double spike);
/** A smooth wave of real values. */
Field WaveField(const std::array<int, 3>& dims);

/** Small fields of many dimensions: full cubes, odd sizes, thin ones, those that end between the
 *  lattice's planes on one axis and on a plane on another. */
std::vector<Field> SmallFields();

/** A parallel-for on a number of threads, cut into many ranges. */
isodiamond::ParallelFor ThreadedFor(int threads);

/** An encoding with its hierarchy. */
struct Built
{
  isodiamond::Encoding Encoding;
  std::unique_ptr<isodiamond::IsodiamondHierarchy> Hierarchy;

  Built(isodiamond::Encoding encoding, const isodiamond::ParallelFor& parallelFor);
  /** Expects that who encoded found the edges that the encoding implies. */
  Built(isodiamond::Encoded encoded, const isodiamond::ParallelFor& parallelFor);
};
Built Build(
  isodiamond::Model model, const Field& field, const isodiamond::BuildOptions& options = {});

/** The paper's linear isovertices, or exact ones. */
isodiamond::BuildOptions Placement(bool exact);
/** The field metric with a refined interior, or without. */
isodiamond::BuildOptions Interior(bool refine);
/** The distance metric in a world. */
isodiamond::BuildOptions Distance(const isodiamond::GridGeometry& world = isodiamond::AffineMap());

/** Expects that encodings are the same to the bit, and in what was counted. */
void ExpectSame(const isodiamond::Encoding& found, const isodiamond::Encoding& expected);

/** An HD with its arrays. */
struct BuiltScalars
{
  isodiamond::ScalarEncoding Encoding;
  std::unique_ptr<isodiamond::ScalarHierarchy> Hierarchy;
};
BuiltScalars BuildScalars(const Field& field);

/** An extracted surface in index space. */
struct Mesh
{
  std::vector<std::array<float, 3>> Points;
  std::vector<std::array<std::int32_t, 3>> Triangles;
  std::vector<std::int8_t> Levels;

  bool operator==(const Mesh& other) const
  {
    return this->Points == other.Points && this->Triangles == other.Triangles &&
      this->Levels == other.Levels;
  }
};
Mesh Extract(const isodiamond::IsodiamondHierarchy& hierarchy, const isodiamond::Query& query,
  const isodiamond::ParallelFor& parallelFor = isodiamond::SerialFor);
Mesh Extract(const isodiamond::IsodiamondHierarchy& hierarchy, double tolerance,
  const isodiamond::ParallelFor& parallelFor = isodiamond::SerialFor);

/**
 * What a surface must have: edges with one triangle only on the grid's boundary, none with more
 * than two, orientation consistent, points distinct and all used, nothing outside of the grid.
 * @return the first fault in words, empty if there is none
 */
std::string FindFault(const Mesh& mesh, const std::array<int, 3>& dims);

/** Triangles by position and level, so that meshes compare whatever their order is. */
using Corner = std::array<float, 3>;
struct PlacedTriangle
{
  std::array<Corner, 3> Corners; ///< smallest first, orientation kept
  int Level = 0;

  bool operator<(const PlacedTriangle& other) const
  {
    return std::tie(this->Corners, this->Level) < std::tie(other.Corners, other.Level);
  }
  bool operator==(const PlacedTriangle& other) const
  {
    return this->Corners == other.Corners && this->Level == other.Level;
  }
};
PlacedTriangle Place(const Corner& a, const Corner& b, const Corner& c, int level);
std::vector<PlacedTriangle> PlacedTriangles(const Mesh& mesh);

/** Removes the reference's patches from the triangles: each must be there once, quadrilaterals by
 *  either diagonal. @return the first difference in words, empty if all and nothing else was there
 */
std::string CompareWithPatches(const Mesh& mesh, const std::vector<reference::Patch>& patches,
  const reference::ScalarField& field, double isovalue, bool exact = true);

/** The library's place of a central vertex. */
isodiamond::Place PlaceOf(const isodiamond::Grid& grid, const reference::Point& centre);

/** Thresholds that are worth trying on a field: between and beyond its error codes. */
std::vector<double> Tolerances(double scale);

}

#endif
