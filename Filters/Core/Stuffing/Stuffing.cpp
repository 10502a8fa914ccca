// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Stuffing.h"

#include "Stuffing/Background.h"
#include "Stuffing/Coarsening.h"
#include "Stuffing/Improvement.h"
#include "Stuffing/MovedVertices.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isodiamond
{
namespace
{

/** In degrees; a little more than is promised to be tried for, as coordinates get rounded. */
constexpr double WantedAngle = 15.5;

/** Where more than this part of the tetrahedra is bad, improving them takes longer than measuring
 *  the surfaces once more. */
constexpr double ManyBad = 0.1;

bool AreManyBad(const TetrahedronMesh& mesh, const ImprovementOptions& options)
{
  const double wanted = WantedSine(options);
  const auto bad = std::count_if(mesh.Tetrahedra.begin(), mesh.Tetrahedra.end(),
    [&](const Corners& corners) { return SmallestSine(mesh, corners) < wanted; });
  return static_cast<double>(bad) > ManyBad * static_cast<double>(mesh.Tetrahedra.size());
}

Walls::Type WallsOf(const CutMesh::Vertex& vertex, const Grid& grid)
{
  const auto [x, y, z] = vertex.Position;
  const int walls = Walls::At({ 1.0 * x, 1.0 * y, 1.0 * z }, grid);
  return static_cast<Walls::Type>(walls | (vertex.IsHidden ? Walls::Fixed : 0));
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

/** The cut edges of isovertices, by point. */
std::vector<CutSide> CutEdgesOf(const Background& background)
{
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
      edges[point] = { background.PositionOf(isOlderInside ? older : younger),
        background.PositionOf(isOlderInside ? younger : older) };
    }
  }
  return edges;
}

}

StuffedMesh Stuff(const StuffingInput& input, const ParallelFor& parallelFor)
{
  std::vector<Walls::Type> walls;
  walls.reserve(input.Leaves.Vertices.size());
  for (const CutMesh::Vertex& vertex : input.Leaves.Vertices)
  {
    walls.push_back(WallsOf(vertex, input.SampleGrid));
  }
  const Background background(
    input.Leaves, input.Vertices, std::move(walls), input.Points, input.World.Mirrors());
  ImprovementOptions options;
  options.WantedAngle = WantedAngle;
  options.SurfaceMove = input.SurfaceMove;
  options.Axes = AxesOf(input.World);
  options.CutEdges = CutEdgesOf(background);
  MovedVertices vertices(background);
  const bool getsCoarser = !input.Allowances.empty();
  const TetrahedronMesh plain = getsCoarser ? vertices.Cut(parallelFor) : TetrahedronMesh();
  CoarseningInput coarsening{ plain, input.Allowances, input.CanBeFiner, input.KeepsInside };
  coarsening.VolumeAtTolerance = input.VolumeAtTolerance;
  coarsening.Axes = options.Axes;
  vertices.MoveAll(parallelFor);
  StuffedMesh result;
  result.Mesh = vertices.Cut(parallelFor);
  if (getsCoarser && AreManyBad(result.Mesh, options))
  {
    // Nearly all that will be too far away already is: improving it would be for nothing.
    result.FarLeaves = FarLeaves(result.Mesh, coarsening, parallelFor);
  }
  if (result.FarLeaves.empty())
  {
    result.Mesh = Improve(std::move(result.Mesh), options, parallelFor);
    if (getsCoarser)
    {
      result.FarLeaves = Coarsen(result.Mesh, coarsening, parallelFor);
    }
  }
  return result;
}

}
