// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Extraction/Simulation.h"

#include "Private/Common/UsedPoints.h"
#include "Private/Extraction/StuffedVolume.h"
#include "Private/Query/HierarchyQuery.h"
#include "Private/Query/PlacedTolerance.h"
#include "Stuffing/KnownChanges.h"
#include "Stuffing/TetrahedronMesh.h"

#include "vtkCellArray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
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

constexpr const char* Improving = "Improving tetrahedra";

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

/** @param some,from sorted */
void Remove(const std::vector<std::uint64_t>& some, std::vector<std::uint64_t>& from)
{
  from.erase(
    std::remove_if(from.begin(), from.end(),
      [&](std::uint64_t each) { return std::binary_search(some.begin(), some.end(), each); }),
    from.end());
}

/** Takes pins away, if there are bad tetrahedra.
 *  @param all or only those of vertices that are near these
 *  @return whether there were any */
bool Release(bool all, const StuffedVolume& volume, std::vector<std::uint64_t>& pinned)
{
  if (pinned.empty())
  {
    return false;
  }
  const std::vector<std::uint64_t> near = volume.VerticesNearBad();
  const std::size_t before = pinned.size();
  if (all && !near.empty())
  {
    pinned.clear();
  }
  Remove(near, pinned);
  return pinned.size() < before;
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

/** Where nothing gets coarser: one mesh, which is measured if that is of use. */
Mesh ExtractOnce(const isodiamond::RefinedSet& refined, const WorldQuery& query,
  const MeshOptions& options, Task& task)
{
  SimulationOptions asked;
  asked.GetsCoarser = false;
  if (query.IsFull())
  {
    asked.ToleranceIn = [](const isodiamond::Vector*, int) { return 0.0; };
  }
  task.Begin(Improving, 0.0, 1.0);
  return StuffedVolume(refined, options, asked, task.For(), nullptr).Write(options, task.For());
}

/** What a query tolerates, as asked of tetrahedra. @param tolerance must outlive the result */
SimulationOptions AskedBy(const WorldQuery& query, const Measure& measure,
  const isodiamond::GridGeometry& world, const PlacedTolerance& tolerance)
{
  SimulationOptions asked;
  asked.DistanceTolerance = query.Region
    ? std::min(query.ErrorTolerance, OutsideOf(query, measure, world))
    : query.ErrorTolerance;
  asked.ToleranceIn = [&tolerance](const isodiamond::Vector* corners, int count)
  { return tolerance.In(corners, count); };
  asked.KeepsInside = std::isfinite(query.InteriorTolerance);
  return asked;
}

/** Stuffs a refined set, again and again: refined, or with vertices pinned, wherever surfaces are
 * too far away. */
class StuffingRounds
{
public:
  /** @param measure of the hierarchy that is refined */
  StuffingRounds(const isodiamond::RefinedSet& refined, const WorldQuery& query,
    const Measure& measure, const MeshOptions& options, Task& task)
    : Hierarchy(refined.Hierarchy())
    , Options(options)
    , Tolerance(query, measure, options.World)
    , Asked(AskedBy(query, measure, options.World, this->Tolerance))
    , Query(
        CoreQuery(HierarchyQuery(query, measure, options.World), this->Hierarchy, options.World))
    , Leaves(&refined)
    , Parts(task, PlainPart, PartOfRound)
  {
    Task plain = task.Part(0.0, PlainPart);
    this->Asked.VolumeAtTolerance = PlainVolume(
      this->Hierarchy, CoreQuery(query, this->Hierarchy, options.World), options, plain);
  }

  Mesh Run()
  {
    for (int round = 1;; ++round)
    {
      Task part = this->Parts.Next();
      this->RefineBefore(part);
      this->Asked.MayRefine = round < LastRefinement;
      this->Asked.MayPin = this->IsPinning && this->Releases == 0 && round < LastPinning;
      std::vector<isodiamond::Place> far;
      if (std::optional<Mesh> mesh = this->Stuff(part, far))
      {
        return *std::move(mesh);
      }
      if (!far.empty())
      {
        this->Refine(far, part);
      }
    }
  }

private:
  /** Before tetrahedra are improved, which takes longer. */
  void RefineBefore(Task& part)
  {
    while (this->Asked.MayRefine && !this->IsSearched)
    {
      const std::vector<isodiamond::Place> far =
        this->Search.Find(*this->Leaves, this->Options, this->Asked, part.For());
      this->IsSearched = far.empty();
      if (!this->IsSearched)
      {
        this->Refine(far, part);
      }
    }
  }

  void Refine(const std::vector<isodiamond::Place>& diamonds, Task& part)
  {
    this->Query.Also.insert(this->Query.Also.end(), diamonds.begin(), diamonds.end());
    this->Leaves = &this->Finer.emplace(this->Hierarchy, this->Query, part.For());
    this->IsSearched = false;
  }

  /** @param far receives the diamonds to be refined before the next round
   *  @return the mesh; none if another round has to follow */
  std::optional<Mesh> Stuff(Task& part, std::vector<isodiamond::Place>& far)
  {
    part.Begin(Improving, 0.0, 1.0);
    const StuffedVolume volume(*this->Leaves, this->Options, this->Asked, part.For(), &this->Known);
    far = volume.FarDiamonds();
    std::vector<std::uint64_t> tight = volume.TightVertices();
    if (volume.IsHopeless() && !tight.empty())
    {
      // Pins near bad tetrahedra would have to go again; where most are, so would later ones.
      const std::size_t before = tight.size();
      Remove(volume.VerticesNearBad(), tight);
      this->IsPinning = 2 * tight.size() > before;
    }
    else if (far.empty() && tight.empty())
    {
      // Angles come first: where some are bad, pins there go; if that does not help, all.
      if (!Release(this->Releases == LocalReleases, volume, this->Asked.Pinned))
      {
        return volume.Write(this->Options, part.For());
      }
      ++this->Releases;
    }
    std::vector<std::uint64_t>& pinned = this->Asked.Pinned;
    pinned.insert(pinned.end(), tight.begin(), tight.end());
    std::sort(pinned.begin(), pinned.end());
    return std::nullopt;
  }

  const isodiamond::IsodiamondHierarchy& Hierarchy;
  const MeshOptions& Options;
  PlacedTolerance Tolerance;
  SimulationOptions Asked;
  isodiamond::Query Query;
  const isodiamond::RefinedSet* Leaves; ///< the given ones, or Finer
  std::optional<isodiamond::RefinedSet> Finer;
  bool IsSearched = false; ///< whether Search finds no more in the leaves that there are now
  FarDiamondSearch Search;
  isodiamond::KnownChanges Known;
  bool IsPinning = true; ///< not where pins would have to go again
  int Releases = 0;      ///< of pins
  Rounds Parts;          ///< of the task
};

}

Mesh ExtractForSimulation(const isodiamond::RefinedSet& refined, const WorldQuery& query,
  const MeshOptions& options, Task& task)
{
  CheckVolumes(options.World);
  const Measure measure(refined.Hierarchy());
  Mesh mesh = GetsCoarser(query, measure.Metric)
    ? StuffingRounds(refined, query, measure, options, task).Run()
    : ExtractOnce(refined, query, options, task);
  KeepShare(options.Wanted, mesh);
  return mesh;
}

}
