// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/MovedVertices.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace isodiamond
{
namespace
{

/** An isovertex is near to a vertex within this part of their edge. The larger it is, the fewer
 *  tetrahedra there are, and in noise the fewer are bad; but the farther surfaces move, and the
 *  coarser the inside gets. */
constexpr double NearPart = 1.0 / 3.0;

/** How far from a vertex that stays an isovertex is pushed at most, as a part of their edge. */
constexpr double PushedPart = 0.2;

/** Moves between two looks at whether to go on. */
constexpr std::size_t MovesOfStep = 1024;

/** This many vertices, or leaves, are worth a thread. */
constexpr std::int64_t LeastRange = 2048;

/** The least sine of a dihedral angle that a move may leave in a whole tetrahedron. */
constexpr double LeastSine = 0.1;

/** Of several ways to cut a leaf, the only one that IntervalPatches() knows. */
constexpr std::uint8_t MeasuredPatch = 0;

/** The walls that an edge lies in. */
Walls::Type CommonWalls(Walls::Type a, Walls::Type b)
{
  return static_cast<Walls::Type>(a & b);
}

}

MovedVertices::MovedVertices(const Background& background)
  : Mesh(background)
  , States(background.VertexCount())
  , Goals(background.VertexCount(), CutMesh::None)
  , Places(background.AllPoints())
  , Links(background, States)
{
  this->Positions.reserve(background.VertexCount());
  for (std::uint32_t vertex = 0; vertex < background.VertexCount(); ++vertex)
  {
    this->States[vertex] = static_cast<std::uint8_t>(2 * background.Leaves().Vertices[vertex].Sign);
    this->Positions.push_back(background.PositionOf(vertex));
  }
}

void MovedVertices::MoveAll(const ParallelFor& parallelFor)
{
  std::vector<Goal> goals(this->Mesh.VertexCount());
  ForEachIndex(parallelFor, goals.size(), LeastRange,
    [&](std::int64_t vertex)
    { goals[vertex] = this->NearestToMove(static_cast<std::uint32_t>(vertex)); });
  goals.erase(std::remove_if(goals.begin(), goals.end(),
                [](const Goal& goal) { return !(goal.Distance < NearPart); }),
    goals.end());
  std::sort(goals.begin(), goals.end(),
    [](const Goal& a, const Goal& b)
    { return a.Distance != b.Distance ? a.Distance < b.Distance : a.Vertex < b.Vertex; });
  InSteps(parallelFor, goals.size(), MovesOfStep,
    [&](std::size_t i)
    {
      // Other moves have taken isovertices away.
      if (const Goal goal = this->NearestToMove(goals[i].Vertex); goal.Distance < NearPart)
      {
        this->TryToMove(goal);
      }
    });
}

void MovedVertices::PushAll(double most)
{
  for (std::uint32_t vertex = 0; vertex < this->Mesh.VertexCount(); ++vertex)
  {
    if (!this->HasToStay(vertex))
    {
      continue;
    }
    for (const std::uint32_t point : this->Mesh.CrossingsAt(vertex))
    {
      const Crossing& crossing = this->Mesh.AllCrossings()[point];
      if (this->IsCut(vertex, this->OtherEnd(point, vertex), crossing.Surface) &&
        this->PartOfEdge(point, vertex) < PushedPart)
      {
        this->Push(point, vertex, most);
      }
    }
  }
}

/** Whether a vertex must not move to what is nearest: it is pinned, or the topology would change.
 */
bool MovedVertices::HasToStay(std::uint32_t vertex)
{
  const Goal nearest = this->NearestTo(vertex, HUGE_VAL);
  if (!(nearest.Distance < PushedPart))
  {
    return false;
  }
  std::uint8_t& state = this->States[vertex];
  const std::uint8_t before =
    std::exchange(state, static_cast<std::uint8_t>(StateOn(nearest.Surface)));
  const bool canBeOn = this->Links.CanBeOn(vertex, nearest.Surface, before == BetweenSurfaces);
  state = before;
  return !canBeOn || std::isfinite(this->Mesh.MostMoveOf(vertex));
}

/** As far as it may, unless pieces of bent leaves would turn over. */
void MovedVertices::Push(std::uint32_t point, std::uint32_t from, double most)
{
  const std::uint32_t to = this->OtherEnd(point, from);
  const Vector& at = this->Mesh.PositionOf(from);
  const Vector edge = this->Mesh.PositionOf(to) - at;
  const double mostHere =
    std::min(most, std::max(this->Mesh.MostMoveOf(from), this->Mesh.MostMoveOf(to)));
  if (!(mostHere > 0.0))
  {
    return;
  }
  const double part =
    std::min(PushedPart, this->PartOfEdge(point, from) + mostHere / std::sqrt(Dot(edge, edge)));
  const Vector before = std::exchange(this->Places[point], at + part * edge);
  const CellsAtPoints::Cells star = this->Mesh.StarOf(from);
  if (!std::all_of(star.begin(), star.end(),
        [&](std::uint32_t tetrahedron) { return this->ArePiecesPositive(tetrahedron); }))
  {
    this->Places[point] = before;
  }
}

/** Whether a surface still crosses an edge of leaves between its ends. */
bool MovedVertices::IsCut(std::uint32_t first, std::uint32_t second, int surface) const
{
  const int a = this->States[first];
  const int b = this->States[second];
  const int on = StateOn(surface);
  return (a < on && b > on) || (a > on && b < on);
}

std::uint32_t MovedVertices::OtherEnd(std::uint32_t point, std::uint32_t vertex) const
{
  const Edge& ends = this->Mesh.AllCrossings()[point].Ends;
  return ends[ends[0] == vertex ? 1 : 0];
}

/** How far from an end of its edge an isovertex is, as a part of the edge. */
double MovedVertices::PartOfEdge(std::uint32_t point, std::uint32_t vertex) const
{
  const Vector& at = this->Mesh.PositionOf(vertex);
  const Vector edge = this->Mesh.PositionOf(this->OtherEnd(point, vertex)) - at;
  const Vector way = this->Mesh.PointAt(point) - at;
  return std::sqrt(Dot(way, way) / Dot(edge, edge));
}

/** The nearest isovertex on a vertex's edges that it can reach without passing another surface.
 *  @param most how far away */
MovedVertices::Goal MovedVertices::NearestTo(std::uint32_t vertex, double most) const
{
  Goal nearest;
  nearest.Vertex = vertex;
  nearest.Distance = HUGE_VAL;
  const int state = this->States[vertex];
  const Walls::Type walls = this->Mesh.WallsOf(vertex);
  if (state % 2 != 0 || (walls & Walls::Fixed) != 0)
  {
    return nearest;
  }
  const Vector& at = this->Mesh.PositionOf(vertex);
  for (const std::uint32_t point : this->Mesh.CrossingsAt(vertex))
  {
    const Crossing& crossing = this->Mesh.AllCrossings()[point];
    const std::uint32_t other = this->OtherEnd(point, vertex);
    const bool isBehind = (state == BelowLower && crossing.Surface == 1) ||
      (state == AboveUpper && crossing.Surface == 0);
    const Walls::Type common = CommonWalls(walls, this->Mesh.WallsOf(other));
    if (isBehind || common != walls || // or it would leave a wall
      !this->IsCut(vertex, other, crossing.Surface))
    {
      continue;
    }
    const Vector way = this->Mesh.PointAt(point) - at;
    if (Dot(way, way) > most * most)
    {
      continue;
    }
    const double distance = this->PartOfEdge(point, vertex);
    if (distance < nearest.Distance || (distance == nearest.Distance && point < nearest.Point))
    {
      nearest = { distance, vertex, point, crossing.Surface };
    }
  }
  return nearest;
}

/** Whether all tetrahedra around a vertex are round enough, and those that a surface cuts on a line
 *  that is no longer straight have positive pieces. */
bool MovedVertices::AreAllRound(std::uint32_t vertex) const
{
  const CellsAtPoints::Cells star = this->Mesh.StarOf(vertex);
  return std::all_of(star.begin(), star.end(),
    [&](std::uint32_t tetrahedron)
    {
      const Corners& corners = this->Mesh.CornersOf(tetrahedron);
      const double sine = SmallestSine(this->Positions[corners[0]], this->Positions[corners[1]],
        this->Positions[corners[2]], this->Positions[corners[3]]);
      return (this->Mesh.IsNegative(tetrahedron) ? -sine : sine) > LeastSine &&
        (!this->IsBent(tetrahedron) || this->ArePiecesPositive(tetrahedron));
    });
}

/** Whether a surface cuts a leaf on a line that is no longer straight. */
bool MovedVertices::IsBent(std::uint32_t tetrahedron) const
{
  const Corners& corners = this->Mesh.CornersOf(tetrahedron);
  bool isBent = false;
  for (int younger = 0; younger < 3; ++younger)
  {
    for (int older = younger + 1; older < 4; ++older)
    {
      const bool isMoved =
        this->States[corners[younger]] % 2 != 0 || this->States[corners[older]] % 2 != 0;
      isBent = isBent ||
        (isMoved &&
          (this->IsCut(corners[younger], corners[older], 0) ||
            this->IsCut(corners[younger], corners[older], 1)));
    }
  }
  return isBent;
}

/** Whether there is a way to cut a leaf into positive pieces. */
bool MovedVertices::ArePiecesPositive(std::uint32_t tetrahedron) const
{
  const auto arePositive = [&](const std::vector<PatchTetrahedron>& pieces)
  {
    return std::all_of(pieces.begin(), pieces.end(),
      [&](const PatchTetrahedron& piece) { return this->SineOf(tetrahedron, piece) > 0.0; });
  };
  const std::vector<std::vector<PatchTetrahedron>>& patches = this->PatchesOf(tetrahedron);
  const auto end = this->IsPinned(tetrahedron) && !patches.empty()
    ? patches.begin() + MeasuredPatch + 1
    : patches.end();
  return patches.empty() || std::any_of(patches.begin(), end, arePositive);
}

bool MovedVertices::TryToMove(const Goal& goal)
{
  const std::uint32_t vertex = goal.Vertex;
  const std::uint8_t state = this->States[vertex];
  const Vector position = this->Positions[vertex];
  this->States[vertex] = static_cast<std::uint8_t>(StateOn(goal.Surface));
  this->Goals[vertex] = goal.Point;
  this->Positions[vertex] = this->Mesh.PointAt(goal.Point);
  if (this->AreAllRound(vertex) &&
    this->Links.CanBeOn(vertex, goal.Surface, state == BetweenSurfaces))
  {
    return true;
  }
  this->States[vertex] = state;
  this->Goals[vertex] = CutMesh::None;
  this->Positions[vertex] = position;
  return false;
}

const std::vector<std::vector<PatchTetrahedron>>& MovedVertices::PatchesOf(
  std::uint32_t tetrahedron) const
{
  const Corners& corners = this->Mesh.CornersOf(tetrahedron);
  return MovedPatches()[MovedCase({ this->States[corners[0]], this->States[corners[1]],
    this->States[corners[2]], this->States[corners[3]] })];
}

/** The point of the mesh at a vertex in range. */
std::uint32_t MovedVertices::PointAt(std::uint32_t vertex) const
{
  return this->Goals[vertex] != CutMesh::None ? this->Goals[vertex]
                                              : this->Mesh.Leaves().Vertices[vertex].PointId;
}

std::uint32_t MovedVertices::PointOf(std::uint32_t tetrahedron, const PatchPoint& point) const
{
  const CutMesh::Tetrahedron& leaf = this->Mesh.Leaves().Tetrahedra[tetrahedron];
  return point.IsVertex() ? this->PointAt(leaf.Vertices[point.Younger()])
                          : leaf.Cuts[CutEdge(point.Younger(), point.Older())][point.Surface()];
}

Corners MovedVertices::CornersOf(std::uint32_t tetrahedron, const PatchTetrahedron& piece) const
{
  const bool flip = this->Mesh.IsNegative(tetrahedron);
  return { this->PointOf(tetrahedron, piece[0]), this->PointOf(tetrahedron, piece[1]),
    this->PointOf(tetrahedron, piece[flip ? 3 : 2]),
    this->PointOf(tetrahedron, piece[flip ? 2 : 3]) };
}

/** The smallest sine of a piece's dihedral angles. */
double MovedVertices::SineOf(std::uint32_t tetrahedron, const PatchTetrahedron& piece) const
{
  const Corners points = this->CornersOf(tetrahedron, piece);
  return SmallestSine(this->Places[points[0]], this->Places[points[1]], this->Places[points[2]],
    this->Places[points[3]]);
}

/** Of several ways to cut a leaf, the one whose worst piece is best; where it is pinned, the one
 *  that is measured. */
std::uint8_t MovedVertices::BestPatch(std::uint32_t tetrahedron) const
{
  if (this->IsPinned(tetrahedron))
  {
    return MeasuredPatch;
  }
  const std::vector<std::vector<PatchTetrahedron>>& patches = this->PatchesOf(tetrahedron);
  double best = -HUGE_VAL;
  std::size_t found = 0;
  for (std::size_t i = 0; i < patches.size() && patches.size() > 1; ++i)
  {
    double worst = HUGE_VAL;
    for (const PatchTetrahedron& piece : patches[i])
    {
      worst = std::min(worst, this->SineOf(tetrahedron, piece));
    }
    if (worst > best)
    {
      best = worst;
      found = i;
    }
  }
  return static_cast<std::uint8_t>(found);
}

/** All points, and the surfaces and walls that they are on. */
TetrahedronMesh MovedVertices::PlacedPoints() const
{
  TetrahedronMesh mesh;
  mesh.Positions = this->Mesh.AllPoints();
  mesh.Surfaces.assign(mesh.Positions.size(), 0);
  mesh.OnWalls.assign(mesh.Positions.size(), 0);
  for (std::uint32_t vertex = 0; vertex < this->Mesh.VertexCount(); ++vertex)
  {
    const std::uint32_t point = this->Mesh.Leaves().Vertices[vertex].PointId;
    if (point != CutMesh::None)
    {
      mesh.OnWalls[point] = this->Mesh.WallsOf(vertex);
    }
  }
  for (std::uint32_t point = 0; point < mesh.Positions.size(); ++point)
  {
    const Crossing& crossing = this->Mesh.AllCrossings()[point];
    if (crossing.IsThere())
    {
      mesh.Surfaces[point] = static_cast<std::int8_t>(2 * crossing.Surface - 1);
      mesh.OnWalls[point] =
        CommonWalls(this->Mesh.WallsOf(crossing.Ends[0]), this->Mesh.WallsOf(crossing.Ends[1]));
    }
  }
  return mesh;
}

void MovedVertices::AddPieces(
  std::uint32_t tetrahedron, std::uint8_t patch, TetrahedronMesh& mesh) const
{
  const std::vector<std::vector<PatchTetrahedron>>& patches = this->PatchesOf(tetrahedron);
  if (!patches.empty())
  {
    for (const PatchTetrahedron& piece : patches[patch])
    {
      mesh.Tetrahedra.push_back(this->CornersOf(tetrahedron, piece));
      mesh.Origins.push_back(tetrahedron);
    }
  }
}

/** Adds what was pushed. @return new ids, by point; points that were not pushed keep theirs */
std::vector<std::uint32_t> MovedVertices::AddPushed(TetrahedronMesh& mesh) const
{
  std::vector<std::uint32_t> ids(this->Places.size());
  std::iota(ids.begin(), ids.end(), 0U);
  for (std::uint32_t point = 0; point < ids.size(); ++point)
  {
    if (this->Places[point] != this->Mesh.PointAt(point))
    {
      ids[point] = static_cast<std::uint32_t>(mesh.Positions.size());
      mesh.Positions.push_back(this->Places[point]);
      mesh.Surfaces.push_back(mesh.Surfaces[point]);
      mesh.OnWalls.push_back(mesh.OnWalls[point]);
      mesh.Blended.push_back({ ids[point], { { point, 1.0 } } });
    }
  }
  return ids;
}

TetrahedronMesh MovedVertices::Cut(const ParallelFor& parallelFor) const
{
  TetrahedronMesh mesh = this->PlacedPoints();
  const std::vector<std::uint32_t> ids = this->AddPushed(mesh);
  const auto count = static_cast<std::uint32_t>(this->Mesh.Leaves().Tetrahedra.size());
  std::vector<std::uint8_t> best(count);
  ForEachIndex(parallelFor, count, LeastRange,
    [&](std::int64_t i) { best[i] = this->BestPatch(static_cast<std::uint32_t>(i)); });
  for (std::uint32_t i = 0; i < count; ++i)
  {
    this->AddPieces(i, best[i], mesh);
  }
  for (Corners& corners : mesh.Tetrahedra)
  {
    std::transform(corners.begin(), corners.end(), corners.begin(),
      [&](std::uint32_t point) { return ids[point]; });
  }
  return mesh;
}

TetrahedronMesh MovedVertices::CutAsMeasured() const
{
  TetrahedronMesh mesh = this->PlacedPoints();
  const auto count = static_cast<std::uint32_t>(this->Mesh.Leaves().Tetrahedra.size());
  for (std::uint32_t i = 0; i < count; ++i)
  {
    this->AddPieces(i, MeasuredPatch, mesh);
  }
  return mesh;
}

}
