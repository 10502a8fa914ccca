// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMRoundArrayRangeDomain.h"

#include "RoundDefaults.h"
#include "SelectedArray.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkSMRoundArrayRangeDomain);

//------------------------------------------------------------------------------
vtkSMRoundArrayRangeDomain::vtkSMRoundArrayRangeDomain() = default;

//------------------------------------------------------------------------------
vtkSMRoundArrayRangeDomain::~vtkSMRoundArrayRangeDomain() = default;

//------------------------------------------------------------------------------
void vtkSMRoundArrayRangeDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
int vtkSMRoundArrayRangeDomain::ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element)
{
  this->Parts = RoundDefaults::ReadParts(element);
  this->FieldArray = element->GetAttributeOrEmpty("field_array");
  this->RangeArray = element->GetAttributeOrEmpty("range_array");
  return this->Superclass::ReadXMLAttributes(property, element);
}

//------------------------------------------------------------------------------
void vtkSMRoundArrayRangeDomain::Update(vtkSMProperty* requestingProperty)
{
  this->Superclass::Update(requestingProperty);
  vtkPVDataInformation* input = this->GetInputDataInformation("Input");
  vtkSMProperty* array = this->GetRequiredProperty("ArraySelection");
  const bool isInfinite = this->GetMinimumExists(0) &&
    !(std::isfinite(this->GetMinimum(0)) && std::isfinite(this->GetMaximum(0)));
  vtkPVArrayInformation* values = this->FieldData(this->RangeArray);
  if (!values && isInfinite && input && array)
  {
    values = SelectedArray(input, array);
  }
  if (values)
  {
    const double* range = values->GetComponentFiniteRange(0);
    this->SetEntries(std::vector<vtkEntry>{ vtkEntry(range[0], range[1]) });
  }
}

//------------------------------------------------------------------------------
int vtkSMRoundArrayRangeDomain::SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues)
{
  const bool isSet = this->SetToFieldArray(property, useUncheckedValues) ||
    RoundDefaults::Set(*this, this->Parts, property, useUncheckedValues) ||
    this->Superclass::SetDefaultValues(property, useUncheckedValues) != 0;
  RoundDefaults::ReplaceUntyped(property, useUncheckedValues);
  return isSet ? 1 : 0;
}

//------------------------------------------------------------------------------
vtkPVArrayInformation* vtkSMRoundArrayRangeDomain::FieldData(const std::string& name)
{
  vtkPVDataInformation* input = this->GetInputDataInformation("Input");
  return input && !name.empty() ? input->GetArrayInformation(name.c_str(), vtkDataObject::FIELD)
                                : nullptr;
}

//------------------------------------------------------------------------------
bool vtkSMRoundArrayRangeDomain::SetToFieldArray(vtkSMProperty* property, bool useUncheckedValues)
{
  vtkPVArrayInformation* array = this->FieldData(this->FieldArray);
  if (!array)
  {
    return false;
  }
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(useUncheckedValues);
  const unsigned int count = std::min(helper.GetNumberOfElements(), 2U);
  for (unsigned int i = 0; i < count; ++i)
  {
    helper.Set(i, array->GetComponentRange(0)[i]);
  }
  return true;
}
