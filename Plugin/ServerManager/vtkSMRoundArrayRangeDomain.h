// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMRoundArrayRangeDomain
 * @brief   the range of an array, with round numbers as defaults
 *
 * As its base class, but the default of element i is about `default_parts[i]` of the way from the
 * minimum to the maximum, and a number that a person would type.
 */

#ifndef vtkSMRoundArrayRangeDomain_h
#define vtkSMRoundArrayRangeDomain_h

#include "vtkIsodiamondServerManagerModule.h" // for export macro
#include "vtkSMArrayRangeDomain.h"

#include <vector> // for the parts

class VTKISODIAMONDSERVERMANAGER_EXPORT vtkSMRoundArrayRangeDomain : public vtkSMArrayRangeDomain
{
public:
  static vtkSMRoundArrayRangeDomain* New();
  vtkTypeMacro(vtkSMRoundArrayRangeDomain, vtkSMArrayRangeDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues) override;

protected:
  vtkSMRoundArrayRangeDomain();
  ~vtkSMRoundArrayRangeDomain() override;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMRoundArrayRangeDomain(const vtkSMRoundArrayRangeDomain&) = delete;
  void operator=(const vtkSMRoundArrayRangeDomain&) = delete;

  std::vector<double> Parts;
};

#endif
