// SPDX-License-Identifier: BSD-3-Clause
// Hierarchies of any arrays: either refused, or every query gives a mesh whose cells have points.
#include "EncodingBytes.h"

#include "Build/Builder.h"
#include "Mesh/DiamondMesh.h"
#include "Mesh/IntervalExtraction.h"
#include "Mesh/SurfaceExtraction.h"
#include "Refinement/ScalarQuery.h"
#include "Simplification/Simplification.h"
#include "Stuffing/Coarsening.h"
#include "Stuffing/Improvement.h"
#include "Stuffing/MovedVertices.h"
#include "Stuffing/Stuffing.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

using namespace isodiamond;

namespace
{

/** No tolerance may take long: what is refined is in the arrays, and these are short. */
constexpr std::int64_t MostPoints = 10'000'000;
/** Larger meshes are not changed any more. */
constexpr std::size_t MostCells = 2000;

void Check(bool condition)
{
  if (!condition)
  {
    std::abort();
  }
}

template <typename Cells>
void CheckIds(const Cells& connectivity, std::int64_t points)
{
  Check(std::all_of(connectivity.begin(), connectivity.end(),
    [&](std::int32_t id) { return id >= 0 && id < points; }));
}

void StuffLeaves(const IntervalExtraction& extraction, const Grid& grid)
{
  const CutMesh leaves = extraction.Leaves(nullptr);
  if (leaves.Tetrahedra.size() > MostCells)
  {
    return;
  }
  const GridGeometry world = AffineMap();
  const std::vector<Vector> vertices = VerticesInWorld(leaves, world);
  std::vector<Vector> points(extraction.PointCount());
  extraction.ForEachPoint([&](const MeshPoint& point) { points[point.Id] = world(point.Index); });
  StuffingInput input{ leaves, vertices, points, world, grid, 0.5 };
  input.Allowances.assign(leaves.Tetrahedra.size(), 1.0);
  input.CanBeFiner.assign(leaves.Tetrahedra.size(), true);
  try
  {
    FarLeaves(input, SerialFor);
  }
  catch (const std::invalid_argument&) // refused
  {
    return;
  }
  // What Stuff() does, but for detours: where a mesh is hopeless, they take seconds.
  std::vector<Walls::Type> walls;
  for (const Vector& vertex : vertices)
  {
    walls.push_back(static_cast<Walls::Type>(Walls::At(vertex, grid)));
  }
  const Background background(leaves, vertices, std::move(walls), points, false);
  MovedVertices moved(background);
  const TetrahedronMesh plain = CutAsMeasured(background, SerialFor);
  moved.MoveAll(SerialFor);
  ImprovementOptions options;
  options.SurfaceMove = 0.5;
  TetrahedronMesh mesh = Improve(moved.Cut(SerialFor), options, SerialFor);
  const std::vector<bool> canBeNearer(leaves.Tetrahedra.size(), false);
  Coarsen(mesh, { plain, input.Allowances, canBeNearer }, SerialFor);
  for (const Corners& corners : mesh.Tetrahedra)
  {
    Check(std::all_of(corners.begin(), corners.end(),
      [&](std::uint32_t point) { return point < mesh.Positions.size(); }));
  }
}

void SimplifyTriangles(
  const std::vector<float>& points, const std::vector<std::int32_t>& connectivity, const Grid& grid)
{
  if (connectivity.size() > 3 * MostCells)
  {
    return;
  }
  AllowedMesh mesh;
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    mesh.Mesh.Positions.push_back({ points[i], points[i + 1], points[i + 2] });
    mesh.OnWalls.push_back(Walls::At(mesh.Mesh.Positions.back(), grid));
  }
  for (std::size_t i = 0; i < connectivity.size(); i += 3)
  {
    Triangle& triangle = mesh.Mesh.Triangles.emplace_back();
    std::copy_n(connectivity.begin() + static_cast<std::ptrdiff_t>(i), 3, triangle.begin());
  }
  mesh.Allowances.assign(mesh.Mesh.Triangles.size(), 1.0);
  for (const Triangle& triangle : Simplify(mesh, SerialFor).Triangles)
  {
    Check(std::all_of(triangle.begin(), triangle.end(),
      [&](std::uint32_t point) { return point < mesh.Mesh.Positions.size(); }));
  }
}

void Extract(const IsodiamondHierarchy& hierarchy, const Query& query)
{
  const RefinedSet refined(hierarchy, query, SerialFor);
  if (hierarchy.Region().IsVolume())
  {
    const IntervalExtraction extraction(refined, SerialFor);
    Check(extraction.PointCount() <= MostPoints);
    std::vector<float> points(3 * extraction.PointCount());
    std::vector<float> values(extraction.PointCount());
    std::vector<std::int8_t> surfaces(extraction.PointCount());
    std::vector<std::int32_t> connectivity(4 * extraction.TetrahedronCount());
    std::vector<std::int16_t> levels(extraction.TetrahedronCount());
    extraction.WritePoints(AffineMap(), points.data());
    extraction.WriteValues(values.data(), surfaces.data());
    extraction.WriteTetrahedra(false, connectivity.data(), levels.data());
    CheckIds(connectivity, extraction.PointCount());
    StuffLeaves(extraction, hierarchy.SampleGrid());
  }
  else
  {
    const SurfaceExtraction extraction(refined, SerialFor);
    Check(extraction.PointCount() <= MostPoints);
    std::vector<float> points(3 * extraction.PointCount());
    std::vector<std::int32_t> connectivity(3 * extraction.TriangleCount());
    std::vector<std::int16_t> levels(extraction.TriangleCount());
    extraction.WritePoints(AffineMap(), points.data());
    extraction.WriteTriangles(false, connectivity.data(), levels.data());
    CheckIds(connectivity, extraction.PointCount());
    SimplifyTriangles(points, connectivity, hierarchy.SampleGrid());
  }
  ExtractDiamondMesh(refined);
}

Query RegionQuery(const fuzz::Arrays& arrays, const Grid& grid)
{
  const std::array<double, 6>& b = arrays.Region;
  Query query{ 0.0, arrays.InteriorTolerance };
  query.Region.emplace(Box{ { b[0], b[1], b[2] }, { b[3], b[4], b[5] } }, grid, AffineMap());
  query.OutsideTolerance = arrays.Tolerance;
  return query;
}

void QueryIsodiamonds(const fuzz::Arrays& arrays)
{
  const IsodiamondHierarchy hierarchy(arrays.Isodiamonds, SerialFor);
  Extract(hierarchy, Query{});
  Extract(hierarchy, Query{ arrays.Tolerance, arrays.InteriorTolerance });
  Query seen;
  seen.View.emplace(Vector{ arrays.Region[0], arrays.Region[1], arrays.Region[2] },
    std::abs(arrays.Tolerance), AffineMap());
  Extract(hierarchy, seen);
  Extract(hierarchy, RegionQuery(arrays, hierarchy.SampleGrid()));
}

void QueryScalars(const fuzz::Arrays& arrays)
{
  const EncodingHeader& header = arrays.Isodiamonds.Header;
  AnySamples samples = ViewOf(arrays.Samples);
  Check(SizeOf(samples) < 1'000'000);
  std::visit(
    [&](auto& view)
    {
      using View = std::decay_t<decltype(view)>;
      const View shaped(view.Pointer(), header.Dimensions);
      // Whoever reads an array has to compare its size with the dimensions.
      const bool fits = std::all_of(
        header.Dimensions.begin(), header.Dimensions.end(), [](int size) { return size > 0; });
      if (!fits || shaped.Size() != view.Size())
      {
        throw std::invalid_argument("dimensions");
      }
      view = shaped;
    },
    samples);
  const ScalarHierarchy hierarchy(samples, header.ErrorScale, arrays.Errors.data(),
    static_cast<std::int64_t>(arrays.Errors.size()), ViewOf(arrays.Minima), ViewOf(arrays.Maxima));
  for (const Query& query : { Query{}, Query{ arrays.Tolerance, arrays.InteriorTolerance },
         RegionQuery(arrays, hierarchy.SampleGrid()) })
  {
    Encoded answer =
      EncodeQuery(hierarchy, header.Region, query, header.ExactIsovertices, SerialFor);
    Extract(
      IsodiamondHierarchy(answer.Encoding, std::move(answer.Diamonds), std::move(answer.Edges)),
      Query{});
  }
  BuildIsodiamonds(Model::Minimal, hierarchy, header.Region, SerialFor);
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  try
  {
    const fuzz::Arrays arrays = fuzz::Read(data, size);
    const std::array<int, 3>& dimensions = arrays.Isodiamonds.Header.Dimensions;
    if (*std::max_element(dimensions.begin(), dimensions.end()) > 1000)
    {
      return 0; // takes long, with nothing to find; TestEncoding tests the limits
    }
    if (arrays.Isodiamonds.Header.TheModel == Model::HierarchyOfDiamonds)
    {
      QueryScalars(arrays);
    }
    else
    {
      QueryIsodiamonds(arrays);
    }
  }
  catch (const std::logic_error&) // refused
  {
  }
  return 0;
}
