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

/** What the core's tests share: fields, threads, built hierarchies and extracted meshes. */
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

/** Small fields of many sizes: full cubes, boxes of unequal sides, thin ones, and some that end
 *  between planes of the lattice on one axis and on a plane on another. */
std::vector<Field> SmallFields();

/** A parallel-for whose threads fetch one range after another, each as long as the grain. */
isodiamond::ParallelFor ThreadedFor(int threads);

/** An encoding with its hierarchy. */
struct Built
{
  isodiamond::Encoding Encoding;
  std::unique_ptr<isodiamond::IsodiamondHierarchy> Hierarchy;

  Built(isodiamond::Encoding encoding, const isodiamond::ParallelFor& parallelFor);
  /** Expects that the edges found while encoding are those that the encoding implies. */
  Built(isodiamond::Encoded encoded, const isodiamond::ParallelFor& parallelFor);
};
Built Build(
  isodiamond::Model model, const Field& field, const isodiamond::BuildOptions& options = {});

/** The paper's linear isovertices, or exact ones. */
isodiamond::BuildOptions Placement(bool exact);
/** The field metric, with a refined interior or without one. */
isodiamond::BuildOptions Interior(bool refine);
/** The distance metric in a world. */
isodiamond::BuildOptions Distance(const isodiamond::GridGeometry& world = isodiamond::AffineMap());

/** Expects that encodings are the same to the bit, and that their headers count the same. */
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
  std::vector<std::int16_t> Levels;

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
 * What must hold of a surface: edges with only one triangle lie on the grid's boundary, none has
 * more than two, orientation is consistent, points are distinct and all used, and nothing lies
 * outside the grid.
 * @return the first fault in words, empty if there is none
 */
std::string FindFault(const Mesh& mesh, const std::array<int, 3>& dims);

/** Triangles by position and level, so that meshes can be compared whatever their order. */
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

/** Strikes the reference's patches off the list of triangles: each must be there once,
 *  quadrilaterals split by either diagonal. @return the first difference in words, empty if all
 *  were there and no triangle is left */
std::string CompareWithPatches(const Mesh& mesh, const std::vector<reference::Patch>& patches,
  const reference::ScalarField& field, double isovalue, bool exact = true);

/** The library's place of a central vertex. */
isodiamond::Place PlaceOf(const isodiamond::Grid& grid, const reference::Point& centre);

/** Tolerances worth trying where errors have this scale, from 0 to beyond all errors. */
std::vector<double> Tolerances(double scale);

}

#endif
