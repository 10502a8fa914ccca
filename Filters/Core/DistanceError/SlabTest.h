// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SlabTest_h
#define isodiamond_SlabTest_h

#include "DistanceError/FineSurface.h"
#include "Field/Bounds.h"
#include "Patches/ConvexPolygon.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isodiamond
{

/** Those cells of another box that a box of index space touches. */
inline CellBox CellsIn(const Bounds& box, const CellBox& whole)
{
  CellBox cells;
  for (int axis = 0; axis < 3; ++axis)
  {
    constexpr double rounding = 1e-6;
    const double last = whole.High[axis];
    const double low = std::clamp(std::floor(box.Low[axis] - rounding), 0.0, last - 1.0);
    const double high = std::clamp(std::ceil(box.High[axis] + rounding), low + 1.0, last);
    cells.Low[axis] = static_cast<int>(low);
    cells.High[axis] = static_cast<int>(high);
  }
  return cells;
}

/** A ball in the world. */
struct Ball
{
  Vector Middle;
  double Radius = 0.0;
};

/** The balls that hold cells, and so their triangles. */
template <typename Lengths>
class CellBalls
{
public:
  explicit CellBalls(const Lengths& lengths)
    : InWorld(lengths)
    , OfAll(this->RadiusOf({ 0, 0, 0 }))
  {
  }

  Ball operator()(const Point& cell) const
  {
    return { this->InWorld(MiddleOf(cell)),
      Lengths::IsLinear ? this->OfAll : this->RadiusOf(cell) };
  }

private:
  static FinePosition MiddleOf(const Point& cell)
  {
    return FineUnits * cell + FinePosition{ FineUnits / 2, FineUnits / 2, FineUnits / 2 };
  }

  double RadiusOf(const Point& cell) const
  {
    FineBox box;
    box.Add(FineUnits * cell);
    box.Add(FineUnits * (cell + Point{ 1, 1, 1 }));
    return std::sqrt(this->InWorld.SquaredRadius(box, MiddleOf(cell)));
  }

  const Lengths& InWorld;
  double OfAll; ///< where lengths are linear
};

/**
 * Whether a surface passes a flat piece within a distance, all over it: it crosses neither of two
 * copies that are moved by the distance, up and down, but does cross the way from one to the other.
 *
 * Only what lies over the piece counts. The surface is closed except at the grid's boundary and at
 * hidden cells: where the copies leave the grid, or come near to a hidden cell, the answer is no.
 */
template <typename Lengths>
class SlabTest
{
public:
  /** @param normal of the piece, of unit length
   *  @param known what is near enough in any case @param limit the greatest distance allowed */
  SlabTest(const ConvexPolygon& piece, const Vector& normal, double known, double limit,
    const FineSurface& fine, const Lengths& lengths, const CellBalls<Lengths>& balls)
    : Piece(piece)
    , Upward(normal)
    , Known(known)
    , Limit(limit)
    , InWorld(lengths)
    , Found(known)
  {
    const CellBox whole = fine.Whole();
    const Bounds box = this->IndexBox(whole);
    if (this->Leaves || fine.AnyHidden(CellsIn(box, whole)))
    {
      return;
    }
    for (int i = 0; i < piece.Count; ++i)
    {
      const Vector& from = piece.Corners[i];
      const Vector& to = piece.Corners[i + 1 == piece.Count ? 0 : i + 1];
      this->Inward[i] = { Cross(normal, to - from), from, lengths };
    }
    // Not at a corner, nor on a line between two: in symmetric surfaces many triangles meet there.
    this->Line = 0.41 * piece.Corners[0] + 0.33 * piece.Corners[1] + 0.26 * piece.Corners[2];
    this->Heights = { normal, this->Line, lengths };
    this->IsClear = fine.ForEachCell(CellsIn(box, whole),
      [&](const Point& cell, const auto& triangles)
      {
        const Ball ball = balls(cell);
        if (this->MayReach(ball))
        {
          const Vector off = Cross(ball.Middle - this->Line, normal);
          const bool isNearLine = Dot(off, off) <= ball.Radius * ball.Radius;
          triangles(
            [&](const FineSurface::Triangle& triangle) { this->Look(triangle, isNearLine); });
        }
        return !this->IsCrossed;
      });
  }

  bool IsBetween() const { return this->IsClear && this->Crossings % 2 == 1; }

  /** How far from the piece the surface is, where it passes between. */
  double Greatest() const { return this->Found; }

private:
  /** Where the piece and its copies are. */
  Bounds IndexBox(const CellBox& whole)
  {
    std::array<Vector, 2 * ConvexPolygon::MostCorners> corners;
    int count = 0;
    for (int i = 0; i < this->Piece.Count; ++i)
    {
      for (const double height : { -this->Limit, this->Limit })
      {
        corners[count++] = this->Piece.Corners[i] + height * this->Upward;
      }
    }
    const Bounds all = this->InWorld.IndexBoxAround(corners.data(), count);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Leaves = this->Leaves || all.Low[axis] < 0.0 || all.High[axis] > whole.High[axis];
    }
    return all;
  }

  /** The signed distance from a plane, times some length. For fine positions it is linear where
   *  lengths are. */
  class Plane
  {
  public:
    Plane() = default;
    Plane(const Vector& normal, const Vector& point, const Lengths& lengths)
      : Normal(normal)
      , Offset(Dot(normal, point))
      , Length(std::sqrt(Dot(normal, normal)))
      , InWorld(&lengths)
    {
      if constexpr (Lengths::IsLinear)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          FinePosition unit{};
          unit[axis] = FineUnits;
          this->InFine[axis] = 1.0 / FineUnits * Dot(normal, lengths(unit));
        }
      }
    }

    const Vector& Across() const { return this->Normal; }
    double operator()(const Vector& point) const { return Dot(this->Normal, point) - this->Offset; }
    double operator()(const FinePosition& p) const
    {
      if constexpr (Lengths::IsLinear)
      {
        return this->InFine[0] * p[0] + this->InFine[1] * p[1] + this->InFine[2] * p[2] -
          this->Offset;
      }
      else
      {
        return (*this)((*this->InWorld)(p));
      }
    }

    /** At the highest point of a ball. */
    double Top(const Ball& ball) const { return (*this)(ball.Middle) + this->Length * ball.Radius; }
    double Bottom(const Ball& ball) const
    {
      return (*this)(ball.Middle) - this->Length * ball.Radius;
    }

  private:
    Vector Normal{};
    double Offset = 0.0;
    double Length = 0.0;
    Vector InFine{};
    const Lengths* InWorld = nullptr;
  };

  /** Whether what a ball holds may be between the copies. */
  bool MayReach(const Ball& ball) const
  {
    const double bottom = this->Heights.Bottom(ball);
    const double top = this->Heights.Top(ball);
    bool mayReach = bottom < this->Limit && top > -this->Limit;
    for (int i = 0; i < this->Piece.Count && mayReach; ++i)
    {
      mayReach = this->Inward[i].Top(ball) >= 0.0;
    }
    return mayReach;
  }

  void Look(const FineSurface::Triangle& triangle, bool isNearLine)
  {
    std::array<double, 3> heights;
    for (int i = 0; i < 3; ++i)
    {
      heights[i] = this->Heights(triangle[i]);
    }
    const double low = std::min({ heights[0], heights[1], heights[2] });
    const double high = std::max({ heights[0], heights[1], heights[2] });
    const bool isBetween = low < this->Limit && high > -this->Limit;
    const bool isKnown = high <= this->Known && low >= -this->Known;
    if (isBetween && (isNearLine || !isKnown) && !this->IsBeside(triangle))
    {
      const std::array<Vector, 3> corners = { this->InWorld(triangle[0]),
        this->InWorld(triangle[1]), this->InWorld(triangle[2]) };
      if (!isKnown)
      {
        this->LookOver(corners);
      }
      this->Crossings += isNearLine && this->CrossesLine(corners, heights) ? 1 : 0;
    }
  }

  /** Whether a triangle lies beyond one of the piece's sides. */
  bool IsBeside(const FineSurface::Triangle& triangle) const
  {
    for (int i = 0; i < this->Piece.Count; ++i)
    {
      const Plane& side = this->Inward[i];
      if (side(triangle[0]) < 0.0 && side(triangle[1]) < 0.0 && side(triangle[2]) < 0.0)
      {
        return true;
      }
    }
    return false;
  }

  /** Looks at what lies over the piece, of a triangle that is not all within what is known. */
  void LookOver(const std::array<Vector, 3>& corners)
  {
    std::array<ConvexPolygon, 2> over;
    int current = 0;
    for (const Vector& corner : corners)
    {
      over[0].Add(corner);
    }
    for (int i = 0; i < this->Piece.Count && !over[current].IsEmpty(); ++i)
    {
      if (over[current].Sides(this->Piece.Corners[i], this->Inward[i].Across())[0] < 0.0)
      {
        KeepAbove(
          over[current], this->Piece.Corners[i], this->Inward[i].Across(), over[1 - current]);
        current = 1 - current;
      }
    }
    if (!over[current].IsEmpty())
    {
      this->CompareHeights(over[current]);
    }
  }

  void CompareHeights(const ConvexPolygon& over)
  {
    const auto [low, high] = over.Sides(this->Line, this->Heights.Across());
    if (low >= this->Limit || high <= -this->Limit)
    {
      return; // another sheet
    }
    this->Found = std::max({ this->Found, high, -low });
    this->IsCrossed = this->IsCrossed || high >= this->Limit || low <= -this->Limit;
  }

  /** Whether the line up and down meets a triangle between the copies. */
  bool CrossesLine(const std::array<Vector, 3>& corners, const std::array<double, 3>& heights) const
  {
    const auto side = [&](int i, int j)
    { return Dot(Cross(corners[i] - this->Line, corners[j] - this->Line), this->Upward); };
    // The weight of each corner where the line is.
    const std::array<double, 3> weights = { side(1, 2), side(2, 0), side(0, 1) };
    const bool isFirst = weights[0] > 0.0;
    if (isFirst != (weights[1] > 0.0) || isFirst != (weights[2] > 0.0))
    {
      return false;
    }
    const double height =
      (weights[0] * heights[0] + weights[1] * heights[1] + weights[2] * heights[2]) /
      (weights[0] + weights[1] + weights[2]);
    return std::abs(height) < this->Limit;
  }

  const ConvexPolygon& Piece;
  Vector Upward;
  Plane Heights; ///< over the piece, along its normal
  double Known;
  double Limit;
  const Lengths& InWorld;
  std::array<Plane, ConvexPolygon::MostCorners> Inward; ///< of the sides
  Vector Line{};                                        ///< the foot of a line across the piece
  bool Leaves = false;                                  ///< the grid
  bool IsClear = false;                                 ///< whether no copy is crossed
  bool IsCrossed = false;
  int Crossings = 0; ///< of the line
  double Found;
};

}

#endif
