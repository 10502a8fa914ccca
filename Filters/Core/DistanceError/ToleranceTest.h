// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ToleranceTest_h
#define isodiamond_ToleranceTest_h

#include "DistanceError/Bisection.h"
#include "DistanceError/DistanceTests.h"
#include "DistanceError/ErrorMaxima.h"
#include "DistanceError/FarthestSearch.h"
#include "DistanceError/IsovertexReader.h"
#include "DistanceError/WayBack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace isodiamond
{

/**
 * Tests whether single diamonds exceed what is tolerated of them, on one surface: first the way
 * forth, then the way back. Used for one diamond after another, by one thread.
 *
 * Isovertices are read from the domain, and a single one that is too far away settles it.
 */
template <typename Lengths>
class ToleranceTest
{
public:
  /** All must outlive it. */
  ToleranceTest(const TestedSurface& surface, const TestedHierarchy& tested, const Lengths& lengths)
    : Tested(tested)
    , Hierarchy(tested.Relevant)
    , InWorld(lengths)
    , Reader(this->Hierarchy, tested.IsFinite, surface.Number)
    , Neighbourhood(this->Hierarchy)
    , Search(this->Hierarchy, lengths, surface.Number)
    , Back(this->Hierarchy, lengths, surface.Number, surface.Fine, tested.Code)
  {
  }

  bool Exceeds(const Place& diamond, ErrorCode::Type accepted)
  {
    this->Begin(diamond, accepted);
    const bool isWithin = diamond.Scale <= 1 ? this->IsSmallDomainWithin() : this->IsDomainWithin();
    return !isWithin || (this->Far.IsAny && !this->IsBackWithin());
  }

private:
  /** Diamonds from this scale on are few, and no map of one tetrahedron is near enough. */
  static constexpr int CoarseScale = 4;

  /** A tetrahedron around the spine, with isovertices in it. */
  struct Part
  {
    bool IsThere = false;
    HalfPlace Place;
    ClosedTetrahedron Closed; ///< of a domain that is not small
    std::vector<FinePosition> Held;
    double SquaredBack = 0.0; ///< bounds the way back
  };

  void Begin(const Place& diamond, ErrorCode::Type accepted)
  {
    this->Diamond = diamond;
    this->Accepted = accepted;
    const double tolerated = this->Tested.Code.Decode(accepted) / (DistanceMargin * DistanceMargin);
    this->Tolerated = tolerated * tolerated;
    this->Far = { this->Tolerated, false };
    this->HasNone = HasNoInterpolant(this->Hierarchy.SampleGrid(), this->Tested.IsFinite, diamond);
    this->Search.Reset(diamond);
    for (Part& part : this->Parts)
    {
      part.IsThere = false;
    }
    this->Neighbourhood.ForEachTetrahedron(diamond, false,
      [&](int number, const HalfPlace& tetrahedron)
      {
        Part& part = this->Parts[number];
        part.IsThere = IsInGrid(this->Hierarchy.SampleGrid(), tetrahedron);
        part.Place = tetrahedron;
        part.SquaredBack = 0.0;
      });
    this->Clear();
  }

  void Clear()
  {
    this->Positions.clear();
    this->NotFinite.clear();
    this->OnBorders.clear();
    for (Part& part : this->Parts)
    {
      part.Held.clear();
    }
  }

  /** Finds isovertices by a table. */
  bool IsSmallDomainWithin()
  {
    bool isFinite = true;
    this->Reader.ForEachInDomain(this->Diamond,
      [&](const FinePosition& position, bool areEndsFinite, const FineDomain::Edge& edge)
      {
        if (edge.Around != 0)
        {
          this->OnBorders.push_back({ position, &edge });
        }
        ForEachBit(edge.Tetrahedra,
          [&](int number)
          {
            this->Parts[number].Held.push_back(position);
            isFinite = isFinite && (areEndsFinite || !this->Parts[number].IsThere);
          });
      });
    if (!isFinite || !this->AreHeldWithin())
    {
      return false;
    }
    for (const auto& [position, edge] : this->OnBorders)
    {
      const double squared = this->Search.SquaredToBorder(edge->Around, position);
      ForEachBit(edge->Tetrahedra,
        [&, squared = squared](int number)
        {
          double& back = this->Parts[number].SquaredBack;
          back = std::max(back, squared);
        });
    }
    return true;
  }

  /** Reads some isovertices at a time: often the first ones settle it. */
  bool IsDomainWithin()
  {
    for (Part& part : this->Parts)
    {
      if (part.IsThere)
      {
        part.Closed = ClosedTetrahedron(part.Place);
      }
    }
    const int h = 1 << this->Diamond.Scale;
    const Point low = Centre(this->Diamond) + Point{ -h, -h, -h };
    const Point high = Centre(this->Diamond) + Point{ h, h, h };
    return this->Reader.ForEachEighth(low, high,
      [&](const auto& eighth, const Point& origin)
      {
        this->Clear();
        eighth([&](const FinePosition& position, bool areEndsFinite)
          { (areEndsFinite ? this->Positions : this->NotFinite).push_back(position); });
        this->Rows.Fill(this->Positions, FineUnits * origin);
        return this->AreReadWithin();
      });
  }

  bool AreReadWithin()
  {
    for (Part& part : this->Parts)
    {
      if (part.IsThere && !(this->Positions.empty() && this->NotFinite.empty()))
      {
        if (std::any_of(this->NotFinite.begin(), this->NotFinite.end(),
              [&](const FinePosition& position) { return part.Closed.Holds(position); }))
        {
          return false;
        }
        this->FindHeld(part);
      }
    }
    return this->AreHeldWithin();
  }

  void FindHeld(Part& part)
  {
    part.Closed.FindHeld(this->Rows, this->Sides);
    for (std::size_t i = 0; i < this->Positions.size(); ++i)
    {
      if (this->Sides[i] >= 0.0F)
      {
        part.Held.push_back(this->Positions[i]);
      }
    }
  }

  /** Whether no isovertex that the tetrahedra hold is too far away. */
  bool AreHeldWithin()
  {
    for (std::size_t number = 0; number < this->Parts.size(); ++number)
    {
      Part& part = this->Parts[number];
      if (part.IsThere && !part.Held.empty() &&
        (this->HasNone || !this->IsPartWithin(static_cast<int>(number), part)))
      {
        return false;
      }
    }
    return true;
  }

  bool IsPartWithin(int number, Part& part)
  {
    const double squared =
      this->Search.Propose(number, part.Held.data(), part.Held.size(), this->Far);
    this->Search.Decide(this->Far);
    if (this->Far.Squared == std::numeric_limits<double>::infinity() &&
      !this->Tested.PreserveFeatures)
    {
      this->Far.Squared =
        SquaredDiameter(this->Hierarchy.SampleGrid(), this->InWorld, this->Diamond);
    }
    if (this->Far.Squared > this->Tolerated &&
      this->Tested.Code.Encode(std::sqrt(this->Far.Squared) * DistanceMargin) > this->Accepted)
    {
      return false;
    }
    part.SquaredBack = std::max(part.SquaredBack, squared);
    // A bound above the tolerance is no help. In small domains a table tells what is on borders.
    if (part.SquaredBack <= this->Tolerated && this->Diamond.Scale > 1 &&
      this->Diamond.Scale < CoarseScale)
    {
      part.SquaredBack = std::max(part.SquaredBack,
        this->Search.SquaredToBorder(number, part.Place, part.Held.data(), part.Held.size()));
    }
    return true;
  }

  bool IsBackWithin()
  {
    MapBounds::OfDiamond bounds = MapBounds::NoneOfDiamond;
    for (std::size_t number = 0; number < this->Parts.size() && this->Diamond.Scale < CoarseScale;
         ++number)
    {
      bounds[number] =
        this->Tested.Code.Encode(std::sqrt(this->Parts[number].SquaredBack) * DistanceMargin);
    }
    const HiddenCells* const hidden = this->Tested.Hidden;
    return this->Back.IsWithin(this->Diamond, bounds,
      this->Tested.Code.Decode(this->Accepted) / DistanceMargin,
      hidden == nullptr || !hidden->Touch(this->Diamond));
  }

  const TestedHierarchy& Tested;
  const IsodiamondHierarchy& Hierarchy;
  const Lengths& InWorld;
  IsovertexReader Reader;
  SpineNeighbourhood Neighbourhood;
  FarthestSearch<Lengths> Search;
  WayBack<Lengths> Back;
  Place Diamond;
  ErrorCode::Type Accepted = 0;
  double Tolerated = 0.0;              ///< squared
  bool HasNone = false;                ///< whether the diamond has no interpolant
  Farthest Far;                        ///< the farthest isovertex, or what is tolerated
  std::array<Part, 8> Parts;           ///< by number
  std::vector<FinePosition> Positions; ///< read in the domain, of edges with finite ends
  std::vector<FinePosition> NotFinite; ///< the others
  std::vector<std::pair<FinePosition, const FineDomain::Edge*>> OnBorders; ///< of tetrahedra
  PositionRows Rows;
  std::vector<float> Sides; ///< of these: not negative in a tetrahedron
};

/** Tests diamonds on one surface. @param exceeds one entry per diamond, to be set where it does */
template <typename Lengths>
void TestAll(const TestedSurface& surface, const TestedHierarchy& tested, const Lengths& lengths,
  const std::vector<TestedDiamond>& diamonds, std::vector<std::uint8_t>& exceeds,
  const ParallelFor& parallelFor)
{
  // Diamonds of the first rounds are few and coarse, and each is much work.
  int coarsest = 0;
  for (const TestedDiamond& tested : diamonds)
  {
    coarsest = std::max(coarsest, tested.Diamond.Scale);
  }
  parallelFor(static_cast<std::int64_t>(diamonds.size()),
    std::max(64 >> (2 * std::min(coarsest, 3)), 1),
    [&](std::int64_t begin, std::int64_t end)
    {
      ToleranceTest<Lengths> test(surface, tested, lengths);
      for (std::int64_t i = begin; i < end; ++i)
      {
        exceeds[i] = exceeds[i] != 0 || test.Exceeds(diamonds[i].Diamond, diamonds[i].Accepted);
      }
    });
}

}

#endif
