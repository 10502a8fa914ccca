// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMRoundArrayRangeDomain
 * @brief   the range of an array, with round numbers as defaults
 *
 * As its base class, but the default of element i is about `default_parts[i]` of the way from the
 * minimum to the maximum, and a number that a person would type. Values that are not finite are not
 * in the range. If the input has field data of the name `field_array`, a hierarchy's own isovalue
 * for instance, the default is what that holds; of the name `range_array`, the samples of a
 * hierarchy of diamonds, the range is that of their values.
 */

#ifndef vtkSMRoundArrayRangeDomain_h
#define vtkSMRoundArrayRangeDomain_h

#include "vtkIsodiamondServerManagerModule.h" // for export macro
#include "vtkSMArrayRangeDomain.h"

#include <string> // for names
#include <vector> // for the parts

class vtkPVArrayInformation;

class VTKISODIAMONDSERVERMANAGER_EXPORT vtkSMRoundArrayRangeDomain : public vtkSMArrayRangeDomain
{
public:
  static vtkSMRoundArrayRangeDomain* New();
  vtkTypeMacro(vtkSMRoundArrayRangeDomain, vtkSMArrayRangeDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Update(vtkSMProperty* requestingProperty) override;
  int SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues) override;

protected:
  vtkSMRoundArrayRangeDomain();
  ~vtkSMRoundArrayRangeDomain() override;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMRoundArrayRangeDomain(const vtkSMRoundArrayRangeDomain&) = delete;
  void operator=(const vtkSMRoundArrayRangeDomain&) = delete;

  /** Field data of the input; null if there are none. */
  vtkPVArrayInformation* FieldData(const std::string& name);
  bool SetToFieldArray(vtkSMProperty* property, bool useUncheckedValues);

  std::vector<double> Parts;
  std::string FieldArray;
  std::string RangeArray;
};

#endif
