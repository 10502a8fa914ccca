// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DomainSummary_h
#define isodiamond_DomainSummary_h

#include "Field/Isoregion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

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

/** What has to be known of the range of a domain's samples. */
class WantedRange
{
public:
  /** All of it. */
  WantedRange() = default;
  /** Whether one of a region's surfaces crosses it; if none does, all of it. */
  explicit WantedRange(const Isoregion& region)
    : Region(region)
  {
  }

  /** Whether the range of some of the samples tells what has to be known. */
  bool IsEnough(const ValueRange& some) const
  {
    return this->Region && this->Region->Crosses(some);
  }

private:
  std::optional<Isoregion> Region;
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

  /** Adds what is known of other samples, all of which are finite. */
  SummaryBuilder& Add(const DomainSummary& others)
  {
    this->AddError(others.Error);
    this->Low = std::min(this->Low, others.Range.Minimum);
    this->High = std::max(this->High, others.Range.Maximum);
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

  /** Whether samples of a range, with errors up to a bound, can change what has to be known. */
  bool CanGrow(const ValueRange& range, double bound, const WantedRange& wanted) const
  {
    return bound > this->Error ||
      ((range.Minimum < this->Low || range.Maximum > this->High) && !this->HasEnoughRange(wanted));
  }

  bool HasEnoughRange(const WantedRange& wanted) const
  {
    return wanted.IsEnough({ this->Low, this->High });
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

/** Adds up a summary of samples that are finite. */
class FiniteExtremes
{
public:
  /** @param withRange std::true_type or std::false_type: whether the sample counts for the range */
  template <typename WithRange>
  void Add(double sample, double interpolated, [[maybe_unused]] WithRange withRange)
  {
    const double error = std::fabs(sample - interpolated);
    this->Error = error > this->Error ? error : this->Error;
    this->Sum += error;
    if constexpr (WithRange::value)
    {
      this->Low = sample < this->Low ? sample : this->Low;
      this->High = sample > this->High ? sample : this->High;
    }
  }

  void Add(const FiniteExtremes& others)
  {
    this->Error = std::max(this->Error, others.Error);
    this->Sum += others.Sum;
    this->Low = std::min(this->Low, others.Low);
    this->High = std::max(this->High, others.High);
  }

  /** Whether what was added is finite, and so is the sum of the errors: if not, what is known is
   *  wrong. */
  bool AreFinite() const { return this->Sum < SummaryBuilder::Infinity; }

  ValueRange Range() const { return { this->Low, this->High }; }
  DomainSummary Summary() const { return { this->Error, this->Range() }; }

private:
  double Error = 0.0;
  double Sum = 0.0; ///< of the errors: NaN or infinite from the first sample on that is not finite
  double Low = SummaryBuilder::Infinity;
  double High = -SummaryBuilder::Infinity;
};

}

#endif
