// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMErrorToleranceDomain
 * @brief   error tolerances that are worth trying, for the slider
 *
 * From 0 to what the input and the metric make of it: by the distance metric 2 % of the diagonal of
 * the input's bounds, by the field metric the extent of the array's values; rounded up. Required
 * properties: *Input*; of filters that work on a volume also *Metric* and *ArraySelection*, and
 * *Unit* where tolerances can be in voxels. Without *Metric* the input is a hierarchy, which says
 * itself how far: its field data have *LargestErrorTolerance*.
 */

#ifndef vtkSMErrorToleranceDomain_h
#define vtkSMErrorToleranceDomain_h

#include "vtkIsodiamondServerManagerModule.h" // for export macro
#include "vtkSMDoubleRangeDomain.h"

class vtkPVDataInformation;

class VTKISODIAMONDSERVERMANAGER_EXPORT vtkSMErrorToleranceDomain : public vtkSMDoubleRangeDomain
{
public:
  static vtkSMErrorToleranceDomain* New();
  vtkTypeMacro(vtkSMErrorToleranceDomain, vtkSMDoubleRangeDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Looks at the required properties again. */
  void Update(vtkSMProperty* changed) override;

  /** Leaves the default to the property: full resolution, not the middle of the range. */
  int SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues) override;

protected:
  vtkSMErrorToleranceDomain();
  ~vtkSMErrorToleranceDomain() override;

private:
  vtkSMErrorToleranceDomain(const vtkSMErrorToleranceDomain&) = delete;
  void operator=(const vtkSMErrorToleranceDomain&) = delete;

  /** The end of the range; 0 or not finite while there is nothing to tell from. */
  double FindLargest();

  /** What 1 is for the user, in the world: a voxel of even spacing stands for all. */
  double FindUnit(vtkPVDataInformation* input);
};

#endif
