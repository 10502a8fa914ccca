// SPDX-License-Identifier: BSD-3-Clause
#include "Tools/StuffingTestTools.h"

#include "Tools/DistanceTestTools.h"

#include "Mesh/IntervalExtraction.h"
#include "Simplification/PartDistance.h"
#include "Simplification/TriangleIntersection.h"
#include "Stuffing/Background.h"
#include "Stuffing/MovedVertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

using namespace isodiamond;

namespace test
{
namespace
{

/** By tetrahedron of the volume's mesh: the leaf that it is a part of, which has all its points at
 *  vertices or on edges. None where leaves are hidden. */
std::vector<std::uint32_t> LeavesOf(const Volume& plain, const CutMesh& leaves)
{
  std::vector<std::vector<std::uint32_t>> at(plain.Points.size());
  for (std::uint32_t leaf = 0; leaf < leaves.Tetrahedra.size(); ++leaf)
  {
    std::vector<std::uint32_t> points;
    for (const std::uint32_t vertex : leaves.Tetrahedra[leaf].Vertices)
    {
      points.push_back(leaves.Vertices[vertex].PointId);
    }
    for (const auto& cuts : leaves.Tetrahedra[leaf].Cuts)
    {
      points.insert(points.end(), cuts.begin(), cuts.end());
    }
    for (const std::uint32_t point : points)
    {
      if (point != CutMesh::None)
      {
        at[point].push_back(leaf);
      }
    }
  }
  std::vector<std::uint32_t> leafOf;
  for (const auto& [a, b, c, d] : plain.Tetrahedra)
  {
    const auto found = std::find_if(at[a].begin(), at[a].end(),
      [&, others = std::array{ b, c, d }](std::uint32_t leaf)
      {
        return std::all_of(others.begin(), others.end(),
          [&](std::int32_t other)
          { return std::find(at[other].begin(), at[other].end(), leaf) != at[other].end(); });
      });
    leafOf.push_back(found != at[a].end() ? *found : CutMesh::None);
  }
  return leafOf;
}

}

Stuffed::Stuffed(const IsodiamondHierarchy& hierarchy, const Query& query,
  const GridGeometry& world, const HiddenCells* hidden, const ParallelFor& parallelFor)
  : Plain(ExtractVolume(hierarchy, query))
{
  const RefinedSet refined(hierarchy, query, SerialFor);
  const IntervalExtraction extraction(refined, SerialFor);
  std::vector<Vector> points;
  for (const std::array<double, 3>& point : this->Plain.Points)
  {
    points.push_back(world(point));
  }
  const CutMesh leaves = extraction.Leaves(hidden);
  const std::vector<Vector> vertices = VerticesInWorld(leaves, world);
  this->SurfaceMove = std::max(0.25 * world.SmallestStep(), 0.5 * query.Tolerance);
  this->LeafCount = leaves.Tetrahedra.size();
  this->PlainOrigins = LeavesOf(this->Plain, leaves);
  this->Mesh = Stuff(
    { leaves, vertices, points, world, hierarchy.SampleGrid(), this->SurfaceMove }, parallelFor)
                 .Mesh;
}

TetrahedronMesh Stuffed::PlainMesh() const
{
  TetrahedronMesh plain = this->Mesh;
  plain.Tetrahedra.clear();
  plain.Positions = this->Plain.Points;
  plain.OnWalls.resize(plain.Positions.size());
  plain.Blended.clear();
  plain.Surfaces = this->Plain.Surfaces;
  for (const std::array<std::int32_t, 4>& corners : this->Plain.Tetrahedra)
  {
    plain.Tetrahedra.push_back(
      { static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[1]),
        static_cast<std::uint32_t>(corners[2]), static_cast<std::uint32_t>(corners[3]) });
  }
  plain.Origins = this->PlainOrigins;
  EXPECT_EQ(std::count(plain.Origins.begin(), plain.Origins.end(), CutMesh::None), 0);
  return plain;
}

Volume Stuffed::AsVolume() const
{
  Volume volume;
  std::vector<std::int32_t> ids(this->Mesh.Positions.size(), -1);
  for (const Corners& corners : this->Mesh.Tetrahedra)
  {
    std::array<std::int32_t, 4> tetrahedron{};
    for (int i = 0; i < 4; ++i)
    {
      std::int32_t& id = ids[corners[i]];
      if (id < 0)
      {
        id = static_cast<std::int32_t>(volume.Points.size());
        volume.Points.push_back(this->Mesh.Positions[corners[i]]);
        volume.Surfaces.push_back(this->Mesh.Surfaces[corners[i]]);
        volume.Values.push_back(0.0);
      }
      tetrahedron[i] = id;
    }
    volume.Tetrahedra.push_back(tetrahedron);
    volume.Levels.push_back(0);
  }
  return volume;
}

std::vector<BlendedPoint> Stuffed::Shifted() const
{
  std::vector<bool> isThere(this->Mesh.Positions.size());
  for (const Corners& corners : this->Mesh.Tetrahedra)
  {
    for (const std::uint32_t point : corners)
    {
      isThere[point] = true;
    }
  }
  std::vector<BlendedPoint> shifted;
  std::copy_if(this->Mesh.Blended.begin(), this->Mesh.Blended.end(), std::back_inserter(shifted),
    [&](const BlendedPoint& blended)
    { return isThere[blended.Point] && this->Mesh.Surfaces[blended.Point] != 0; });
  return shifted;
}

std::size_t Stuffed::CountBad() const
{
  return std::count_if(this->Mesh.Tetrahedra.begin(), this->Mesh.Tetrahedra.end(),
    [&](const Corners& corners)
    { return SmallestSine(this->Mesh, corners) < std::sin(15.0 * std::acos(-1.0) / 180.0); });
}

Leaves::Leaves(const IsodiamondHierarchy& hierarchy, double tolerance,
  const std::vector<isodiamond::Place>& also)
  : SampleGrid(hierarchy.SampleGrid())
{
  Query query;
  query.Tolerance = tolerance;
  query.Also = also;
  const RefinedSet refined(hierarchy, query, SerialFor);
  const IntervalExtraction extraction(refined, SerialFor);
  this->Points.resize(extraction.PointCount());
  extraction.ForEachPoint([&](const MeshPoint& point) { this->Points[point.Id] = point.Index; });
  this->Mesh = extraction.Leaves(nullptr);
}

std::vector<isodiamond::Place> Leaves::Diamonds(std::size_t step) const
{
  std::vector<isodiamond::Place> places;
  for (std::size_t leaf = 0; leaf < this->Mesh.Tetrahedra.size(); leaf += step)
  {
    if (const auto place = DiamondOf(this->Mesh, leaf, this->SampleGrid))
    {
      places.push_back(*place);
    }
  }
  return places;
}

TetrahedronMesh Leaves::Moved(double mostPush, const std::vector<double>& mostMoves) const
{
  const std::vector<Vector> vertices = VerticesInWorld(this->Mesh, AffineMap());
  std::vector<Walls::Type> walls;
  for (const Vector& vertex : vertices)
  {
    walls.push_back(Walls::At(vertex, this->SampleGrid));
  }
  const Background background(this->Mesh, vertices, walls, this->Points, false, mostMoves);
  MovedVertices moved(background);
  moved.MoveAll(SerialFor);
  moved.PushAll(mostPush, SerialFor);
  return moved.Cut(SerialFor);
}

ImprovementOptions OptionsFor(const TetrahedronMesh& mesh, double wantedAngle)
{
  ImprovementOptions options;
  options.WantedAngle = wantedAngle;
  options.Axes = UnitAxes;
  options.SurfaceMove = 0.25;
  for (const Vector& position : mesh.Positions)
  {
    options.CutEdges.push_back(
      { position - Vector{ 0.5, 0.0, 0.0 }, position + Vector{ 0.5, 0.0, 0.0 }, 1.0 });
  }
  return options;
}

std::multiset<std::set<Vector>> PlacesOf(const LocalMesh& mesh)
{
  std::multiset<std::set<Vector>> all;
  for (std::uint32_t i = 0; i < mesh.Mesh().Tetrahedra.size(); ++i)
  {
    if (mesh.IsAlive(i))
    {
      std::set<Vector> places;
      for (const std::uint32_t corner : mesh.CornersOf(i))
      {
        places.insert(mesh.At(corner));
      }
      all.insert(std::move(places));
    }
  }
  return all;
}

std::size_t CountIntersections(const TetrahedronMesh& mesh)
{
  const std::vector<Triangle> triangles = SurfacesOf(mesh).Triangles;
  std::size_t count = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      count += Intersect(mesh.Positions, triangles[i], triangles[k]) ? 1 : 0;
    }
  }
  return count;
}

Topology TopologyOf(const Volume& volume, AnyMesh mesh)
{
  mesh.Interval = volume;
  return Topology(mesh);
}

bool IsFar(const TetrahedronMesh& plain, const TetrahedronMesh& mesh, double allowance)
{
  std::uint32_t last = 0;
  for (const std::vector<std::uint32_t>* origins : { &plain.Origins, &mesh.Origins })
  {
    last = std::accumulate(origins->begin(), origins->end(), last,
      [](std::uint32_t a, std::uint32_t b) { return std::max(a, b); });
  }
  const std::vector<double> allowances(last + 1, allowance);
  MeasuredSurfaces surfaces(plain, mesh, allowances, SerialFor);
  EXPECT_TRUE(surfaces.AreSound);
  const std::vector<bool> all(surfaces.Part.Simple.Triangles.size(), true);
  return PartDistance(surfaces.Part).Find(surfaces.Part.Simple, surfaces.Homes(), all).Any();
}

std::string FarByForce(const Volume& plain, const Volume& mesh, double allowance)
{
  Promise promise;
  promise.Tolerance = allowance;
  std::string fault;
  for (const int surface : { -1, 1 })
  {
    fault +=
      FaultOf(promise, Placed(plain, surface, AffineMap()), Placed(mesh, surface, AffineMap()));
  }
  return fault;
}

Field GyroidField(int size, double periods)
{
  Field field{ "gyroid", { size, size, size }, {}, 0.1 };
  const double step = periods * 2.0 * std::acos(-1.0) / (size - 1);
  for (int z = 0; z < size; ++z)
  {
    for (int y = 0; y < size; ++y)
    {
      for (int x = 0; x < size; ++x)
      {
        field.Samples.push_back(static_cast<float>(std::sin(step * x) * std::cos(step * y) +
          std::sin(step * y) * std::cos(step * z) + std::sin(step * z) * std::cos(step * x)));
      }
    }
  }
  return field;
}

void ForRandomVolumes(
  const std::function<void(Random&, const RandomSamples&, const BuildOptions&, const Built&)>&
    check)
{
  ForRandomSeeds(
    [&](std::uint32_t seed)
    {
      Random random(seed);
      const RandomSamples samples(random, 10, 100);
      const Isoregion any = RandomRegion(random, samples);
      if (!any.IsVolume() && !std::isfinite(any.Isovalue()))
      {
        return;
      }
      const Isoregion region = any.IsVolume() ? any : Isoregion(any.Isovalue(), HUGE_VAL);
      const OwningOptions options = RandomOptions(random, samples.Dimensions);
      SCOPED_TRACE(Describe(samples, region));
      const Built built(
        BuildIsodiamonds(Model::Minimal, samples.View(), region, SerialFor, options), SerialFor);
      check(random, samples, options, built);
    });
}

Built BuildVolume(const Field& field, const Isoregion& region)
{
  BuildOptions options = Distance();
  options.PreserveTopology = true;
  return { BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options), SerialFor };
}

}
