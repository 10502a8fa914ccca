// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_WorldQuery_h
#define vtkIsodiamond_WorldQuery_h

#include "Private/Common/Threads.h"
#include "Private/State/State.h"
#include "Refinement/RefinedSet.h"
#include "Refinement/ScalarQuery.h"

#include "vtkAlgorithm.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace vtkIsodiamond
{

/** From where a mesh is seen. */
struct View
{
  isodiamond::Vector Position{}; ///< in the world
  double TolerancePerDistance = 0.0;
};

/** What a filter's properties ask of a hierarchy, in the world; isodiamond::Query asks it of the
 *  core, in index space. */
struct WorldQuery
{
  double ErrorTolerance = 0.0;
  bool HasTarget = false;    ///< whether that tolerance is yet to be found: see SetFound()
  bool OneTolerance = false; ///< whether errors are to be measured for it alone
  double InteriorTolerance = HUGE_VAL;
  bool RefinesInterior = false; ///< whether that tolerance may refine anything; of a volume
  /** In the world; the tolerances hold there. */
  std::optional<isodiamond::Box> Region;
  double OutsideErrorTolerance = HUGE_VAL; ///< 0: see OutsideOf()
  std::optional<vtkIsodiamond::View> View;
  /** What to extract instead of the hierarchy's own choice, from an HD. */
  std::optional<isodiamond::Shape> Shape;
  std::optional<double> Isovalue;
  std::optional<std::array<double, 2>> Isorange;
  bool PreserveTopology = false;   ///< of an HD
  bool Simplify = false;           ///< see Extraction.h
  bool SimulationQuality = false;  ///< of tetrahedra, see StuffedVolume.h
  bool AreTrianglesShaped = false; ///< whether Simplify cares for triangles' shapes

  /** Whether it is for full resolution, whatever the errors are. */
  bool IsFull() const
  {
    return this->ErrorTolerance == 0.0 && !this->HasTarget && !this->Region && !this->View;
  }

  /** Asks for a tolerance that was found for a target, as if there had been none: then all errors
   *  are known. */
  void SetFound(double tolerance)
  {
    this->ErrorTolerance = tolerance;
    this->HasTarget = false;
    this->OneTolerance = false;
  }

  /** Asks for triangles for simulations, simplified ones, where it asked for such tetrahedra. */
  void TurnToTriangles()
  {
    this->Simplify = this->Simplify || this->SimulationQuality;
    this->AreTrianglesShaped = this->SimulationQuality;
    this->SimulationQuality = false;
  }

  /** The hierarchy's own choice, overridden by the query's. */
  Choice Override(Choice choice) const
  {
    choice.Shape = this->Shape.value_or(choice.Shape);
    choice.Isovalue = this->Isovalue.value_or(choice.Isovalue);
    choice.Isorange = this->Isorange.value_or(choice.Isorange);
    return choice;
  }
};

/** @throws std::invalid_argument for a negative tolerance or NaN */
inline void CheckTolerance(double tolerance, const std::string& name = "error")
{
  if (!(tolerance >= 0.0))
  {
    std::ostringstream message;
    message << "The " << name << " tolerance must be 0 or greater; it is " << tolerance << ".";
    throw std::invalid_argument(message.str());
  }
}

/** The same for all tolerances of a query. */
inline void CheckTolerances(const WorldQuery& query)
{
  CheckTolerance(query.ErrorTolerance);
  CheckTolerance(query.InteriorTolerance, "interior");
  if (query.Region)
  {
    CheckTolerance(query.OutsideErrorTolerance, "outside error");
  }
}

/** Warns if the region of a query is a point, or empty: VTK's empty bounds end before they
 *  begin. */
inline void WarnOfEmptyRegion(vtkAlgorithm* filter, const WorldQuery& query)
{
  bool isPoint = query.Region.has_value();
  bool isNothing = false;
  for (int axis = 0; axis < 3 && query.Region; ++axis)
  {
    isPoint = isPoint && query.Region->Minimum[axis] == query.Region->Maximum[axis];
    isNothing = isNothing || query.Region->Minimum[axis] > query.Region->Maximum[axis];
  }
  if (isPoint || isNothing)
  {
    vtkWarningWithObjectMacro(filter,
      "The region of interest has no size, or ends before it begins: the outside tolerance holds "
      "nearly everywhere.");
  }
}

/** The metric of a hierarchy, and the extent of what it measures. */
struct Measure
{
  isodiamond::ErrorMetric Metric = isodiamond::ErrorMetric::Field;
  double Extent = 1.0;

  explicit Measure(const isodiamond::IsodiamondHierarchy& hierarchy)
    : Metric(hierarchy.Header().Metric)
    , Extent(hierarchy.Codes().Scale())
  {
  }
  explicit Measure(const isodiamond::ScalarHierarchy& hierarchy)
    : Extent(hierarchy.Codes().Scale())
  {
  }
};

/** The tolerance outside a query's region. */
inline double OutsideOf(
  const WorldQuery& query, const Measure& measure, const isodiamond::GridGeometry& world)
{
  if (query.OutsideErrorTolerance != 0.0)
  {
    return query.OutsideErrorTolerance;
  }
  const bool isDistance = measure.Metric == isodiamond::ErrorMetric::Distance;
  return std::max(
    4.0 * query.ErrorTolerance, isDistance ? world.SmallestStep() : 0.01 * measure.Extent);
}

/** The query in terms of the core. @param world from the grid's index space */
template <typename Hierarchy>
isodiamond::Query CoreQuery(
  const WorldQuery& query, const Hierarchy& hierarchy, const isodiamond::GridGeometry& world)
{
  const isodiamond::Grid& grid = hierarchy.SampleGrid();
  isodiamond::Query result;
  result.Tolerance = query.ErrorTolerance;
  result.InteriorTolerance = query.InteriorTolerance;
  result.OutsideTolerance = OutsideOf(query, Measure(hierarchy), world);
  result.PreserveTopology = query.PreserveTopology;
  const isodiamond::AffineMap* map = world.Affine();
  if (query.Region && map)
  {
    result.Region.emplace(*query.Region, grid, *map);
  }
  else if (query.Region)
  {
    result.Region.emplace(
      isodiamond::IndexBoxOf(*query.Region, world), grid, isodiamond::AffineMap());
  }
  if (query.View)
  {
    result.View.emplace(query.View->Position, query.View->TolerancePerDistance, world);
  }
  return result;
}

/** Whether a query's mesh is an interval volume: an RI or MI has its own shape, whatever is asked.
 */
inline bool IsForVolume(const WorldQuery& query, const State& state)
{
  return state.Isodiamonds
    ? state.Isodiamonds->Region().IsVolume()
    : query.Override(state.Chosen).Shape == isodiamond::Shape::IntervalVolume;
}

/** Warns where a query asks for what its shape does not have. */
inline void WarnOfOtherShape(vtkAlgorithm* filter, const State& state, const WorldQuery& query)
{
  const bool isVolume = IsForVolume(query, state);
  if (!isVolume && query.InteriorTolerance < VTK_DOUBLE_MAX)
  {
    vtkWarningWithObjectMacro(
      filter, "An isosurface has no inside: the interior tolerance has no effect.");
  }
  if (state.Scalars && !isVolume && query.Isorange)
  {
    vtkWarningWithObjectMacro(filter,
      "An isosurface has no isorange: it has no effect unless the shape is an interval volume.");
  }
  if (state.Scalars && isVolume && query.Isovalue)
  {
    vtkWarningWithObjectMacro(filter,
      "An interval volume has no isovalue: it has no effect unless the shape is an isosurface.");
  }
}

/** Warns where a relevant or minimal hierarchy cannot do what the query asks. */
inline void WarnOfWhatHasNoEffect(vtkAlgorithm* filter, const State& state, const WorldQuery& query)
{
  const isodiamond::IsodiamondHierarchy& hierarchy = *state.Isodiamonds;
  const Choice& own = state.Chosen;
  const bool isVolume = hierarchy.Region().IsVolume();
  if ((query.Shape && *query.Shape != own.Shape) ||
    (query.Isovalue && (isVolume || *query.Isovalue != own.Isovalue)) ||
    (query.Isorange && (!isVolume || *query.Isorange != own.Isorange)))
  {
    vtkWarningWithObjectMacro(filter,
      "A relevant or minimal hierarchy is of one isovalue or isorange; another shape, isovalue or "
      "isorange has no effect.");
  }
  if (query.PreserveTopology && !hierarchy.Header().PreservesTopology)
  {
    vtkWarningWithObjectMacro(filter,
      "The hierarchy was built without PreserveTopology: for the extractor it has no effect.");
  }
  if (isVolume && !hierarchy.RefinesInterior() &&
    query.InteriorTolerance < hierarchy.InteriorCodes().Scale())
  {
    vtkWarningWithObjectMacro(filter,
      "The hierarchy was built without RefineInterior: the interior tolerance has no effect.");
  }
}

/**
 * Calls use(refined) with the refined set of an RI or MI, or of an HD's answer to a query.
 *
 * @throws std::exception that says what is wrong with the query
 */
template <typename Use>
void RefineState(const State& state, const WorldQuery& query, int numberOfThreads,
  const isodiamond::ParallelFor& parallelFor, Use&& use)
{
  RunThreaded(numberOfThreads,
    [&]
    {
      if (state.Isodiamonds)
      {
        use(isodiamond::RefinedSet(
          *state.Isodiamonds, CoreQuery(query, *state.Isodiamonds, state.World), parallelFor));
        return;
      }
      isodiamond::Encoded answer =
        isodiamond::EncodeQuery(*state.Scalars, query.Override(state.Chosen).Region(),
          CoreQuery(query, *state.Scalars, state.World), state.ExactIsovertices, parallelFor);
      const isodiamond::IsodiamondHierarchy hierarchy(
        answer.Encoding, std::move(answer.Diamonds), std::move(answer.Edges));
      use(isodiamond::RefinedSet(hierarchy, {}, parallelFor));
    });
}

/** The hierarchy that a data set holds, ready for a query.
 *  @throws std::exception that says what is wrong with the input or the query */
inline std::shared_ptr<const State> ReadForQuery(
  vtkAlgorithm* filter, vtkPolyData* input, int numberOfThreads, const WorldQuery& query)
{
  CheckTolerances(query);
  if (!input)
  {
    throw std::invalid_argument("There is no input hierarchy.");
  }
  std::shared_ptr<const State> state = vtkIsodiamondHierarchy::ReadState(input, numberOfThreads);
  if (query.View && state->Metric != isodiamond::ErrorMetric::Distance)
  {
    throw std::invalid_argument("A view-dependent mesh needs a hierarchy of the distance metric.");
  }
  WarnOfEmptyRegion(filter, query);
  WarnOfOtherShape(filter, *state, query);
  if (state->Isodiamonds)
  {
    WarnOfWhatHasNoEffect(filter, *state, query);
  }
  return state;
}

}

#endif
