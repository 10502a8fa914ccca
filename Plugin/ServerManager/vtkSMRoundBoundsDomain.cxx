// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMRoundBoundsDomain.h"

#include "RoundDefaults.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkSMRoundBoundsDomain);

//------------------------------------------------------------------------------
vtkSMRoundBoundsDomain::vtkSMRoundBoundsDomain() = default;

//------------------------------------------------------------------------------
vtkSMRoundBoundsDomain::~vtkSMRoundBoundsDomain() = default;

//------------------------------------------------------------------------------
void vtkSMRoundBoundsDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
int vtkSMRoundBoundsDomain::ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element)
{
  this->Parts = RoundDefaults::ReadParts(element);
  return this->Superclass::ReadXMLAttributes(property, element);
}

//------------------------------------------------------------------------------
int vtkSMRoundBoundsDomain::SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues)
{
  const bool isSet = RoundDefaults::Set(*this, this->Parts, property, useUncheckedValues) ||
    this->Superclass::SetDefaultValues(property, useUncheckedValues) != 0;
  RoundDefaults::ReplaceUntyped(property, useUncheckedValues);
  return isSet ? 1 : 0;
}
