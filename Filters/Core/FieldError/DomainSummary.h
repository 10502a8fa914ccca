// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DomainSummary_h
#define isodiamond_DomainSummary_h

#include "Field/Samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isodiamond
{

/** What the samples in a diamond's closed domain (the union of its tetrahedra) say. */
struct DomainSummary
{
  /** max |F - linear interpolation| over the lattice points of the domain, in field units;
   *  infinite where the interpolant is undefined: the diamond sticks out of the grid, or a sample
   *  of the domain is not finite. Paper, section 4.2. */
  double Error = 0.0;
  /** Range of the sampled lattice points of the domain; the minimum is NaN if one of them is. If
   *  there are none, the minimum exceeds the maximum. */
  ValueRange Range;
};

/** Adds up a summary, sample by sample. */
class SummaryBuilder
{
public:
  static constexpr double Infinity = std::numeric_limits<double>::infinity();

  /** Notes a lower bound of the error. */
  SummaryBuilder& AddError(double error)
  {
    this->Error = std::max(this->Error, error);
    return *this;
  }

  /** The findings as values whose maxima over several builders are the findings of all. */
  std::array<double, 4> AsMaxima() const
  {
    return { this->Error, -this->Low, this->High, this->HasNaN ? 1.0 : 0.0 };
  }
  static SummaryBuilder OfMaxima(const std::array<double, 4>& maxima)
  {
    SummaryBuilder sums;
    sums.Error = maxima[0];
    sums.Low = -maxima[1];
    sums.High = maxima[2];
    sums.HasNaN = maxima[3] > 0.0;
    return sums;
  }

  template <typename T>
  void Add(T sample, double interpolated)
  {
    const auto value = static_cast<double>(sample);
    const double error = std::fabs(value - interpolated);
    this->Error = error > this->Error ? error : this->Error; // never NaN
    this->Low = value < this->Low ? value : this->Low;
    this->High = value > this->High ? value : this->High;
    this->HasNaN |= sample != sample;
  }

  /** Whether samples of a range, with errors up to a bound, can change the summary. */
  bool CanGrow(const ValueRange& range, double bound) const
  {
    return bound > this->Error || range.Minimum < this->Low || range.Maximum > this->High;
  }

  /** NaN counts as below every surface: it becomes the minimum, and the maximum if it is alone. */
  DomainSummary Result() const
  {
    const bool isFinite = !this->HasNaN && this->Low != -Infinity && this->High != Infinity;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    DomainSummary summary{ isFinite ? this->Error : Infinity, { this->Low, this->High } };
    if (this->HasNaN)
    {
      summary.Range = { nan, this->Low > this->High ? nan : this->High };
    }
    return summary;
  }

private:
  double Error = 0.0;
  double Low = Infinity;
  double High = -Infinity;
  bool HasNaN = false;
};

}

#endif
