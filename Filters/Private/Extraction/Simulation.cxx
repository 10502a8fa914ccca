// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Extraction/Simulation.h"

#include "Private/Common/UsedPoints.h"
#include "Private/Extraction/Stuff.h"
#include "Private/Query/HierarchyQuery.h"
#include "Private/Query/PlacedTolerance.h"
#include "Stuffing/KnownChanges.h"
#include "Stuffing/TetrahedronMesh.h"

#include "vtkCellArray.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vtkIsodiamond
{
namespace
{

///@{
/** The number of the mesh from which on nothing is refined, or pinned, any more: two or three
 * meshes are usual, more in noise. Refinement before tetrahedra are improved does not count. Where
 * angles are bad in the end, a few more meshes follow, with fewer pins. */
constexpr int LastRefinement = 10;
constexpr int LastPinning = 20;
///@}

/** How often one pin of each vertex around bad angles goes before all do. */
constexpr int LocalReleases = 2;

///@{
/** Of progress: of the mesh that is not for simulations, and of each round, of what is left. */
constexpr double PlainPart = 0.05;
constexpr double PartOfRound = 0.25;
///@}

/** The volume of what a query gives if it is not for simulations. */
double PlainVolume(const isodiamond::IsodiamondHierarchy& hierarchy, const isodiamond::Query& query,
  const MeshOptions& options, Task& task)
{
  MeshOptions plain = options;
  plain.PointsPrecision = vtkAlgorithm::DEFAULT_PRECISION;
  plain.MorePointData = nullptr;
  plain.Wanted = {};
  const Mesh mesh = ExtractMesh(isodiamond::RefinedSet(hierarchy, query, task.For()), plain, task);
  isodiamond::TetrahedronMesh tetrahedra;
  tetrahedra.Positions = PositionsOf(mesh.Points);
  for (vtkIdType cell = 0; cell < mesh.Cells->GetNumberOfCells(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    mesh.Cells->GetCellAtId(cell, size, ids);
    isodiamond::Corners& corners = tetrahedra.Tetrahedra.emplace_back();
    std::copy_n(ids, corners.size(), corners.begin());
  }
  return VolumeOf(tetrahedra);
}

/** Takes pins away.
 *  @param all or only one of each vertex that is near a bad tetrahedron
 *  @param near such vertices, sorted; without any nothing has to go @param pinned sorted
 *  @return whether there were any */
bool Release(bool all, const std::vector<std::uint64_t>& near, std::vector<std::uint64_t>& pinned)
{
  if (near.empty())
  {
    return false;
  }
  std::vector<std::uint64_t> left;
  if (!all)
  {
    std::set_difference(
      pinned.begin(), pinned.end(), near.begin(), near.end(), std::back_inserter(left));
  }
  const bool isAny = left.size() < pinned.size();
  pinned = std::move(left);
  return isAny;
}

/** Where tetrahedra have no volume or are nowhere, improving them would take long, for nothing.
 *  @throws std::invalid_argument */
void CheckVolumes(const isodiamond::GridGeometry& world)
{
  const isodiamond::AffineMap* map = world.Affine();
  const bool isFine = map == nullptr ||
    (std::isnormal(map->Determinant()) &&
      std::isfinite(map->At(0, 0, 0, 0) + map->At(1, 0, 0, 0) + map->At(2, 0, 0, 0)));
  if (!isFine)
  {
    throw std::invalid_argument(
      "SimulationQuality needs a finite origin, and a finite spacing other than 0.");
  }
}

}

Mesh ExtractForSimulation(const isodiamond::RefinedSet& refined, const WorldQuery& query,
  const MeshOptions& options, Task& task)
{
  CheckVolumes(options.World);
  const isodiamond::IsodiamondHierarchy& hierarchy = refined.Hierarchy();
  const Measure measure(hierarchy);
  MeshOptions asked = options;
  asked.ForSimulation = true;
  if (!GetsCoarser(query, measure.Metric))
  {
    if (query.IsFull())
    {
      asked.ToleranceIn = [](const isodiamond::Vector*, int) { return 0.0; };
      asked.GetsCoarser = false;
    }
    return ExtractMesh(refined, asked, task);
  }
  const PlacedTolerance tolerance(query, measure, options.World);
  asked.DistanceTolerance = query.Region
    ? std::min(query.ErrorTolerance, OutsideOf(query, measure, options.World))
    : query.ErrorTolerance;
  asked.ToleranceIn = [&](const isodiamond::Vector* corners, int count)
  { return tolerance.In(corners, count); };
  asked.KeepsInside = std::isfinite(query.InteriorTolerance);
  isodiamond::Query core =
    CoreQuery(HierarchyQuery(query, measure, options.World), hierarchy, options.World);
  Task plain = task.Part(0.0, PlainPart);
  asked.VolumeAtTolerance =
    PlainVolume(hierarchy, CoreQuery(query, hierarchy, options.World), options, plain);
  const isodiamond::RefinedSet* leaves = &refined;
  std::optional<isodiamond::RefinedSet> finer;
  const auto refine = [&](const std::vector<isodiamond::Place>& diamonds, Task& part)
  {
    core.Also.insert(core.Also.end(), diamonds.begin(), diamonds.end());
    leaves = &finer.emplace(hierarchy, core, part.For());
  };
  FarDiamondSearch search;
  isodiamond::KnownChanges known;
  asked.Known = &known;
  int releases = 0;
  double done = PlainPart;
  for (int round = 1;; ++round)
  {
    const double begin = std::exchange(done, done + PartOfRound * (1.0 - done));
    Task part = task.Part(begin, done);
    for (std::vector<isodiamond::Place> far;
         far = search.Find(*leaves, asked, part.For()), !far.empty();)
    {
      refine(far, part);
    }
    asked.MayRefine = round < LastRefinement;
    asked.MayPin = releases == 0 && round < LastPinning;
    Mesh mesh = ExtractMesh(*leaves, asked, part);
    if (!mesh.FarDiamonds.empty())
    {
      refine(mesh.FarDiamonds, part);
    }
    else if (mesh.TightVertices.empty())
    {
      // Angles come first: where some are bad, pins there go one by one; if that does not help,
      // all.
      if (!Release(releases == LocalReleases, mesh.BadVertices, asked.Pinned))
      {
        return mesh;
      }
      ++releases;
    }
    asked.Pinned.insert(asked.Pinned.end(), mesh.TightVertices.begin(), mesh.TightVertices.end());
    std::sort(asked.Pinned.begin(), asked.Pinned.end());
  }
}

}
