// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/BestAttempt.h"

#include "Simplification/SelfIntersections.h"
#include "Stuffing/Detours.h"
#include "Stuffing/MeasuredSurfaces.h"
#include "Stuffing/ReturnedPoints.h"

#include <atomic>
#include <utility>

namespace isodiamond
{
namespace
{

/** This many tetrahedra are worth a thread. */
constexpr std::int64_t TetrahedraOfThread = 2048;

///@{
/** How many tetrahedra may be bad after all single changes, and which part of them. Where there are
 *  more, as beside missing values, where surfaces lie on each other, there is no room for good
 *  angles, and looking for it takes long, for worse. */
constexpr std::size_t ManyBad = 200;
constexpr double MuchBad = 0.05;
///@}

/** How often what is held is released in part. */
constexpr int MostReleases = 3;

}

bool BestAttempt::Attempt::IsHopeless() const
{
  const auto all = static_cast<double>(this->Mesh.Tetrahedra.size());
  return this->Bad > ManyBad && static_cast<double>(this->Bad) > MuchBad * all;
}

BestAttempt::BestAttempt(const Background& background, const TetrahedronMesh& start,
  const ImprovementOptions& options, const CoarseningInput* measured,
  const ParallelFor& parallelFor, KnownChanges* known)
  : Leaves(background)
  , Start(start)
  , Options(options)
  , HeldAt(options.CutEdges.size(), Holds::None)
  , Measured(measured)
  , ForAll(parallelFor)
  , Known(known)
{
  this->MostMoves.reserve(options.CutEdges.size());
  for (const CutSide& edge : options.CutEdges)
  {
    this->MostMoves.push_back(edge.MostMove);
  }
}

BestAttempt::Attempt BestAttempt::Find()
{
  Attempt best = this->Try();
  bool isToTry = best.FarLeaves.empty() && !best.IsHopeless() && this->HoldIntersecting(best);
  for (int releases = 0; isToTry;)
  {
    Attempt held = this->Try();
    if (!held.FarLeaves.empty())
    {
      return held;
    }
    isToTry = !held.IsHopeless() && this->HoldIntersecting(held);
    if (!isToTry && best.Bad < held.Bad && releases < MostReleases)
    {
      ++releases;
      isToTry = this->ReleaseAroundBad(held.Mesh);
    }
    if (held.IsBetterThan(best))
    {
      best = std::move(held);
    }
  }
  return best;
}

/** Improves the mesh. Detours are long: they wait until nothing needs a finer mesh. */
BestAttempt::Attempt BestAttempt::Try()
{
  Attempt attempt{ Improve(this->Start, this->Options, this->ForAll, this->Known), {} };
  attempt.Bad = this->CountBad(attempt.Mesh);
  if (attempt.Bad > 0)
  {
    if (this->Measured != nullptr)
    {
      attempt.FarLeaves = FarLeaves(attempt.Mesh, *this->Measured, this->ForAll);
    }
    if (attempt.FarLeaves.empty() && !attempt.IsHopeless())
    {
      attempt.Mesh = TakeDetours(std::move(attempt.Mesh), this->Options, this->ForAll);
      attempt.Bad = this->CountBad(attempt.Mesh);
    }
  }
  if (attempt.FarLeaves.empty()) // else there will be another mesh
  {
    attempt.Mesh = ReturnPoints(std::move(attempt.Mesh), WantedSine(this->Options));
  }
  return attempt;
}

/** The tetrahedra whose angles are not as wanted. */
std::size_t BestAttempt::CountBad(const TetrahedronMesh& mesh) const
{
  std::atomic<std::size_t> count = 0;
  const double wanted = WantedSine(this->Options);
  ForEachIndex(this->ForAll, mesh.Tetrahedra.size(), TetrahedraOfThread,
    [&](std::int64_t i)
    {
      if (SmallestSine(mesh, mesh.Tetrahedra[i]) < wanted)
      {
        ++count;
      }
    });
  return count;
}

/** Calls visit(point) for all points where surfaces cross edges at the corners of a leaf. */
template <typename Visit>
void BestAttempt::ForEachCrossingAround(std::uint32_t leaf, Visit&& visit) const
{
  for (const std::uint32_t vertex : this->Leaves.CornersOf(leaf))
  {
    for (const std::uint32_t point : this->Leaves.CrossingsAt(vertex))
    {
      visit(point);
    }
  }
}

/** Counts intersections, and holds surfaces there. @return whether that is new for some of them */
bool BestAttempt::HoldIntersecting(Attempt& attempt)
{
  const Surfaces surfaces = SurfacesOf(attempt.Mesh);
  const std::vector<IntersectingPair> pairs =
    IntersectionsOf(attempt.Mesh.Positions, surfaces.Triangles, this->ForAll);
  attempt.Intersections = pairs.size();
  bool isNew = false;
  const auto holdAround = [&](std::uint32_t triangle)
  {
    this->ForEachCrossingAround(surfaces.Origins[triangle],
      [&](std::uint32_t point)
      {
        if (this->HeldAt[point] == Holds::None)
        {
          this->HeldAt[point] = Holds::Held;
          isNew = std::exchange(this->Options.CutEdges[point].MostMove, 0.0) > 0.0 || isNew;
        }
      });
  };
  for (const auto& [a, b] : pairs)
  {
    holdAround(a);
    holdAround(b);
  }
  return isNew;
}

/** Releases what is held around tetrahedra whose angles are not as wanted. @return whether there is
 *  any */
bool BestAttempt::ReleaseAroundBad(const TetrahedronMesh& mesh)
{
  const double wanted = WantedSine(this->Options);
  bool isAny = false;
  for (std::size_t i = 0; i < mesh.Tetrahedra.size(); ++i)
  {
    if (SmallestSine(mesh, mesh.Tetrahedra[i]) < wanted)
    {
      this->ForEachCrossingAround(mesh.Origins[i],
        [&](std::uint32_t point)
        {
          isAny = isAny || this->HeldAt[point] == Holds::Held;
          this->HeldAt[point] = Holds::Released;
          this->Options.CutEdges[point].MostMove = this->MostMoves[point];
        });
    }
  }
  return isAny;
}

}
