// SPDX-License-Identifier: BSD-3-Clause
#ifndef FilterContestant_h
#define FilterContestant_h

#include "Measurement.h"

#include "vtkAlgorithm.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace benchmark
{

/** Describes a filter's output: "points", "cells" and "output bytes". */
void DescribeMesh(vtkAlgorithm* filter, Figures& figures);

/** A contestant that runs filters, each of which is the input of the next. */
Contestant FilterContestant(
  const std::string& name, const std::vector<vtkSmartPointer<vtkAlgorithm>>& filters);

}

#endif
