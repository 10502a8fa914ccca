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

/** How often pins of the vertices around bad angles go before all do. */
constexpr int LocalReleases = 4;

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
 *  @param all or only those of vertices that are near a bad tetrahedron
 *  @param near such vertices, sorted; without any nothing has to go
 *  @return whether there were any */
bool Release(bool all, const std::vector<std::uint64_t>& near, std::vector<std::uint64_t>& pinned)
{
  if (near.empty())
  {
    return false;
  }
  const auto left = std::remove_if(pinned.begin(), pinned.end(),
    [&](std::uint64_t vertex)
    { return all || std::binary_search(near.begin(), near.end(), vertex); });
  const bool isAny = left != pinned.end();
  pinned.erase(left, pinned.end());
  return isAny;
}

/** Whether all cells have a volume, as far as one can tell without looking at each. Steps may be as
 *  short or long as numbers are; those that are measured (WorldLengths.h) may not. */
bool HasVolumes(const isodiamond::GridGeometry& world)
{
  if (const isodiamond::AffineMap* map = world.Affine())
  {
    return std::isnormal(map->Determinant()) &&
      std::isfinite(map->At(0, 0, 0, 0) + map->At(1, 0, 0, 0) + map->At(2, 0, 0, 0));
  }
  if (const isodiamond::AxisCoordinates* axes = world.Axes())
  {
    return std::all_of(axes->begin(), axes->end(),
      [](const std::vector<double>& places)
      {
        const double way = places.back() - places.front();
        return std::isfinite(way) &&
          std::adjacent_find(places.begin(), places.end(),
            [&](double from, double to) { return !((to - from) * way > 0.0); }) == places.end();
      });
  }
  return world.SmallestStep() > 0.0;
}

/** Where tetrahedra have no volume or are nowhere, improving them would take long, for nothing.
 *  @throws std::invalid_argument */
void CheckVolumes(const isodiamond::GridGeometry& world)
{
  if (!HasVolumes(world))
  {
    throw std::invalid_argument("SimulationQuality needs cells with volumes: a spacing other than "
                                "0, coordinates that rise or fall, positions that are finite.");
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
  bool isSearched = false; // in the leaves that there are now
  const auto refine = [&](const std::vector<isodiamond::Place>& diamonds, Task& part)
  {
    core.Also.insert(core.Also.end(), diamonds.begin(), diamonds.end());
    leaves = &finer.emplace(hierarchy, core, part.For());
    isSearched = false;
  };
  FarDiamondSearch search;
  isodiamond::KnownChanges known;
  asked.Known = &known;
  int releases = 0;
  Rounds rounds(task, PlainPart, PartOfRound);
  for (int round = 1;; ++round)
  {
    Task part = rounds.Next();
    while (asked.MayRefine && !isSearched)
    {
      const std::vector<isodiamond::Place> far = search.Find(*leaves, asked, part.For());
      isSearched = far.empty();
      if (!isSearched)
      {
        refine(far, part);
      }
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
      // Angles come first: where some are bad, pins there go; if that does not help, all.
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
