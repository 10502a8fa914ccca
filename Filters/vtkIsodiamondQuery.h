// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamondQuery_h
#define vtkIsodiamondQuery_h

#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondState.h"
#include "vtkIsodiamondThreads.h"

#include "vtkAlgorithm.h"
#include "vtkPolyData.h"

#include <cmath>
#include <stdexcept>

namespace vtkIsodiamond
{

/** What the filters that read a hierarchy ask it. */
struct Query
{
  double ErrorTolerance = 0.0;
  bool UseIsovalue = false;
  double Isovalue = 0.0;
};

/** @throws std::invalid_argument for a negative tolerance or NaN */
inline void CheckTolerance(double tolerance)
{
  if (!(tolerance >= 0.0))
  {
    throw std::invalid_argument(
      "The error tolerance must be 0 or greater; it is " + std::to_string(tolerance) + ".");
  }
}

/**
 * Calls use(state, hierarchy) with the RI or MI that a data set holds, or with the answer of its
 * HD to the query.
 *
 * @throws std::exception that says what is wrong with the input or the query
 */
template <typename Use>
void RunQuery(
  vtkAlgorithm* filter, vtkPolyData* input, const Query& query, int numberOfThreads, Use&& use)
{
  CheckTolerance(query.ErrorTolerance);
  if (!input)
  {
    throw std::invalid_argument("There is no input hierarchy.");
  }
  const std::shared_ptr<const State> state = vtkIsodiamondHierarchy::ReadState(input);
  if (state->Isodiamonds && query.UseIsovalue && query.Isovalue != state->Isovalue)
  {
    vtkWarningWithObjectMacro(filter, << "A relevant or minimal hierarchy is of one isovalue ("
                                      << state->Isovalue << "); the isovalue " << query.Isovalue
                                      << " has no effect.");
  }
  const double isovalue = query.UseIsovalue ? query.Isovalue : state->Isovalue;
  if (!std::isfinite(isovalue))
  {
    throw std::invalid_argument("The isovalue is not a finite number.");
  }
  RunThreaded(numberOfThreads,
    [&]
    {
      if (state->Isodiamonds)
      {
        use(*state, *state->Isodiamonds);
        return;
      }
      const isodiamond::Encoding answer =
        isodiamond::EncodeQuery(*state->Scalars, isovalue, query.ErrorTolerance, SMPFor());
      use(*state, isodiamond::IsodiamondHierarchy(answer, SMPFor()));
    });
}

}

#endif
