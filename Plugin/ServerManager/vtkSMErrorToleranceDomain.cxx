// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMErrorToleranceDomain.h"

#include "RoundNumbers.h"
#include "SelectedArray.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <algorithm>
#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkSMErrorToleranceDomain);

namespace
{

/** As vtkIsodiamond::DistanceOfInterest of the filters, which a client need not have. */
constexpr double DistanceOfInterest = 0.02;

}

//------------------------------------------------------------------------------
vtkSMErrorToleranceDomain::vtkSMErrorToleranceDomain() = default;

//------------------------------------------------------------------------------
vtkSMErrorToleranceDomain::~vtkSMErrorToleranceDomain() = default;

//------------------------------------------------------------------------------
void vtkSMErrorToleranceDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
void vtkSMErrorToleranceDomain::Update(vtkSMProperty*)
{
  const double largest = this->FindLargest();
  const bool isKnown = std::isfinite(largest) && largest > 0.0;
  this->SetEntries(
    std::vector<vtkEntry>{ vtkEntry(0.0, isKnown ? RoundNumbers::AtLeast(largest) : 1.0) });
}

//------------------------------------------------------------------------------
int vtkSMErrorToleranceDomain::SetDefaultValues(vtkSMProperty*, bool)
{
  return 0;
}

//------------------------------------------------------------------------------
double vtkSMErrorToleranceDomain::FindLargest()
{
  vtkPVDataInformation* input = this->GetInputDataInformation("Input");
  vtkSMProperty* metric = this->GetRequiredProperty("Metric");
  vtkSMProperty* array = this->GetRequiredProperty("ArraySelection");
  double largest = 0.0;
  if (input && !metric)
  {
    // vtkIsodiamondBuilder writes it beside the hierarchy.
    vtkPVArrayInformation* own =
      input->GetArrayInformation("LargestErrorTolerance", vtkDataObject::FIELD);
    largest = own ? own->GetComponentRange(0)[1] : 0.0;
  }
  else if (input && vtkSMUncheckedPropertyHelper(metric).GetAsInt() == 1) // distance
  {
    const double* bounds = input->GetBounds();
    largest = DistanceOfInterest *
      std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]) /
      this->FindUnit(input);
  }
  else if (input && array)
  {
    vtkPVArrayInformation* values = SelectedArray(input, array);
    largest =
      values ? values->GetComponentFiniteRange(0)[1] - values->GetComponentFiniteRange(0)[0] : 0.0;
  }
  return largest;
}

//------------------------------------------------------------------------------
double vtkSMErrorToleranceDomain::FindUnit(vtkPVDataInformation* input)
{
  vtkSMProperty* unit = this->GetRequiredProperty("Unit");
  if (!unit || vtkSMUncheckedPropertyHelper(unit).GetAsInt() == 0)
  {
    return 1.0;
  }
  const double* bounds = input->GetBounds();
  const int* extent = input->GetExtent();
  double voxel = HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis)
  {
    voxel = std::min(
      voxel, (bounds[2 * axis + 1] - bounds[2 * axis]) / (extent[2 * axis + 1] - extent[2 * axis]));
  }
  return std::isfinite(voxel) && voxel > 0.0 ? voxel : 1.0;
}
