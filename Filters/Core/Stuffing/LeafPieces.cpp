// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/LeafPieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isodiamond
{
namespace
{

/** This many leaves are worth a thread. */
constexpr std::int64_t LeastLeaves = 2048;

/** All points of a background, and the surfaces and walls that they are on. */
TetrahedronMesh PointsOf(const Background& background)
{
  TetrahedronMesh mesh;
  mesh.Positions = background.AllPoints();
  mesh.Surfaces.assign(mesh.Positions.size(), 0);
  mesh.OnWalls.assign(mesh.Positions.size(), 0);
  for (std::uint32_t vertex = 0; vertex < background.VertexCount(); ++vertex)
  {
    const std::uint32_t point = background.Leaves().Vertices[vertex].PointId;
    if (point != CutMesh::None)
    {
      mesh.OnWalls[point] = background.WallsOf(vertex);
    }
  }
  for (std::uint32_t point = 0; point < mesh.Positions.size(); ++point)
  {
    const Crossing& crossing = background.AllCrossings()[point];
    if (crossing.IsThere())
    {
      mesh.Surfaces[point] = static_cast<std::int8_t>(2 * crossing.Surface - 1);
      mesh.OnWalls[point] = static_cast<Walls::Type>(
        background.WallsOf(crossing.Ends[0]) & background.WallsOf(crossing.Ends[1]));
    }
  }
  return mesh;
}

/** Adds those of some places that are not where they were. @return new ids, by point; all others
 *  keep theirs */
std::vector<std::uint32_t> AddPushed(const std::vector<Vector>& places, TetrahedronMesh& mesh)
{
  std::vector<std::uint32_t> ids(places.size());
  std::iota(ids.begin(), ids.end(), 0U);
  for (std::uint32_t point = 0; point < ids.size(); ++point)
  {
    if (places[point] != mesh.Positions[point])
    {
      ids[point] = static_cast<std::uint32_t>(mesh.Positions.size());
      mesh.Positions.push_back(places[point]);
      mesh.Surfaces.push_back(mesh.Surfaces[point]);
      mesh.OnWalls.push_back(mesh.OnWalls[point]);
      mesh.Blended.push_back({ ids[point], { { point, 1.0 } } });
    }
  }
  return ids;
}

/** Adds the pieces of all leaves. @param ways by leaf @param idOf (point) -> its id in the mesh */
template <typename IdOf>
void AddPieces(const LeafPieces& pieces, const std::vector<std::uint8_t>& ways, const IdOf& idOf,
  const ParallelFor& parallelFor, TetrahedronMesh& mesh)
{
  const auto leaves = static_cast<std::uint32_t>(ways.size());
  std::vector<std::size_t> first(leaves + std::size_t{ 1 }); // by leaf
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf)
  {
    first[leaf + std::size_t{ 1 }] = first[leaf] + pieces.Count(leaf, ways[leaf]);
  }
  mesh.Tetrahedra.resize(first.back());
  mesh.Origins.resize(first.back());
  ForEachIndex(parallelFor, leaves, LeastLeaves,
    [&](std::int64_t i)
    {
      const auto leaf = static_cast<std::uint32_t>(i);
      std::size_t next = first[leaf];
      pieces.ForEach(leaf, ways[leaf],
        [&](const Corners& corners)
        {
          std::transform(corners.begin(), corners.end(), mesh.Tetrahedra[next].begin(), idOf);
          mesh.Origins[next++] = leaf;
        });
    });
}

}

const LeafPieces::Ways& LeafPieces::WaysOf(std::uint32_t leaf) const
{
  const auto [a, b, c, d] = this->Mesh.CornersOf(leaf);
  return MovedPatches()[MovedCase({ this->Vertices.StateOf(a), this->Vertices.StateOf(b),
    this->Vertices.StateOf(c), this->Vertices.StateOf(d) })];
}

std::uint32_t LeafPieces::PointOf(std::uint32_t leaf, const PatchPoint& point) const
{
  const CutMesh::Tetrahedron& cut = this->Mesh.Leaves().Tetrahedra[leaf];
  if (!point.IsVertex())
  {
    return cut.Cuts[CutEdge(point.Younger(), point.Older())][point.Surface()];
  }
  const std::uint32_t vertex = cut.Vertices[point.Younger()];
  const std::uint32_t goal = this->Vertices.GoalOf(vertex);
  return goal != CutMesh::None ? goal : this->Mesh.Leaves().Vertices[vertex].PointId;
}

Corners LeafPieces::CornersOf(std::uint32_t leaf, const PatchTetrahedron& piece) const
{
  const bool flip = this->Mesh.IsNegative(leaf);
  return { this->PointOf(leaf, piece[0]), this->PointOf(leaf, piece[1]),
    this->PointOf(leaf, piece[flip ? 3 : 2]), this->PointOf(leaf, piece[flip ? 2 : 3]) };
}

/** The smallest sine of a piece's dihedral angles. */
double LeafPieces::SineOf(std::uint32_t leaf, const PatchTetrahedron& piece) const
{
  const Corners points = this->CornersOf(leaf, piece);
  return SmallestSine(this->Points[points[0]], this->Points[points[1]], this->Points[points[2]],
    this->Points[points[3]]);
}

bool LeafPieces::ArePositive(std::uint32_t leaf) const
{
  const auto arePositive = [&](const std::vector<PatchTetrahedron>& pieces)
  {
    return std::all_of(pieces.begin(), pieces.end(),
      [&](const PatchTetrahedron& piece) { return this->SineOf(leaf, piece) > 0.0; });
  };
  const Ways& ways = this->WaysOf(leaf);
  const auto end =
    this->IsPinned(leaf) && !ways.empty() ? ways.begin() + MeasuredWay + 1 : ways.end();
  return ways.empty() || std::any_of(ways.begin(), end, arePositive);
}

std::uint8_t LeafPieces::BestWay(std::uint32_t leaf) const
{
  if (this->IsPinned(leaf))
  {
    return MeasuredWay;
  }
  const Ways& ways = this->WaysOf(leaf);
  double best = -HUGE_VAL;
  std::size_t found = 0;
  for (std::size_t i = 0; i < ways.size() && ways.size() > 1; ++i)
  {
    double worst = HUGE_VAL;
    for (const PatchTetrahedron& piece : ways[i])
    {
      worst = std::min(worst, this->SineOf(leaf, piece));
    }
    if (worst > best)
    {
      best = worst;
      found = i;
    }
  }
  return static_cast<std::uint8_t>(found);
}

TetrahedronMesh CutInBestWay(const Background& background, const VertexPlaces& vertices,
  const std::vector<Vector>& places, const ParallelFor& parallelFor)
{
  const LeafPieces pieces(background, vertices, places);
  std::vector<std::uint8_t> ways(background.Leaves().Tetrahedra.size());
  ForEachIndex(parallelFor, ways.size(), LeastLeaves,
    [&](std::int64_t leaf) { ways[leaf] = pieces.BestWay(static_cast<std::uint32_t>(leaf)); });
  TetrahedronMesh mesh = PointsOf(background);
  const std::vector<std::uint32_t> ids = AddPushed(places, mesh);
  AddPieces(
    pieces, ways, [&](std::uint32_t point) { return ids[point]; }, parallelFor, mesh);
  return mesh;
}

TetrahedronMesh CutAsMeasured(const Background& background, const ParallelFor& parallelFor)
{
  const VertexPlaces vertices(background.Leaves());
  const LeafPieces pieces(background, vertices, background.AllPoints());
  const std::vector<std::uint8_t> ways(
    background.Leaves().Tetrahedra.size(), LeafPieces::MeasuredWay);
  TetrahedronMesh mesh = PointsOf(background);
  AddPieces(
    pieces, ways, [](std::uint32_t point) { return point; }, parallelFor, mesh);
  return mesh;
}

}
