// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError.h"

#include "Bisection.h"
#include "DiamondPatches.h"
#include "FinestDomain.h"
#include "IsovertexClusters.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

namespace isodiamond
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

using Ends = IsovertexClusters::Ends;

/** What a tetrahedron has of a cluster of isovertices. */
struct ClusterPart
{
  std::uint32_t Index = 0;
  bool Straddles = false; ///< some of the cluster may lie outside
};

/** A tetrahedron with its items, isovertices or parts of clusters, and the diamond that it lies
 *  in. */
struct Holder
{
  HalfPlace Tetrahedron;
  Place Diamond;
  std::uint32_t Rank = 0; ///< of the diamond
  std::size_t Begin = 0;  ///< its items in the level's
  std::size_t End = 0;
};

/** Tetrahedra of one generation. */
template <typename Item>
struct Generation
{
  std::vector<Holder> Holders;
  std::vector<Item> Items; ///< the first Count; memory that was used once is kept
  std::size_t Count = 0;

  /** Where some more items fit. */
  Item* Room(std::size_t more)
  {
    if (this->Count + more > this->Items.size())
    {
      this->Items.resize(std::max(this->Count + more, 2 * this->Items.size()));
    }
    return this->Items.data() + this->Count;
  }
  void Add(const Item& item)
  {
    *this->Room(1) = item;
    ++this->Count;
  }
  void Clear()
  {
    this->Holders.clear();
    this->Count = 0;
  }
};

/**
 * Hands the full-resolution isovertices of a surface down the tree of bisected tetrahedra. Every
 * tetrahedron that holds some raises the error of the diamond that it lies in.
 *
 * Where diamonds are large, whole clusters are handed down: most are so near to the patches that
 * none of their isovertices can be the farthest.
 */
class DistanceWalk
{
public:
  DistanceWalk(const IsodiamondHierarchy& hierarchy, const AnySamples& samples,
    const AffineMap& world, bool preserveFeatures)
    : Hierarchy(hierarchy)
    , IsFinite(samples)
    , Neighbourhood(hierarchy)
    , Metric(world)
    , Code(DistanceErrorScale(hierarchy.Domain(), world))
    , PreserveFeatures(preserveFeatures)
    , Codes(hierarchy.Diamonds().Size())
  {
  }

  /** Measures the isovertices with finite ends against the surface; the others always subdivide
   *  whatever holds them. */
  void Run(int surface, Ends ends, const ParallelFor& parallelFor)
  {
    this->Surface = surface;
    this->RaisesAll = ends == Ends::NotFinite;
    const IsovertexClusters clusters(this->Hierarchy, this->IsFinite, surface, ends);
    this->Clusters = &clusters;
    std::vector<Task> tasks = this->RootTasks();
    // Generation by generation until there is work for many threads, then each subtree by itself.
    constexpr std::size_t enough = 128;
    while (!tasks.empty() && tasks.size() < enough && IsCoarse(tasks[0].Holders[0]))
    {
      std::vector<std::vector<Task>> halves(tasks.size());
      parallelFor(static_cast<std::int64_t>(tasks.size()), 1,
        [&](std::int64_t begin, std::int64_t end)
        {
          for (std::int64_t i = begin; i < end; ++i)
          {
            halves[i] = this->Bisect(tasks[i]);
          }
        });
      tasks.clear();
      for (std::vector<Task>& some : halves)
      {
        std::move(some.begin(), some.end(), std::back_inserter(tasks));
      }
    }
    parallelFor(static_cast<std::int64_t>(tasks.size()), 1,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          this->Descend(std::move(tasks[i]));
        }
      });
    const std::vector<Brick>& bricks = this->Hierarchy.Diamonds().Level(0).Bricks;
    parallelFor(static_cast<std::int64_t>(bricks.size()), 16,
      [&](std::int64_t begin, std::int64_t end)
      {
        Tools tools(*this);
        for (std::int64_t i = begin; i < end && !clusters.All().empty(); ++i)
        {
          this->MeasureFinest(tools, bricks[i]);
        }
      });
  }

  std::vector<ErrorCode::Type> Result() const { return { this->Codes.begin(), this->Codes.end() }; }

private:
  /** One tetrahedron, with all below. */
  using Task = Generation<ClusterPart>;

  /** An isovertex whose patch is not near enough. */
  struct Candidate
  {
    double Squared = 0.0; ///< distance to the tetrahedron's own patch
    int Tetrahedron = 0;
    Vector Point{};
  };

  /** An isovertex in the domain of a diamond of scale 0. */
  struct Located
  {
    std::uint16_t Tetrahedra = 0; ///< that hold it, a mask
    FinePosition Position{};
  };

  /** What measuring one diamond after the other needs. */
  struct Tools
  {
    explicit Tools(const DistanceWalk& walk)
      : Patches(walk.Hierarchy, walk.Metric, walk.Surface)
    {
    }
    DiamondPatches Patches;
    std::vector<Candidate> Candidates;
    std::vector<DistanceWalk::Located> Located;
  };

  /** Whether a cluster is small beside the diamond. */
  static bool IsCoarse(const Holder& holder) { return holder.Diamond.Scale >= 4; }

  /** The six tetrahedra of the base cube. */
  std::vector<Task> RootTasks() const
  {
    std::vector<Task> tasks;
    const Place root{ this->Hierarchy.Domain().Depth() - 1, { 1, 1, 1 } };
    this->Neighbourhood.ForEachTetrahedron(root, false,
      [&](int /*number*/, const HalfPlace& tetrahedron)
      {
        const ClosedTetrahedron closed(tetrahedron);
        Task task;
        for (std::uint32_t i = 0; i < this->Clusters->All().size(); ++i)
        {
          const FineBox& box = this->Clusters->All()[i].Box;
          if (closed.MayHold(box))
          {
            task.Add({ i, !closed.HoldsAll(box) });
          }
        }
        this->Hold(tetrahedron, 0, task);
        if (!task.Holders.empty())
        {
          tasks.push_back(std::move(task));
        }
      });
    return tasks;
  }

  /** Makes the items from a first one on those of a tetrahedron. Without any there is none, nor
   *  at scale 0. */
  template <typename Item>
  void Hold(const HalfPlace& tetrahedron, std::size_t begin, Generation<Item>& generation) const
  {
    // A diamond in the grid that holds an isovertex is a member: it leads to the surface.
    const Place diamond = tetrahedron.Child();
    const bool isWanted = generation.Count > begin && diamond.Scale > 0;
    const std::int64_t rank =
      isWanted ? this->Hierarchy.Diamonds().Rank(diamond) : DiamondSet::None;
    if (rank == DiamondSet::None)
    {
      generation.Count = begin;
      return;
    }
    generation.Holders.push_back(
      { tetrahedron, diamond, static_cast<std::uint32_t>(rank), begin, generation.Count });
  }

  /** Appends a tetrahedron's halves, and what lies in them, to the next generation. */
  template <typename Item>
  void Split(const Holder& holder, const std::vector<Item>& items, Generation<Item>& halves) const
  {
    ForEachHalf(this->Hierarchy.Domain(), holder.Tetrahedron, holder.Diamond, holder.Rank,
      [&](const HalfPlace& half, const FinePlane& plane)
      {
        const std::size_t begin = halves.Count;
        Item* const room = halves.Room(holder.End - holder.Begin);
        Item* next = room;
        for (std::size_t i = holder.Begin; i < holder.End; ++i)
        {
          *next = items[i];
          next += this->IsInHalf(plane, *next) ? 1 : 0;
        }
        halves.Count += next - room;
        this->Hold(half, begin, halves);
      });
  }

  bool IsInHalf(const FinePlane& plane, const FinePosition& position) const
  {
    return plane.Side(position) >= 0;
  }
  bool IsInHalf(const FinePlane& plane, ClusterPart& part) const
  {
    const auto [least, greatest] = plane.Sides(this->Clusters->All()[part.Index].Box);
    part.Straddles = part.Straddles || least < 0;
    return greatest >= 0;
  }

  /** A tetrahedron's part, and what it leaves to its halves. */
  std::vector<Task> Bisect(const Task& task)
  {
    Tools tools(*this);
    const Holder& holder = task.Holders[0];
    this->Measure(tools, &holder, &holder + 1, task.Items);
    Task both;
    this->Split(holder, task.Items, both);
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

  /** A tetrahedron and all below. */
  void Descend(Task task)
  {
    Tools tools(*this);
    Generation<ClusterPart> next;
    while (!task.Holders.empty() && IsCoarse(task.Holders[0]))
    {
      this->Measure(tools, task);
      this->Split(task, next);
    }
    Generation<FinePosition> positions = this->Expand(task);
    Generation<FinePosition> nextPositions;
    while (!positions.Holders.empty())
    {
      this->Measure(tools, positions);
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

  /** The isovertices of clusters that lie in the tetrahedra. */
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

  /** Calls body(position) for what of a cluster lies in a tetrahedron. */
  template <typename Body>
  void ForEachIn(const ClusterPart& part, const ClosedTetrahedron& closed, Body&& body) const
  {
    this->Clusters->ForEach(this->Clusters->All()[part.Index],
      [&](const FinePosition& position)
      {
        if (!part.Straddles || closed.Holds(position))
        {
          body(position);
        }
      });
  }

  /** Measures all diamonds of a generation: the tetrahedra of each come together. */
  template <typename Item>
  void Measure(Tools& tools, Generation<Item>& generation)
  {
    std::vector<Holder>& holders = generation.Holders;
    std::sort(holders.begin(), holders.end(),
      [](const Holder& a, const Holder& b) { return a.Rank < b.Rank; });
    for (std::size_t begin = 0, end = 0; begin < holders.size(); begin = end)
    {
      while (end < holders.size() && holders[end].Rank == holders[begin].Rank)
      {
        ++end;
      }
      this->Measure(tools, holders.data() + begin, holders.data() + end, generation.Items);
    }
  }

  /** Raises the error of a diamond by the items that some of its tetrahedra hold. */
  template <typename Item>
  void Measure(Tools& tools, const Holder* begin, const Holder* end, const std::vector<Item>& items)
  {
    const Place& diamond = begin->Diamond;
    const std::uint32_t rank = begin->Rank;
    const ErrorCode::Type code = this->Codes[rank].load(std::memory_order_relaxed);
    if (code == ErrorCode::Always)
    {
      return;
    }
    if (this->IsAlwaysSubdivided(diamond))
    {
      if (std::any_of(
            begin, end, [&](const Holder& holder) { return this->HasIsovertex(holder, items); }))
      {
        this->Raise(rank, ErrorCode::Always);
      }
      return;
    }
    tools.Patches.Reset(diamond);
    this->RaiseToFarthest(diamond, rank, code,
      [&](Farthest& farthest) { this->FindFarthest(tools, begin, end, items, farthest); });
  }

  /** Whether a diamond that holds one of the isovertices of this run must not be a leaf. */
  bool IsAlwaysSubdivided(const Place& diamond) const
  {
    return this->RaisesAll || this->Hierarchy.Domain().SticksOut(diamond.Position, diamond.Scale) ||
      !this->HasFiniteVertices(diamond);
  }

  /** Raises the error of a diamond to the distance of its farthest isovertex, as find(farthest)
   *  finds it. @param code of the error so far */
  template <typename Find>
  void RaiseToFarthest(const Place& diamond, std::uint32_t rank, ErrorCode::Type code, Find&& find)
  {
    // Only what exceeds the error so far is of interest: it is a maximum. What would only just not
    // raise the code counts too, or the order of threads would.
    const double known = code == 0 ? 0.0 : this->Code.Decode(code) / (Margin * Margin);
    Farthest farthest{ known * known, code != 0 };
    find(farthest);
    if (farthest.Squared == Infinity && !this->PreserveFeatures)
    {
      farthest.Squared = this->SquaredDiameter(diamond);
    }
    if (farthest.IsAny && (farthest.Squared > known * known || code == 0))
    {
      this->Raise(rank, this->Code.Encode(std::sqrt(farthest.Squared) * Margin));
    }
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

  /** The farthest isovertex of a diamond so far. */
  struct Farthest
  {
    double Squared = 0.0;
    bool IsAny = false; ///< whether there is an isovertex at all
  };

  void FindFarthest(Tools& tools, const Holder* begin, const Holder* end,
    const std::vector<FinePosition>& positions, Farthest& farthest) const
  {
    tools.Candidates.clear();
    for (const Holder* holder = begin; holder != end; ++holder)
    {
      const int tetrahedron = tools.Patches.Find(holder->Tetrahedron);
      for (std::size_t i = holder->Begin; i < holder->End; ++i)
      {
        this->Propose(tools, tetrahedron, this->Metric(positions[i]), farthest);
      }
    }
    this->Decide(tools, farthest);
  }

  /** Looks at the distance of an isovertex to the patch of its tetrahedron. */
  void Propose(Tools& tools, int tetrahedron, const Vector& point, Farthest& farthest) const
  {
    farthest.IsAny = true;
    const double squared = tools.Patches.SquaredTo(tetrahedron, point);
    if (squared > farthest.Squared)
    {
      tools.Candidates.push_back({ squared, tetrahedron, point });
    }
  }

  /** Looks for nearer patches. The isovertex that is farthest from its own goes first: few others
   *  need it. */
  void Decide(Tools& tools, Farthest& farthest) const
  {
    const auto measure = [&](const Candidate& candidate)
    {
      if (candidate.Squared > farthest.Squared)
      {
        farthest.Squared = std::max(farthest.Squared,
          tools.Patches.SquaredToNearest(
            candidate.Tetrahedron, candidate.Point, candidate.Squared, farthest.Squared));
      }
    };
    const auto first = std::max_element(tools.Candidates.begin(), tools.Candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.Squared < b.Squared; });
    if (first != tools.Candidates.end())
    {
      measure(*first);
    }
    std::for_each(tools.Candidates.begin(), tools.Candidates.end(), measure);
  }

  void FindFarthest(Tools& tools, const Holder* begin, const Holder* end,
    const std::vector<ClusterPart>& parts, Farthest& farthest) const
  {
    for (const Holder* holder = begin; holder != end; ++holder)
    {
      const ClosedTetrahedron closed(holder->Tetrahedron);
      const int tetrahedron = tools.Patches.Find(holder->Tetrahedron);
      for (std::size_t i = holder->Begin; i < holder->End; ++i)
      {
        const FineBox& box = this->Clusters->All()[parts[i].Index].Box;
        if (farthest.IsAny && this->IsWithin(tools.Patches, tetrahedron, box, farthest.Squared))
        {
          continue;
        }
        tools.Candidates.clear();
        this->ForEachIn(parts[i], closed,
          [&](const FinePosition& position)
          { this->Propose(tools, tetrahedron, this->Metric(position), farthest); });
        this->Decide(tools, farthest);
      }
    }
  }

  /** Whether all of a box is surely nearer than a distance: no distance changes faster than the
   *  place does. */
  bool IsWithin(
    DiamondPatches& patches, int tetrahedron, const FineBox& box, double squaredLimit) const
  {
    FinePosition centre;
    std::array<double, 3> half;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int size = box.High[axis] - box.Low[axis];
      centre[axis] = box.Low[axis] + size / 2;
      half[axis] = (size - size / 2) / static_cast<double>(FineUnits);
    }
    double squaredRadius = 0.0;
    for (int corner = 0; corner < 4; ++corner)
    {
      const Vector reach = this->Metric(
        (corner & 1) != 0 ? -half[0] : half[0], (corner & 2) != 0 ? -half[1] : half[1], half[2]);
      squaredRadius = std::max(squaredRadius, Dot(reach, reach));
    }
    const double limit =
      std::sqrt(squaredLimit) / (Margin * Margin) - std::sqrt(squaredRadius) * Margin;
    if (limit <= 0.0)
    {
      return false;
    }
    const Vector point = this->Metric(centre);
    const double own = patches.SquaredTo(tetrahedron, point);
    const double enough = limit * limit;
    return own <= enough || patches.SquaredToNearest(tetrahedron, point, own, enough) <= enough;
  }

  /** Measures the diamonds of scale 0 in a brick. */
  void MeasureFinest(Tools& tools, const Brick& brick)
  {
    const DiamondSet& set = this->Hierarchy.Diamonds();
    const BrickWindow window(set.Level(0), brick);
    set.ForEachInBrick(0, brick,
      [&](const Place& diamond, std::uint32_t rank)
      {
        tools.Located.clear();
        for (const FinestDomain::Owner& owner : FinestDomainOf(diamond.Position).Owners)
        {
          // The isovertices of older owners are corners of the patches: at a distance of 0.
          if (!owner.IsOlder || this->RaisesAll)
          {
            this->Locate(tools, window, diamond, owner);
          }
        }
        if (!tools.Located.empty())
        {
          this->MeasureFinest(tools, diamond, rank);
        }
      });
  }

  /** Finds the isovertices on the edges of one owner in the domain of a diamond of scale 0. */
  void Locate(Tools& tools, const BrickWindow& window, const Place& diamond,
    const FinestDomain::Owner& owner) const
  {
    const Place place{ 0, diamond.Position + owner.Offset };
    const std::int32_t index = window.IndexAt(place.Position);
    if (index < 0)
    {
      return;
    }
    const Brick& brick = this->Hierarchy.Diamonds().Level(0).Bricks[index];
    const int z = place.Position[2] & 7;
    const int bit = BitOf(place.Position);
    if (!brick.Contains(z, bit))
    {
      return;
    }
    const std::uint32_t rank = brick.Rank(z, bit);
    const std::uint32_t crossed = owner.EdgeMask &
      (this->Surface == 0 ? this->Hierarchy.Edges(rank) : this->Hierarchy.UpperEdges(rank));
    for (const FinestDomain::Edge& edge : owner.Edges)
    {
      if (((crossed >> edge.OwnerEdge) & 1U) != 0 &&
        this->Clusters->IsWanted(place, edge.OwnerEdge))
      {
        tools.Located.push_back({ edge.Tetrahedra,
          IsovertexAt(this->Hierarchy, place, rank, edge.OwnerEdge, this->Surface) });
      }
    }
  }

  void MeasureFinest(Tools& tools, const Place& diamond, std::uint32_t rank)
  {
    const ErrorCode::Type code = this->Codes[rank].load(std::memory_order_relaxed);
    if (code == ErrorCode::Always)
    {
      return;
    }
    if (this->IsAlwaysSubdivided(diamond))
    {
      this->Neighbourhood.ForEachTetrahedron(diamond, false,
        [&](int number, const HalfPlace& tetrahedron)
        {
          const bool holds = std::any_of(tools.Located.begin(), tools.Located.end(),
            [number](const Located& located)
            { return ((located.Tetrahedra >> number) & 1U) != 0; });
          if (holds && IsInGrid(this->Hierarchy.Domain(), tetrahedron))
          {
            this->Raise(rank, ErrorCode::Always);
          }
        });
      return;
    }
    tools.Patches.Reset(diamond);
    tools.Candidates.clear();
    this->RaiseToFarthest(diamond, rank, code,
      [&](Farthest& farthest)
      {
        for (const Located& located : tools.Located)
        {
          const Vector point = this->Metric(located.Position);
          ForEachBit(located.Tetrahedra,
            [&](int tetrahedron)
            {
              if (tools.Patches.IsThere(tetrahedron))
              {
                this->Propose(tools, tetrahedron, point, farthest);
              }
            });
        }
        this->Decide(tools, farthest);
      });
  }

  bool HasFiniteVertices(const Place& diamond) const
  {
    const TypeTable& shape = ShapeOf(diamond.Position);
    bool finite = true;
    ForEachBit(SampledVertices(this->Hierarchy.Domain(), diamond, shape),
      [&](int i)
      {
        finite =
          finite && this->IsFinite((1 << diamond.Scale) * (diamond.Position + shape.Offsets[i]));
      });
    return finite;
  }

  double SquaredDiameter(const Place& diamond) const
  {
    const TypeTable& shape = ShapeOf(diamond.Position);
    const std::uint32_t vertices = SampledVertices(this->Hierarchy.Domain(), diamond, shape);
    double largest = 0.0;
    const auto measure = [&](int a, int b)
    {
      const Point between = (1 << diamond.Scale) * (shape.Offsets[a] + -1 * shape.Offsets[b]);
      const Vector vector = this->Metric(between[0], between[1], between[2]);
      largest = std::max(largest, Dot(vector, vector));
    };
    ForEachBit(vertices, [&](int a) { ForEachBit(vertices, [&](int b) { measure(a, b); }); });
    return largest;
  }

  /** A maximum: the same whatever the order of the threads. */
  void Raise(std::uint32_t rank, ErrorCode::Type code)
  {
    std::atomic<ErrorCode::Type>& current = this->Codes[rank];
    ErrorCode::Type seen = current.load(std::memory_order_relaxed);
    while (seen < code && !current.compare_exchange_weak(seen, code, std::memory_order_relaxed))
    {
    }
  }

  /** Errors are rounded up by more than the arithmetic's own rounding. */
  static constexpr double Margin = 1.0 + 1e-12;

  const IsodiamondHierarchy& Hierarchy;
  Finiteness IsFinite;
  SpineNeighbourhood Neighbourhood;
  WorldMetric Metric;
  ErrorCode Code;
  bool PreserveFeatures;
  std::vector<std::atomic<ErrorCode::Type>> Codes;

  // Of the run.
  const IsovertexClusters* Clusters = nullptr;
  int Surface = 0;
  bool RaisesAll = false;
};

}

double DistanceErrorScale(const Grid& grid, const AffineMap& world)
{
  const WorldMetric metric(world);
  if (!metric.IsValid())
  {
    throw std::invalid_argument("Distances need a spacing that is neither 0 nor infinite.");
  }
  const Vector diagonal = metric(grid.Last(0), grid.Last(1), grid.Last(2));
  return ErrorCode(std::sqrt(Dot(diagonal, diagonal))).Scale();
}

std::vector<ErrorCode::Type> DistanceErrors(const IsodiamondHierarchy& relevant,
  const AnySamples& samples, const AffineMap& world, bool preserveFeatures,
  const ParallelFor& parallelFor)
{
  DistanceWalk walk(relevant, samples, world, preserveFeatures);
  for (int surface = 0; surface < relevant.Region().SurfaceCount(); ++surface)
  {
    walk.Run(surface, Ends::Finite, parallelFor);
    walk.Run(surface, Ends::NotFinite, parallelFor);
  }
  return walk.Result();
}

}
