// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Improvement.h"

#include "Stuffing/BestPlace.h"
#include "Stuffing/LocalMesh.h"
#include "Stuffing/RingFilling.h"
#include "Stuffing/SurfaceChanges.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace isodiamond
{
namespace
{

/** Passes over what is bad; most is done in two. */
constexpr int MostPasses = 10;
/** Tries in all passes, of so many that are bad at first: where it is hopeless, for a coarse mesh
 *  can be no better, they would become ever more. */
constexpr std::size_t MostTries(std::size_t bad)
{
  return 1000 + 4 * bad;
}
/** Less of what a tetrahedron lacks is no improvement. */
constexpr double LeastGain = 0.01;
/** Tetrahedra with less than this part of the wanted sine are all equally bad. */
constexpr double WorstPart = 0.01;

/** Tries between two looks at whether to go on: some milliseconds. */
constexpr std::size_t TriesOfStep = 16;

/** A change that has been tried. */
struct Change
{
  enum Kinds
  {
    None,
    Move,     ///< of Point to Place
    Collapse, ///< of the edge from Point to Other into Other
    Replace,  ///< of Old by Fresh
    Split,    ///< as Replace, with Fresh around a new point, written as NewPoint, at Place
    Shift     ///< of Point, on a surface, which a new point at Place replaces
  };
  static constexpr std::uint32_t NewPoint = LocalMesh::None;

  Kinds Kind = None;
  double Gain = 0.0; ///< see Improver::Shortfall
  std::uint32_t Point = 0;
  std::uint32_t Other = 0;
  Vector Place{};
  Walls::Type OnWalls = 0;
  std::vector<std::uint32_t> Old;
  std::vector<Corners> Fresh;
};

class Improver
{
public:
  Improver(TetrahedronMesh mesh, const ImprovementOptions& options)
    : Mesh(std::move(mesh))
    , Options(options)
    , Wanted(std::sin(options.WantedAngle / DegreesOfRadian))
  {
  }

  void Run(const ParallelFor& parallelFor)
  {
    std::vector<std::uint32_t> bad(this->Mesh.Mesh().Tetrahedra.size());
    std::iota(bad.begin(), bad.end(), 0U);
    std::size_t triesLeft = 0;
    for (int pass = 0; pass < MostPasses && !bad.empty(); ++pass)
    {
      bad = this->WorstFirst(bad);
      triesLeft = pass == 0 ? MostTries(bad.size()) : triesLeft;
      if (bad.size() > triesLeft)
      {
        return;
      }
      triesLeft -= bad.size();
      std::vector<std::uint32_t> changed;
      InSteps(parallelFor, bad.size(), TriesOfStep,
        [&](std::size_t i)
        {
          const std::uint32_t tetrahedron = bad[i];
          if (this->IsBad(tetrahedron) && this->IsWorthATry(tetrahedron))
          {
            const std::size_t before = changed.size();
            this->ImproveAt(tetrahedron, changed);
            this->NoteChange(tetrahedron, changed.data() + before, changed.data() + changed.size());
          }
        });
      if (changed.empty())
      {
        return;
      }
      bad.insert(bad.end(), changed.begin(), changed.end());
    }
  }

  TetrahedronMesh Take() { return this->Mesh.Take(); }

private:
  bool IsBad(std::uint32_t tetrahedron) const
  {
    return this->Mesh.IsAlive(tetrahedron) && this->Mesh.SineOf(tetrahedron) < this->Wanted;
  }

  /** Whether anything has changed around a tetrahedron since it was tried. */
  bool IsWorthATry(std::uint32_t tetrahedron) const
  {
    const auto tried = this->Tried.find(tetrahedron);
    const Corners& corners = this->Mesh.CornersOf(tetrahedron);
    return tried == this->Tried.end() ||
      std::any_of(corners.begin(), corners.end(),
        [&](std::uint32_t point)
        {
          const auto touched = this->Touched.find(point);
          return touched != this->Touched.end() && touched->second > tried->second;
        });
  }

  void NoteChange(std::uint32_t tetrahedron, const std::uint32_t* first, const std::uint32_t* last)
  {
    this->Tried[tetrahedron] = this->Changes;
    if (first != last)
    {
      ++this->Changes;
      for (; first != last; ++first)
      {
        for (const std::uint32_t point : this->Mesh.CornersOf(*first))
        {
          this->Touched[point] = this->Changes;
        }
      }
    }
  }

  std::vector<std::uint32_t> WorstFirst(const std::vector<std::uint32_t>& all) const
  {
    std::vector<std::uint32_t> bad;
    std::copy_if(all.begin(), all.end(), std::back_inserter(bad),
      [&](std::uint32_t tetrahedron) { return this->IsBad(tetrahedron); });
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    std::stable_sort(bad.begin(), bad.end(),
      [&](std::uint32_t a, std::uint32_t b)
      { return this->Mesh.SineOf(a) < this->Mesh.SineOf(b); });
    return bad;
  }

  /** Does the best change that there is. */
  void ImproveAt(std::uint32_t tetrahedron, std::vector<std::uint32_t>& changed)
  {
    const Corners corners = this->Mesh.CornersOf(tetrahedron);
    this->Best = Change();
    this->Best.Gain = LeastGain * this->Shortfall(this->Mesh.SineOf(tetrahedron));
    for (const std::uint32_t point : corners)
    {
      this->TryToMove(point);
    }
    this->ForEachEdge(corners,
      [&](std::uint32_t a, std::uint32_t b)
      {
        this->TryToCollapse(a, b);
        this->TryToCollapse(b, a);
      });
    this->ForEachEdge(
      corners, [&](std::uint32_t a, std::uint32_t b) { this->TryToRemoveEdge(a, b); });
    for (const std::uint32_t point : corners)
    {
      this->TryToRemoveFace(tetrahedron, point);
    }
    if (this->Best.Kind == Change::None)
    {
      this->ForEachEdge(corners, [&](std::uint32_t a, std::uint32_t b) { this->TryToSplit(a, b); });
    }
    for (const std::uint32_t point : corners)
    {
      if (this->Best.Kind == Change::None || this->Best.Kind == Change::Shift)
      {
        this->TryToShift(point);
      }
    }
    this->Do(this->Best, changed);
  }

  template <typename Body>
  static void ForEachEdge(const Corners& corners, Body&& body)
  {
    for (int i = 0; i < 4; ++i)
    {
      for (int j = i + 1; j < 4; ++j)
      {
        body(corners[i], corners[j]);
      }
    }
  }

  void Do(const Change& change, std::vector<std::uint32_t>& changed)
  {
    switch (change.Kind)
    {
      case Change::None:
        break;
      case Change::Move:
        this->Mesh.Move(change.Point, change.Place);
        changed.insert(changed.end(), this->Mesh.StarOf(change.Point).begin(),
          this->Mesh.StarOf(change.Point).end());
        break;
      case Change::Collapse:
        this->Mesh.Collapse(change.Point, change.Other, changed);
        break;
      case Change::Replace:
        this->Mesh.Replace(change.Old, change.Fresh, changed);
        break;
      case Change::Split:
        this->Split(change, changed);
        break;
      case Change::Shift:
        this->Shift(change, changed);
        break;
    }
  }

  void Split(const Change& change, std::vector<std::uint32_t>& changed)
  {
    const std::uint32_t point =
      this->Mesh.AddPoint(0.5 * (this->Mesh.At(change.Point) + this->Mesh.At(change.Other)), 0,
        change.OnWalls, { { change.Point, 0.5 }, { change.Other, 0.5 } });
    std::vector<Corners> fresh = change.Fresh;
    for (Corners& corners : fresh)
    {
      std::replace(corners.begin(), corners.end(), Change::NewPoint, point);
    }
    this->Mesh.Replace(change.Old, fresh, changed);
    this->Mesh.Move(point, change.Place);
  }

  /** The old point stays known: it tells where the surface was. Attributes are those of before. */
  void Shift(const Change& change, std::vector<std::uint32_t>& changed)
  {
    const std::uint32_t old = change.Point;
    const std::uint32_t point = this->Mesh.AddPoint(change.Place, this->Mesh.Mesh().Surfaces[old],
      this->Mesh.Mesh().OnWalls[old], { { old, 1.0 } });
    const LocalMesh::Star star = this->Mesh.StarOf(old);
    const std::vector<std::uint32_t> around(star.begin(), star.end());
    for (const std::uint32_t tetrahedron : around)
    {
      Corners corners = this->Mesh.CornersOf(tetrahedron);
      std::replace(corners.begin(), corners.end(), old, point);
      this->Mesh.Replace({ tetrahedron }, { corners }, changed);
    }
  }

  /** What a tetrahedron lacks: of several bad ones each counts, the worst most. */
  double Shortfall(double sine) const
  {
    const double missing =
      std::max(0.0, this->Wanted / std::max(sine, WorstPart * this->Wanted) - 1.0);
    return missing * missing;
  }

  /** Of some tetrahedra. */
  struct Shape
  {
    double Worst = 1.0; ///< the smallest sine
    double Shortfall = 0.0;
  };
  void Add(double sine, Shape& shape) const
  {
    shape.Worst = std::min(shape.Worst, sine);
    shape.Shortfall += this->Shortfall(sine);
  }
  template <typename Tetrahedra>
  Shape ShapeOf(const Tetrahedra& tetrahedra) const
  {
    Shape shape;
    for (const auto& tetrahedron : tetrahedra)
    {
      this->Add(this->Mesh.SineOf(tetrahedron), shape);
    }
    return shape;
  }

  /** Whether a change would be the best one so far: the worst gets no worse, and all together
   *  better. */
  bool IsBetter(const Shape& before, const Shape& after) const
  {
    return after.Worst >= before.Worst && before.Shortfall - after.Shortfall > this->Best.Gain;
  }
  /** Begins the best change so far. */
  Change& Take(Change::Kinds kind, const Shape& before, const Shape& after)
  {
    this->Best = Change();
    this->Best.Kind = kind;
    this->Best.Gain = before.Shortfall - after.Shortfall;
    return this->Best;
  }

  //--- Moves ------------------------------------------------------------------

  void TryToMove(std::uint32_t point)
  {
    if (this->Mesh.Mesh().Surfaces[point] != 0)
    {
      return;
    }
    PointStar star;
    for (const std::uint32_t tetrahedron : this->Mesh.StarOf(point))
    {
      star.Add(this->Mesh.Mesh(), this->Mesh.CornersOf(tetrahedron), point);
    }
    const Shape before = this->ShapeOf(this->Mesh.StarOf(point));
    const PlacedPoint best = BestPlace(star, this->Mesh.At(point), this->Mesh.Mesh().OnWalls[point],
      this->Options.Axes, this->Wanted);
    Shape after;
    star.ForEachSine(best.Place, [&](double sine) { this->Add(sine, after); });
    if (this->IsBetter(before, after))
    {
      Change& move = this->Take(Change::Move, before, after);
      move.Point = point;
      move.Place = best.Place;
    }
  }

  //--- Edges that shrink ------------------------------------------------------

  void TryToCollapse(std::uint32_t from, std::uint32_t to)
  {
    const Shape before = this->ShapeOf(this->Mesh.StarOf(from));
    Shape after;
    for (const std::uint32_t tetrahedron : this->Mesh.StarOf(from))
    {
      Corners corners = this->Mesh.CornersOf(tetrahedron);
      if (!Has(corners, to))
      {
        std::replace(corners.begin(), corners.end(), from, to);
        this->Add(this->Mesh.SineOf(corners), after);
        if (!this->IsBetter(before, after))
        {
          return;
        }
      }
    }
    if (this->IsBetter(before, after) && this->Mesh.CanCollapse(from, to) &&
      StaysNear(this->Mesh, from, to, this->Options.SurfaceMove))
    {
      Change& collapse = this->Take(Change::Collapse, before, after);
      collapse.Point = from;
      collapse.Other = to;
    }
  }

  //--- Edges and faces that go ------------------------------------------------

  void TryToRemoveEdge(std::uint32_t a, std::uint32_t b)
  {
    LocalMesh::Ring ring;
    if (!this->Mesh.FindRing(a, b, MostAround, ring) || ring.Points.size() < 3 ||
      (!ring.IsClosed && !CanTurn(this->Mesh, a, b, ring, this->Options.SurfaceMove)))
    {
      return;
    }
    const Shape before = this->ShapeOf(ring.Tetrahedra);
    std::vector<Corners> fresh;
    FillRing(this->Mesh, a, b, ring.Points, fresh);
    const Shape after = this->ShapeOf(fresh);
    if (this->IsBetter(before, after) && this->AreNew(ring, fresh))
    {
      Change& replace = this->Take(Change::Replace, before, after);
      replace.Old = ring.Tetrahedra;
      replace.Fresh = std::move(fresh);
    }
  }

  /** Whether edges, and a lone triangle, between points around an edge are not in the mesh yet, and
   *  everybody can tell what is on a surface. */
  bool AreNew(const LocalMesh::Ring& ring, const std::vector<Corners>& fresh) const
  {
    const std::vector<std::uint32_t>& points = ring.Points;
    if (std::any_of(fresh.begin(), fresh.end(),
          [&](const Corners& corners) { return this->Mesh.IsAmbiguous(corners); }))
    {
      return false;
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      for (std::size_t j = i + 2; j < points.size(); ++j)
      {
        const bool isSide = ring.IsClosed && i == 0 && j + 1 == points.size();
        const bool isUsed = std::any_of(fresh.begin(), fresh.end(),
          [&](const Corners& corners)
          { return Has(corners, points[i]) && Has(corners, points[j]); });
        if (!isSide && isUsed && this->Mesh.HasEdge(points[i], points[j]))
        {
          return false;
        }
      }
    }
    return points.size() > 3 || this->Mesh.CountAt(points[0], points[1], points[2]) == 0;
  }

  /** Two tetrahedra on both sides of the face opposite to a point become three. */
  void TryToRemoveFace(std::uint32_t tetrahedron, std::uint32_t apex)
  {
    const Corners& corners = this->Mesh.CornersOf(tetrahedron);
    Face face = Without(corners, apex);
    const LocalMesh::Star star = this->Mesh.StarOf(face[0]);
    const auto other = std::find_if(star.begin(), star.end(),
      [&](std::uint32_t candidate)
      {
        const Corners& points = this->Mesh.CornersOf(candidate);
        return candidate != tetrahedron && Has(points, face[1]) && Has(points, face[2]);
      });
    if (other == star.end())
    {
      return;
    }
    const Corners& beyond = this->Mesh.CornersOf(*other);
    const std::uint32_t far = *std::find_if(beyond.begin(), beyond.end(),
      [&](std::uint32_t corner)
      { return std::find(face.begin(), face.end(), corner) == face.end(); });
    if (SixVolumes(this->Mesh.At(face[0]), this->Mesh.At(face[1]), this->Mesh.At(face[2]),
          this->Mesh.At(apex)) < 0.0)
    {
      std::swap(face[1], face[2]);
    }
    std::vector<Corners> fresh = { { far, apex, face[0], face[1] }, { far, apex, face[1], face[2] },
      { far, apex, face[2], face[0] } };
    std::vector<std::uint32_t> old = { tetrahedron, *other };
    const Shape before = this->ShapeOf(old);
    const Shape after = this->ShapeOf(fresh);
    if (this->IsBetter(before, after) && !this->Mesh.HasEdge(apex, far))
    {
      Change& replace = this->Take(Change::Replace, before, after);
      replace.Old = std::move(old);
      replace.Fresh = std::move(fresh);
    }
  }

  //--- New points -------------------------------------------------------------

  /** Puts a point into the middle of an edge, inside or in a wall, and moves it. */
  void TryToSplit(std::uint32_t a, std::uint32_t b)
  {
    LocalMesh::Ring ring;
    if (!this->Mesh.FindRing(a, b, MostAround, ring))
    {
      return;
    }
    int place = 0;
    if (!ring.IsClosed)
    {
      place = this->Mesh.PlaceOfFace(a, b, ring.Points.front());
      if (place == 0 || place >= Walls::Fixed ||
        place != this->Mesh.PlaceOfFace(a, b, ring.Points.back()))
      {
        return;
      }
    }
    PointStar star;
    std::vector<Corners> fresh;
    for (const std::uint32_t tetrahedron : ring.Tetrahedra)
    {
      for (const std::uint32_t end : { a, b })
      {
        Corners corners = this->Mesh.CornersOf(tetrahedron);
        star.Add(this->Mesh.Mesh(), corners, end);
        std::replace(corners.begin(), corners.end(), end, Change::NewPoint);
        fresh.push_back(corners);
      }
    }
    const auto walls = static_cast<Walls::Type>(place);
    const PlacedPoint best = BestPlace(
      star, 0.5 * (this->Mesh.At(a) + this->Mesh.At(b)), walls, this->Options.Axes, this->Wanted);
    const Shape before = this->ShapeOf(ring.Tetrahedra);
    Shape after;
    star.ForEachSine(best.Place, [&](double sine) { this->Add(sine, after); });
    if (this->IsBetter(before, after))
    {
      Change& split = this->Take(Change::Split, before, after);
      split.Point = a;
      split.Other = b;
      split.Place = best.Place;
      split.OnWalls = walls;
      split.Old = ring.Tetrahedra;
      split.Fresh = std::move(fresh);
    }
  }

  //--- Points on surfaces -----------------------------------------------------

  void TryToShift(std::uint32_t point)
  {
    const std::uint32_t source = this->Mesh.SourceOf(point); // where the surface is
    if (this->Mesh.Mesh().Surfaces[point] == 0 || source >= this->Options.Beyond.size())
    {
      return;
    }
    const CutEdgeEnd& beyond = this->Options.Beyond[source];
    PointStar star;
    for (const std::uint32_t tetrahedron : this->Mesh.StarOf(point))
    {
      star.Add(this->Mesh.Mesh(), this->Mesh.CornersOf(tetrahedron), point);
    }
    const Shape before = this->ShapeOf(this->Mesh.StarOf(point));
    const PlacedPoint best = BestPlace(star, this->Mesh.At(point), this->Mesh.Mesh().OnWalls[point],
      this->Options.Axes, this->Wanted,
      { this->Mesh.At(source), std::min(this->Options.SurfaceMove, 0.5 * beyond.Half) });
    Shape after;
    star.ForEachSine(best.Place, [&](double sine) { this->Add(sine, after); });
    if (this->IsBetter(before, after) && CanShift(this->Mesh, point, best.Place, beyond))
    {
      Change& shift = this->Take(Change::Shift, before, after);
      shift.Point = point;
      shift.Place = best.Place;
    }
  }

  LocalMesh Mesh;
  const ImprovementOptions& Options;
  double Wanted; ///< sine
  Change Best;
  int Changes = 0;
  /** How many changes there were when a tetrahedron was tried last, and a point touched. */
  std::unordered_map<std::uint32_t, int> Tried, Touched;
};

}

TetrahedronMesh Improve(
  TetrahedronMesh mesh, const ImprovementOptions& options, const ParallelFor& parallelFor)
{
  Improver improver(std::move(mesh), options);
  improver.Run(parallelFor);
  return improver.Take();
}

}
