// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/BestAttempt.h"

#include "Simplification/SelfIntersections.h"
#include "Stuffing/Detours.h"
#include "Stuffing/MeasuredSurfaces.h"

#include <atomic>
#include <utility>

namespace isodiamond
{
namespace
{

/** This many tetrahedra are worth a thread. */
constexpr std::int64_t TetrahedraOfThread = 2048;

}

BestAttempt::BestAttempt(const Background& background, const TetrahedronMesh& start,
  const ImprovementOptions& options, const CoarseningInput* measured,
  const ParallelFor& parallelFor, KnownChanges* known)
  : Leaves(background)
  , Start(start)
  , Options(options)
  , Measured(measured)
  , ForAll(parallelFor)
  , Known(known)
{
}

BestAttempt::Attempt BestAttempt::Find()
{
  Attempt free = this->Try();
  if (!free.FarLeaves.empty() || !this->HoldIntersecting(free.Mesh))
  {
    return free;
  }
  Attempt held;
  do
  {
    held = this->Try();
  } while (held.FarLeaves.empty() && this->HoldIntersecting(held.Mesh));
  const bool isWorse =
    held.FarLeaves.empty() && this->CountBad(held.Mesh) > this->CountBad(free.Mesh);
  return isWorse ? std::move(free) : std::move(held);
}

/** Improves the mesh. Detours are long: they wait until nothing needs a finer mesh. */
BestAttempt::Attempt BestAttempt::Try()
{
  Attempt attempt{ Improve(this->Start, this->Options, this->ForAll, this->Known), {} };
  if (this->CountBad(attempt.Mesh) > 0)
  {
    if (this->Measured != nullptr)
    {
      attempt.FarLeaves = FarLeaves(attempt.Mesh, *this->Measured, this->ForAll);
    }
    if (attempt.FarLeaves.empty())
    {
      attempt.Mesh = TakeDetours(std::move(attempt.Mesh), this->Options, this->ForAll);
    }
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

/** Holds surfaces where they intersect. @return whether that is new for some of them */
bool BestAttempt::HoldIntersecting(const TetrahedronMesh& mesh)
{
  const Surfaces surfaces = SurfacesOf(mesh);
  bool isNew = false;
  const auto holdAround = [&](std::uint32_t triangle)
  {
    for (const std::uint32_t vertex : this->Leaves.CornersOf(surfaces.Origins[triangle]))
    {
      for (const std::uint32_t point : this->Leaves.CrossingsAt(vertex))
      {
        isNew = std::exchange(this->Options.CutEdges[point].MostMove, 0.0) > 0.0 || isNew;
      }
    }
  };
  for (const auto& [a, b] : IntersectionsOf(mesh.Positions, surfaces.Triangles, this->ForAll))
  {
    holdAround(a);
    holdAround(b);
  }
  return isNew;
}

}
