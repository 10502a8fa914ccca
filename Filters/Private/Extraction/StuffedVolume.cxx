// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Extraction/StuffedVolume.h"

#include "Private/Common/Arrays.h"
#include "Private/Common/Tuples.h"
#include "Private/Common/UsedPoints.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"
#include "vtkShortArray.h"

#include <algorithm>
#include <cmath>

namespace vtkIsodiamond
{
namespace
{

/** In one change, a surface may move by this part of an image's smallest step, or of the tolerance
 *  if that is more; where steps differ along an axis, by this part of the edge that it cuts. */
constexpr double MovePartOfStep = 0.25;
constexpr double MovePartOfTolerance = 0.5;

/** Where the vertices of leaves, and the points that they are cut at, are in the world. */
struct Places
{
  std::vector<isodiamond::Vector> Vertices;
  std::vector<isodiamond::Vector> Points;
};
Places PlacesOf(const isodiamond::IntervalExtraction& extraction, const isodiamond::CutMesh& leaves,
  const isodiamond::GridGeometry& world)
{
  Places places{ VerticesInWorld(leaves, world), {} };
  places.Points.resize(extraction.PointCount());
  extraction.ForEachPoint(
    [&](const isodiamond::MeshPoint& point) { places.Points[point.Id] = world(point.Index); });
  return places;
}

/** @param leaves,places,world must outlive the result */
isodiamond::StuffingInput InputOf(const isodiamond::CutMesh& leaves, const Places& places,
  const isodiamond::GridGeometry& world, const isodiamond::IsodiamondHierarchy& hierarchy,
  const SimulationOptions& options)
{
  isodiamond::StuffingInput input{ leaves, places.Vertices, places.Points, world,
    hierarchy.SampleGrid() };
  if (world.Affine() != nullptr)
  {
    input.SurfaceMove = std::max(
      MovePartOfStep * world.SmallestStep(), MovePartOfTolerance * options.DistanceTolerance);
  }
  else
  {
    input.SurfaceMove = HUGE_VAL;
    input.SurfaceMoveOfEdge = MovePartOfStep;
  }
  input.GetsCoarser = options.GetsCoarser;
  input.KeepsInside = options.KeepsInside;
  input.VolumeAtTolerance = options.VolumeAtTolerance;
  input.MayPin = options.MayPin;
  // Each leaf may use what is left of the tolerance: its diamond's error may already use some of
  // it. Leaves at full resolution cannot be made finer.
  for (std::size_t i = 0; options.ToleranceIn && i < input.Leaves.Tetrahedra.size(); ++i)
  {
    const auto place = isodiamond::DiamondOf(input.Leaves, i, hierarchy.SampleGrid());
    const std::int64_t rank = place ? hierarchy.Diamonds().Rank(*place) : -1;
    std::array<isodiamond::Vector, 4> corners{};
    const auto& ids = input.Leaves.Tetrahedra[i].Vertices;
    std::transform(ids.begin(), ids.end(), corners.begin(),
      [&](std::uint32_t id) { return places.Vertices[id]; });
    const double error = rank < 0 ? 0.0 : hierarchy.Codes().Decode(hierarchy.Threshold(rank));
    const double tolerance = options.ToleranceIn(corners.data(), 4);
    input.Allowances.push_back(std::max(0.0, tolerance - error));
    input.ToleratesNothing.push_back(!(tolerance > 0.0));
    input.CanBeFiner.push_back(rank >= 0 && options.MayRefine);
  }
  return input;
}

std::vector<isodiamond::Place> DiamondsOf(const isodiamond::CutMesh& leaves,
  const std::vector<std::uint32_t>& numbers, const isodiamond::Grid& grid)
{
  std::vector<isodiamond::Place> diamonds;
  diamonds.reserve(numbers.size());
  for (const std::uint32_t leaf : numbers)
  {
    diamonds.push_back(*isodiamond::DiamondOf(leaves, leaf, grid));
  }
  return diamonds;
}

std::vector<std::uint64_t> VerticesOf(
  const isodiamond::CutMesh& mesh, const std::vector<std::uint32_t>& leaves)
{
  std::vector<std::uint64_t> positions;
  for (const std::uint32_t leaf : leaves)
  {
    for (const std::uint32_t vertex : mesh.Tetrahedra[leaf].Vertices)
    {
      positions.push_back(isodiamond::PackedPoint(mesh.Vertices[vertex].Position));
    }
  }
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

/** What to copy the attributes of a mesh's points from: the points before; for added ones, any
 * point that has a share in them. @param kept ids in the mesh @param before how many points there
 * were */
std::vector<vtkIdType> SourcesOf(
  const isodiamond::TetrahedronMesh& mesh, const std::vector<vtkIdType>& kept, std::size_t before)
{
  std::vector<vtkIdType> shared(mesh.Positions.size() - before);
  for (const isodiamond::BlendedPoint& blended : mesh.Blended)
  {
    if (blended.Point >= before)
    {
      shared[blended.Point - before] = blended.Shares.front().Point;
    }
  }
  std::vector<vtkIdType> sources(kept.size());
  std::transform(kept.begin(), kept.end(), sources.begin(),
    [&](vtkIdType id)
    {
      const auto point = static_cast<std::size_t>(id);
      return point < before ? id : shared[point - before];
    });
  return sources;
}

/** Overwrites the values of blended points with the sums of their shares. */
void Blend(const isodiamond::TetrahedronMesh& mesh, const UsedPoints& used, vtkPointData* before,
  vtkPointData* after)
{
  for (int i = 0; i < after->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* from = before->GetArray(i);
    vtkDataArray* to = after->GetArray(i);
    const bool isWhole = to->GetDataType() != VTK_FLOAT && to->GetDataType() != VTK_DOUBLE;
    for (const isodiamond::BlendedPoint& blended : mesh.Blended)
    {
      const vtkIdType point = used.NewId(blended.Point);
      for (int component = 0; point >= 0 && component < to->GetNumberOfComponents(); ++component)
      {
        double sum = 0.0;
        for (const isodiamond::Share& share : blended.Shares)
        {
          sum += share.Part * from->GetComponent(share.Point, component);
        }
        to->SetComponent(point, component, isWhole ? std::round(sum) : sum);
      }
    }
  }
}

/** The smallest and the largest dihedral angle. @param rounded as points are stored */
std::array<double, 2> AnglesOf(const isodiamond::TetrahedronMesh& mesh, bool rounded)
{
  if (!rounded)
  {
    return isodiamond::DihedralAngles(mesh);
  }
  isodiamond::TetrahedronMesh stored;
  stored.Tetrahedra = mesh.Tetrahedra;
  stored.Positions = mesh.Positions;
  for (isodiamond::Vector& position : stored.Positions)
  {
    for (double& coordinate : position)
    {
      coordinate = static_cast<float>(coordinate);
    }
  }
  return isodiamond::DihedralAngles(stored);
}

/** Writes the positions of moved and added points, and which surfaces they are on. */
void WritePlaces(const isodiamond::TetrahedronMesh& mesh, const UsedPoints& used, Mesh& output)
{
  vtkDataArray* surfaces = output.PointData->GetArray("Surface");
  for (const isodiamond::BlendedPoint& blended : mesh.Blended)
  {
    const vtkIdType point = used.NewId(blended.Point);
    if (point >= 0)
    {
      output.Points->SetPoint(point, mesh.Positions[blended.Point].data());
      surfaces->SetComponent(point, 0, mesh.Surfaces[blended.Point]);
    }
  }
}

}

StuffedVolume::StuffedVolume(const isodiamond::RefinedSet& refined, const MeshOptions& options,
  const SimulationOptions& simulation, const isodiamond::ParallelFor& parallelFor,
  isodiamond::KnownChanges* known)
  : Hierarchy(refined.Hierarchy())
  , Extraction(refined, parallelFor)
  , Leaves(this->Extraction.Leaves(options.Hidden))
{
  Pin(this->Leaves, simulation.Pinned);
  const Places places = PlacesOf(this->Extraction, this->Leaves, options.World);
  this->Stuffed = isodiamond::Stuff(
    InputOf(this->Leaves, places, options.World, this->Hierarchy, simulation), parallelFor, known);
}

std::vector<isodiamond::Place> StuffedVolume::FarDiamonds() const
{
  return DiamondsOf(this->Leaves, this->Stuffed.FarLeaves, this->Hierarchy.SampleGrid());
}

std::vector<std::uint64_t> StuffedVolume::TightVertices() const
{
  return VerticesOf(this->Leaves, this->Stuffed.TightLeaves);
}

std::vector<std::uint64_t> StuffedVolume::VerticesNearBad() const
{
  return VerticesOf(this->Leaves, LeavesOfBad(this->Leaves, this->Stuffed.Mesh));
}

Mesh StuffedVolume::Write(
  const MeshOptions& options, const isodiamond::ParallelFor& parallelFor) const
{
  Mesh mesh = ExtractPoints(this->Extraction, this->Hierarchy, options);
  const isodiamond::TetrahedronMesh& stuffed = this->Stuffed.Mesh;
  const UsedPoints used(stuffed.Tetrahedra, stuffed.Positions.size(), parallelFor);
  const std::vector<vtkIdType> sources =
    SourcesOf(stuffed, used.Ids(), static_cast<std::size_t>(this->Extraction.PointCount()));
  vtkNew<vtkPointData> before;
  before->ShallowCopy(mesh.PointData);
  mesh.Points = PointsOf(mesh.Points, sources);
  KeepTuples(mesh.PointData, sources);
  Blend(stuffed, used, before, mesh.PointData);
  WritePlaces(stuffed, used, mesh);
  mesh.Cells = used.Write(stuffed.Tetrahedra, parallelFor);

  const auto count = static_cast<std::int64_t>(stuffed.Tetrahedra.size());
  const auto levels = NewArray<vtkShortArray>("Level", count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    levels->SetValue(i, this->Leaves.Tetrahedra[stuffed.Origins[i]].Level);
  }
  mesh.CellData->AddArray(levels);
  if (count > 0)
  {
    mesh.DihedralAngles = AnglesOf(stuffed, mesh.Points->GetDataType() == VTK_FLOAT);
    mesh.ToleranceExcess = this->Stuffed.ToleranceExcess;
  }
  return mesh;
}

std::vector<isodiamond::Place> FarDiamondSearch::Find(const isodiamond::RefinedSet& refined,
  const MeshOptions& options, const SimulationOptions& simulation,
  const isodiamond::ParallelFor& parallelFor)
{
  const isodiamond::IsodiamondHierarchy& hierarchy = refined.Hierarchy();
  const isodiamond::IntervalExtraction extraction(refined, parallelFor);
  isodiamond::CutMesh leaves = this->News.Find(extraction.Leaves(options.Hidden));
  Pin(leaves, simulation.Pinned);
  const Places places = PlacesOf(extraction, leaves, options.World);
  return DiamondsOf(leaves,
    isodiamond::FarLeaves(
      InputOf(leaves, places, options.World, hierarchy, simulation), parallelFor),
    hierarchy.SampleGrid());
}

}
