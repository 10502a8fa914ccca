// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMRoundArrayRangeDomain.h"

#include "RoundDefaults.h"

#include "vtkObjectFactory.h"

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
  return this->Superclass::ReadXMLAttributes(property, element);
}

//------------------------------------------------------------------------------
int vtkSMRoundArrayRangeDomain::SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues)
{
  return RoundDefaults::Set(*this, this->Parts, property, useUncheckedValues)
    ? 1
    : this->Superclass::SetDefaultValues(property, useUncheckedValues);
}
