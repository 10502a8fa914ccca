// SPDX-License-Identifier: BSD-3-Clause
#ifndef RoundDefaults_h
#define RoundDefaults_h

#include "RoundNumbers.h"

#include "vtkPVXMLElement.h"
#include "vtkSMDoubleRangeDomain.h"
#include "vtkSMPropertyHelper.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

/**
 * @file RoundDefaults.h
 * Defaults within ranges, as round numbers.
 *
 * ParaView takes a value in a Python constructor that equals the XML's default for one that was not
 * given, and replaces it. So the XML has a default that nobody types where these domains find one.
 */
namespace RoundDefaults
{

/** The XML's default where people would type 0. */
constexpr double Untyped = 1e-300;

/** Makes 0 of what is still the XML's default. */
inline void ReplaceUntyped(vtkSMProperty* property, bool useUncheckedValues)
{
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(useUncheckedValues);
  for (unsigned int i = 0; i < helper.GetNumberOfElements(); ++i)
  {
    if (helper.GetAsDouble(i) == Untyped)
    {
      helper.Set(i, 0.0);
    }
  }
}

/** The attribute `default_parts` of a domain's XML. */
inline std::vector<double> ReadParts(vtkPVXMLElement* element)
{
  std::vector<double> parts;
  std::istringstream text(std::string(element->GetAttributeOrEmpty("default_parts")));
  for (double part = 0.0; text >> part;)
  {
    parts.push_back(part);
  }
  return parts;
}

/** Sets a property's elements, as many as there are parts or ranges, whichever is more; none where
 *  a range ends before it begins, as bounds of what has never been updated do. @return false
 * without ranges or parts */
inline bool Set(vtkSMDoubleRangeDomain& domain, const std::vector<double>& parts,
  vtkSMProperty* property, bool useUncheckedValues)
{
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(useUncheckedValues);
  unsigned int ranges = 0;
  while (domain.GetMinimumExists(ranges) && domain.GetMaximumExists(ranges))
  {
    ++ranges;
  }
  if (ranges == 0 || parts.empty())
  {
    return false;
  }
  for (unsigned int i = 0; i < ranges; ++i)
  {
    if (!(domain.GetMinimum(i) <= domain.GetMaximum(i)))
    {
      return true;
    }
  }
  const auto given = static_cast<unsigned int>(parts.size());
  for (unsigned int i = 0; i < std::max(given, ranges); ++i)
  {
    const unsigned int range = std::min(i, ranges - 1);
    helper.Set(i,
      RoundNumbers::Between(
        domain.GetMinimum(range), domain.GetMaximum(range), parts[std::min(i, given - 1)]));
  }
  // A range of constant data is nothing that one could choose a part of: what is beyond its end is.
  const unsigned int last = std::min(given, ranges) - 1;
  if (given > 1 && domain.GetMinimum(last) == domain.GetMaximum(last) &&
    helper.GetAsDouble(0) == helper.GetAsDouble(given - 1))
  {
    const double value = helper.GetAsDouble(0);
    helper.Set(given - 1, value + std::max(1.0, std::abs(value)));
  }
  return true;
}

}

#endif
