// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_WorldMetric_h
#define isodiamond_WorldMetric_h

#include "AffineMap.h"
#include "FinePlane.h"
#include "Vector.h"

#include <array>
#include <cmath>

namespace isodiamond
{

/**
 * World lengths in index space: maps fine positions to a space in which distances are the world's
 * but orientation and origin do not matter, by the upper triangular factor of the map.
 */
class WorldMetric
{
public:
  explicit WorldMetric(const AffineMap& world)
  {
    // Gram-Schmidt on the columns.
    std::array<Vector, 3> directions{};
    for (int j = 0; j < 3; ++j)
    {
      Vector rest = { world.Rows[0][j], world.Rows[1][j], world.Rows[2][j] };
      for (int i = 0; i < j; ++i)
      {
        this->Factor[i][j] = Dot(directions[i], rest);
        rest = rest - this->Factor[i][j] * directions[i];
      }
      this->Factor[j][j] = std::hypot(rest[0], rest[1], rest[2]);
      directions[j] = { rest[0] / this->Factor[j][j], rest[1] / this->Factor[j][j],
        rest[2] / this->Factor[j][j] };
    }
  }

  /** Whether the world has lengths along all axes. */
  bool IsValid() const
  {
    return this->Factor[0][0] > 0.0 && this->Factor[1][1] > 0.0 && this->Factor[2][2] > 0.0 &&
      std::isfinite(this->Factor[0][0] + this->Factor[1][1] + this->Factor[2][2]);
  }

  Vector operator()(double x, double y, double z) const
  {
    const auto& f = this->Factor;
    return { f[0][0] * x + f[0][1] * y + f[0][2] * z, f[1][1] * y + f[1][2] * z, f[2][2] * z };
  }
  Vector operator()(const FinePosition& p) const
  {
    constexpr double unit = 1.0 / FineUnits;
    return (*this)(unit * p[0], unit * p[1], unit * p[2]);
  }

private:
  std::array<std::array<double, 3>, 3> Factor{};
};

}

#endif
