// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/MovedVertices.h"

#include "Stuffing/SearchAhead.h"
#include "Stuffing/SurfaceLinks.h"

#include <algorithm>
#include <cmath>
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

/** Moves that are tried at the same time: few of them are near to each other. */
constexpr std::size_t MovesAtOnce = 64;

/** This many vertices are worth a thread. */
constexpr std::int64_t LeastRange = 2048;

/** The least sine of a dihedral angle that a move may leave in a whole tetrahedron. */
constexpr double LeastSine = 0.1;

}

MovedVertices::MovedVertices(const Background& background)
  : Mesh(background)
  , Vertices(background.Leaves())
  , Points(background.AllPoints())
{
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
  SearchAhead(
    parallelFor, goals.size(), MovesAtOnce, this->Touched,
    [&](std::size_t i) { return this->GoalOf(goals[i].Vertex); },
    [&](std::size_t i, const Goal& /*found*/, int changes)
    {
      // What decides is no more than two edges away.
      return this->Touched.AnyIsTouched(this->Mesh, this->Mesh.StarOf(goals[i].Vertex), changes);
    },
    [&](std::size_t /*i*/, const Goal& found) { this->MoveTo(found); });
}

/** Where a vertex moves to, if it can; other moves may have taken isovertices away. */
MovedVertices::Goal MovedVertices::GoalOf(std::uint32_t vertex) const
{
  const Goal goal = this->NearestToMove(vertex);
  const bool isGood = goal.Distance < NearPart && this->IsRoundAround(goal) && this->CanBeOn(goal);
  return isGood ? goal : Goal{};
}

void MovedVertices::MoveTo(const Goal& goal)
{
  if (goal.Point != CutMesh::None)
  {
    this->Vertices.States[goal.Vertex] = static_cast<std::uint8_t>(StateOn(goal.Surface));
    this->Vertices.Goals[goal.Vertex] = goal.Point;
    this->Touched.BeginChange();
    this->Touched.Touch(this->Mesh, this->Mesh.StarOf(goal.Vertex));
  }
}

/** As if a vertex was at its goal. */
PlacesView MovedVertices::Tried(const Goal& goal) const
{
  return { this->Vertices, goal.Vertex, StateOn(goal.Surface), goal.Point };
}

/** Whether a vertex can be on the surface of its goal without a change of topology. */
bool MovedVertices::CanBeOn(const Goal& goal) const
{
  return SurfaceLinks(this->Mesh, this->Tried(goal))
    .CanBeOn(goal.Vertex, goal.Surface, this->Vertices.States[goal.Vertex] == BetweenSurfaces);
}

void MovedVertices::PushAll(double most, const ParallelFor& parallelFor)
{
  std::vector<std::uint8_t> haveToStay(this->Mesh.VertexCount()); // by vertex
  ForEachIndex(parallelFor, haveToStay.size(), LeastRange,
    [&](std::int64_t vertex)
    { haveToStay[vertex] = this->HasToStay(static_cast<std::uint32_t>(vertex)) ? 1 : 0; });
  for (std::uint32_t vertex = 0; vertex < haveToStay.size(); ++vertex)
  {
    if (haveToStay[vertex] == 0)
    {
      continue;
    }
    for (const std::uint32_t point : this->Mesh.CrossingsAt(vertex))
    {
      const Crossing& crossing = this->Mesh.AllCrossings()[point];
      if (PlacesView(this->Vertices)
            .IsCut(vertex, this->OtherEnd(point, vertex), crossing.Surface) &&
        this->PartOfEdge(point, vertex) < PushedPart)
      {
        this->Push(point, vertex, most);
      }
    }
  }
}

/** Whether a vertex must not move to what is nearest: it is pinned, or the topology would change.
 */
bool MovedVertices::HasToStay(std::uint32_t vertex) const
{
  const Goal nearest = this->NearestTo(vertex, HUGE_VAL);
  return nearest.Distance < PushedPart &&
    (std::isfinite(this->Mesh.MostMoveOf(vertex)) || !this->CanBeOn(nearest));
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
  const Vector before = std::exchange(this->Points[point], at + part * edge);
  const LeafPieces pieces(this->Mesh, this->Vertices, this->Points);
  const CellsAtPoints::Cells star = this->Mesh.StarOf(from);
  if (!std::all_of(
        star.begin(), star.end(), [&](std::uint32_t leaf) { return pieces.ArePositive(leaf); }))
  {
    this->Points[point] = before;
  }
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
  const int state = this->Vertices.States[vertex];
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
    const int common = walls & this->Mesh.WallsOf(other);
    if (isBehind || common != walls || // or it would leave a wall
      !PlacesView(this->Vertices).IsCut(vertex, other, crossing.Surface))
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

/** Whether all leaves around a vertex at its goal are round enough, and those that a surface cuts
 * on a line that is no longer straight have positive pieces. */
bool MovedVertices::IsRoundAround(const Goal& goal) const
{
  const PlacesView tried = this->Tried(goal);
  const LeafPieces pieces(this->Mesh, tried, this->Points);
  const CellsAtPoints::Cells star = this->Mesh.StarOf(goal.Vertex);
  return std::all_of(star.begin(), star.end(),
    [&](std::uint32_t leaf)
    {
      const auto [a, b, c, d] = this->Mesh.CornersOf(leaf);
      const double sine =
        SmallestSine(tried.PositionOf(this->Mesh, a), tried.PositionOf(this->Mesh, b),
          tried.PositionOf(this->Mesh, c), tried.PositionOf(this->Mesh, d));
      return (this->Mesh.IsNegative(leaf) ? -sine : sine) > LeastSine &&
        (!this->IsBent(tried, leaf) || pieces.ArePositive(leaf));
    });
}

/** Whether a surface cuts a leaf on a line that is no longer straight. */
bool MovedVertices::IsBent(const PlacesView& tried, std::uint32_t leaf) const
{
  const Corners& corners = this->Mesh.CornersOf(leaf);
  bool isBent = false;
  for (int younger = 0; younger < 3; ++younger)
  {
    for (int older = younger + 1; older < 4; ++older)
    {
      const bool isMoved =
        tried.StateOf(corners[younger]) % 2 != 0 || tried.StateOf(corners[older]) % 2 != 0;
      isBent = isBent ||
        (isMoved &&
          (tried.IsCut(corners[younger], corners[older], 0) ||
            tried.IsCut(corners[younger], corners[older], 1)));
    }
  }
  return isBent;
}

}
