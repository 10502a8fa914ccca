// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_NearestSearch_h
#define isodiamond_NearestSearch_h

#include "DistanceError/CellBox.h"
#include "DistanceError/FineSurface.h"
#include "DistanceError/NearbyTriangles.h"
#include "DistanceError/SlabTest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isodiamond
{

/**
 * Finds the triangle of full resolution that is nearest to a point.
 *
 * It is meant for many points near to each other: the triangles found last are good guesses, those
 * in cells that were gathered are compared next, and others only as far away as they could be
 * nearer.
 */
template <typename Lengths>
class NearestSearch
{
public:
  /** Both must outlive it. */
  NearestSearch(const FineSurface& fine, const Lengths& lengths)
    : Fine(fine)
    , InWorld(lengths)
    , TheBalls(lengths)
    , Nearby(lengths)
  {
  }

  /** Around the surface in each cell. */
  const CellBalls<Lengths>& Balls() const { return this->TheBalls; }

  /** Forgets what was found and gathered, to begin elsewhere. */
  void Clear()
  {
    this->Count = 0;
    this->Nearby.Clear();
  }

  /** Makes what is in some cells faster to search. */
  void Gather(const CellBox& cells) { this->Nearby.Gather(this->Fine, cells); }

  /** The nearest triangle, or one that is near enough. */
  NearestTriangle Find(const Vector& point, double enough)
  {
    // Those that were found are good guesses: pieces lie side by side.
    double guess = std::numeric_limits<double>::infinity();
    const TriangleDistance* guessed = nullptr;
    for (int i = 0; i < this->FoundCount(); ++i)
    {
      const double squared = this->Last[i].Squared(point);
      if (squared < guess)
      {
        guess = squared;
        guessed = &this->Last[i];
      }
    }
    NearestTriangle nearest;
    if (guessed != nullptr)
    {
      nearest = { guess, *guessed };
    }
    const double squaredEnough = enough * enough;
    if (nearest.Squared > squaredEnough)
    {
      this->Nearby.FindNearer(point, squaredEnough, nearest);
    }
    if (nearest.Squared > squaredEnough)
    {
      this->LookFarther(point, squaredEnough, nearest);
    }
    if (nearest.Squared < guess)
    {
      this->Last[this->Count++ % MostFound] = nearest.Triangle;
    }
    return nearest;
  }

  ///@{
  /** The triangles found last, in no order. */
  int FoundCount() const { return std::min(this->Count, MostFound); }
  const TriangleDistance& Found(int i) const { return this->Last[i]; }
  ///@}

private:
  /** How many of the triangles found are kept. */
  static constexpr int MostFound = 4;

  /** Looks farther and farther away, at last wherever something may be nearer than what was found.
   */
  void LookFarther(const Vector& point, double squaredEnough, NearestTriangle& nearest) const
  {
    CellBox done = this->Nearby.Cells();
    double radius = 0.5 * this->StepAt(point);
    bool isAll = false;
    while (nearest.Squared > squaredEnough && !isAll)
    {
      const double found = std::sqrt(nearest.Squared);
      isAll = found <= 2.0 * radius;
      const CellBox box =
        CellsIn(this->InWorld.IndexBox(point, isAll ? found : radius), this->Fine.Whole());
      isAll = isAll || (box.Low == this->Fine.Whole().Low && box.High == this->Fine.Whole().High);
      if (!done.Holds(box))
      {
        this->Fine.ForEachCell(box,
          [&](const Point& cell, const auto& triangles)
          {
            if (!done.Holds(cell) && this->MayBeNearer(cell, point, nearest))
            {
              triangles([&](const FineSurface::Triangle& corners)
                { this->Compare(point, corners, nearest); });
            }
            return nearest.Squared > squaredEnough;
          });
        done = box;
      }
      radius *= 2.0;
    }
  }

  /** About how far away other cells are. */
  double StepAt(const Vector& point) const
  {
    if constexpr (Lengths::IsLinear)
    {
      return this->InWorld.TypicalStep();
    }
    else
    {
      return this->InWorld.StepIn(
        CellsIn(this->InWorld.IndexBox(point, 0.0), this->Fine.Whole()).Low);
    }
  }

  bool MayBeNearer(const Point& cell, const Vector& point, const NearestTriangle& nearest) const
  {
    const Ball ball = this->TheBalls(cell);
    const Vector to = ball.Middle - point;
    // Whether |to| < the radius and the distance together, without roots.
    const double beyond = Dot(to, to) - ball.Radius * ball.Radius - nearest.Squared;
    return beyond < 0.0 || beyond * beyond < 4.0 * ball.Radius * ball.Radius * nearest.Squared;
  }

  void Compare(
    const Vector& point, const FineSurface::Triangle& corners, NearestTriangle& nearest) const
  {
    const Vector a = this->InWorld(corners[0]);
    const Vector b = this->InWorld(corners[1]);
    const Vector c = this->InWorld(corners[2]);
    const Vector normal = Cross(b - a, c - a);
    const double height = Dot(point - a, normal);
    if (height * height > nearest.Squared * Dot(normal, normal))
    {
      return; // even its plane is farther
    }
    const TriangleDistance triangle(a, b, c);
    const double squared = triangle.Squared(point);
    if (squared < nearest.Squared)
    {
      nearest = { squared, triangle };
    }
  }

  const FineSurface& Fine;
  const Lengths& InWorld;
  CellBalls<Lengths> TheBalls;
  NearbyTriangles<Lengths> Nearby; ///< in cells that were gathered
  int Count = 0;                   ///< of all that were found
  std::array<TriangleDistance, MostFound> Last;
};

}

#endif
