// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_EdgeCollapses_h
#define isodiamond_EdgeCollapses_h

#include "Patches/PatchDistance.h"
#include "Simplification/Fan.h"
#include "Simplification/Hole.h"
#include "Simplification/MeshPart.h"
#include "Simplification/Quadric.h"

#include <array>
#include <cstdint>
#include <queue>
#include <unordered_set>
#include <vector>

namespace isodiamond
{

/** Anything else that edges of a surface belong to and that has a say in their collapse. */
class CollapseGuard
{
public:
  virtual ~CollapseGuard() = default;
  /** Whether a vertex may collapse into another one. */
  virtual bool Allows(std::uint32_t vertex, std::uint32_t target) = 0;
  /** Collapses a vertex into another one. */
  virtual void Collapse(std::uint32_t vertex, std::uint32_t target) = 0;
  /** Notes that a vertex cannot collapse into any other one at present. */
  virtual void NoteRefusal(std::uint32_t vertex) = 0;
  /** Whether a vertex may have become able to collapse since the last NoteRefusal() of it. */
  virtual bool IsWorthATry(std::uint32_t vertex) const = 0;
  /** Undoes collapses. @return the vertices that are restored: these, and all whose collapses
   *  built on theirs */
  virtual std::vector<std::uint32_t> Undo(const std::vector<std::uint32_t>& vertices) = 0;
};

/**
 * Collapses edges of a mesh into one of their ends, the cheapest by quadrics first (Garland and
 * Heckbert, SIGGRAPH 1997), as long as everything stays within its allowance.
 *
 * A vertex is removed, and the hole filled by triangles from one of its neighbours. Seen along the
 * mean normal of the hole, the old and the new filling must be the same polygon, covered once, so
 * nothing is turned over (of an open hole, up to its new border). Where no direction shows that, or
 * only barely, as on the edge of a thin wall, no triangle may turn by more than 75 degrees, and
 * samples stay with triangles that face as they do. The link condition keeps the topology. Samples
 * of the original stay with the triangle that they lie over: their distance from it is nearly that
 * of the original. So the result has to be measured, and what is wrong with it can be undone.
 *
 * A vertex at the border moves along it, and only if its two edges there are on one wall, so that
 * the edge that replaces them is, too. Where no walls are known, the border stays. No new edge
 * joins two fixed vertices: a neighbouring part that has them, too, might make the same edge.
 *
 * Then each vertex that is left moves to another of the original's points that lies over its
 * triangles, if these are nearer to all that lies over them then, or shaped better (Fan.h); and
 * edges collapse where that has become possible. A mesh that only collapses can make has its
 * vertices where others, earlier, happened to leave them.
 *
 * Last, the remaining edges are flipped where that brings samples nearer overall: quadrics tell
 * which vertices to keep, but not which of two diagonals follows a ridge or a groove between them.
 * Where both do equally well, the one that gives the better shape is taken.
 */
class EdgeCollapses
{
public:
  /** @param part stays as it is, and must outlive it
   *  @param usedPart what part of allowances samples may use: between them the surface may be a
   * bit farther off
   *  @param guard is asked first whether a vertex is worth a try, last whether it may collapse, and
   * told if it does. Null if there is none. Must outlive it */
  EdgeCollapses(const MeshPart& part, double usedPart, CollapseGuard* guard = nullptr);
  EdgeCollapses(const EdgeCollapses&) = delete;
  EdgeCollapses& operator=(const EdgeCollapses&) = delete;

  /** Collapses all that it can, except what the guard knows to be futile, or what is settled and
   * has nothing change around it. Moves vertices and flips edges only if there is no guard. @return
   * by number: whether a triangle has changed, or is gone */
  std::vector<bool> Run();

  /** The mesh as it is now; triangles that remain keep their numbers. */
  const LinkedTriangles& Mesh() const { return this->Links; }

  /** By sample: the number of the triangle that it lies over now; None for points in use. */
  const std::vector<std::uint32_t>& SampleHomes() const { return this->Homes; }

  /** The one of two triangles that was changed last; either of them may be None. */
  std::uint32_t LastChangedOf(std::uint32_t a, std::uint32_t b) const
  {
    const auto steps = [&](std::uint32_t triangle)
    { return triangle == None ? 0 : this->LastStep[triangle] + 1; }; // None + 1 is 0
    return steps(b) > steps(a) ? b : a;
  }

  /** Undoes the last collapse or flip that made each triangle what it is, and those that removed
   * points, with all later ones that built on them. @return by number: which triangles this
   * changed */
  std::vector<bool> Undo(
    const std::vector<std::uint32_t>& triangles, const std::vector<std::uint32_t>& points);

private:
  static constexpr int MostNeighbours = Hole::MostPoints;

  /** A vertex's cheapest collapse that has not been refused. */
  struct Candidate
  {
    double Cost;
    std::uint32_t Vertex;
    std::uint32_t Target;
    std::uint32_t Version; ///< of the vertex's neighbourhood

    bool operator<(const Candidate& other) const // a queue has the greatest first
    {
      return this->Cost != other.Cost  ? this->Cost > other.Cost
        : this->Vertex != other.Vertex ? this->Vertex > other.Vertex
                                       : this->Target > other.Target;
    }
  };

  /** A triangle that fills a part of a hole, seen along the mean normal. */
  struct Filling
  {
    Vector Normal{};
    TriangleDistance Distance; ///< of an open hole, or a ridge's
    Hole::Place Start{};       ///< of the edge to the next one
    Hole::Place Spoke{};
    std::uint32_t FirstSample = None;

    bool IsBeyond(const Hole::Place& place) const
    {
      return this->Spoke[0] * (place[1] - this->Start[1]) >
        this->Spoke[1] * (place[0] - this->Start[0]);
    }
  };

  /** A sample, kept small: there are many, and each is looked at often. */
  struct Watched
  {
    std::array<float, 3> Position; ///< relative to the first point
    float Allowance;               ///< the used part of it
    std::uint32_t Next;            ///< the next one over the same triangle
    std::uint32_t NextOver;        ///< likewise, over what fills a hole

    Vector At() const { return { this->Position[0], this->Position[1], this->Position[2] }; }
  };

  /** What was done, so as to undo it: a vertex was removed or moved, or an edge flipped. */
  struct Step
  {
    std::uint32_t Vertex;    ///< None for a flip
    std::uint32_t Successor; ///< the point that took its place; None if it was removed
    std::size_t First;       ///< of its triangles, and of its points: for a flip, A to D
    int Count;
  };

  /** Two triangles (A, B, C) and (B, A, D), which become (A, D, C) and (D, B, C). */
  struct Flip
  {
    std::uint32_t First = None;
    std::uint32_t Second = None;
    std::uint32_t A = None;
    std::uint32_t B = None;
    std::uint32_t C = None;
    std::uint32_t D = None;
    Vector FirstNormal{}; ///< afterwards
    Vector SecondNormal{};
    Vector TowardB{}; ///< across the new edge, as it is seen

    std::array<std::uint32_t, 6> Numbers() const
    {
      return { this->First, this->Second, this->A, this->B, this->C, this->D };
    }
  };

  void AddTriangles();
  void AddSamples(const std::vector<SurfaceSample>& samples, const Vector& origin, double usedPart);
  bool IsWorthATry(std::uint32_t vertex) const;
  bool FindHole(std::uint32_t vertex, std::uint32_t first, Hole& hole) const;
  bool KeepsTopology(const Hole& hole);
  bool KeepsShape(std::uint32_t vertex, const Hole& hole) const;
  /** Of a triangle's smallest angle. */
  double SineOf(const Triangle& points) const
  {
    return SmallestSine(
      this->Positions[points[0]], this->Positions[points[1]], this->Positions[points[2]]);
  }
  bool CanFill(std::uint32_t vertex, Hole& hole);
  bool Fill(const Hole& hole);
  bool TakesSamples(std::uint32_t vertex, const Hole& hole);
  bool FillRidge(std::uint32_t vertex, const Hole& hole);
  void FillWithTheSame(std::uint32_t vertex, const Hole& hole);
  bool MakesCrease(const Hole& hole) const;
  bool MakesCrease(const Flip& flip) const;
  bool MakesCrease(const Fan& fan) const;
  template <typename NewNormal>
  bool MakesCrease(const Hole& hole, bool goesRound, NewNormal&& newNormal) const;
  bool MayGo(std::uint32_t vertex) const
  {
    return this->AnyTriangle[vertex] != None && !this->IsFixed[vertex] &&
      !this->IsLeftAlone[vertex] && (!this->IsAtBorder[vertex] || this->OnWalls[vertex] != 0);
  }
  void AddBorder(std::uint32_t from, std::uint32_t to, const Vector& normal);
  bool FindOpenHole(std::uint32_t vertex, std::uint32_t first, Hole& hole) const;
  bool Put(int i, const Hole& hole, const Vector& direction, double leastCosine);
  TriangleDistance DistanceFrom(int i, const Hole& hole) const;
  void Take(Filling& filling, std::uint32_t sample);
  bool IsNear(
    const Hole& hole, const Watched& sample, std::uint32_t number, const Hole::Place& place);
  bool IsNearRidge(std::uint32_t number, const Vector& normal);
  void CollapseAll();
  void MoveVertices();
  bool FindFan(std::uint32_t vertex);
  void Move(std::uint32_t vertex, const Fan& fan);
  void UndoMove(const Step& step);
  void FlipEdges();
  bool SeeFlip(std::uint32_t triangle, int edge, Flip& flip) const;
  bool IsWorthIt(const Flip& flip) const;
  bool IsNewEdge(const Flip& flip) const;
  void Do(const Flip& flip);
  void UndoFlip(const Step& step);
  void SetSides(
    std::uint32_t first, std::uint32_t second, const std::array<std::uint32_t, 4>& points);
  void ShareSamples(
    std::uint32_t first, std::uint32_t second, std::uint32_t point, const Vector& towardSecond);
  std::vector<bool> StepsThatMade(
    const std::vector<std::uint32_t>& triangles, const std::vector<std::uint32_t>& points) const;
  void AskGuard(std::vector<bool>& isUndone);
  void Undo(const Step& step);
  void UndoCollapse(const Step& step);
  void Forget(const std::vector<bool>& isUndone);
  void GiveBackSamples(const Step& step);
  int NearestIn(const Hole& hole, const Vector& place) const;
  void PutOver(std::uint32_t triangle, std::uint32_t sample);
  void TakeAway(std::uint32_t sample);
  void Collapse(std::uint32_t vertex, const Hole& hole);
  void Note(std::uint32_t vertex, const Hole& hole);
  void Close(std::uint32_t vertex, std::uint32_t gone, std::uint32_t stays, int edge);
  void Offer(std::uint32_t vertex, double cost, std::uint32_t target);
  void OfferAnew(std::uint32_t vertex);
  void OfferAgain(std::uint32_t vertex, std::uint32_t gone, std::uint32_t target);

  /** Calls visit(triangle) for those that a step changed or removed. */
  template <typename Visit>
  void ForEachTriangleOf(const Step& step, Visit&& visit) const;
  /** Calls visit(neighbour, triangle between it and the next one; None if it is the last). */
  template <typename Visit>
  void ForEachNeighbour(std::uint32_t vertex, Visit&& visit) const;

  CollapseGuard* Guard;          ///< or null
  double LeastSine;              ///< of new triangles
  std::vector<Vector> Positions; ///< relative to the first one
  LinkedTriangles Links;
  std::vector<Triangle>& Triangles;       ///< of these
  std::vector<Triangle>& Neighbours;      ///< of these
  std::vector<Vector> Normals;            ///< of unit length
  std::vector<std::uint32_t> FirstSample; ///< by triangle: of those over it
  std::vector<std::uint32_t> Homes;       ///< by sample
  std::vector<Watched> Samples;

  std::vector<std::uint32_t> AnyTriangle;  ///< by vertex
  std::vector<bool> IsFixed;               ///< stays
  const std::vector<bool>& IsSettled;      ///< by vertex: need not be tried unless things change
  std::vector<bool> IsAtBorder;            ///< by vertex
  const std::vector<Walls::Type>& OnWalls; ///< by vertex
  std::vector<bool> IsLeftAlone;           ///< more than one fan of triangles
  std::vector<Quadric> Quadrics;
  struct Price
  {
    double Cost = 0.0;
    std::uint32_t Target = None;
    bool WasRefused = false; ///< a better one was
    bool IsOld = false;      ///< has to be found again
  };
  std::vector<Price> Best; ///< by vertex: what is offered; None if all were refused
  std::vector<std::uint32_t> Versions;
  std::vector<std::uint32_t> Marks; ///< by vertex: the last hole that it was seen around
  std::uint32_t Mark = 0;

  std::priority_queue<Candidate> Queue;
  std::array<Filling, MostNeighbours> Fillings; ///< of the last hole, by its points
  Vector Corner{};                              ///< that all of them share
  int FillingCount = 0;
  Fan Around; ///< the last vertex that might have moved

  std::vector<Step> Steps;
  std::vector<std::uint32_t> TrianglesOfSteps;
  std::vector<std::uint32_t> PointsOfSteps;
  std::vector<std::uint32_t> LastStep;  ///< by triangle
  std::vector<std::uint32_t> RemovedIn; ///< by point: the step
  /** Edges that undoing flips would bring back. */
  std::unordered_set<std::uint64_t> FlippedAway;
};

template <typename Visit>
void EdgeCollapses::ForEachTriangleOf(const Step& step, Visit&& visit) const
{
  for (int i = 0; i < step.Count; ++i)
  {
    const std::uint32_t triangle = this->TrianglesOfSteps[step.First + static_cast<std::size_t>(i)];
    if (triangle != None)
    {
      visit(triangle);
    }
  }
}

template <typename Visit>
void EdgeCollapses::ForEachNeighbour(std::uint32_t vertex, Visit&& visit) const
{
  // At the border: start where there is no triangle before.
  std::uint32_t first = this->AnyTriangle[vertex];
  if (this->IsAtBorder[vertex])
  {
    std::uint32_t before = first;
    do
    {
      first = before;
      before = this->Neighbours[first][PlaceOf(this->Triangles[first], vertex)];
    } while (before != None && before != this->AnyTriangle[vertex]);
  }
  std::uint32_t at = first;
  do
  {
    const Triangle& triangle = this->Triangles[at];
    const int place = PlaceOf(triangle, vertex);
    visit(triangle[(place + 1) % 3], at);
    const std::uint32_t next = this->Neighbours[at][(place + 2) % 3];
    if (next == None)
    {
      visit(triangle[(place + 2) % 3], None);
    }
    at = next;
  } while (at != None && at != first);
}

}

#endif
