// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError.h"

#include "PatchDistance.h"

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

using Positions = std::vector<FinePosition>;

/** Whether a tetrahedron has samples at all of its vertices. */
bool IsSampled(const Grid& grid, const HalfPlace& tetrahedron)
{
  return (tetrahedron.Half->Mask &
           ~SampledVertices(grid, tetrahedron.Parent, tetrahedron.Shape())) == 0 &&
    grid.IsSampled(Centre(tetrahedron.Parent));
}

/** Whether a tetrahedron shares volume with the grid's box. */
bool IsInGrid(const Grid& grid, const HalfPlace& tetrahedron)
{
  const int h = 1 << tetrahedron.Parent.Scale;
  const TypeTable& shape = tetrahedron.Shape();
  for (int axis = 0; axis < 3; ++axis)
  {
    int low = 0; // offsets from the centre, which is a corner
    int high = 0;
    for (const std::uint8_t vertex : tetrahedron.Half->Vertices)
    {
      low = std::min(low, shape.Offsets[vertex][axis]);
      high = std::max(high, shape.Offsets[vertex][axis]);
    }
    const int centre = h * tetrahedron.Parent.Position[axis];
    if (centre + h * low >= grid.Last(axis) || centre + h * high <= 0)
    {
      return false;
    }
  }
  return true;
}

/** The tetrahedra of one diamond and those that can take their place in a mesh. */
class SpineNeighbourhood
{
public:
  explicit SpineNeighbourhood(const IsodiamondHierarchy& hierarchy)
    : Hierarchy(hierarchy)
  {
  }

  /** Calls body(tetrahedron) for the tetrahedra of a diamond.
   *  @param onlySampled those that have samples at all of their vertices */
  template <typename Body>
  void ForEachTetrahedron(const Place& diamond, bool onlySampled, Body&& body) const
  {
    const Grid& grid = this->Hierarchy.Domain();
    const TypeTable& shape = ShapeOf(diamond.Position);
    for (int i = 0; i < shape.ParentCount; ++i)
    {
      const Place parent = ParentPlace(shape, diamond, i);
      const std::int64_t rank = grid.IsValid(parent.Position, parent.Scale)
        ? this->Hierarchy.Diamonds().Rank(parent)
        : DiamondSet::None;
      if (rank == DiamondSet::None)
      {
        continue;
      }
      const TypeTable& parentShape = ShapeOf(parent.Position);
      const Point offset = diamond.Position + -(1 << parentShape.ChildStep) * parent.Position;
      const auto* const children = parentShape.ChildOffsets.data();
      const std::int64_t child =
        std::find(children, children + parentShape.ChildCount, offset) - children;
      for (int j = 0; j < parentShape.HalfTetrahedraPerChild; ++j)
      {
        const HalfTetrahedron& half =
          parentShape.HalfTetrahedra[child * parentShape.HalfTetrahedraPerChild + j];
        const HalfPlace tetrahedron{ parent, static_cast<std::uint32_t>(rank), &half };
        if (!onlySampled || IsSampled(grid, tetrahedron))
        {
          body(tetrahedron);
        }
      }
    }
  }

  /** Replaces a tetrahedron by the one that it is half of. @return false if that is in no mesh with
   *  the diamond's spine */
  bool Coarsen(HalfPlace& tetrahedron, const Place& diamond) const
  {
    const Place& parent = tetrahedron.Parent;
    const Point centre = Centre(parent);
    if (parent.Scale == this->Hierarchy.Domain().Depth() || IsSpineEnd(diamond, centre))
    {
      return false;
    }
    // The other end of the parent's spine instead of its centre.
    const TypeTable& shape = tetrahedron.Shape();
    const bool hasFirst = ((tetrahedron.Half->Mask >> shape.Spine[0]) & 1U) != 0;
    std::array<Point, 4> corners;
    for (int i = 0; i < 3; ++i)
    {
      corners[i] = VertexOf(parent, shape, tetrahedron.Half->Vertices[i]);
    }
    corners[3] = VertexOf(parent, shape, shape.Spine[hasFirst ? 1 : 0]);
    return this->Identify(corners, tetrahedron);
  }

private:
  static Point VertexOf(const Place& place, const TypeTable& shape, int vertex)
  {
    return (1 << place.Scale) * (place.Position + shape.Offsets[vertex]);
  }

  static bool IsSpineEnd(const Place& diamond, const Point& point)
  {
    const TypeTable& shape = ShapeOf(diamond.Position);
    return VertexOf(diamond, shape, shape.Spine[0]) == point ||
      VertexOf(diamond, shape, shape.Spine[1]) == point;
  }

  /** The place of the diamond centred at a lattice point. */
  Place PlaceAt(const Point& point) const
  {
    const int scale = this->Hierarchy.Domain().Scale(point);
    return { scale, { point[0] >> scale, point[1] >> scale, point[2] >> scale } };
  }

  /** Finds the half-tetrahedron that has four given corners. */
  bool Identify(const std::array<Point, 4>& corners, HalfPlace& tetrahedron) const
  {
    const auto age = [&](const Point& corner)
    {
      const Place place = this->PlaceAt(corner);
      return 3 * place.Scale - tables::Parities[Parity(place.Position)].DiamondClass;
    };
    const Point& youngest = *std::min_element(corners.begin(), corners.end(),
      [&](const Point& a, const Point& b) { return age(a) < age(b); });
    tetrahedron.Parent = this->PlaceAt(youngest);
    const std::int64_t rank = this->Hierarchy.Diamonds().Rank(tetrahedron.Parent);
    if (rank == DiamondSet::None)
    {
      return false;
    }
    tetrahedron.Rank = static_cast<std::uint32_t>(rank);
    const TypeTable& shape = tetrahedron.Shape();
    std::uint32_t mask = 0;
    for (int i = 0; i < shape.VertexCount; ++i)
    {
      const Point vertex = VertexOf(tetrahedron.Parent, shape, i);
      mask |= static_cast<std::uint32_t>(
                std::find(corners.begin(), corners.end(), vertex) != corners.end())
        << i;
    }
    const auto* end = shape.HalfTetrahedra.data() + shape.HalfTetrahedronCount;
    tetrahedron.Half = std::find_if(shape.HalfTetrahedra.data(), end,
      [mask](const HalfTetrahedron& half) { return half.Mask == mask; });
    return tetrahedron.Half != end && IsSampled(this->Hierarchy.Domain(), tetrahedron);
  }

  const IsodiamondHierarchy& Hierarchy;
};

/**
 * The patches around the spine of a diamond that are near one of its tetrahedra, whenever that is
 * in the mesh. Made one after the other, as far as they are asked for.
 */
class NearPatches
{
public:
  NearPatches(const IsodiamondHierarchy& hierarchy, const WorldMetric& metric, int surface,
    const HalfPlace& tetrahedron, const Place& diamond)
    : Neighbourhood(hierarchy)
    , Hierarchy(hierarchy)
    , Metric(metric)
    , Surface(surface)
    , Tetrahedron(tetrahedron)
    , Diamond(diamond)
    , Own(hierarchy, metric, tetrahedron, surface)
  {
  }

  /** The squared distance to the tetrahedron's own patch; infinite if it has none. */
  double SquaredToOwn(const Vector& point) const { return SquaredTo(this->Own, point); }

  /** The squared distance to the nearest patch, or some that is small enough. */
  double SquaredToNearest(const Vector& point, double enough)
  {
    if (!this->HasOthers)
    {
      this->FindOthers();
    }
    double nearest = this->SquaredToOwn(point);
    for (std::size_t i = 0; i < this->Others.size() && nearest > enough; ++i)
    {
      if (i == this->Places.size())
      {
        this->Places.push_back(this->WhatCanBeThere(this->Others[i]));
      }
      nearest = std::min(nearest, Farthest(this->Places[i], point));
    }
    return nearest;
  }

private:
  /** What can be in one place: of these, the farthest counts. */
  using Alternatives = std::vector<PatchDistance>;

  static double SquaredTo(const PatchDistance& patch, const Vector& point)
  {
    return patch.IsEmpty() ? Infinity : patch.Squared(point);
  }

  static double Farthest(const Alternatives& alternatives, const Vector& point)
  {
    double farthest = 0.0;
    for (const PatchDistance& patch : alternatives)
    {
      farthest = std::max(farthest, SquaredTo(patch, point));
    }
    return farthest;
  }

  /** The other tetrahedra of the diamond, the mate first. */
  void FindOthers()
  {
    this->HasOthers = true;
    this->Neighbourhood.ForEachTetrahedron(this->Diamond, true,
      [&](const HalfPlace& other)
      {
        if (other.Rank != this->Tetrahedron.Rank)
        {
          this->Others.push_back(other);
        }
        else if (other.Half != this->Tetrahedron.Half)
        {
          this->Others.insert(this->Others.begin(), other);
        }
      });
  }

  Alternatives WhatCanBeThere(HalfPlace other) const
  {
    const bool isMate = other.Rank == this->Tetrahedron.Rank;
    Alternatives alternatives;
    do
    {
      alternatives.emplace_back(this->Hierarchy, this->Metric, other, this->Surface);
    } while (!isMate && !alternatives.back().IsEmpty() &&
      this->Neighbourhood.Coarsen(other, this->Diamond));
    return alternatives;
  }

  SpineNeighbourhood Neighbourhood;
  const IsodiamondHierarchy& Hierarchy;
  const WorldMetric& Metric;
  int Surface;
  const HalfPlace& Tetrahedron;
  const Place& Diamond;
  PatchDistance Own;
  bool HasOthers = false;
  std::vector<HalfPlace> Others;
  std::vector<Alternatives> Places; ///< of the others, as far as they are made
};

/** A plane between lattice points, for exact tests of which side a position is on. */
class FinePlane
{
public:
  /** Through a point, spanned by two small offsets. */
  FinePlane(const Point& point, const Point& first, const Point& second)
    : Origin(FineUnits * point)
    , Normal{ std::int64_t{ 1 } * first[1] * second[2] - first[2] * second[1],
      std::int64_t{ 1 } * first[2] * second[0] - first[0] * second[2],
      std::int64_t{ 1 } * first[0] * second[1] - first[1] * second[0] }
  {
  }

  /** Positive on one side, negative on the other, 0 on the plane. */
  std::int64_t Side(const FinePosition& position) const
  {
    return this->Normal[0] * (position[0] - this->Origin[0]) +
      this->Normal[1] * (position[1] - this->Origin[1]) +
      this->Normal[2] * (position[2] - this->Origin[2]);
  }

private:
  FinePosition Origin;
  std::array<std::int64_t, 3> Normal;
};

/**
 * Hands the full-resolution isovertices down the tree of bisected tetrahedra. Every tetrahedron
 * that holds some raises the error of the diamond that it lies in.
 */
class DistanceWalk
{
public:
  DistanceWalk(const IsodiamondHierarchy& hierarchy, const AffineMap& world, bool preserveFeatures)
    : Hierarchy(hierarchy)
    , Neighbourhood(hierarchy)
    , Metric(world)
    , Code(DistanceErrorScale(hierarchy.Domain(), world))
    , PreserveFeatures(preserveFeatures)
    , Codes(hierarchy.Diamonds().Size())
  {
  }

  /** Measures positions against a surface, or lets them subdivide whatever holds one always. */
  void Run(int surface, bool always, const Positions& positions, const ParallelFor& parallelFor)
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
          if (!half.Held.empty())
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
          Positions held = std::move(tasks[i].Held);
          this->Descend(tasks[i].Tetrahedron, held, 0);
        }
      });
  }

  std::vector<ErrorCode::Type> Result() const { return { this->Codes.begin(), this->Codes.end() }; }

private:
  struct Task
  {
    HalfPlace Tetrahedron;
    Positions Held; ///< in the closed tetrahedron
  };

  /** The six tetrahedra of the base cube. */
  std::vector<Task> RootTasks(const Positions& positions) const
  {
    std::vector<Task> tasks;
    const Place root{ this->Hierarchy.Domain().Depth() - 1, { 1, 1, 1 } };
    this->Neighbourhood.ForEachTetrahedron(root, false,
      [&](const HalfPlace& tetrahedron)
      {
        Task task{ tetrahedron, {} };
        std::copy_if(positions.begin(), positions.end(), std::back_inserter(task.Held),
          [&](const FinePosition& position) { return Holds(tetrahedron, position); });
        if (!task.Held.empty())
        {
          tasks.push_back(std::move(task));
        }
      });
    return tasks;
  }

  static bool Holds(const HalfPlace& tetrahedron, const FinePosition& position)
  {
    const TypeTable& shape = tetrahedron.Shape();
    std::array<Point, 4> corners{}; // as offsets from the centre
    for (int i = 0; i < 3; ++i)
    {
      corners[i + 1] = shape.Offsets[tetrahedron.Half->Vertices[i]];
    }
    for (int opposite = 0; opposite < 4; ++opposite)
    {
      const Point& origin = corners[(opposite + 1) % 4];
      const Point at = Centre(tetrahedron.Parent) + (1 << tetrahedron.Parent.Scale) * origin;
      const FinePlane face(
        at, corners[(opposite + 2) % 4] + -1 * origin, corners[(opposite + 3) % 4] + -1 * origin);
      const Point inside =
        Centre(tetrahedron.Parent) + (1 << tetrahedron.Parent.Scale) * corners[opposite];
      if ((face.Side(position) < 0) != (face.Side(FineUnits * inside) < 0) &&
        face.Side(position) != 0)
      {
        return false;
      }
    }
    return true;
  }

  /** Splits the range of positions from `begin` on at the plane through the centre of the diamond
   *  that a tetrahedron lies in and its ring edge: calls body(half, positive side) for both. */
  template <typename Body>
  void ForEachHalf(
    const HalfPlace& tetrahedron, const Place& diamond, std::uint32_t rank, Body&& body) const
  {
    // The corners of the tetrahedron among the diamond's vertices.
    const TypeTable& shape = ShapeOf(diamond.Position);
    const int ratio = 1 << (tetrahedron.Parent.Scale - diamond.Scale);
    const Point toParent = ratio * tetrahedron.Parent.Position + -1 * diamond.Position;
    std::uint32_t corners = VertexAt(shape, toParent);
    for (int i = 0; i < 3; ++i)
    {
      const Point& offset = tetrahedron.Shape().Offsets[tetrahedron.Half->Vertices[i]];
      corners |= VertexAt(shape, toParent + ratio * offset);
    }
    const std::uint32_t ends = (1U << shape.Spine[0]) | (1U << shape.Spine[1]);
    const std::uint32_t ring = corners & ~ends;
    const FinePlane plane(
      Centre(diamond), shape.Offsets[LowestBit(ring)], shape.Offsets[LowestBit(ring & (ring - 1))]);
    for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
    {
      const HalfTetrahedron& half = shape.HalfTetrahedra[i];
      if ((half.Mask & ring) == ring && (half.Mask & ends) != 0)
      {
        const int end = (half.Mask >> shape.Spine[0] & 1U) != 0 ? 0 : 1;
        const Point at = Centre(diamond) + (1 << diamond.Scale) * shape.Offsets[shape.Spine[end]];
        const HalfPlace place{ diamond, rank, &half };
        if (IsInGrid(this->Hierarchy.Domain(), place))
        {
          body(place, plane, plane.Side(FineUnits * at) > 0);
        }
      }
    }
  }

  static std::uint32_t VertexAt(const TypeTable& shape, const Point& offset)
  {
    const auto* const begin = shape.Offsets.data();
    return 1U << (std::find(begin, begin + shape.VertexCount, offset) - begin);
  }

  /** A tetrahedron's part, and what it leaves to its halves. */
  std::array<Task, 2> Bisect(const Task& task)
  {
    std::array<Task, 2> halves;
    const Place diamond = task.Tetrahedron.Child();
    if (diamond.Scale < 0)
    {
      return halves;
    }
    const std::uint32_t rank =
      this->Measure(task.Tetrahedron, diamond, task.Held.data(), task.Held.size());
    int count = 0;
    this->ForEachHalf(task.Tetrahedron, diamond, rank,
      [&](const HalfPlace& half, const FinePlane& plane, bool positive)
      {
        Task& next = halves[count++];
        next.Tetrahedron = half;
        std::copy_if(task.Held.begin(), task.Held.end(), std::back_inserter(next.Held),
          [&](const FinePosition& position)
          { return positive ? plane.Side(position) >= 0 : plane.Side(position) <= 0; });
      });
    return halves;
  }

  /** A tetrahedron and all below; it holds the positions from `begin` on, the last ones of a stack
   *  on which the halves put theirs. */
  void Descend(const HalfPlace& tetrahedron, Positions& stack, std::size_t begin)
  {
    const Place diamond = tetrahedron.Child();
    if (diamond.Scale < 0)
    {
      return;
    }
    const std::size_t end = stack.size();
    const std::uint32_t rank =
      this->Measure(tetrahedron, diamond, stack.data() + begin, end - begin);
    this->ForEachHalf(tetrahedron, diamond, rank,
      [&](const HalfPlace& half, const FinePlane& plane, bool positive)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          const FinePosition position = stack[i];
          const std::int64_t side = plane.Side(position);
          if (positive ? side >= 0 : side <= 0)
          {
            stack.push_back(position);
          }
        }
        if (stack.size() > end)
        {
          this->Descend(half, stack, end);
        }
        stack.resize(end);
      });
  }

  /** Raises the error of the diamond of a tetrahedron by the positions that it holds. @return the
   *  diamond's rank */
  std::uint32_t Measure(const HalfPlace& tetrahedron, const Place& diamond,
    const FinePosition* positions, std::size_t count)
  {
    const auto rank = static_cast<std::uint32_t>(this->Hierarchy.Diamonds().Rank(diamond));
    if (this->RaisesAll || this->Hierarchy.Domain().SticksOut(diamond.Position, diamond.Scale))
    {
      this->Raise(rank, ErrorCode::Always);
    }
    const ErrorCode::Type code = this->Codes[rank].load(std::memory_order_relaxed);
    if (code == ErrorCode::Always)
    {
      return rank;
    }
    // Only what exceeds the error so far is of interest: it is a maximum.
    const double known = code == 0 ? 0.0 : this->Code.Decode(code);
    double largest = known * known;
    NearPatches patches(this->Hierarchy, this->Metric, this->Surface, tetrahedron, diamond);
    for (std::size_t i = 0; i < count; ++i)
    {
      const Vector point = this->Metric(positions[i]);
      if (patches.SquaredToOwn(point) > largest)
      {
        largest = std::max(largest, patches.SquaredToNearest(point, largest));
      }
    }
    if (largest == Infinity && !this->PreserveFeatures)
    {
      largest = this->SquaredDiameter(diamond);
    }
    if (largest > known * known || code == 0)
    {
      // Rounding up by much more than the arithmetic's own rounding.
      this->Raise(rank, this->Code.Encode(std::sqrt(largest) * (1.0 + 1e-12)));
    }
    return rank;
  }

  double SquaredDiameter(const Place& diamond) const
  {
    const TypeTable& shape = ShapeOf(diamond.Position);
    double largest = 0.0;
    for (int i = 0; i < shape.VertexCount; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        const Point between = (1 << diamond.Scale) * (shape.Offsets[i] + -1 * shape.Offsets[j]);
        const Vector vector = this->Metric(between[0], between[1], between[2]);
        largest = std::max(largest, Dot(vector, vector));
      }
    }
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

  const IsodiamondHierarchy& Hierarchy;
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
  Positions Finite;
  Positions NotFinite; ///< on edges with an end that is not finite

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
                .push_back(PatchDistance::IsovertexAt(hierarchy, place, rank, edge, surface));
            });
        });
    }
  }
};

}

double DistanceErrorScale(const Grid& grid, const AffineMap& world)
{
  if (!(std::fabs(world.Determinant()) > 0.0) || !std::isfinite(world.Determinant()))
  {
    throw std::invalid_argument("Distances need a spacing that is neither 0 nor infinite.");
  }
  const Vector diagonal = WorldMetric(world)(grid.Last(0), grid.Last(1), grid.Last(2));
  return ErrorCode(std::sqrt(Dot(diagonal, diagonal))).Scale();
}

std::vector<ErrorCode::Type> DistanceErrors(const IsodiamondHierarchy& relevant,
  const AnySamples& samples, const AffineMap& world, bool preserveFeatures,
  const ParallelFor& parallelFor)
{
  DistanceWalk walk(relevant, world, preserveFeatures);
  for (int surface = 0; surface < relevant.Region().SurfaceCount(); ++surface)
  {
    const FullResolution isovertices(relevant, samples, surface);
    walk.Run(surface, false, isovertices.Finite, parallelFor);
    walk.Run(surface, true, isovertices.NotFinite, parallelFor);
  }
  return walk.Result();
}

}
