// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Interpolant_h
#define isodiamond_Interpolant_h

#include "DiamondTables.h"
#include "Samples.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace isodiamond
{

/**
 * The interpolant of one diamond, piecewise linear over its tetrahedra, in closed form.
 *
 * Offsets are relative to the central vertex. Along every axis it is linear between *knots*,
 * where the axis crosses the planes between the tetrahedra; all knots are lattice points.
 */
template <typename T>
class Interpolant
{
public:
  Interpolant(const Grid& grid, const SampleView<T>& samples, const Place& place)
    : Half(1 << place.Scale)
    , Shape(ShapeOf(place.Position))
  {
    const Point centre = this->Half * place.Position;
    for (int i = 0; i < this->Shape.VertexCount; ++i)
    {
      const Point vertex = centre + this->Half * this->Shape.Offsets[i];
      this->At(this->Shape.Offsets[i]) = grid.IsSampled(vertex) ? samples(vertex) : 0.0;
    }
    this->End = this->Shape.Offsets[this->Shape.Spine[0]];
    this->Middle = 0.5 * (this->At(this->End) + this->At(-1 * this->End));
    this->OddAxes = Parity(place.Position);
    this->SingleAxis = this->FindSingleAxis();
  }

  /** The value at an offset inside the domain. */
  double operator()(const Point& offset)
  {
    switch (this->Shape.DiamondClass)
    {
      case 0:
        return this->InCube(offset);
      case 1:
        return this->InSquareBipyramid(offset);
      default:
        return this->InRingBipyramid(offset);
    }
  }

  /** The slope along x on a piece of a row between two knots. @param doubledX begin + end, twice a
   *  place inside of the piece. */
  double SlopeAlongX(int doubledX, int y, int z)
  {
    switch (this->Shape.DiamondClass)
    {
      case 0:
        return this->SlopeInCube(doubledX, y, z);
      case 1:
        return this->SlopeInSquareBipyramid(doubledX, y, z);
      default:
        return this->SlopeInRingBipyramid(doubledX, y, z);
    }
  }

  /** Whether the domain, which is symmetric, has a point at distances from the centre along the
   *  axes. */
  bool Holds(const std::array<int, 3>& distance) const
  {
    if (this->Shape.DiamondClass == 0)
    {
      return std::max({ distance[0], distance[1], distance[2] }) <= this->Half;
    }
    const int a = (this->SingleAxis + 1) % 3;
    const int b = (this->SingleAxis + 2) % 3;
    return distance[this->SingleAxis] + std::max(distance[a], distance[b]) <= this->Half;
  }

  /** Half the extent of the domain along x for given y and z offsets; negative if empty. */
  int Reach(int y, int z) const
  {
    if (this->Shape.DiamondClass == 0)
    {
      return this->Half;
    }
    // Bipyramids over a square: height along the single axis, |other two| <= h - |height|.
    switch (this->SingleAxis)
    {
      case 0:
        return this->Half - std::max(std::abs(y), std::abs(z));
      case 1:
        return std::abs(z) > this->Half - std::abs(y) ? -1 : this->Half - std::abs(y);
      default:
        return std::abs(y) > this->Half - std::abs(z) ? -1 : this->Half - std::abs(z);
    }
  }

  /** Inner knots along x for given y and z offsets, ascending. @return their number. */
  int Knots(int y, int z, std::array<int, 3>& knots) const
  {
    switch (this->Shape.DiamondClass)
    {
      case 0: // the planes between the orders of the reflected coordinates
        knots = { this->End[0] * this->End[1] * y, this->End[0] * this->End[2] * z, 0 };
        std::sort(knots.begin(), knots.begin() + 2);
        return 2;
      case 1: // the plane of the square, or the one through the spine
        knots = { 0, 0, 0 };
        if (this->SingleAxis != 0)
        {
          knots[0] = this->SingleAxis == 1 ? this->End[0] * this->End[2] * z
                                           : this->End[0] * this->End[1] * y;
        }
        return 1;
      default: // the planes through the spine
      {
        const int side = std::abs(this->SingleAxis == 1 ? z : y);
        knots = { -side, 0, side };
        return this->SingleAxis == 0 ? 0 : 3;
      }
    }
  }

private:
  double& At(const Point& offset)
  {
    return this->Values[(offset[0] + 1) + 3 * (offset[1] + 1) + 9 * (offset[2] + 1)];
  }

  /** The axis that stands alone: class 1 the even one, class 2 the odd one. */
  int FindSingleAxis() const
  {
    const int single = this->Shape.DiamondClass == 1 ? 7 & ~this->OddAxes : this->OddAxes;
    return single == 1 ? 0 : (single == 2 ? 1 : 2);
  }

  /** Class 0: along the spine coordinates grow from 0 to 2h; sorted, they name the tetrahedron. */
  double InCube(const Point& offset)
  {
    std::array<int, 3> axes = { 0, 1, 2 };
    std::array<int, 3> along{};
    for (int axis = 0; axis < 3; ++axis)
    {
      along[axis] = this->End[axis] * offset[axis] + this->Half;
    }
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return along[a] > along[b]; });
    Point corner = -1 * this->End;
    double sum = (2 * this->Half - along[axes[0]]) * this->At(corner);
    for (int i = 0; i < 3; ++i)
    {
      const int next = i < 2 ? along[axes[i + 1]] : 0;
      corner[axes[i]] = this->End[axes[i]];
      sum += (along[axes[i]] - next) * this->At(corner);
    }
    return sum / (2 * this->Half);
  }

  double SlopeInCube(int doubledX, int y, int z)
  {
    // Over an edge along x, from where the axes that are farther along the spine have moved.
    Point corner = -1 * this->End;
    const int x = this->End[0] * doubledX;
    corner[1] = 2 * this->End[1] * y > x ? this->End[1] : corner[1];
    corner[2] = 2 * this->End[2] * z > x ? this->End[2] : corner[2];
    const double before = this->At(corner);
    corner[0] = this->End[0];
    return this->End[0] * (this->At(corner) - before) / (2 * this->Half);
  }

  /** Class 1: a square cut by the spine into two triangles, and an apex on either side. */
  double InSquareBipyramid(const Point& offset)
  {
    const int a = (this->SingleAxis + 1) % 3;
    const int b = (this->SingleAxis + 2) % 3;
    const int alongA = this->End[a] * offset[a];
    const int alongB = this->End[b] * offset[b];
    Point corner = { 0, 0, 0 };
    corner[a] = alongA >= alongB ? this->End[a] : -this->End[a];
    corner[b] = alongA >= alongB ? -this->End[b] : this->End[b];
    Point apex = { 0, 0, 0 };
    apex[this->SingleAxis] = offset[this->SingleAxis] > 0 ? 1 : -1;
    const double spine = 0.5 * (this->At(this->End) - this->At(-1 * this->End));
    const double sum = (alongA + alongB) * spine +
      std::abs(alongA - alongB) * (this->At(corner) - this->Middle) +
      2.0 * std::abs(offset[this->SingleAxis]) * (this->At(apex) - this->Middle);
    return this->Middle + sum / (2 * this->Half);
  }

  double SlopeInSquareBipyramid(int doubledX, int y, int z)
  {
    const int side = doubledX > 0 ? 1 : -1;
    if (this->SingleAxis == 0)
    {
      return side * (this->At({ side, 0, 0 }) - this->Middle) / this->Half;
    }
    const int other = 3 - this->SingleAxis;
    const bool ahead = this->End[0] * doubledX > 2 * this->End[other] * (other == 1 ? y : z);
    Point corner = { ahead ? this->End[0] : -this->End[0], 0, 0 };
    corner[other] = ahead ? -this->End[other] : this->End[other];
    const double spine = 0.5 * (this->At(this->End) - this->At(-1 * this->End));
    const double outward = this->At(corner) - this->Middle;
    return this->End[0] * (ahead ? spine + outward : spine - outward) / (2 * this->Half);
  }

  /** Class 2: eight triangles around the spine. */
  double InRingBipyramid(const Point& offset)
  {
    const int a = (this->SingleAxis + 1) % 3;
    const int b = (this->SingleAxis + 2) % 3;
    const bool nearA = std::abs(offset[a]) >= std::abs(offset[b]);
    const int major = nearA ? a : b;
    const int minor = nearA ? b : a;
    Point onAxis = { 0, 0, 0 };
    onAxis[major] = offset[major] > 0 ? 1 : -1;
    Point diagonal = onAxis;
    diagonal[minor] = offset[minor] > 0 ? 1 : -1;
    const double spine = 0.5 * (this->At(this->End) - this->At(-1 * this->End));
    const int outward = std::abs(offset[major]);
    const int sideward = std::abs(offset[minor]);
    double sum = this->End[this->SingleAxis] * offset[this->SingleAxis] * spine;
    if (outward > 0)
    {
      sum += (outward - sideward) * (this->At(onAxis) - this->Middle);
    }
    if (sideward > 0)
    {
      sum += sideward * (this->At(diagonal) - this->Middle);
    }
    return this->Middle + sum / this->Half;
  }

  double SlopeInRingBipyramid(int doubledX, int y, int z)
  {
    if (this->SingleAxis == 0)
    {
      const double spine = 0.5 * (this->At(this->End) - this->At(-1 * this->End));
      return this->End[0] * spine / this->Half;
    }
    const int other = 3 - this->SingleAxis;
    const int across = other == 1 ? y : z;
    const int side = doubledX > 0 ? 1 : -1;
    if (std::abs(doubledX) > 2 * std::abs(across))
    {
      return side * (this->At({ side, 0, 0 }) - this->Middle) / this->Half;
    }
    Point onAxis = { 0, 0, 0 };
    onAxis[other] = across > 0 ? 1 : -1;
    const double before = this->At(onAxis);
    onAxis[0] = side;
    return side * (this->At(onAxis) - before) / this->Half;
  }

  int Half;
  const TypeTable& Shape;
  int OddAxes = 0;
  int SingleAxis = 0;
  Point End{};
  double Middle = 0.0;
  std::array<double, 27> Values{};
};

}

#endif
