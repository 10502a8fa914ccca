// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_State_h
#define vtkIsodiamond_State_h

#include "Build/Builder.h"
#include "Field/AffineMap.h"
#include "Private/Input/Volume.h"
#include "Private/State/Choice.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkFieldData;
class vtkPolyData;

/**
 * @file State.h
 * Between a hierarchy's field-data arrays and the core: writing, and checked reading. The arrays
 * are those of docs/file-format.md, with names and indices in Format.h.
 */
namespace vtkIsodiamond
{

/** A hierarchy read from field data, with the arrays that it views. */
struct State
{
  int Model = 0; ///< as isodiamond::Model
  /** What an RI or MI represents; for an HD, the default of queries. */
  Choice Chosen;
  isodiamond::ErrorMetric Metric = isodiamond::ErrorMetric::Field;
  bool ExactIsovertices = true; ///< of an HD: those that queries make
  std::string ArrayName;
  isodiamond::AffineMap World;
  std::int64_t StorageSize = 0;
  /** All that the field data had of the hierarchy, and when each array was last modified. */
  std::vector<std::pair<vtkSmartPointer<vtkAbstractArray>, vtkMTimeType>> Arrays;
  /** Other arrays at stored points, under their own names. */
  std::vector<vtkSmartPointer<vtkDataArray>> PointArrays;
  /** One of the two is set: RI and MI, or HD. */
  std::unique_ptr<isodiamond::IsodiamondHierarchy> Isodiamonds;
  std::unique_ptr<isodiamond::ScalarHierarchy> Scalars;
};

/** Whether the field data has the header of a hierarchy. */
bool HasHierarchy(vtkFieldData* fieldData);

/** The largest error tolerance that is worth trying; 1 if there is no hierarchy. */
double LargestTolerance(vtkFieldData* fieldData);

/** The extent of the field's values; 1 if there is no hierarchy. */
double FieldScale(vtkFieldData* fieldData);

/** Reads and checks a hierarchy. @param numberOfThreads 0 for as many as VTK would use
 *  @throws std::exception saying what is wrong with it. */
std::shared_ptr<const State> ReadState(vtkFieldData* fieldData, int numberOfThreads);

/** Whether the state was read from exactly these arrays, and none was modified since. */
bool IsCurrent(const State& state, vtkFieldData* fieldData);

/** Removes a hierarchy, and the numbers that describe it, from field data that were passed on with
 * it: a mesh would keep all of it alive, and be saved with it. */
void RemoveState(vtkFieldData* fieldData);

/** Puts an RI or MI into a data set, whose geometry becomes the outline of the grid. @param
 *  pointArrays other arrays at stored points */
void WriteIsodiamonds(const isodiamond::Encoding& encoding, const Choice& choice,
  const isodiamond::AffineMap& world, const std::string& arrayName,
  const std::vector<vtkSmartPointer<vtkDataArray>>& pointArrays, vtkPolyData* output);

/** Gives an HD in a data set other defaults of queries, and another way to place isovertices.
 *  @param state the HD as it was read */
void WriteDefaultsOfQueries(
  const State& state, const Choice& choice, bool exactIsovertices, vtkPolyData* output);

/** Puts an HD into a data set. @param choice,exactIsovertices the default of queries, and how they
 *  place isovertices */
void WriteScalars(const isodiamond::ScalarEncoding& encoding, const Choice& choice,
  bool exactIsovertices, const Volume& volume, vtkPolyData* output);

}

#endif
