// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ErrorCode_h
#define isodiamond_ErrorCode_h

#include <cmath>
#include <cstdint>
#include <cstring>

namespace isodiamond
{

/**
 * Errors in 14 bits: a floating-point code, monotone, relative precision 2^-9, rounded up.
 *
 * With `code = 512 e + m` the value is `scale * (1 + m / 512) * 2^(e - 31)`, where the scale is
 * the largest error that the volume and the metric allow. Decode(Encode(x)) >= x, so a test with
 * the code can subdivide too much (by 0.2 %), never too little. Code 0 means "no error of its
 * own" and is stored only where an interior tolerance alone can subdivide; the top code decodes to
 * infinity: always subdivided.
 */
class ErrorCode
{
public:
  using Type = std::uint16_t;

  static constexpr Type Always = 0x3fff;
  static constexpr Type Least = 1;

  /** @param scale the largest possible error, in the metric's units; 1 if that is not positive. */
  explicit ErrorCode(double scale = 1.0)
    : ScaleValue(scale > 0.0 && std::isfinite(scale) ? scale : 1.0)
  {
  }

  double Scale() const { return this->ScaleValue; }

  /** The error that a code stands for. */
  double Decode(Type code) const
  {
    if (code >= Always)
    {
      return HUGE_VAL;
    }
    // 1 + i / 512, and a power of two, as the bits of doubles.
    const double mantissa = FromBits((Bias << 52) | (std::uint64_t{ code & 511U } << 43));
    const double power = FromBits((Bias - 31 + (code >> 9)) << 52);
    return this->ScaleValue * mantissa * power;
  }

  /** The smallest code >= Least whose value is not below the error; Always for NaN and beyond. */
  Type Encode(double error) const
  {
    const double relative = error / this->ScaleValue;
    if (!(relative <= 1.5)) // also NaN; errors beyond the scale come from overflow only
    {
      return Always;
    }
    if (!(relative > std::ldexp(1.0, -31)))
    {
      return Least;
    }
    // The exponent and nine more bits of the double, rounded up.
    const std::uint64_t bits = ToBits(relative);
    const std::uint64_t rounded = (bits + (std::uint64_t{ 1 } << 43) - 1) >> 43;
    int code = static_cast<int>(rounded - ((Bias - 31) << 9));
    while (code < Always && this->Decode(static_cast<Type>(code)) < error)
    {
      ++code; // the division may have rounded down
    }
    while (code > Least && this->Decode(static_cast<Type>(code - 1)) >= error)
    {
      --code; // or up
    }
    return code < Least ? Least : static_cast<Type>(code);
  }

  /**
   * The largest code that a tolerance accepts: a diamond is subdivided iff its code is greater.
   * Always - 1 for an infinite tolerance; 0 for tolerance 0 (and for anything not positive).
   */
  Type Accepted(double tolerance) const
  {
    int low = 0;
    int high = Always - 1;
    while (low < high)
    {
      const int middle = (low + high + 1) / 2;
      if (this->Decode(static_cast<Type>(middle)) <= tolerance)
      {
        low = middle;
      }
      else
      {
        high = middle - 1;
      }
    }
    return static_cast<Type>(low);
  }

private:
  static constexpr std::uint64_t Bias = 1023; ///< of a double's exponent

  static double FromBits(std::uint64_t bits)
  {
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  static std::uint64_t ToBits(double value)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    return bits;
  }

  double ScaleValue;
};

}

#endif
