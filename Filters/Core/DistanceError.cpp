// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError.h"

#include "Bisection.h"
#include "DiamondPatches.h"

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

using FinePositions = std::vector<FinePosition>;

/**
 * Hands the full-resolution isovertices down the tree of bisected tetrahedra. Every tetrahedron
 * that holds some raises the error of the diamond that it lies in.
 */
class DistanceWalk
{
public:
  DistanceWalk(const IsodiamondHierarchy& hierarchy, const AnySamples& samples,
    const AffineMap& world, bool preserveFeatures)
    : Hierarchy(hierarchy)
    , Samples(samples)
    , Neighbourhood(hierarchy)
    , Metric(world)
    , Code(DistanceErrorScale(hierarchy.Domain(), world))
    , PreserveFeatures(preserveFeatures)
    , Codes(hierarchy.Diamonds().Size())
  {
  }

  /** Measures positions against a surface, or lets them subdivide whatever holds one always. */
  void Run(int surface, bool always, const FinePositions& positions, const ParallelFor& parallelFor)
  {
    this->Surface = surface;
    this->RaisesAll = always;
    std::vector<Task> tasks = this->RootTasks(positions);
    // Level by level until there is work for many threads, then each subtree by itself.
    constexpr std::size_t enough = 128;
    while (!tasks.empty() && tasks.size() < enough)
    {
      std::vector<std::array<Task, 2>> halves(tasks.size());
      parallelFor(static_cast<std::int64_t>(tasks.size()), 1,
        [&](std::int64_t begin, std::int64_t end)
        {
          for (std::int64_t i = begin; i < end; ++i)
          {
            halves[i] = this->Bisect(tasks[i]);
          }
        });
      tasks.clear();
      for (std::array<Task, 2>& pair : halves)
      {
        for (Task& half : pair)
        {
          if (!half.Positions.empty())
          {
            tasks.push_back(std::move(half));
          }
        }
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
  }

  std::vector<ErrorCode::Type> Result() const { return { this->Codes.begin(), this->Codes.end() }; }

private:
  struct Task
  {
    HalfPlace Tetrahedron;
    FinePositions Positions; ///< in the closed tetrahedron
  };

  /** The six tetrahedra of the base cube. */
  std::vector<Task> RootTasks(const FinePositions& positions) const
  {
    std::vector<Task> tasks;
    const Place root{ this->Hierarchy.Domain().Depth() - 1, { 1, 1, 1 } };
    this->Neighbourhood.ForEachTetrahedron(root, false,
      [&](const HalfPlace& tetrahedron)
      {
        Task task{ tetrahedron, {} };
        std::copy_if(positions.begin(), positions.end(), std::back_inserter(task.Positions),
          [&](const FinePosition& position) { return Holds(tetrahedron, position); });
        if (!task.Positions.empty())
        {
          tasks.push_back(std::move(task));
        }
      });
    return tasks;
  }

  /** A tetrahedron with positions, and the diamond that it lies in. */
  struct Held
  {
    HalfPlace Tetrahedron;
    Place Diamond;
    std::uint32_t Rank = 0; ///< of the diamond
    std::size_t Begin = 0;  ///< its positions in a list of many tetrahedra's
    std::size_t End = 0;
  };

  Held Hold(const HalfPlace& tetrahedron, std::size_t begin, std::size_t end) const
  {
    // A diamond in the grid that holds an isovertex is a member: it leads to the surface.
    const Place diamond = tetrahedron.Child();
    const std::int64_t rank = diamond.Scale < 0 ? 0 : this->Hierarchy.Diamonds().Rank(diamond);
    return { tetrahedron, diamond, static_cast<std::uint32_t>(rank), begin, end };
  }

  /** Appends the positions of a tetrahedron's halves to a list, and the halves to another. */
  void Split(const Held& held, const FinePositions& positions, std::vector<Held>& halves,
    FinePositions& positionsOfHalves) const
  {
    ForEachHalf(this->Hierarchy.Domain(), held.Tetrahedron, held.Diamond, held.Rank,
      [&](const HalfPlace& half, const FinePlane& plane, bool positive)
      {
        const std::size_t begin = positionsOfHalves.size();
        for (std::size_t i = held.Begin; i < held.End; ++i)
        {
          const std::int64_t side = plane.Side(positions[i]);
          if (positive ? side >= 0 : side <= 0)
          {
            positionsOfHalves.push_back(positions[i]);
          }
        }
        if (positionsOfHalves.size() > begin && half.Child().Scale >= 0)
        {
          halves.push_back(this->Hold(half, begin, positionsOfHalves.size()));
        }
      });
  }

  /** A tetrahedron's part, and what it leaves to its halves. */
  std::array<Task, 2> Bisect(const Task& task)
  {
    const Held held = this->Hold(task.Tetrahedron, 0, task.Positions.size());
    DiamondPatches patches(this->Hierarchy, this->Metric, this->Surface);
    this->Measure(patches, &held, &held + 1, task.Positions);
    std::vector<Held> halves;
    FinePositions positions;
    this->Split(held, task.Positions, halves, positions);
    std::array<Task, 2> tasks;
    for (std::size_t i = 0; i < halves.size(); ++i)
    {
      tasks[i].Tetrahedron = halves[i].Tetrahedron;
      tasks[i].Positions.assign(
        positions.begin() + halves[i].Begin, positions.begin() + halves[i].End);
    }
    return tasks;
  }

  /** A tetrahedron and all below, level by level: so the tetrahedra of a diamond come together. */
  void Descend(Task task)
  {
    DiamondPatches patches(this->Hierarchy, this->Metric, this->Surface);
    std::vector<Held> level = { this->Hold(task.Tetrahedron, 0, task.Positions.size()) };
    std::vector<Held> nextLevel;
    FinePositions positions = std::move(task.Positions);
    FinePositions nextPositions;
    while (!level.empty())
    {
      std::sort(
        level.begin(), level.end(), [](const Held& a, const Held& b) { return a.Rank < b.Rank; });
      for (std::size_t begin = 0, end = 0; begin < level.size(); begin = end)
      {
        while (end < level.size() && level[end].Rank == level[begin].Rank)
        {
          ++end;
        }
        this->Measure(patches, level.data() + begin, level.data() + end, positions);
      }
      nextLevel.clear();
      nextPositions.clear();
      for (const Held& held : level)
      {
        this->Split(held, positions, nextLevel, nextPositions);
      }
      level.swap(nextLevel);
      positions.swap(nextPositions);
    }
  }

  /** Raises the error of a diamond by the positions that some of its tetrahedra hold. */
  void Measure(
    DiamondPatches& patches, const Held* begin, const Held* end, const FinePositions& positions)
  {
    const Place& diamond = begin->Diamond;
    const std::uint32_t rank = begin->Rank;
    if (this->RaisesAll || this->Hierarchy.Domain().SticksOut(diamond.Position, diamond.Scale) ||
      !this->HasFiniteVertices(diamond))
    {
      this->Raise(rank, ErrorCode::Always);
    }
    const ErrorCode::Type code = this->Codes[rank].load(std::memory_order_relaxed);
    if (code == ErrorCode::Always)
    {
      return;
    }
    // Only what exceeds the error so far is of interest: it is a maximum. What would only just not
    // raise the code counts too, or the order of threads would.
    const double known = code == 0 ? 0.0 : this->Code.Decode(code) / (Margin * Margin);
    double largest = known * known;
    patches.Reset(diamond);
    for (const Held* held = begin; held != end; ++held)
    {
      const int tetrahedron = patches.Find(held->Tetrahedron);
      for (std::size_t i = held->Begin; i < held->End; ++i)
      {
        const Vector point = this->Metric(positions[i]);
        if (patches.SquaredTo(tetrahedron, point) > largest)
        {
          largest = std::max(largest, patches.SquaredToNearest(tetrahedron, point, largest));
        }
      }
    }
    if (largest == Infinity && !this->PreserveFeatures)
    {
      largest = this->SquaredDiameter(diamond);
    }
    if (largest > known * known || code == 0)
    {
      this->Raise(rank, this->Code.Encode(std::sqrt(largest) * Margin));
    }
  }

  bool HasFiniteVertices(const Place& diamond) const
  {
    return std::visit(
      [&](const auto& view)
      {
        using T = typename std::decay_t<decltype(view)>::Value;
        bool finite = true;
        if constexpr (std::is_floating_point_v<T>)
        {
          const TypeTable& shape = ShapeOf(diamond.Position);
          ForEachBit(SampledVertices(this->Hierarchy.Domain(), diamond, shape),
            [&](int i)
            {
              const Point vertex = diamond.Position + shape.Offsets[i];
              finite = finite && std::isfinite(view((1 << diamond.Scale) * vertex));
            });
        }
        return finite;
      },
      this->Samples);
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
  const AnySamples& Samples;
  SpineNeighbourhood Neighbourhood;
  WorldMetric Metric;
  ErrorCode Code;
  bool PreserveFeatures;
  std::vector<std::atomic<ErrorCode::Type>> Codes;
  int Surface = 0;
  bool RaisesAll = false;
};

/** The isovertices of full resolution on a surface: those of scale 0. */
struct FullResolution
{
  FinePositions Finite;
  FinePositions NotFinite; ///< on edges with an end that is not finite

  FullResolution(const IsodiamondHierarchy& hierarchy, const AnySamples& samples, int surface)
  {
    const DiamondSet& set = hierarchy.Diamonds();
    for (const Brick& brick : set.Level(0).Bricks)
    {
      set.ForEachInBrick(0, brick,
        [&](const Place& place, std::uint32_t rank)
        {
          const ParityTable& shape = tables::Parities[Parity(place.Position)];
          ForEachBit(surface == 0 ? hierarchy.Edges(rank) : hierarchy.UpperEdges(rank),
            [&](int edge)
            {
              const bool isFinite = std::isfinite(SampleAt(samples, place.Position)) &&
                std::isfinite(SampleAt(samples, place.Position + shape.Offsets[edge]));
              (isFinite ? this->Finite : this->NotFinite)
                .push_back(IsovertexAt(hierarchy, place, rank, edge, surface));
            });
        });
    }
  }
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
    const FullResolution isovertices(relevant, samples, surface);
    walk.Run(surface, false, isovertices.Finite, parallelFor);
    walk.Run(surface, true, isovertices.NotFinite, parallelFor);
  }
  return walk.Result();
}

}
