// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Stuffing.h"

#include "Stuffing/Background.h"
#include "Stuffing/BestAttempt.h"
#include "Stuffing/Coarsening.h"
#include "Stuffing/Improvement.h"
#include "Stuffing/LeafChecks.h"
#include "Stuffing/MovedVertices.h"
#include "Stuffing/ToleranceExcess.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isodiamond
{
namespace
{

///@{
/** In degrees: what is promised to be tried for, and a little more, as coordinates get rounded. */
constexpr double PromisedAngle = 15.0;
constexpr double WantedAngle = 15.5;
///@}

/** How often a leaf can be pinned. More would bring surfaces nearer in noise, but leave bad angles
 *  there. */
constexpr int MostPins = 4;

/** How much of the grid's smallest step is a small excess of the tolerance. */
constexpr double ExcessPartOfStep = 0.25;

/** How far surfaces may move in one change where a leaf is pinned, as a part of what is allowed
 *  there. */
double PartForMoves(int pins)
{
  return 0.35 * std::pow(0.5, pins - 1);
}

Walls::Type WallsOf(const CutMesh::Vertex& vertex, const Grid& grid)
{
  const auto [x, y, z] = vertex.Position;
  const int walls = Walls::At({ 1.0 * x, 1.0 * y, 1.0 * z }, grid);
  return static_cast<Walls::Type>(walls | (vertex.IsFixed ? Walls::Fixed : 0));
}

/** By vertex: how far it may move, if a leaf there is pinned; none if none is. */
std::vector<double> MostMovesOf(const StuffingInput& input)
{
  std::vector<double> mostMoves;
  for (std::size_t leaf = 0; leaf < input.Allowances.size(); ++leaf)
  {
    const int pins = PinsOf(input.Leaves, leaf);
    if (pins > 0)
    {
      mostMoves.resize(input.Leaves.Vertices.size(), HUGE_VAL);
      const double most = PartForMoves(pins) * input.Allowances[leaf];
      for (const std::uint32_t vertex : input.Leaves.Tetrahedra[leaf].Vertices)
      {
        mostMoves[vertex] = std::min(mostMoves[vertex], most);
      }
    }
  }
  return mostMoves;
}

Background BackgroundOf(const StuffingInput& input)
{
  std::vector<Walls::Type> walls;
  walls.reserve(input.Leaves.Vertices.size());
  for (const CutMesh::Vertex& vertex : input.Leaves.Vertices)
  {
    walls.push_back(WallsOf(vertex, input.SampleGrid));
  }
  return { input.Leaves, input.Vertices, std::move(walls), input.Points, input.World.Mirrors(),
    MostMovesOf(input) };
}

/** The directions of the grid's axes, where they are the same everywhere. */
std::array<Vector, 3> AxesOf(const GridGeometry& world)
{
  std::array<Vector, 3> axes{};
  if (const AffineMap* map = world.Affine())
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector along = { map->Rows[0][axis], map->Rows[1][axis], map->Rows[2][axis] };
      axes[axis] = (1.0 / std::sqrt(Dot(along, along))) * along;
    }
  }
  else if (world.Axes() != nullptr)
  {
    axes = { Vector{ 1.0, 0.0, 0.0 }, Vector{ 0.0, 1.0, 0.0 }, Vector{ 0.0, 0.0, 1.0 } };
  }
  return axes;
}

/** The cut edges of isovertices, by point. @param mostOfEdge see SurfaceMoveOfEdge */
std::vector<CutSide> CutEdgesOf(const Background& background, bool inIndexSpace, double mostOfEdge)
{
  const auto placeOf = [&](std::uint32_t vertex) -> Vector
  {
    const auto [x, y, z] = background.Leaves().Vertices[vertex].Position;
    return inIndexSpace ? Vector{ 1.0 * x, 1.0 * y, 1.0 * z } : background.PositionOf(vertex);
  };
  std::vector<CutSide> edges(background.AllCrossings().size());
  for (std::size_t point = 0; point < edges.size(); ++point)
  {
    const Crossing& crossing = background.AllCrossings()[point];
    if (crossing.IsThere())
    {
      const auto [younger, older] = crossing.Ends;
      const std::vector<CutMesh::Vertex>& vertices = background.Leaves().Vertices;
      const bool isRising = vertices[younger].Sign < vertices[older].Sign;
      const bool isOlderInside = isRising == (crossing.Surface == 0);
      const Vector way = background.PositionOf(older) - background.PositionOf(younger);
      const double length = std::sqrt(Dot(way, way));
      const double most = std::max(background.MostMoveOf(younger), background.MostMoveOf(older));
      edges[point] = { placeOf(isOlderInside ? older : younger),
        placeOf(isOlderInside ? younger : older), length, std::min(most, mostOfEdge * length) };
    }
  }
  return edges;
}

/** The mesh of leaves before and after vertices have moved. */
struct BothMeshes
{
  TetrahedronMesh Plain; ///< if it is wanted
  TetrahedronMesh Stuffed;
};
BothMeshes CutLeaves(
  const Background& background, bool withPlain, double mostPush, const ParallelFor& parallelFor)
{
  MovedVertices vertices(background);
  BothMeshes meshes;
  if (withPlain)
  {
    meshes.Plain = CutAsMeasured(background, parallelFor);
  }
  vertices.MoveAll(parallelFor);
  vertices.PushAll(mostPush, parallelFor);
  meshes.Stuffed = vertices.Cut(parallelFor);
  return meshes;
}

/** By leaf: whether its surfaces get near enough if it is finer, or pinned. Beside leaves where
 *  nothing is tolerated they do not: their vertices move with those.
 *  @param mayPin whether it could be pinned instead */
std::vector<bool> CanBeNearer(const StuffingInput& input, bool mayPin)
{
  const std::vector<CutMesh::Tetrahedron>& leaves = input.Leaves.Tetrahedra;
  std::vector<bool> movesFreely(input.Leaves.Vertices.size());
  for (std::size_t leaf = 0; leaf < input.ToleratesNothing.size(); ++leaf)
  {
    for (const std::uint32_t vertex : leaves[leaf].Vertices)
    {
      movesFreely[vertex] = movesFreely[vertex] || input.ToleratesNothing[leaf];
    }
  }
  std::vector<bool> canBeNearer = input.CanBeFiner;
  for (std::size_t leaf = 0; leaf < canBeNearer.size(); ++leaf)
  {
    const auto& vertices = leaves[leaf].Vertices;
    canBeNearer[leaf] = (canBeNearer[leaf] || (mayPin && PinsOf(input.Leaves, leaf) < MostPins)) &&
      std::none_of(vertices.begin(), vertices.end(),
        [&](std::uint32_t vertex) { return movesFreely[vertex]; });
  }
  return canBeNearer;
}

bool HasFixedVertex(const CutMesh& leaves, std::uint32_t leaf)
{
  const auto& vertices = leaves.Tetrahedra[leaf].Vertices;
  return std::any_of(vertices.begin(), vertices.end(),
    [&](std::uint32_t vertex) { return leaves.Vertices[vertex].IsFixed; });
}

}

std::vector<std::uint32_t> LeavesOfBad(const CutMesh& leaves, const TetrahedronMesh& mesh)
{
  const double least = std::sin(PromisedAngle / DegreesOfRadian);
  std::vector<bool> isNear(leaves.Vertices.size());
  for (std::size_t i = 0; i < mesh.Tetrahedra.size(); ++i)
  {
    if (SmallestSine(mesh, mesh.Tetrahedra[i]) < least)
    {
      for (const std::uint32_t vertex : leaves.Tetrahedra[mesh.Origins[i]].Vertices)
      {
        isNear[vertex] = true;
      }
    }
  }
  std::vector<std::uint32_t> near;
  for (std::uint32_t leaf = 0; leaf < leaves.Tetrahedra.size(); ++leaf)
  {
    const auto& vertices = leaves.Tetrahedra[leaf].Vertices;
    if (std::any_of(
          vertices.begin(), vertices.end(), [&](std::uint32_t vertex) { return isNear[vertex]; }))
    {
      near.push_back(leaf);
    }
  }
  return near;
}

std::vector<std::uint32_t> FarLeaves(const StuffingInput& input, const ParallelFor& parallelFor)
{
  CheckLeaves(input.Leaves, parallelFor);
  const BothMeshes meshes = CutLeaves(BackgroundOf(input), true, input.SurfaceMove, parallelFor);
  const std::vector<bool> canBeNearer = CanBeNearer(input, false);
  std::vector<std::uint32_t> leaves =
    FarLeaves(meshes.Stuffed, { meshes.Plain, input.Allowances, canBeNearer }, parallelFor);
  leaves.erase(std::remove_if(leaves.begin(), leaves.end(),
                 [&](std::uint32_t leaf) { return HasFixedVertex(input.Leaves, leaf); }),
    leaves.end());
  return leaves;
}

StuffedMesh Stuff(const StuffingInput& input, const ParallelFor& parallelFor, KnownChanges* known)
{
  CheckLeaves(input.Leaves, parallelFor);
  const Background background = BackgroundOf(input);
  const bool isMeasured = !input.Allowances.empty();
  const bool getsCoarser = isMeasured && input.GetsCoarser;
  const BothMeshes meshes = CutLeaves(background, isMeasured, input.SurfaceMove, parallelFor);
  ImprovementOptions options;
  options.WantedAngle = WantedAngle;
  options.SurfaceMove = input.SurfaceMove;
  options.Axes = AxesOf(input.World);
  options.World = input.World.Positions() == nullptr ? &input.World : nullptr;
  options.CutEdges = CutEdgesOf(background, options.World != nullptr, input.SurfaceMoveOfEdge);
  const std::vector<bool> canBeNearer = CanBeNearer(input, input.MayPin);
  CoarseningInput coarsening{ meshes.Plain, input.Allowances, canBeNearer, input.KeepsInside };
  coarsening.VolumeAtTolerance = input.VolumeAtTolerance;
  coarsening.Axes = options.Axes;
  BestAttempt attempts(
    background, meshes.Stuffed, options, getsCoarser ? &coarsening : nullptr, parallelFor, known);
  BestAttempt::Attempt best = attempts.Find();
  const bool isHopeless = best.IsHopeless();
  std::vector<std::uint32_t> far = std::move(best.FarLeaves);
  if (getsCoarser && far.empty())
  {
    far = Coarsen(best.Mesh, coarsening, parallelFor);
  }
  StuffedMesh result{ std::move(best.Mesh), {}, {}, isHopeless, {} };
  for (const std::uint32_t leaf : far)
  {
    (input.CanBeFiner[leaf] ? result.FarLeaves : result.TightLeaves).push_back(leaf);
  }
  if (isMeasured && far.empty())
  {
    result.ToleranceExcess = ToleranceExcess(meshes.Plain, result.Mesh, input.Allowances,
      ExcessPartOfStep * input.World.SmallestStep(), parallelFor);
  }
  return result;
}

}
