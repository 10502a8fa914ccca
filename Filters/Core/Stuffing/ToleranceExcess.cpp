// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/ToleranceExcess.h"

#include "Simplification/PartDistance.h"
#include "Stuffing/MeasuredSurfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace isodiamond
{
namespace
{

/** How often a length is doubled until it suffices. */
constexpr int MostDoublings = 8;

/** How often what is between a length that suffices and one that does not is halved. */
constexpr int Halvings = 4;

/** Measures surfaces with longer and shorter allowances. What is near enough stays so with a longer
 *  one, so that only what was too far away is looked at again. */
class LongerAllowances
{
public:
  LongerAllowances(MeasuredSurfaces& surfaces, const ParallelFor& parallelFor)
    : Part(surfaces.Part)
    , Allowed(surfaces.Part.Allowances)
    , Homes(surfaces.Homes())
    , ForAll(parallelFor)
    , Distance(surfaces.Part, false, true)
  {
  }

  /** What is too far away. */
  struct Far
  {
    NearLists Near; ///< of the part
    std::vector<bool> Triangles;
    bool IsAny = true;
  };
  Far All() const
  {
    return { this->Part.Near, std::vector<bool>(this->Part.Simple.Triangles.size(), true) };
  }

  /** @param before what is too far away with less */
  Far With(double length, const Far& before)
  {
    std::transform(this->Allowed.begin(), this->Allowed.end(), this->Part.Allowances.begin(),
      [&](double allowed) { return allowed + length; });
    this->Part.Near = before.Near;
    const PartDistance::Faults faults =
      this->Distance.Find(this->Part.Simple, this->Homes, before.Triangles, this->ForAll);
    Far far{ this->Part.Near, std::vector<bool>(before.Triangles.size()),
      !faults.Triangles.empty() };
    for (const std::uint32_t triangle : faults.Triangles)
    {
      far.Triangles[triangle] = true;
    }
    for (std::size_t i = 0; i < far.Near.Count(); ++i)
    {
      far.IsAny = far.IsAny || far.Near[i].empty(); // nothing is near to it
    }
    return far;
  }

private:
  MeshPart& Part;
  const std::vector<double> Allowed;
  const std::vector<std::uint32_t> Homes;
  const ParallelFor& ForAll;
  PartDistance Distance;
};

}

double ToleranceExcess(const TetrahedronMesh& plain, const TetrahedronMesh& stuffed,
  const std::vector<double>& allowances, double step, const ParallelFor& parallelFor)
{
  MeasuredSurfaces surfaces(plain, stuffed, allowances, parallelFor);
  if (!surfaces.AreSound)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  LongerAllowances measure(surfaces, parallelFor);
  double tooLittle = 0.0;
  LongerAllowances::Far far = measure.All();
  // If nothing is allowed, hardly anything is near.
  const bool isAllowed = std::any_of(
    allowances.begin(), allowances.end(), [](double allowance) { return allowance > 0.0; });
  if (isAllowed)
  {
    far = measure.With(tooLittle, far);
    if (!far.IsAny)
    {
      return 0.0;
    }
  }
  const auto suffices = [&](double length)
  {
    LongerAllowances::Far left = measure.With(length, far);
    if (!left.IsAny)
    {
      return true;
    }
    tooLittle = length;
    far = std::move(left);
    return false;
  };
  double enough = step;
  for (int doubling = 0; !suffices(enough); ++doubling)
  {
    if (doubling == MostDoublings)
    {
      return HUGE_VAL;
    }
    enough *= 2.0;
  }
  for (int halving = 0; halving < Halvings; ++halving)
  {
    const double middle = 0.5 * (tooLittle + enough);
    enough = suffices(middle) ? middle : enough;
  }
  return enough;
}

}
