// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_WayBack_h
#define isodiamond_WayBack_h

#include "DistanceError/DistanceError.h"
#include "DistanceError/DomainMap.h"
#include "DistanceError/ErrorMaxima.h"
#include "DistanceError/FineSurface.h"
#include "DistanceError/FlatPiece.h"
#include "DistanceError/NearestSearch.h"
#include "DistanceError/SlabTest.h"
#include "DistanceError/SpineNeighbourhood.h"
#include "Patches/ConvexPolygon.h"
#include "Patches/PatchDistance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace isodiamond
{

/**
 * The way back of one diamond: how far a point of its patches can be from the surface of full
 * resolution. A leaf of a mesh lies in one diamond only, so no mates and no stand-ins count.
 *
 * Only what exceeds the error so far is of interest, and most patches are settled by how far a map,
 * of one tetrahedron (MapBounds) or of the domain (DomainMap), moves the surface to them.
 *
 * For the others, move two copies of a flat piece away from it by a distance, one up and one down.
 * If the surface crosses neither, but does cross the way from one to the other, it has to pass
 * between, all over the piece: no point of the piece is farther. Few triangles need a look for
 * that. Pieces that this does not settle are cut, until the nearest triangles decide.
 *
 * The result is the greatest distance, or more by at most 1/4 unless cells are extremely uneven;
 * never less.
 */
template <typename Lengths>
class WayBack
{
public:
  /** @param fine the surface with that number. All must outlive it. */
  WayBack(const IsodiamondHierarchy& hierarchy, const Lengths& lengths, int surface,
    const FineSurface& fine, const ErrorCode& code)
    : Hierarchy(hierarchy)
    , Neighbourhood(hierarchy)
    , InWorld(lengths)
    , Surface(surface)
    , Fine(fine)
    , Code(code)
    , Nearest(fine, lengths)
    , Map(hierarchy, lengths, surface)
    , Least(lengths.TypicalStep() / 64.0)
  {
  }

  /** The greater of a diamond's error so far and its way back.
   *  @param bounds of the way forth
   *  @param isWhole whether no cell in the domain is hidden: maps do not know of hidden cells */
  double Measure(
    const Place& diamond, const MapBounds::OfDiamond& bounds, double error, bool isWhole)
  {
    return std::max(error, this->BoundAbove(diamond, bounds, error, isWhole));
  }

  /** Whether the way back of a diamond is surely no longer than `most`. It may say no from 8/9 of
   *  that on, and after MostLooks. */
  bool IsWithin(const Place& diamond, const MapBounds::OfDiamond& bounds, double most, bool isWhole)
  {
    this->Most = most;
    const double bound = this->BoundAbove(diamond, bounds, most / (1.0 + Precision), isWhole);
    const bool isWithin = bound <= most && !this->IsBeyondMost();
    this->Most = HUGE_VAL;
    return isWithin;
  }

private:
  /** By what part bounds can exceed what is known: those of maps; of maps, once what was in the way
   *  has been compared with what is nearest; of pieces. */
  static constexpr double MapPrecision = 1.0 / 16.0;
  static constexpr double ComparedPrecision = 1.0 / 4.0;
  static constexpr double Precision = 1.0 / 8.0;
  /** How often pieces of one diamond are compared with what is nearest before bounds are taken as
   *  they are. Few diamonds need so many: those with cells a million times longer than wide. */
  static constexpr int MostLooks = 500;
  /** How many cells are worth gathering. */
  static constexpr std::int64_t MostCells = 1000;

  /** A bound of the way back, as far as it exceeds what is known. */
  double BoundAbove(
    const Place& diamond, const MapBounds::OfDiamond& bounds, double known, bool isWhole)
  {
    this->Known = this->Most < HUGE_VAL ? known : std::max(known, this->Least);
    this->Bound = 0.0;
    this->Left = MostLooks;
    this->HasNearby = false;
    this->Nearest.Clear();
    this->Hard.Clear();
    this->Neighbourhood.FindPatches(diamond, this->Surface, this->Patches);
    for (const NumberedPatch& patch : this->Patches)
    {
      if (patch.Patch.TriangleCount > 0 && !(isWhole && this->IsBounded(patch, bounds)))
      {
        this->Hard.Add(patch);
      }
    }
    const bool isMapped =
      !this->Hard.IsEmpty() && isWhole && diamond.Scale <= 1 && this->IsDomainMapped(diamond);
    if (!isMapped)
    {
      for (const NumberedPatch& patch : this->Hard)
      {
        this->MeasureFrom(patch);
      }
    }
    return this->Bound;
  }

  /** What a bound may be: more than what is known by a part of it, or all that is allowed. */
  double Limit(double part) const
  {
    return this->Most < HUGE_VAL ? this->Most : (1.0 + part) * this->Known;
  }

  /** Whether something is too far away, whatever else there is. */
  bool IsBeyondMost() const
  {
    return (1.0 + Precision) * this->Known > DistanceMargin * this->Most;
  }

  Vector Corner(const HalfPlace& tetrahedron, int edge) const
  {
    return this->InWorld(IsovertexOn(this->Hierarchy, tetrahedron, edge, this->Surface));
  }

  /** Whether a bound of a piece is good enough, as it exceeds what is known by little. */
  bool IsAccepted(double bound)
  {
    if (!(bound <= this->Limit(Precision)))
    {
      return false;
    }
    this->Bound = std::max(this->Bound, bound);
    return true;
  }

  /** Whether the isovertices in a tetrahedron bound the way back from its patch. */
  bool IsBounded(const NumberedPatch& hard, const MapBounds::OfDiamond& bounds)
  {
    const double limit = this->Limit(MapPrecision);
    const ErrorCode::Type code = bounds[hard.Number];
    double bound = code != MapBounds::None ? this->Code.Decode(code) : HUGE_VAL;
    if (bound <= limit && hard.Patch.TriangleCount == 2)
    {
      bound += BendOf(hard.Patch, this->CornersOf(hard));
    }
    if (!(bound <= limit))
    {
      return false;
    }
    this->Bound = std::max(this->Bound, bound);
    return true;
  }

  /** Whether a map of the domain bounds the way back. What exceeds what is known is measured. */
  bool IsDomainMapped(const Place& diamond)
  {
    return this->BoundByMap(diamond, MapPrecision) < HUGE_VAL ||
      (this->Most == HUGE_VAL && this->BoundByMap(diamond, ComparedPrecision) < HUGE_VAL);
  }

  double BoundByMap(const Place& diamond, double precision)
  {
    const auto isWithin = [&](double squared, double part)
    {
      const double limit = this->Limit(part);
      return squared <= limit * limit;
    };
    const auto isNear = [&](double squared) { return isWithin(squared, precision); };
    const double bound = this->Map.Bound(diamond, this->Patches, isNear,
      [&](const Vector& place, double squared)
      {
        if (!isNear(squared) && squared < HUGE_VAL)
        {
          this->FindNearest(place, this->Known);
        }
        return isWithin(squared, ComparedPrecision);
      });
    this->Bound = bound < HUGE_VAL ? std::max(this->Bound, bound) : this->Bound;
    return bound;
  }

  std::array<Vector, 6> CornersOf(const NumberedPatch& hard) const
  {
    std::array<Vector, 6> corners; // by edge
    std::uint32_t known = 0;
    for (int i = 0; i < hard.Patch.TriangleCount; ++i)
    {
      for (const std::uint8_t edge : hard.Patch.Triangles[i])
      {
        if (((known >> edge) & 1U) == 0)
        {
          known |= 1U << edge;
          corners[edge] = this->Corner(hard.Tetrahedron, edge);
        }
      }
    }
    return corners;
  }

  void MeasureFrom(const NumberedPatch& hard)
  {
    if (this->IsBeyondMost())
    {
      return;
    }
    const SurfacePatch& patch = hard.Patch;
    const std::array<Vector, 6> corners = this->CornersOf(hard);
    if (patch.TriangleCount == 2)
    {
      const FlatPiece both = Flatten(patch, corners);
      if (both.Bend <= 0.25 * this->Known && this->IsBetween(both))
      {
        return;
      }
    }
    for (int i = 0; i < patch.TriangleCount; ++i)
    {
      const std::array<std::uint8_t, 3>& edges = patch.Triangles[i];
      const ConvexPolygon triangle = { 3,
        { corners[edges[0]], corners[edges[1]], corners[edges[2]] } };
      const Vector across =
        Cross(triangle.Corners[1] - triangle.Corners[0], triangle.Corners[2] - triangle.Corners[0]);
      this->MeasureFrom({ triangle, Direction(across), 0.0 });
    }
  }

  /** Measures all of a piece, in smaller ones. */
  void MeasureFrom(const FlatPiece& whole)
  {
    if (this->IsBetween(whole))
    {
      return;
    }
    this->GatherNearby();
    this->Pieces.assign(1, whole.Polygon);
    // Its corners lie on the surface, but for rounding: there is nothing to be found.
    this->Seen.assign(
      whole.Polygon.Corners.begin(), whole.Polygon.Corners.begin() + whole.Polygon.Count);
    while (!this->Pieces.empty() && !this->IsBeyondMost())
    {
      const ConvexPolygon piece = this->Pieces.back();
      this->Pieces.pop_back();
      this->CompareWithNearest(piece);
    }
  }

  /** Whether the surface passes a piece within what is known, all over it. */
  bool IsBetween(const FlatPiece& piece)
  {
    // Within so large a distance other sheets pass too, and the nearest triangles tell as soon.
    const Vector middle = piece.Polygon.Middle();
    if (this->Known * this->Known > piece.Polygon.SquaredRadius(middle))
    {
      return false;
    }
    const SlabTest<Lengths> test(piece.Polygon, piece.Normal, this->Known - piece.Bend,
      this->Limit(Precision) - piece.Bend, this->Fine, this->InWorld, this->Nearest.Balls());
    return test.IsBetween() && this->IsAccepted(test.Greatest() + piece.Bend);
  }

  /** Compares a piece with the triangle nearest to its middle; cuts it if it is not near enough. */
  void CompareWithNearest(const ConvexPolygon& piece)
  {
    if (this->IsNearToFound(piece))
    {
      return;
    }
    const Vector middle = piece.Middle();
    const double radius = std::sqrt(piece.SquaredRadius(middle));
    const NearestTriangle nearest = this->FindNearest(middle, std::max(this->Known - radius, 0.0));
    const double bound = std::sqrt(nearest.Squared) + radius;
    if ((bound <= this->Known || radius <= Precision / 2.0 * this->Known) &&
      this->IsAccepted(bound))
    {
      return;
    }
    const Vector& farthest = FarthestCorner(piece, nearest.Triangle);
    const double distance = std::sqrt(nearest.Triangle.Squared(farthest));
    if (--this->Left < 0)
    {
      this->Bound = std::max(this->Bound, std::min(bound, distance));
      return;
    }
    if (this->IsAccepted(distance)) // as distances to a triangle are convex
    {
      return;
    }
    if (std::find(this->Seen.begin(), this->Seen.end(), farthest) == this->Seen.end())
    {
      this->Seen.push_back(farthest);
      this->FindNearest(farthest, this->Known);
      if (this->IsAccepted(distance))
      {
        return;
      }
    }
    this->CutUp(piece, nearest.Triangle);
  }

  /** Whether all of a piece is within what is known of a triangle that was found: often one found
   *  for a piece beside it. */
  bool IsNearToFound(const ConvexPolygon& piece)
  {
    const double enough = this->Known * this->Known;
    for (int i = 0; i < this->Nearest.FoundCount(); ++i)
    {
      double squared = 0.0;
      for (int j = 0; j < piece.Count && squared <= enough; ++j)
      {
        squared = std::max(squared, this->Nearest.Found(i).Squared(piece.Corners[j]));
      }
      if (squared <= enough)
      {
        this->Bound = std::max(this->Bound, std::sqrt(squared));
        return true;
      }
    }
    return false;
  }

  static const Vector& FarthestCorner(const ConvexPolygon& piece, const TriangleDistance& triangle)
  {
    return *std::max_element(piece.Corners.begin(), piece.Corners.begin() + piece.Count,
      [&](const Vector& a, const Vector& b) { return triangle.Squared(a) < triangle.Squared(b); });
  }

  /** Cuts a piece into what lies over a triangle and what lies beyond its sides; in halves if all
   *  but slivers lies on one side. */
  void CutUp(const ConvexPolygon& piece, const TriangleDistance& triangle)
  {
    constexpr int many = 6;
    if (piece.Count > many)
    {
      for (int i = 2; i < piece.Count; ++i)
      {
        this->Pieces.push_back({ 3, { piece.Corners[0], piece.Corners[i - 1], piece.Corners[i] } });
      }
      return;
    }
    const double sliver = Precision / 2.0 * this->Known;
    ConvexPolygon rest = piece;
    bool isCut = false;
    for (int side = 0; side < 3 && rest.Count <= many; ++side)
    {
      const TriangleDistance::Wall wall = triangle.WallOf(side);
      const Vector outward = Direction(wall.Outward);
      const auto [least, greatest] = rest.Sides(wall.Point, outward);
      if (least < -sliver && greatest > sliver)
      {
        isCut = true;
        ConvexPolygon part;
        KeepAbove(rest, wall.Point, outward, part);
        this->Push(part);
        KeepAbove(rest, wall.Point, -1.0 * outward, part);
        rest = part;
      }
    }
    if (!isCut)
    {
      this->Halve(rest);
    }
    else if (!this->IsAccepted(DistanceTo(triangle, rest)))
    {
      this->Push(rest);
    }
  }

  /** How far a piece is from a triangle: nothing of it is farther than its corners. */
  static double DistanceTo(const TriangleDistance& triangle, const ConvexPolygon& piece)
  {
    double squared = 0.0;
    for (int i = 0; i < piece.Count; ++i)
    {
      squared = std::max(squared, triangle.Squared(piece.Corners[i]));
    }
    return std::sqrt(squared);
  }

  void Push(const ConvexPolygon& piece)
  {
    if (!piece.IsEmpty())
    {
      this->Pieces.push_back(piece);
    }
  }

  void CutAt(const ConvexPolygon& piece, const Vector& point, const Vector& normal)
  {
    for (const double side : { -1.0, 1.0 })
    {
      ConvexPolygon part;
      KeepAbove(piece, point, side * normal, part);
      this->Push(part);
    }
  }

  /** Gathers what is near to the patches that are still to be measured, once per diamond. */
  void GatherNearby()
  {
    if (this->HasNearby)
    {
      return;
    }
    this->HasNearby = true;
    const double reach = std::min(1.25 * this->Known, 0.5 * this->InWorld.TypicalStep());
    Bounds all;
    for (const NumberedPatch& hard : this->Hard)
    {
      const SurfacePatch& patch = hard.Patch;
      const std::array<Vector, 6> corners = this->CornersOf(hard);
      for (int j = 0; j < patch.TriangleCount; ++j)
      {
        for (const std::uint8_t edge : patch.Triangles[j])
        {
          all.Add(this->InWorld.IndexBox(corners[edge], reach));
        }
      }
    }
    const CellBox cells = CellsIn(all, this->Fine.Whole());
    if (cells.Size() <= MostCells)
    {
      this->Nearest.Gather(cells);
    }
  }

  /** The nearest triangle, or one that is near enough: what is known rises to its distance. */
  NearestTriangle FindNearest(const Vector& point, double enough)
  {
    const NearestTriangle nearest = this->Nearest.Find(point, enough);
    this->Known = std::max(this->Known, std::sqrt(nearest.Squared));
    return nearest;
  }

  /** Cuts across the longest way from one corner to another. */
  void Halve(const ConvexPolygon& piece)
  {
    Vector longest{};
    Vector middle{};
    for (int i = 0; i < piece.Count; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        const Vector way = piece.Corners[i] - piece.Corners[j];
        if (Dot(way, way) > Dot(longest, longest))
        {
          longest = way;
          middle = 0.5 * (piece.Corners[i] + piece.Corners[j]);
        }
      }
    }
    this->CutAt(piece, middle, longest);
  }

  const IsodiamondHierarchy& Hierarchy;
  SpineNeighbourhood Neighbourhood;
  const Lengths& InWorld;
  int Surface;
  const FineSurface& Fine;
  ErrorCode Code;
  NearestSearch<Lengths> Nearest;
  DomainMap<Lengths> Map;
  double Least;            ///< what is less is no error
  double Known = 0.0;      ///< the error is not less: the one so far, or a distance found
  double Bound = 0.0;      ///< nothing that was looked at is farther
  double Most = HUGE_VAL;  ///< what is farther need not be measured
  int Left = 0;            ///< how many more looks are worth it
  bool HasNearby = false;  ///< whether what is near to the diamond has been gathered
  NumberedPatches Patches; ///< of the diamond
  NumberedPatches Hard;    ///< those that are still to be measured
  std::vector<ConvexPolygon> Pieces;
  std::vector<Vector> Seen; ///< corners of pieces that were looked at
};

}

#endif
