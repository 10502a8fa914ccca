// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Stuff.h"

#include "Private/Arrays.h"
#include "Private/Cells.h"
#include "Private/Tuples.h"
#include "Stuffing/Stuffing.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"
#include "vtkSignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace vtkIsodiamond
{
namespace
{

/** At one change a surface may move by this part of the grid's smallest step, or of the tolerance
 *  if that is more. */
constexpr double MovePartOfStep = 0.25;
constexpr double MovePartOfTolerance = 0.5;

std::vector<isodiamond::Vector> PositionsOf(vtkPoints* points)
{
  std::vector<isodiamond::Vector> positions(points->GetNumberOfPoints());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    points->GetPoint(static_cast<vtkIdType>(i), positions[i].data());
  }
  return positions;
}

/** What is left of the tolerance in each leaf: its diamond's error may be so far away already.
 *  Leaves of full resolution, which cannot be finer, are not asked. */
std::vector<double> AllowancesOf(const isodiamond::CutMesh& leaves,
  const isodiamond::IsodiamondHierarchy& hierarchy, const MeshOptions& options)
{
  std::vector<double> allowances;
  if (!options.ToleranceIn)
  {
    return allowances;
  }
  std::vector<isodiamond::Vector> positions;
  for (const isodiamond::CutMesh::Vertex& vertex : leaves.Vertices)
  {
    const isodiamond::Point& at = vertex.Position;
    positions.push_back(options.World({ 1.0 * at[0], 1.0 * at[1], 1.0 * at[2] }));
  }
  for (std::size_t i = 0; i < leaves.Tetrahedra.size(); ++i)
  {
    const auto place = isodiamond::DiamondOf(leaves, i, hierarchy.SampleGrid());
    const isodiamond::Brick* brick =
      place ? hierarchy.Diamonds().Level(place->Scale).Find(place->Position) : nullptr;
    const int bit = place ? isodiamond::BitOf(place->Position) : 0;
    if (brick == nullptr || !brick->Contains(place->Position[2] & 7, bit))
    {
      allowances.push_back(HUGE_VAL); // nothing finer is there
      continue;
    }
    std::array<isodiamond::Vector, 4> corners{};
    std::transform(leaves.Tetrahedra[i].Vertices.begin(), leaves.Tetrahedra[i].Vertices.end(),
      corners.begin(), [&](std::uint32_t vertex) { return positions[vertex]; });
    const double error =
      hierarchy.Codes().Decode(hierarchy.Threshold(brick->Rank(place->Position[2] & 7, bit)));
    allowances.push_back(std::max(0.0, options.ToleranceIn(corners.data(), 4) - error));
  }
  return allowances;
}

/** Which points are used, by their ids before; an added one begins as a copy of one that it is
 *  blended from. */
struct PointNumbers
{
  std::vector<vtkIdType> New; ///< by id before, or -1
  std::vector<vtkIdType> Kept;

  PointNumbers(const isodiamond::TetrahedronMesh& mesh, std::size_t before)
    : New(mesh.Positions.size(), -1)
  {
    for (const isodiamond::Corners& corners : mesh.Tetrahedra)
    {
      std::for_each(
        corners.begin(), corners.end(), [&](std::uint32_t point) { this->New[point] = 0; });
    }
    std::vector<vtkIdType> source(mesh.Positions.size());
    for (const isodiamond::BlendedPoint& blended : mesh.Blended)
    {
      source[blended.Point] = blended.Shares.front().Point;
    }
    for (std::size_t i = 0; i < this->New.size(); ++i)
    {
      if (this->New[i] == 0)
      {
        this->New[i] = static_cast<vtkIdType>(this->Kept.size());
        this->Kept.push_back(i < before ? static_cast<vtkIdType>(i) : source[i]);
      }
    }
  }
};

/** Overwrites the values of blended points with the sums of their shares. */
void Blend(const isodiamond::TetrahedronMesh& mesh, const PointNumbers& numbers,
  vtkPointData* before, vtkPointData* after)
{
  for (int i = 0; i < after->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* to = after->GetArray(i);
    vtkDataArray* from = before->GetArray(to->GetName());
    const bool isWhole = to->GetDataType() != VTK_FLOAT && to->GetDataType() != VTK_DOUBLE;
    for (const isodiamond::BlendedPoint& blended : mesh.Blended)
    {
      const vtkIdType point = numbers.New[blended.Point];
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

/** Points that were moved are inside, and all on surfaces stayed. */
void WriteSurfaces(
  const isodiamond::TetrahedronMesh& mesh, const PointNumbers& numbers, vtkDataArray* surfaces)
{
  for (std::size_t i = 0; i < numbers.New.size(); ++i)
  {
    if (numbers.New[i] >= 0)
    {
      surfaces->SetComponent(numbers.New[i], 0, mesh.Surfaces[i]);
    }
  }
}

std::array<double, 2> AnglesOf(const isodiamond::TetrahedronMesh& mesh)
{
  std::array<double, 2> all = { 180.0, 0.0 };
  for (const isodiamond::Corners& corners : mesh.Tetrahedra)
  {
    const std::array<double, 2> angles = isodiamond::DihedralAngles(mesh.Positions[corners[0]],
      mesh.Positions[corners[1]], mesh.Positions[corners[2]], mesh.Positions[corners[3]]);
    all = { std::min(all[0], angles[0]), std::max(all[1], angles[1]) };
  }
  return all;
}

}

void StuffMesh(const isodiamond::IntervalExtraction& extraction,
  const isodiamond::IsodiamondHierarchy& hierarchy, const MeshOptions& options,
  const isodiamond::ParallelFor& parallelFor, Mesh& mesh)
{
  const isodiamond::CutMesh leaves = extraction.Leaves(options.Hidden);
  const std::vector<isodiamond::Vector> positions = PositionsOf(mesh.Points);
  const double move = std::max(
    MovePartOfStep * options.World.SmallestStep(), MovePartOfTolerance * options.DistanceTolerance);
  const isodiamond::Grid& grid = hierarchy.SampleGrid();
  const isodiamond::StuffedMesh result = isodiamond::Stuff(
    { leaves, positions, options.World, grid, move, AllowancesOf(leaves, hierarchy, options) },
    parallelFor);
  const isodiamond::TetrahedronMesh& stuffed = result.Mesh;
  for (const std::uint32_t leaf : result.FarLeaves)
  {
    mesh.FarDiamonds.push_back(*isodiamond::DiamondOf(leaves, leaf, grid));
  }

  const PointNumbers numbers(stuffed, positions.size());
  mesh.Points = PointsOf(mesh.Points, numbers.Kept);
  for (std::size_t i = 0; i < numbers.New.size(); ++i)
  {
    if (numbers.New[i] >= 0)
    {
      mesh.Points->SetPoint(numbers.New[i], stuffed.Positions[i].data());
    }
  }
  vtkNew<vtkPointData> before;
  before->ShallowCopy(mesh.PointData);
  KeepTuples(mesh.PointData, numbers.Kept);
  Blend(stuffed, numbers, before, mesh.PointData);
  WriteSurfaces(stuffed, numbers, mesh.PointData->GetArray("Surface"));

  const auto count = static_cast<std::int64_t>(stuffed.Tetrahedra.size());
  mesh.Cells = WriteCells(count, 4, parallelFor,
    [&](auto* connectivity)
    {
      using Id = std::remove_pointer_t<decltype(connectivity)>;
      for (const isodiamond::Corners& corners : stuffed.Tetrahedra)
      {
        connectivity = std::transform(corners.begin(), corners.end(), connectivity,
          [&](std::uint32_t point) { return static_cast<Id>(numbers.New[point]); });
      }
    });
  const auto levels = NewArray<vtkSignedCharArray>("Level", count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    levels->SetValue(i, leaves.Tetrahedra[stuffed.Origins[i]].Level);
  }
  mesh.CellData->Initialize();
  mesh.CellData->AddArray(levels);
  if (count > 0)
  {
    mesh.DihedralAngles = AnglesOf(stuffed);
  }
}

}
