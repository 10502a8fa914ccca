// SPDX-License-Identifier: BSD-3-Clause
#ifndef SelectedArray_h
#define SelectedArray_h

#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMUncheckedPropertyHelper.h"

/** What is known of the array that a property selects, as the panel has it now; null if nothing is.
 */
inline vtkPVArrayInformation* SelectedArray(vtkPVDataInformation* input, vtkSMProperty* property)
{
  const vtkSMUncheckedPropertyHelper selection(property);
  const char* name = selection.GetAsString(4);
  return name ? input->GetArrayInformation(name, selection.GetAsInt(3)) : nullptr;
}

#endif
