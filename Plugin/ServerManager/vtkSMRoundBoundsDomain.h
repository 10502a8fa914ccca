// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMRoundBoundsDomain
 * @brief   the bounds of data, with round numbers as defaults
 *
 * As its base class, but the default of an element is about a part of the way from its minimum to
 * its maximum, and a number that a person would type: `default_parts` has one for each, or one for
 * all.
 */

#ifndef vtkSMRoundBoundsDomain_h
#define vtkSMRoundBoundsDomain_h

#include "vtkIsodiamondServerManagerModule.h" // for export macro
#include "vtkSMBoundsDomain.h"

#include <vector> // for the parts

class VTKISODIAMONDSERVERMANAGER_EXPORT vtkSMRoundBoundsDomain : public vtkSMBoundsDomain
{
public:
  static vtkSMRoundBoundsDomain* New();
  vtkTypeMacro(vtkSMRoundBoundsDomain, vtkSMBoundsDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues) override;

protected:
  vtkSMRoundBoundsDomain();
  ~vtkSMRoundBoundsDomain() override;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMRoundBoundsDomain(const vtkSMRoundBoundsDomain&) = delete;
  void operator=(const vtkSMRoundBoundsDomain&) = delete;

  std::vector<double> Parts;
};

#endif
