// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_AffineMap_h
#define isodiamond_AffineMap_h

#include <array>

namespace isodiamond
{

/** An affine map from index space to the world: Rows * (x, y, z, 1). */
struct AffineMap
{
  std::array<std::array<double, 4>, 3> Rows = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 },
    { 0, 0, 1, 0 } } };

  std::array<double, 3> operator()(double x, double y, double z) const
  {
    return { this->At(0, x, y, z), this->At(1, x, y, z), this->At(2, x, y, z) };
  }

  /** One coordinate in the world. */
  double At(int axis, double x, double y, double z) const
  {
    const std::array<double, 4>& row = this->Rows[axis];
    return row[0] * x + row[1] * y + row[2] * z + row[3];
  }

  /** Determinant of the linear part. */
  double Determinant() const
  {
    const auto& r = this->Rows;
    return r[0][0] * this->Cofactor(0, 0) + r[0][1] * this->Cofactor(0, 1) +
      r[0][2] * this->Cofactor(0, 2);
  }

  /** Whether the map reverses orientation; triangles then wind the other way in index space. */
  bool Mirrors() const { return this->Determinant() < 0.0; }

  /** Cofactor of the linear part; the cofactor matrix maps normals, up to the determinant. */
  double Cofactor(int i, int j) const
  {
    const auto& a = this->Rows[(i + 1) % 3];
    const auto& b = this->Rows[(i + 2) % 3];
    return a[(j + 1) % 3] * b[(j + 2) % 3] - a[(j + 2) % 3] * b[(j + 1) % 3];
  }

  /** The index space point of a world point. @pre the determinant is not 0 */
  std::array<double, 3> Inverse(const std::array<double, 3>& world) const
  {
    const double determinant = this->Determinant();
    std::array<double, 3> index{};
    for (int j = 0; j < 3; ++j)
    {
      double sum = 0.0;
      for (int i = 0; i < 3; ++i)
      {
        sum += this->Cofactor(i, j) * (world[i] - this->Rows[i][3]);
      }
      index[j] = sum / determinant;
    }
    return index;
  }
};

}

#endif
