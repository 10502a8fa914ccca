// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ChangeSearch_h
#define isodiamond_ChangeSearch_h

#include "Stuffing/BestPlace.h"
#include "Stuffing/Change.h"
#include "Stuffing/Improvement.h"
#include "Stuffing/Shortfall.h"

#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace isodiamond
{

/** Tries all changes around one tetrahedron, and keeps the best: see BestChange.h. */
class ChangeSearch
{
public:
  /** @param chance picks any change instead of the best one, if not null */
  ChangeSearch(
    const LocalMesh& mesh, const ImprovementOptions& options, std::minstd_rand* chance = nullptr)
    : Mesh(mesh)
    , Options(options)
    , Chance(chance)
    , Wanted(WantedSine(options))
  {
  }

  /** Tries all in random order, until one can be done. */
  Change FindAny(std::uint32_t tetrahedron);
  Change FindBest(std::uint32_t tetrahedron);
  /** See isodiamond::Helps(). */
  bool Helps(const Change& change, std::uint32_t tetrahedron);

private:
  /** Gaining less than this part of what a tetrahedron lacks is no improvement. */
  static constexpr double LeastGain = 0.01;
  /** Random changes leave tetrahedra with at least this part of the wanted sine. */
  static constexpr double LeastPartByChance = 0.1;

  double GainWanted(std::uint32_t tetrahedron) const
  {
    return LeastGain * ShortfallOf(this->Mesh.SineOf(tetrahedron), this->Wanted);
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

  template <typename Tetrahedra>
  Shortfall LackOf(const Tetrahedra& tetrahedra) const
  {
    Shortfall sum(this->Wanted);
    for (const auto& tetrahedron : tetrahedra)
    {
      sum.Add(this->Mesh.SineOf(tetrahedron));
    }
    return sum;
  }

  /** What the tetrahedra of a star lack with its point at a place. */
  Shortfall LackAt(const PointStar& star, const Vector& place) const
  {
    Shortfall sum(this->Wanted);
    star.ForEachSine(place, [&](double sine) { sum.Add(sine); });
    return sum;
  }

  bool IsBetterAt(std::uint32_t point, const Vector& place) const
  {
    return this->IsBetter(
      this->LackOf(this->Mesh.StarOf(point)), this->LackAt(FacesAround(this->Mesh, point), place));
  }

  /** Whether a change would be the best one so far: the worst gets no worse, and all together
   *  better. If chance picks, whether it could be done. */
  bool IsBetter(const Shortfall& before, const Shortfall& after) const
  {
    return this->Chance == nullptr
      ? after.Worst >= before.Worst && before.Sum - after.Sum > this->Best.Gain
      : after.Worst >= LeastPartByChance * this->Wanted;
  }

  /** Begins a new best change. */
  Change& Take(Change::Kinds kind, const Shortfall& before, const Shortfall& after)
  {
    this->Best = Change();
    this->Best.Kind = kind;
    this->Best.Gain = before.Sum - after.Sum;
    return this->Best;
  }

  void TryToMove(std::uint32_t point);
  void TryToCollapse(std::uint32_t from, std::uint32_t to);

  ///@{
  /** Edges and faces that go: EdgeChanges.cpp. */
  void TryToRemoveEdge(std::uint32_t a, std::uint32_t b);
  bool CanRemoveEdge(std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring) const;
  bool IsAllAround(const Change& change, LocalMesh::Ring& ring) const;
  bool CanReplace(const Change& change) const;
  bool AreNew(const LocalMesh::Ring& ring, const std::vector<Corners>& fresh) const;
  void TryToRemoveFace(std::uint32_t tetrahedron, std::uint32_t apex);
  ///@}

  ///@{
  /** New points in the middle of edges: EdgeChanges.cpp. */
  void TryToSplit(std::uint32_t a, std::uint32_t b);
  std::optional<Walls::Type> WallsOfMiddle(
    std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring) const;
  PointStar HalvesAround(std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring,
    std::vector<Corners>* fresh = nullptr) const;
  bool CanSplit(const Change& change) const;
  ///@}

  ///@{
  /** Points on surfaces. */
  double SurfaceMoveAt(std::uint32_t point) const;
  double MostShift(std::uint32_t point) const;
  bool MayShift(std::uint32_t point, const Vector& place) const;
  Vector InLattice(const Vector& place) const;
  void TryToShift(std::uint32_t point);
  ///@}

  const LocalMesh& Mesh;
  const ImprovementOptions& Options;
  std::minstd_rand* Chance;
  double Wanted; ///< sine
  Change Best;
};

}

#endif
