// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ErrorMaxima_h
#define isodiamond_ErrorMaxima_h

#include "DistanceError/MapBounds.h"
#include "Field/Samples.h"
#include "Hierarchy/IsodiamondHierarchy.h"
#include "Patches/WorldLengths.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

namespace isodiamond
{

/** Distances are rounded up by more than the arithmetic's own rounding. */
inline constexpr double DistanceMargin = 1.0 + 1e-12;

/** The farthest isovertex of a diamond so far. */
struct Farthest
{
  double Squared = 0.0; ///< its distance; infinite if there is nothing to measure it against
  bool IsAny = false;   ///< whether there is an isovertex at all
};

/** Whether a diamond that holds an isovertex must not be a leaf, wherever the isovertex lies: the
 *  diamond sticks out of the grid, or one of its vertices is not finite. */
inline bool HasNoInterpolant(const Grid& grid, const Finiteness& isFinite, const Place& diamond)
{
  bool has = grid.SticksOut(diamond.Position, diamond.Scale);
  if (!has && !isFinite.All())
  {
    const TypeTable& shape = ShapeOf(diamond.Position);
    ForEachBit(SampledVertices(grid, diamond),
      [&](int i) { has = has || !isFinite(VertexAt(diamond, shape.Offsets[i])); });
  }
  return has;
}

/** The greatest distance between two vertices of a diamond, squared: what counts for an isovertex
 *  without any patch to be measured against, where features need not be preserved. */
template <typename Lengths>
double SquaredDiameter(const Grid& grid, const Lengths& lengths, const Place& diamond)
{
  const TypeTable& shape = ShapeOf(diamond.Position);
  const std::uint32_t vertices = SampledVertices(grid, diamond);
  double largest = 0.0;
  const auto vertexAt = [&](int i) { return VertexAt(diamond, shape.Offsets[i]); };
  const auto measure = [&](int a, int b)
  {
    const Vector vector = lengths.Between(vertexAt(b), vertexAt(a));
    largest = std::max(largest, Dot(vector, vector));
  };
  ForEachBit(vertices, [&](int a) { ForEachBit(vertices, [&](int b) { measure(a, b); }); });
  return largest;
}

/**
 * The distance errors of all diamonds while they are being found. Each is a maximum over
 * isovertices and only rises: in the end it is the same whatever the order of the threads.
 */
class ErrorMaxima
{
public:
  /** Hierarchy, finiteness and bounds must outlive it.
   *  @param codes by rank, to start from
   *  @param bounds of the way back, to be filled if they are wanted
   *  @throws std::invalid_argument if the world has no distances */
  ErrorMaxima(const IsodiamondHierarchy& hierarchy, const Finiteness& isFinite,
    const GridGeometry& world, double scale, bool preserveFeatures,
    const std::vector<ErrorCode::Type>& codes, MapBounds& bounds)
    : Source(hierarchy)
    , Finite(isFinite)
    , InWorld(WorldLengthsOf(world))
    , Code(scale)
    , PreserveFeatures(preserveFeatures)
    , Bounds(bounds)
    , Codes(codes.begin(), codes.end())
  {
  }

  const IsodiamondHierarchy& Hierarchy() const { return this->Source; }
  const Finiteness& IsFinite() const { return this->Finite; }
  const WorldLengths& Lengths() const { return this->InWorld; }

  /** By rank; 0 without an isovertex. */
  std::vector<ErrorCode::Type> Result() const { return { this->Codes.begin(), this->Codes.end() }; }

  bool IsAlways(std::uint32_t rank) const
  {
    return this->Codes[rank].load(std::memory_order_relaxed) == ErrorCode::Always;
  }
  bool AreBoundsWanted() const { return this->Bounds.AreWanted(); }

  /** Keeps a bound of the way back. @param squared infinite if there is none */
  void SetBound(int surface, std::uint32_t rank, int tetrahedron, double squared)
  {
    this->Bounds.Set(
      surface, rank, tetrahedron, this->Code.Encode(std::sqrt(squared) * DistanceMargin));
  }

  void RaiseToAlways(std::uint32_t rank) { this->Raise(rank, ErrorCode::Always); }

  /** Whether a diamond that holds an isovertex must not be a leaf, wherever the isovertex lies. */
  bool HasNoInterpolant(const Place& diamond) const
  {
    return isodiamond::HasNoInterpolant(this->Source.SampleGrid(), this->Finite, diamond);
  }

  /** Raises an error to the distance of the farthest isovertex, as find(farthest) finds it. */
  template <typename Find>
  void RaiseToFarthest(const Place& diamond, std::uint32_t rank, Find&& find)
  {
    // Only what exceeds the error so far is of interest. What only just fails to raise the code
    // counts too, or else the order of threads would.
    const ErrorCode::Type code = this->Codes[rank].load(std::memory_order_relaxed);
    const double known =
      code == 0 ? 0.0 : this->Code.Decode(code) / (DistanceMargin * DistanceMargin);
    Farthest farthest{ known * known, code != 0 };
    find(farthest);
    if (farthest.Squared == std::numeric_limits<double>::infinity() && !this->PreserveFeatures)
    {
      farthest.Squared = std::visit([&](const auto& lengths)
        { return SquaredDiameter(this->Source.SampleGrid(), lengths, diamond); },
        this->InWorld);
    }
    if (farthest.IsAny && (farthest.Squared > known * known || code == 0))
    {
      this->Raise(rank, this->Code.Encode(std::sqrt(farthest.Squared) * DistanceMargin));
    }
  }

private:
  /** A maximum: the same whatever the order of the threads. */
  void Raise(std::uint32_t rank, ErrorCode::Type code)
  {
    std::atomic<ErrorCode::Type>& current = this->Codes[rank];
    ErrorCode::Type seen = current.load(std::memory_order_relaxed);
    while (seen < code && !current.compare_exchange_weak(seen, code, std::memory_order_relaxed))
    {
    }
  }

  const IsodiamondHierarchy& Source;
  const Finiteness& Finite;
  WorldLengths InWorld;
  ErrorCode Code;
  bool PreserveFeatures;
  MapBounds& Bounds;
  std::vector<std::atomic<ErrorCode::Type>> Codes;
};

}

#endif
