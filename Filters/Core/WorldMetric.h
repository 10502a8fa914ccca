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
 * but orientation and origin do not matter, by the upper triangular factor of the map's metric.
 */
class WorldMetric
{
public:
  explicit WorldMetric(const AffineMap& world)
  {
    const auto metric = [&](int i, int j)
    {
      double sum = 0.0;
      for (const std::array<double, 4>& row : world.Rows)
      {
        sum += row[i] * row[j];
      }
      return sum;
    };
    // Cholesky: rows of the factor one after the other.
    for (int i = 0; i < 3; ++i)
    {
      for (int j = i; j < 3; ++j)
      {
        double rest = metric(i, j);
        for (int k = 0; k < i; ++k)
        {
          rest -= this->Factor[k][i] * this->Factor[k][j];
        }
        this->Factor[i][j] = i == j ? std::sqrt(rest) : rest / this->Factor[i][i];
      }
    }
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
