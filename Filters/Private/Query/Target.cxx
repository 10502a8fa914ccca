// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Query/Target.h"

#include "Private/Common/Arrays.h"

#include "vtkAlgorithm.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

namespace vtkIsodiamond
{
namespace
{

using isodiamond::ErrorCode;

/** The least tolerance that accepts a code. */
double ToleranceOf(const ErrorCode& codes, int code)
{
  return code == 0 ? 0.0 : codes.Decode(static_cast<ErrorCode::Type>(code));
}

std::int64_t CellsAt(const std::vector<const isodiamond::CellCounts*>& counts, double tolerance)
{
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 },
    [&](std::int64_t sum, const isodiamond::CellCounts* one) { return sum + one->At(tolerance); });
}

/** The i-th tolerance, from the largest one down, among 1, 2 and 5 times powers of ten. */
double RoundTolerance(double largest, int i)
{
  constexpr double digits[] = { 5.0, 2.0, 1.0 };
  double power = std::pow(10.0, std::floor(std::log10(largest)));
  int digit = 0;
  while (digit < 2 && digits[digit] * power > largest * (1.0 + 1e-9))
  {
    ++digit;
  }
  for (digit += i; digit >= 3; digit -= 3)
  {
    power /= 10.0;
  }
  return digits[digit] * power;
}

}

CountedTolerance LeastTolerance(
  const std::vector<const isodiamond::CellCounts*>& counts, std::int64_t target)
{
  if (counts.empty())
  {
    return {};
  }
  const ErrorCode& codes = counts.front()->Codes();
  CountedTolerance coarsest{ 0.0, -1 };
  for (int code = 0; code < ErrorCode::Always; ++code)
  {
    const double tolerance = ToleranceOf(codes, code);
    const std::int64_t cells = CellsAt(counts, tolerance);
    if (cells <= target)
    {
      return { tolerance, cells };
    }
    if (cells != coarsest.Cells)
    {
      coarsest = { tolerance, cells };
    }
  }
  return coarsest;
}

CountedTolerance LeastTolerance(const ErrorCode& codes, std::int64_t target,
  const std::function<std::int64_t(double tolerance)>& cellsAt)
{
  const auto at = [&](int code)
  {
    const double tolerance = ToleranceOf(codes, code);
    return CountedTolerance{ tolerance, cellsAt(tolerance) };
  };
  CountedTolerance found = at(0);
  if (found.Cells <= target)
  {
    return found;
  }
  int above = 0;
  int below = ErrorCode::Always - 1;
  found = at(below);
  while (found.Cells <= target && below - above > 1)
  {
    const int middle = (above + below) / 2;
    const CountedTolerance tried = at(middle);
    if (tried.Cells <= target)
    {
      found = tried;
      below = middle;
    }
    else
    {
      above = middle;
    }
  }
  return found;
}

namespace
{

/** Tolerances that differ by a factor, and by less, where no other one has few enough cells. */
constexpr double TargetStep = 4.0;
constexpr double SmallTargetStep = 1.5;

/** Tolerances that have been tried, of which the best one is kept. */
class Trials
{
public:
  Trials(std::int64_t target, const std::function<std::int64_t(double tolerance)>& cellsAt)
    : Target(target)
    , CellsAt(cellsAt)
  {
  }

  CountedTolerance At(double tolerance)
  {
    const CountedTolerance tried{ tolerance, this->CellsAt(tolerance) };
    const auto rank = [this](const CountedTolerance& one)
    { return std::pair(this->HasFew(one) ? std::int64_t{ 0 } : one.Cells, one.Tolerance); };
    if (rank(tried) < rank(this->TheBest))
    {
      this->TheBest = tried;
    }
    return tried;
  }

  bool HasFew(const CountedTolerance& tried) const { return tried.Cells <= this->Target; }

  /** The least tolerance with few enough cells, or with the fewest if none has. */
  const CountedTolerance& Best() const { return this->TheBest; }

private:
  std::int64_t Target;
  const std::function<std::int64_t(double tolerance)>& CellsAt;
  CountedTolerance TheBest{ 0.0, std::numeric_limits<std::int64_t>::max() };
};

/** Goes up to a tolerance with few enough cells. @param many a tolerance with too many; afterwards
 *  one that is nearer @param last that may be tried
 *  @return last if no other one has few enough */
CountedTolerance FirstWithFew(double& many, const CountedTolerance& last, Trials& trials)
{
  while (TargetStep * many < last.Tolerance)
  {
    const CountedTolerance tried = trials.At(TargetStep * many);
    if (trials.HasFew(tried))
    {
      return tried;
    }
    many = tried.Tolerance;
  }
  return last;
}

/** Tries what is between two tolerances with too many cells, until one has few enough. */
CountedTolerance BestBetween(double least, double most, Trials& trials)
{
  for (double tolerance = most / SmallTargetStep;
       tolerance > least && !trials.HasFew(trials.Best()); tolerance /= SmallTargetStep)
  {
    trials.At(tolerance);
  }
  return trials.Best();
}

/** Goes down as long as there are few cells; down to 0, if need be: below some tolerance,
 *  triangles for simulations no longer increase. @param many afterwards a tolerance with too many
 *  cells, or one that is low enough; 0 if 0 has few */
CountedTolerance LastWithFew(CountedTolerance few, Trials& trials, double& many)
{
  constexpr int steps = 4;
  for (int i = 0; i <= steps; ++i)
  {
    const double tolerance = i < steps ? few.Tolerance / TargetStep : 0.0;
    const CountedTolerance tried = trials.At(tolerance);
    if (!trials.HasFew(tried))
    {
      many = i < steps ? tolerance : few.Tolerance / TargetStep;
      return few;
    }
    few = tried;
  }
  return few;
}

}

CountedTolerance LeastToleranceBelow(double guess, double largest, std::int64_t target,
  const std::function<std::int64_t(double tolerance)>& cellsAt)
{
  constexpr int bisections = 6;
  constexpr double leastPart = 1.0 / 4096.0; // of the largest, if full resolution was the guess
  Trials trials(target, cellsAt);
  CountedTolerance few = trials.At(std::min(guess, largest));
  double many = 0.0; // a tolerance with too many cells, once there is one
  if (!trials.HasFew(few))
  {
    // A coarser mesh can have a few more cells: what is between is tried even if the last has many.
    const double least = few.Tolerance > 0.0 ? few.Tolerance : leastPart * largest;
    many = least;
    few = FirstWithFew(many, trials.At(largest), trials);
    if (!trials.HasFew(few))
    {
      return BestBetween(least, largest, trials);
    }
  }
  else if (few.Tolerance > 0.0)
  {
    few = LastWithFew(few, trials, many);
  }
  for (int i = 0; i < bisections && many > 0.0; ++i)
  {
    const CountedTolerance tried = trials.At(std::sqrt(many * few.Tolerance));
    if (trials.HasFew(tried))
    {
      few = tried;
    }
    else
    {
      many = tried.Tolerance;
    }
  }
  return trials.Best();
}

void WarnIfAbove(vtkAlgorithm* filter, const CountedTolerance& found, std::int64_t target)
{
  if (found.Cells > target)
  {
    vtkWarningWithObjectMacro(filter,
      "The mesh has " << found.Cells
                      << " cells, and none with fewer was found: more than the target of " << target
                      << ". PreserveTopology and PreserveFeatures keep what a coarser one "
                      << "would lose; MinimumPieceSize removes specks.");
  }
}

void WriteCounts(const std::vector<const isodiamond::CellCounts*>& counts, const char* cells,
  double largest, double unit, vtkFieldData* output)
{
  constexpr int steps = 9;
  const std::string prefix = std::string(cells) + " at tolerance ";
  AddNumber<vtkTypeInt64Array>(output, (prefix + "0").c_str(), CellsAt(counts, 0.0));
  for (int i = steps - 1; i >= 0; --i)
  {
    const double tolerance = RoundTolerance(largest / unit, i);
    std::ostringstream number;
    number << tolerance;
    AddNumber<vtkTypeInt64Array>(
      output, (prefix + number.str()).c_str(), CellsAt(counts, tolerance * unit));
  }
}

}
