// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PatchBound_h
#define isodiamond_PatchBound_h

#include "Patches/SurfacePatch.h"
#include "Patches/WorldLengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace isodiamond
{

/**
 * Lengths for bounds: the world's lengths as numbers of 32 bits, in a unit of about one lattice
 * step, so that their squares neither vanish nor overflow.
 */
template <typename Lengths>
class BoundLengths
{
public:
  /** @param lengths must outlive it */
  explicit BoundLengths(const Lengths& lengths)
    : World(lengths)
    , PerUnit(1.0 / lengths.TypicalStep())
    , PerSquaredUnit(1.0 / (lengths.TypicalStep() * lengths.TypicalStep()))
    , AbsoluteError(static_cast<float>(lengths.Rounding() / lengths.TypicalStep()))
  {
    if constexpr (Lengths::IsLinear)
    {
      this->SetFactor(lengths.Factor(), lengths.TypicalStep());
    }
    else
    {
      this->Factor = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
      this->RelativeError = LeastRelativeError;
    }
  }

  /** Offsets of positions from an origin: on the lattice or, where lengths are not linear in these,
   *  as lengths. Factor turns either into lengths. */
  void Offsets(const FinePosition& origin, const FinePosition* positions, int count, float* x,
    float* y, float* z) const
  {
    if constexpr (Lengths::IsLinear)
    {
      for (int i = 0; i < count; ++i)
      {
        const FinePosition& position = positions[i];
        x[i] = static_cast<float>(position[0] - origin[0]);
        y[i] = static_cast<float>(position[1] - origin[1]);
        z[i] = static_cast<float>(position[2] - origin[2]);
      }
    }
    else
    {
      const Vector start = this->World(origin);
      for (int i = 0; i < count; ++i)
      {
        const Vector offset = this->PerUnit * (this->World(positions[i]) - start);
        x[i] = static_cast<float>(offset[0]);
        y[i] = static_cast<float>(offset[1]);
        z[i] = static_cast<float>(offset[2]);
      }
    }
  }

  /** Squared lengths of the world, to and from squared units. */
  float Squared(double squared) const { return static_cast<float>(squared * this->PerSquaredUnit); }
  double FromSquared(float squared) const { return squared / this->PerSquaredUnit; }

private:
  static constexpr float LeastRelativeError = 4e-6F;

  void SetFactor(const std::array<std::array<double, 3>, 3>& factor, double unit)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int row = 0; row < 3; ++row)
      {
        this->Factor[row][axis] = static_cast<float>(factor[row][axis] / unit / FineUnits);
      }
    }
    // How much longer than a vector its parts along the axes can be.
    const double shear = std::abs(factor[0][1]) / factor[1][1] +
      (std::abs(factor[0][2]) + std::abs(factor[1][2])) / factor[2][2];
    const double condition = (1.0 + 2.0 * shear) * (1.0 + 2.0 * shear);
    this->RelativeError = condition < 1000.0 ? static_cast<float>(4e-6 * condition)
                                             : std::numeric_limits<float>::infinity();
  }

  const Lengths& World;
  double PerUnit;
  double PerSquaredUnit;

public:
  /** Upper triangular. */
  std::array<std::array<float, 3>, 3> Factor{};
  /** More than what rounding changes in sums of a few lengths: relative to these, and independently
   *  of them. */
  float RelativeError = 0.0F;
  float AbsoluteError;
};

/**
 * Upper bounds of the distances of several positions at once to the patch of a tetrahedron.
 *
 * A bound is the distance to a nearby point of the patch; for positions over the patch, and near
 * two of a triangle's sides, to the nearest. This takes no branches, only short loops over numbers
 * of 32 bits, which compilers turn into vector instructions.
 */
template <typename Lengths>
class PatchBound
{
public:
  static constexpr int Width = 8; ///< positions at once

  /** @param cornerAt gives the isovertex on an edge of the patch's half-tetrahedron
   *  @pre the patch is not empty */
  template <typename CornerAt>
  void Reset(const BoundLengths<Lengths>& lengths, const SurfacePatch& patch, CornerAt&& cornerAt)
  {
    this->InBounds = &lengths;
    this->Origin = cornerAt(patch.Triangles[0][0]);
    this->Count = patch.TriangleCount;
    float extent = 0.0F;
    for (int i = 0; i < this->Count; ++i)
    {
      Triangle& triangle = this->Triangles[i];
      triangle.Start = this->Place(cornerAt(patch.Triangles[i][0]));
      triangle.First = this->Place(cornerAt(patch.Triangles[i][1]));
      triangle.Second = this->Place(cornerAt(patch.Triangles[i][2]));
      for (int axis = 0; axis < 3; ++axis)
      {
        triangle.First[axis] -= triangle.Start[axis];
        triangle.Second[axis] -= triangle.Start[axis];
      }
      triangle.Complete();
      extent = std::max({ extent, triangle.Extent(), Length(triangle.Start) });
    }
    // (a + b)^2 <= 1.01 a^2 + 101 b^2; plus what is lost where numbers are too small.
    const float error = lengths.RelativeError * extent + lengths.AbsoluteError;
    this->Slack = 101.0F * error * error + 1e-30F;
  }

  /** Bounds of squared distances, in the units of the lengths; NaN where there is none.
   *  @param count of the positions, at least 1 and at most Width */
  std::array<float, Width> Squared(const FinePosition* positions, int count) const
  {
    std::array<float, Width> x;
    std::array<float, Width> y;
    std::array<float, Width> z;
    x.fill(0.0F);
    y.fill(0.0F);
    z.fill(0.0F);
    this->InBounds->Offsets(this->Origin, positions, count, x.data(), y.data(), z.data());
    const auto& f = this->InBounds->Factor;
    for (int i = 0; i < Width; ++i)
    {
      x[i] = f[0][0] * x[i] + f[0][1] * y[i] + f[0][2] * z[i];
      y[i] = f[1][1] * y[i] + f[1][2] * z[i];
      z[i] = f[2][2] * z[i];
    }
    std::array<float, Width> squared = this->Triangles[0].Squared(x, y, z);
    if (this->Count > 1)
    {
      const std::array<float, Width> second = this->Triangles[1].Squared(x, y, z);
      for (int i = 0; i < Width; ++i)
      {
        squared[i] = squared[i] < second[i] ? squared[i] : second[i];
      }
    }
    for (int i = 0; i < Width; ++i)
    {
      squared[i] = 1.01F * squared[i] + this->Slack;
    }
    return squared;
  }

private:
  using Vector32 = std::array<float, 3>;

  static float Dot(const Vector32& a, const Vector32& b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static float Length(const Vector32& a) { return std::sqrt(Dot(a, a)); }

  struct Triangle
  {
    Vector32 Start{};
    Vector32 First{};
    Vector32 Second{};
    Vector32 AlongFirst{}; ///< barycentric coordinate as a dot product
    float PerFirst = 0.0F;
    float PerSecond = 0.0F; ///< inverse squared lengths

    void Complete()
    {
      const float first = Dot(this->First, this->First);
      const float second = Dot(this->Second, this->Second);
      const float both = Dot(this->First, this->Second);
      this->PerFirst = 1.0F / first;
      this->PerSecond = 1.0F / second;
      const float inverse = 1.0F / (first * second - both * both);
      for (int axis = 0; axis < 3; ++axis)
      {
        this->AlongFirst[axis] = inverse * (second * this->First[axis] - both * this->Second[axis]);
      }
    }
    float Extent() const { return Length(this->First) + Length(this->Second); }

    /** The distance to any point of the triangle is a bound: how exact its coordinates are does
     *  not matter. */
    std::array<float, Width> Squared(const std::array<float, Width>& x,
      const std::array<float, Width>& y, const std::array<float, Width>& z) const
    {
      std::array<float, Width> squared;
      const Vector32 start = this->Start;
      const Vector32 first = this->First;
      const Vector32 second = this->Second;
      const Vector32 along = this->AlongFirst;
      const Vector32 unitFirst = { this->PerFirst * first[0], this->PerFirst * first[1],
        this->PerFirst * first[2] };
      const Vector32 unitSecond = { this->PerSecond * second[0], this->PerSecond * second[1],
        this->PerSecond * second[2] };
      // Comparisons would keep some compilers from making vector instructions.
      const auto positive = [](float value) { return 0.5F * (value + std::abs(value)); };
      const auto within = [&](float value, float most)
      { return positive(most - positive(most - value)); };
      for (int i = 0; i < Width; ++i)
      {
        const float px = x[i] - start[0];
        const float py = y[i] - start[1];
        const float pz = z[i] - start[2];
        // Seen along the normal; then the nearest along one side, then along the other.
        const float u = within(along[0] * px + along[1] * py + along[2] * pz, 1.0F);
        const float v = within(unitSecond[0] * (px - u * first[0]) +
            unitSecond[1] * (py - u * first[1]) + unitSecond[2] * (pz - u * first[2]),
          1.0F - u);
        const float qx = px - v * second[0];
        const float qy = py - v * second[1];
        const float qz = pz - v * second[2];
        const float w = within(unitFirst[0] * qx + unitFirst[1] * qy + unitFirst[2] * qz, 1.0F - v);
        const float rx = qx - w * first[0];
        const float ry = qy - w * first[1];
        const float rz = qz - w * first[2];
        squared[i] = rx * rx + ry * ry + rz * rz;
      }
      return squared;
    }
  };

  Vector32 Place(const FinePosition& position) const
  {
    float x = 0.0F;
    float y = 0.0F;
    float z = 0.0F;
    this->InBounds->Offsets(this->Origin, &position, 1, &x, &y, &z);
    const auto& f = this->InBounds->Factor;
    return { f[0][0] * x + f[0][1] * y + f[0][2] * z, f[1][1] * y + f[1][2] * z, f[2][2] * z };
  }

  const BoundLengths<Lengths>* InBounds = nullptr;
  FinePosition Origin{};
  int Count = 0;
  std::array<Triangle, 2> Triangles;
  float Slack = 0.0F;
};

}

#endif
