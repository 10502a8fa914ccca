// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DistanceWalk_h
#define isodiamond_DistanceWalk_h

#include "DistanceError/Bisection.h"
#include "DistanceError/ErrorMaxima.h"
#include "DistanceError/FarthestSearch.h"
#include "DistanceError/IsovertexClusters.h"
#include "DistanceError/TetrahedronGeneration.h"
#include "Field/Peers.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace isodiamond
{

/** What a tetrahedron of the walk holds of a cluster of isovertices. */
struct ClusterPart
{
  std::uint32_t Index = 0;
  bool Straddles = false; ///< some of the cluster may lie outside
};

/**
 * Raises the distance errors of the diamonds of scale 1 and above.
 *
 * The isovertices of full resolution are handed down the tree of bisected tetrahedra. Every
 * tetrahedron that holds some raises the error of the diamond that it lies in. Where diamonds are
 * large, whole clusters are handed down: most are so near to the patches that none of their
 * isovertices can be the farthest.
 */
template <typename Lengths>
class DistanceWalk
{
public:
  DistanceWalk(const IsovertexClusters& clusters, const Lengths& lengths, ErrorMaxima& errors)
    : Clusters(clusters)
    , InWorld(lengths)
    , Errors(errors)
    , Neighbourhood(errors.Hierarchy())
  {
  }

  void Run(const Loops& loops)
  {
    std::vector<Task> tasks = this->RootTasks(loops.Whole);
    // Generation by generation until there is work for many threads, then each subtree by itself.
    constexpr std::size_t enough = 1024;
    while (!tasks.empty() && tasks.size() < enough && IsCoarse(tasks[0].Holders[0]))
    {
      std::vector<std::vector<Task>> halves(tasks.size());
      ForEachIndex(
        loops.Whole, tasks.size(), 1, [&](std::int64_t i) { halves[i] = this->Bisect(tasks[i]); });
      tasks.clear();
      for (std::vector<Task>& some : halves)
      {
        std::move(some.begin(), some.end(), std::back_inserter(tasks));
      }
    }
    ForEachIndex(
      loops.Share, tasks.size(), 1, [&](std::int64_t i) { this->Descend(std::move(tasks[i])); });
  }

private:
  /** One tetrahedron, with all below it. */
  using Task = Generation<ClusterPart>;
  using Search = FarthestSearch<Lengths>;

  Search MakeSearch() const
  {
    return { this->Errors.Hierarchy(), this->InWorld, this->Clusters.Surface() };
  }

  /** Whether a cluster is small compared with the diamond. */
  static bool IsCoarse(const Holder& holder) { return holder.Diamond.Scale >= 4; }

  /** The six tetrahedra of the base cube. */
  std::vector<Task> RootTasks(const ParallelFor& parallelFor) const
  {
    std::vector<HalfPlace> tetrahedra;
    const Place root{ this->Errors.Hierarchy().SampleGrid().Depth() - 1, { 1, 1, 1 } };
    this->Neighbourhood.ForEachTetrahedron(root, false,
      [&](int /*number*/, const HalfPlace& tetrahedron) { tetrahedra.push_back(tetrahedron); });
    std::vector<Task> tasks(tetrahedra.size());
    ForEachIndex(parallelFor, tasks.size(), 1,
      [&](std::int64_t i) { this->FindClusters(tetrahedra[i], tasks[i]); });
    tasks.erase(std::remove_if(tasks.begin(), tasks.end(),
                  [](const Task& task) { return task.Holders.empty(); }),
      tasks.end());
    return tasks;
  }

  /** Makes a task of a tetrahedron and all clusters that may reach into it. */
  void FindClusters(const HalfPlace& tetrahedron, Task& task) const
  {
    const ClosedTetrahedron closed(tetrahedron);
    for (std::uint32_t i = 0; i < this->Clusters.All().size(); ++i)
    {
      const FineBox& box = this->Clusters.All()[i].Box;
      if (closed.MayHold(box))
      {
        task.Add({ i, !closed.HoldsAll(box) });
      }
    }
    this->Hold(tetrahedron, 0, task);
  }

  /** Makes a tetrahedron the holder of the items from a first one on; of none, or at scale 0, there
   *  is no holder. */
  template <typename Item>
  void Hold(const HalfPlace& tetrahedron, std::size_t begin, Generation<Item>& generation) const
  {
    // A diamond in the grid that holds an isovertex is a member: it leads to the surface.
    const Place diamond = tetrahedron.Child();
    const bool isWanted = generation.Count > begin && diamond.Scale > 0;
    const std::int64_t rank =
      isWanted ? this->Errors.Hierarchy().Diamonds().Rank(diamond) : DiamondSet::None;
    if (rank == DiamondSet::None)
    {
      generation.Count = begin;
      return;
    }
    generation.Holders.push_back(
      { tetrahedron, diamond, static_cast<std::uint32_t>(rank), begin, generation.Count });
  }

  /** Appends a tetrahedron's halves, and what lies in them, to the next generation. */
  void Split(const Holder& holder, const std::vector<ClusterPart>& items,
    Generation<ClusterPart>& halves) const
  {
    ForEachHalf(this->Errors.Hierarchy().SampleGrid(), holder.Tetrahedron, holder.Diamond,
      holder.Rank,
      [&](const HalfPlace& half, const ExactPlane& plane)
      {
        const std::size_t begin = halves.Count;
        for (std::size_t i = holder.Begin; i < holder.End; ++i)
        {
          ClusterPart part = items[i];
          if (this->IsInHalf(plane, part))
          {
            halves.Add(part);
          }
        }
        this->Hold(half, begin, halves);
      });
  }

  /** The same for isovertices, looking once at each. */
  void Split(const Holder& holder, const std::vector<FinePosition>& items,
    Generation<FinePosition>& halves) const
  {
    std::array<HalfPlace, 2> places;
    ExactPlane plane; // whose positive side is the last half's
    int count = 0;
    ForEachHalf(this->Errors.Hierarchy().SampleGrid(), holder.Tetrahedron, holder.Diamond,
      holder.Rank,
      [&](const HalfPlace& half, const ExactPlane& turned)
      {
        places[count++] = half;
        plane = turned;
      });
    if (count == 0)
    {
      return;
    }
    const std::size_t all = holder.End - holder.Begin;
    const std::size_t begin = halves.Count;
    FinePosition* const last = halves.Room(2 * all);
    FinePosition* const first = last + all;
    FinePosition* nextLast = last;
    FinePosition* nextFirst = first;
    for (std::size_t i = holder.Begin; i < holder.End; ++i)
    {
      const FinePosition position = items[i];
      const std::int32_t side = plane.Side(position);
      *nextLast = position;
      *nextFirst = position;
      nextLast += side >= 0 ? 1 : 0;
      nextFirst += side <= 0 ? 1 : 0;
    }
    halves.Count += nextLast - last;
    this->Hold(places[count - 1], begin, halves);
    if (count == 2)
    {
      const std::size_t middle = halves.Count;
      std::copy(first, nextFirst, halves.Items.data() + middle);
      halves.Count += nextFirst - first;
      this->Hold(places[0], middle, halves);
    }
  }

  bool IsInHalf(const ExactPlane& plane, ClusterPart& part) const
  {
    const auto [least, greatest] = plane.Sides(this->Clusters.All()[part.Index].Box);
    part.Straddles = part.Straddles || least < 0;
    return greatest >= 0;
  }

  /** Measures a tetrahedron. @return the tasks left to its halves */
  std::vector<Task> Bisect(Task& task)
  {
    Search search = this->MakeSearch();
    this->Measure(search, task);
    Task both;
    this->Split(task.Holders[0], task.Items, both);
    std::vector<Task> halves(both.Holders.size());
    for (std::size_t i = 0; i < halves.size(); ++i)
    {
      const Holder& half = both.Holders[i];
      halves[i].Items.assign(both.Items.data() + half.Begin, both.Items.data() + half.End);
      halves[i].Count = halves[i].Items.size();
      this->Hold(half.Tetrahedron, 0, halves[i]);
    }
    return halves;
  }

  /** Measures a tetrahedron and all below it. */
  void Descend(Task task)
  {
    Search search = this->MakeSearch();
    Generation<ClusterPart> next;
    while (!task.Holders.empty() && IsCoarse(task.Holders[0]))
    {
      this->Measure(search, task);
      this->Split(task, next);
    }
    Generation<FinePosition> positions = this->Expand(task);
    Generation<FinePosition> nextPositions;
    while (!positions.Holders.empty())
    {
      this->Measure(search, positions);
      this->Split(positions, nextPositions);
    }
  }

  /** Replaces a generation by the next. */
  template <typename Item>
  void Split(Generation<Item>& generation, Generation<Item>& next) const
  {
    next.Clear();
    for (const Holder& holder : generation.Holders)
    {
      this->Split(holder, generation.Items, next);
    }
    std::swap(generation, next);
  }

  /** Those isovertices of the clusters that lie in the tetrahedra. */
  Generation<FinePosition> Expand(const Generation<ClusterPart>& generation) const
  {
    Generation<FinePosition> expanded;
    for (const Holder& holder : generation.Holders)
    {
      const std::size_t begin = expanded.Count;
      const ClosedTetrahedron closed(holder.Tetrahedron);
      for (std::size_t i = holder.Begin; i < holder.End; ++i)
      {
        this->ForEachIn(generation.Items[i], closed,
          [&](const FinePosition& position) { expanded.Add(position); });
      }
      this->Hold(holder.Tetrahedron, begin, expanded);
    }
    return expanded;
  }

  /** Calls body(position) for those isovertices of a cluster that lie in a tetrahedron. */
  template <typename Body>
  void ForEachIn(const ClusterPart& part, const ClosedTetrahedron& closed, Body&& body) const
  {
    this->Clusters.ForEach(this->Clusters.All()[part.Index],
      [&](const FinePosition& position)
      {
        if (!part.Straddles || closed.Holds(position))
        {
          body(position);
        }
      });
  }

  /** Measures all diamonds of a generation, taking the tetrahedra of each together. */
  template <typename Item>
  void Measure(Search& search, Generation<Item>& generation)
  {
    generation.SortByDiamond();
    const std::vector<std::uint64_t>& order = generation.Order;
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end)
    {
      const std::uint64_t rank = order[begin] >> 32;
      while (end < order.size() && order[end] >> 32 == rank)
      {
        ++end;
      }
      this->Measure(search, generation, begin, end);
    }
  }

  /** Raises the error of a diamond as the items of some of its tetrahedra require; these are a
   *  range of the order. */
  template <typename Item>
  void Measure(
    Search& search, const Generation<Item>& generation, std::size_t begin, std::size_t end)
  {
    const Place diamond = generation.At(begin).Diamond;
    const std::uint32_t rank = generation.At(begin).Rank;
    if (this->Errors.IsAlways(rank))
    {
      return;
    }
    if (this->Clusters.AlwaysSubdivide() || this->Errors.HasNoInterpolant(diamond))
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        if (this->HasIsovertex(generation.At(i), generation.Items))
        {
          this->Errors.RaiseToAlways(rank);
          return;
        }
      }
      return;
    }
    search.Reset(diamond);
    this->Errors.RaiseToFarthest(diamond, rank,
      [&](Farthest& farthest)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          this->FindFarthest(search, generation.At(i), generation.Items, farthest);
        }
        search.Decide(farthest);
      });
  }

  bool HasIsovertex(const Holder& /*holder*/, const std::vector<FinePosition>& /*items*/) const
  {
    return true;
  }
  bool HasIsovertex(const Holder& holder, const std::vector<ClusterPart>& items) const
  {
    const ClosedTetrahedron closed(holder.Tetrahedron);
    bool has = false;
    for (std::size_t i = holder.Begin; i < holder.End && !has; ++i)
    {
      this->ForEachIn(items[i], closed, [&](const FinePosition&) { has = true; });
    }
    return has;
  }

  void FindFarthest(Search& search, const Holder& holder,
    const std::vector<FinePosition>& positions, Farthest& farthest) const
  {
    const int tetrahedron = search.Find(holder.Tetrahedron);
    const FinePosition* const first = positions.data() + holder.Begin;
    const std::size_t count = holder.End - holder.Begin;
    const double squared = search.Propose(tetrahedron, first, count, farthest);
    if (this->Errors.AreBoundsWanted())
    {
      const double onBorder = squared < std::numeric_limits<double>::infinity()
        ? search.SquaredToBorder(tetrahedron, holder.Tetrahedron, first, count)
        : squared;
      this->Errors.SetBound(
        this->Clusters.Surface(), holder.Rank, tetrahedron, std::max(squared, onBorder));
    }
  }

  void FindFarthest(Search& search, const Holder& holder, const std::vector<ClusterPart>& parts,
    Farthest& farthest) const
  {
    const ClosedTetrahedron closed(holder.Tetrahedron);
    const int tetrahedron = search.Find(holder.Tetrahedron);
    for (std::size_t i = holder.Begin; i < holder.End; ++i)
    {
      const FineBox& box = this->Clusters.All()[parts[i].Index].Box;
      if (!farthest.IsAny || !search.IsWithin(tetrahedron, box, farthest.Squared))
      {
        this->ForEachIn(parts[i], closed,
          [&](const FinePosition& position)
          { search.Propose(tetrahedron, &position, 1, farthest); });
        search.Decide(farthest);
      }
    }
  }

  const IsovertexClusters& Clusters;
  const Lengths& InWorld;
  ErrorMaxima& Errors;
  SpineNeighbourhood Neighbourhood;
};

}

#endif
