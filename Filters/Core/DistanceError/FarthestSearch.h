// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FarthestSearch_h
#define isodiamond_FarthestSearch_h

#include "DistanceError/Bisection.h"
#include "DistanceError/DiamondPatches.h"
#include "DistanceError/ErrorMaxima.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace isodiamond
{

/**
 * Finds the isovertex of a diamond that is farthest from the patches around the spine. Isovertices
 * are proposed, with the tetrahedron that holds them; few of them need to be compared with more
 * than its patch. Used for one diamond after another, by one thread.
 */
template <typename Lengths>
class FarthestSearch
{
public:
  /** The hierarchy and the lengths must outlive it. */
  FarthestSearch(const IsodiamondHierarchy& hierarchy, const Lengths& lengths, int surface)
    : InWorld(lengths)
    , Patches(hierarchy, lengths, surface)
  {
  }

  /** Goes on to another diamond. */
  void Reset(const Place& diamond)
  {
    this->Patches.Reset(diamond);
    this->CandidateCount = 0;
  }

  /** The number of one of the diamond's tetrahedra. */
  int Find(const HalfPlace& tetrahedron) const { return this->Patches.Find(tetrahedron); }

  /** Looks at how far isovertices can be from the patch of their tetrahedron.
   *  @return a bound for all of them, squared; infinite without a patch */
  double Propose(
    int tetrahedron, const FinePosition* positions, std::size_t count, Farthest& farthest)
  {
    if (count == 0)
    {
      return 0.0;
    }
    farthest.IsAny = true;
    const float known = this->Patches.LengthsOfBounds().Squared(farthest.Squared);
    const PatchBound<Lengths>* bound = this->Patches.Bound(tetrahedron);
    Candidate* next = this->Room(count);
    std::array<float, Width> bounds;
    bounds.fill(std::numeric_limits<float>::infinity());
    float highest = 0.0F;
    for (std::size_t first = 0; first < count; first += Width)
    {
      const int some = static_cast<int>(std::min<std::size_t>(count - first, Width));
      if (bound != nullptr)
      {
        bounds = bound->Squared(positions + first, some);
      }
      for (int i = 0; i < some; ++i)
      {
        *next = { bounds[i], 1U << tetrahedron, positions[first + i] };
        next += bounds[i] <= known ? 0 : 1;
        highest = bounds[i] <= highest ? highest : bounds[i];
      }
    }
    this->CandidateCount = next - this->Candidates.data();
    return this->Patches.LengthsOfBounds().FromSquared(highest);
  }

  /** The same for one isovertex that some tetrahedra hold.
   *  @param around the edge between them that it lies on, or the edges of the triangle; or none */
  void Propose(std::uint32_t tetrahedra, std::uint32_t around, const FinePosition& position,
    Farthest& farthest)
  {
    const std::uint32_t holders = tetrahedra & this->Patches.AreThere();
    if (holders == 0)
    {
      return;
    }
    farthest.IsAny = true;
    const double squared = this->SquaredToBorder(around, position);
    const float bound = 1.01F * this->Patches.LengthsOfBounds().Squared(squared) + 1e-20F;
    if (!(bound <= this->Patches.LengthsOfBounds().Squared(farthest.Squared)))
    {
      *this->Room(1) = { bound, holders, position };
      ++this->CandidateCount;
    }
  }

  /** The squared distance to where the patches of all tetrahedra meet an edge or a triangle between
   *  them; infinite if they do not. @param around its edges, a mask */
  double SquaredToBorder(std::uint32_t around, const FinePosition& position)
  {
    return this->Patches.BorderIn(around).Squared(this->InWorld(position));
  }

  /** The greatest squared distance to the border of a patch from the isovertices that lie on the
   *  tetrahedron's; infinite if one lies where the patch has none. See MapBounds. */
  double SquaredToBorder(
    int tetrahedron, const HalfPlace& place, const FinePosition* positions, std::size_t count)
  {
    const ClosedTetrahedron closed(place);
    std::array<Border, 15> borders; // by corners around
    std::uint32_t known = 0;
    double greatest = 0.0;
    for (std::size_t first = 0; first < count; first += Width)
    {
      const int some = static_cast<int>(std::min<std::size_t>(count - first, Width));
      const std::array<std::uint32_t, Width> corners =
        closed.CornersAround(positions + first, some);
      for (int i = 0; i < some; ++i)
      {
        if (corners[i] == 0b1111)
        {
          continue;
        }
        Border& border = borders[corners[i]];
        if (((known >> corners[i]) & 1U) == 0)
        {
          known |= 1U << corners[i];
          border = this->Patches.BorderIn(tetrahedron, EdgesBetween(corners[i]));
        }
        greatest = std::max(greatest, border.Squared(this->InWorld(positions[first + i])));
      }
    }
    return greatest;
  }

  /** Measures what was proposed. The isovertex that may be farthest from its own patch goes first:
   *  few others then have to be measured. */
  void Decide(Farthest& farthest)
  {
    const auto begin = this->Candidates.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(this->CandidateCount);
    this->CandidateCount = 0;
    const auto first = std::max_element(
      begin, end, [](const Candidate& a, const Candidate& b) { return a.Bound < b.Bound; });
    if (first == end)
    {
      return;
    }
    this->Measure(*first, farthest);
    float known = this->Patches.LengthsOfBounds().Squared(farthest.Squared);
    for (auto candidate = begin; candidate != end; ++candidate)
    {
      if (!(candidate->Bound <= known) && candidate != first)
      {
        this->Measure(*candidate, farthest);
        known = this->Patches.LengthsOfBounds().Squared(farthest.Squared);
      }
    }
  }

  /** Whether all of a box is sure to be nearer than a distance: distances change no faster than the
   *  place does. */
  bool IsWithin(int tetrahedron, const FineBox& box, double squaredLimit)
  {
    FinePosition centre;
    for (int axis = 0; axis < 3; ++axis)
    {
      centre[axis] = box.Low[axis] + (box.High[axis] - box.Low[axis]) / 2;
    }
    const double limit = std::sqrt(squaredLimit) / (DistanceMargin * DistanceMargin) -
      std::sqrt(this->InWorld.SquaredRadius(box, centre)) * DistanceMargin -
      this->InWorld.Rounding();
    if (limit <= 0.0)
    {
      return false;
    }
    const Vector point = this->InWorld(centre);
    const double own = this->Patches.SquaredTo(tetrahedron, point);
    const double enough = limit * limit;
    return own <= enough ||
      this->Patches.SquaredToNearest(tetrahedron, point, own, enough) <= enough;
  }

private:
  static constexpr int Width = PatchBound<Lengths>::Width;
  using Border = typename DiamondPatches<Lengths>::Border;

  struct Candidate
  {
    float Bound = 0.0F;           ///< of the squared distance to the tetrahedron's own patch
    std::uint32_t Tetrahedra = 0; ///< that hold it, a mask
    FinePosition Position{};
  };

  /** Room for some more candidates. */
  Candidate* Room(std::size_t more)
  {
    if (this->Candidates.size() < this->CandidateCount + more)
    {
      this->Candidates.resize(2 * (this->CandidateCount + more));
    }
    return this->Candidates.data() + this->CandidateCount;
  }

  /** Raises the farthest distance to a candidate's distance from the nearest patch. */
  void Measure(const Candidate& candidate, Farthest& farthest)
  {
    const Vector point = this->InWorld(candidate.Position);
    ForEachBit(candidate.Tetrahedra,
      [&](int tetrahedron)
      {
        const double own = this->Patches.SquaredTo(tetrahedron, point);
        if (own > farthest.Squared)
        {
          farthest.Squared = std::max(farthest.Squared,
            this->Patches.SquaredToNearest(tetrahedron, point, own, farthest.Squared));
        }
      });
  }

  const Lengths& InWorld;
  DiamondPatches<Lengths> Patches;
  std::vector<Candidate> Candidates; ///< the first CandidateCount; memory is kept
  std::size_t CandidateCount = 0;
};

}

#endif
