// SPDX-License-Identifier: BSD-3-Clause
#ifndef IsodiamondContestants_h
#define IsodiamondContestants_h

#include "Measurement.h"
#include "Volumes.h"

#include "vtkIsodiamondHierarchy.h"

/**
 * @file IsodiamondContestants.h
 * Isodiamonds: building hierarchies, extracting from them, and the filters that do both.
 */
namespace benchmark
{

/** What all contestants on one shape of a volume have in common. */
struct Task
{
  const benchmark::Volume& Volume;
  benchmark::Shape Shape;
  int Threads;
};

/** A hierarchy and how its errors are measured. */
struct Model
{
  int Kind;   ///< of vtkIsodiamondHierarchy::Models
  int Metric; ///< of vtkIsodiamondHierarchy::ErrorMetrics

  /** A tolerance in the unit that is shown to people for the metric. */
  Tolerance ToleranceOf(double value) const;
};

constexpr Model HD = { vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS,
  vtkIsodiamondHierarchy::FIELD };
constexpr Model RIField = { vtkIsodiamondHierarchy::RELEVANT, vtkIsodiamondHierarchy::FIELD };
constexpr Model RIDistance = { vtkIsodiamondHierarchy::RELEVANT, vtkIsodiamondHierarchy::DISTANCE };
constexpr Model MIField = { vtkIsodiamondHierarchy::MINIMAL, vtkIsodiamondHierarchy::FIELD };
constexpr Model MIDistance = { vtkIsodiamondHierarchy::MINIMAL, vtkIsodiamondHierarchy::DISTANCE };

/** A hierarchy that has been checked, so that extractions start at once. */
vtkSmartPointer<vtkIsodiamondHierarchy> BuildHierarchy(const Task& task, const Model& model);

/** A tolerance, in the units of Model::ToleranceOf, and the number of cells that it keeps. */
struct Level
{
  double Tolerance = NAN;
  double Cells = NAN;
};

/** About the smallest tolerance that keeps no more than a fraction of the full resolution's cells;
 *  NaN if every tolerance keeps more, or there are no cells. */
Level FindLevel(
  const Task& task, const Model& model, vtkIsodiamondHierarchy* hierarchy, double fraction);

/** Builds from the volume. "MI build, field" and the like. */
Contestant BuildContestant(const Task& task, const Model& model);

/** Checks a hierarchy and derives what queries need, as after a reload; on all cores. */
Contestant CheckContestant(const Model& model, vtkIsodiamondHierarchy* hierarchy);

/** Extracts from a hierarchy. "MI extract, field" and the like, or what name says. */
Contestant ExtractContestant(const Task& task, const Model& model,
  vtkIsodiamondHierarchy* hierarchy, double tolerance, const std::string& name = "");

/** vtkIsodiamondContour or vtkIsodiamondIntervalVolume on a new volume: builds, measures errors,
 * and extracts full resolution. "one step, field" or "one step, distance". */
Contestant OneStepContestant(const Task& task, int metric);

/** The same at tolerance 0, where no errors are measured. "one step, full resolution". */
Contestant FullResolutionContestant(const Task& task);

/** The same filter with a new tolerance on the same volume. @param threads 0 for the task's */
Contestant NewToleranceContestant(
  const Task& task, int metric, double tolerance, const std::string& name, int threads = 0);

}

#endif
