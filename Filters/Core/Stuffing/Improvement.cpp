// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Improvement.h"

#include "Stuffing/BestChange.h"
#include "Stuffing/LocalMesh.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
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

/** Changes that are looked for at the same time: few of them touch each other. */
constexpr std::size_t TriesAtOnce = 64;

class Improver
{
public:
  Improver(TetrahedronMesh mesh, const ImprovementOptions& options)
    : Mesh(std::move(mesh))
    , Options(options)
    , Wanted(WantedSine(options))
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
      for (std::size_t first = 0; first < bad.size(); first += TriesAtOnce)
      {
        const std::size_t count = std::min(TriesAtOnce, bad.size() - first);
        this->Improve(bad.data() + first, count, parallelFor, changed);
      }
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

  /** Of a point or tetrahedron, of which there may be new ones: how many changes there were when it
   *  was noted last; less than any if it never was. */
  static int NotedAt(const std::vector<int>& notes, std::uint32_t number)
  {
    return number < notes.size() ? notes[number] : Never;
  }
  static void Note(std::vector<int>& notes, std::uint32_t number, int changes)
  {
    if (number >= notes.size())
    {
      notes.resize(number + number / 2 + 1, Never);
    }
    notes[number] = changes;
  }

  /** Whether a point has been touched after so many changes. */
  bool IsTouched(std::uint32_t point, int changes) const
  {
    return NotedAt(this->Touched, point) > changes;
  }

  /** Whether anything has changed around a tetrahedron since it was tried. */
  bool IsWorthATry(std::uint32_t tetrahedron) const
  {
    const int tried = NotedAt(this->Tried, tetrahedron);
    const Corners& corners = this->Mesh.CornersOf(tetrahedron);
    return tried == Never ||
      std::any_of(corners.begin(), corners.end(),
        [&](std::uint32_t point) { return this->IsTouched(point, tried); });
  }

  /** Whether anything that BestChange() reads has changed after so many changes. */
  bool IsTouchedAround(std::uint32_t tetrahedron, int changes) const
  {
    const Corners& corners = this->Mesh.CornersOf(tetrahedron);
    return std::any_of(corners.begin(), corners.end(),
      [&](std::uint32_t corner)
      {
        const LocalMesh::Star star = this->Mesh.StarOf(corner);
        return std::any_of(star.begin(), star.end(),
          [&](std::uint32_t beside)
          {
            const Corners& points = this->Mesh.CornersOf(beside);
            return std::any_of(points.begin(), points.end(),
              [&](std::uint32_t point) { return this->IsTouched(point, changes); });
          });
      });
  }

  /** Finds the best changes for some tetrahedra at once, and does them one after the other. A
   *  change that is found by what another one has changed is found again: so all are as if each
   *  had been found when it was its turn. */
  void Improve(const std::uint32_t* tetrahedra, std::size_t count, const ParallelFor& parallelFor,
    std::vector<std::uint32_t>& changed)
  {
    const auto isToBeTried = [&](std::size_t i)
    { return this->IsBad(tetrahedra[i]) && this->IsWorthATry(tetrahedra[i]); };
    const int before = this->Changes;
    std::vector<Change> changes(count);
    ForEachIndex(parallelFor, count, 1,
      [&](std::int64_t i)
      {
        if (isToBeTried(i))
        {
          changes[i] = BestChange(this->Mesh, this->Options, tetrahedra[i]);
        }
      });
    for (std::size_t i = 0; i < count; ++i)
    {
      if (isToBeTried(i))
      {
        if (this->IsTouchedAround(tetrahedra[i], before))
        {
          changes[i] = BestChange(this->Mesh, this->Options, tetrahedra[i]);
        }
        this->DoAndNote(tetrahedra[i], changes[i], changed);
      }
    }
  }

  void DoAndNote(
    std::uint32_t tetrahedron, const Change& change, std::vector<std::uint32_t>& changed)
  {
    Note(this->Tried, tetrahedron, this->Changes);
    if (change.Kind == Change::None)
    {
      return;
    }
    ++this->Changes;
    if (change.Kind == Change::Collapse)
    {
      this->Touch(this->Mesh.StarOf(change.Point)); // some of it has nothing in its place
    }
    const std::size_t first = changed.size();
    this->Do(change, changed);
    this->Touch({ changed.data() + first, changed.data() + changed.size() });
  }

  void Touch(const LocalMesh::Star& tetrahedra)
  {
    for (const std::uint32_t tetrahedron : tetrahedra)
    {
      for (const std::uint32_t point : this->Mesh.CornersOf(tetrahedron))
      {
        Note(this->Touched, point, this->Changes);
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

  static constexpr int Never = -1;

  LocalMesh Mesh;
  const ImprovementOptions& Options;
  double Wanted; ///< sine
  int Changes = 0;
  std::vector<int> Tried;   ///< by tetrahedron: how many changes there were, the last time
  std::vector<int> Touched; ///< by point, likewise
};

}

double WantedSine(const ImprovementOptions& options)
{
  return std::sin(options.WantedAngle / DegreesOfRadian);
}

TetrahedronMesh Improve(
  TetrahedronMesh mesh, const ImprovementOptions& options, const ParallelFor& parallelFor)
{
  Improver improver(std::move(mesh), options);
  improver.Run(parallelFor);
  return improver.Take();
}

}
