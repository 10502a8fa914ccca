// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceInterval.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

namespace reference
{

namespace
{

/** The signs that occur at those points that have a sample. */
std::set<int> SignsAt(const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range,
  const std::vector<Point>& points)
{
  std::set<int> signs;
  for (const Point& point : points)
  {
    if (hierarchy.IsSampled(point))
    {
      signs.insert(SignOf(field.At(point), range));
    }
  }
  return signs;
}

const std::set<int> AllInside{ 0 };

/** A diamond's kind by itself: active or creation if it is a seed, else inactive. */
Kind SeedKind(const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range,
  bool refineInterior, const Diamond& diamond)
{
  const std::set<int> signs = SignsAt(hierarchy, field, range, diamond.Vertices);
  if (signs.empty())
  {
    return Kind::Inactive;
  }
  if (signs.size() > 1)
  {
    return Kind::Active;
  }
  const bool centerDiffers = hierarchy.IsSampled(diamond.Center) &&
    signs.count(SignOf(field.At(diamond.Center), range)) == 0;
  if (signs == AllInside)
  {
    const bool isSeed = centerDiffers || diamond.SticksOut || refineInterior;
    return isSeed ? Kind::Active : Kind::Inactive;
  }
  return centerDiffers ? Kind::Creation : Kind::Inactive;
}

/** Every diamond's answer to a question. */
template <typename Question>
DiamondSet DiamondsThat(const Hierarchy& hierarchy, const Question& question)
{
  DiamondSet diamonds;
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    diamonds.push_back(question(index));
  }
  return diamonds;
}

}

int SignOf(double value, const Isorange& range)
{
  if (value > range.Upper)
  {
    return 1;
  }
  return value >= range.Lower ? 0 : -1;
}

bool HasVerticesInside(
  const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range, int diamond)
{
  return SignsAt(hierarchy, field, range, hierarchy.At(diamond).Vertices) == AllInside;
}

DiamondSet DiamondsInside(
  const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range)
{
  return DiamondsThat(
    hierarchy, [&](int diamond) { return HasVerticesInside(hierarchy, field, range, diamond); });
}

std::vector<Kind> Classify(
  const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range, bool refineInterior)
{
  std::vector<Kind> kinds(hierarchy.Size(), Kind::Inactive);
  // Children come after their parents, so going backwards every child is known before its parents.
  for (int index = hierarchy.Size() - 1; index >= 0; --index)
  {
    const Diamond& diamond = hierarchy.At(index);
    kinds[index] = SeedKind(hierarchy, field, range, refineInterior, diamond);
    const bool isAncestor = std::any_of(diamond.Children.begin(), diamond.Children.end(),
      [&kinds](int child) { return kinds[child] != Kind::Inactive; });
    if (kinds[index] == Kind::Inactive && isAncestor)
    {
      const bool isInside = HasVerticesInside(hierarchy, field, range, index);
      kinds[index] = isInside ? Kind::Active : Kind::Relevant;
    }
  }
  return kinds;
}

Counts Count(const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range,
  const std::vector<Kind>& kinds)
{
  const auto isoverticesBetween = [&](const Point& a, const Point& b)
  {
    if (!hierarchy.IsSampled(a) || !hierarchy.IsSampled(b))
    {
      return 0;
    }
    return std::abs(SignOf(field.At(a), range) - SignOf(field.At(b), range));
  };

  Counts counts;
  for (int index = 0; index < hierarchy.Size(); ++index)
  {
    counts.Active += kinds[index] == Kind::Active;
    counts.Creation += kinds[index] == Kind::Creation;
    counts.Relevant += kinds[index] == Kind::Creation || kinds[index] == Kind::Relevant;
    if (kinds[index] != Kind::Inactive)
    {
      const Diamond& diamond = hierarchy.At(index);
      for (const Point& vertex : diamond.Vertices)
      {
        counts.Isovertices += isoverticesBetween(diamond.Center, vertex);
      }
    }
  }
  for (const std::array<Point, 2>& edge : hierarchy.BaseEdges())
  {
    counts.BaseIsovertices += isoverticesBetween(edge[0], edge[1]);
  }
  return counts;
}

bool IsCarrying(
  const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range, int diamond)
{
  const std::set<int> signs = SignsAt(hierarchy, field, range, DomainPoints(hierarchy, diamond));
  return signs.size() > 1 || (signs == AllInside && hierarchy.At(diamond).SticksOut);
}

DiamondSet CarryingDomains(
  const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range)
{
  return DiamondsThat(
    hierarchy, [&](int diamond) { return IsCarrying(hierarchy, field, range, diamond); });
}

Criterion IntervalCriterion(
  const std::vector<double>& errors, const DiamondSet& carrying, double tolerance)
{
  return [&errors, &carrying, tolerance](int index)
  {
    const bool isAlways = errors[index] == std::numeric_limits<double>::infinity();
    return carrying[index] && (isAlways || errors[index] > tolerance);
  };
}

DiamondSet RefineInterior(const Hierarchy& hierarchy, const DiamondSet& subdivided,
  const std::vector<double>& errors, const DiamondSet& inside, double interiorTolerance)
{
  DiamondSet set = subdivided;
  // Children come after their parents, so going backwards all that forces a diamond is known first.
  for (int index = hierarchy.Size() - 1; index >= 0; --index)
  {
    if (inside[index] && errors[index] > interiorTolerance)
    {
      set[index] = true;
    }
    if (set[index])
    {
      for (const int parent : hierarchy.At(index).Parents)
      {
        set[parent] = true;
      }
    }
  }
  return set;
}

}
