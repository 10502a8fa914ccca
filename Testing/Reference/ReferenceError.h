// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceError_h
#define ReferenceError_h

namespace reference
{

/**
 * Errors as a file keeps them, in 14 bits. A code c from 1 to 16382 stands for the error
 * scale * (1 + m / 512) * 2^(e - 31), with c = 512 e + m and m < 512; the last code, 16383, for an
 * infinite error. An error gets the first code whose error is not less. Errors of more than 1.5
 * scales do not occur; they would count as infinite.
 */
class ErrorCodes
{
public:
  static constexpr int Infinite = 16383;

  explicit ErrorCodes(double scale);

  double ErrorOf(int code) const;
  /** NaN counts as infinite. */
  int CodeOf(double error) const;
  /** The last code whose error is not greater than a tolerance; 0 if there is none. */
  int LastWithin(double tolerance) const;

private:
  double Scale;
};

}

#endif
