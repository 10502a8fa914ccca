// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondPoints
 * @brief   the stored isodiamonds of a hierarchy as points
 *
 * Input: an RI or MI hierarchy (an HD stores no isodiamonds: a clear error). Output: one vertex for
 * each stored isodiamond at its central vertex, with the point arrays `Kind` (0 active, 1 creation,
 * 2 relevant), `Class` (0, 1, 2), `Level` (0 for the root) and `Error` (the tolerance, in the
 * metric's units, below which the diamond is subdivided; infinite if it always is). See the paper's
 * figures 11 and 16. In parallel each process has a share of the points.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", IEEE TVCG 2010.
 */

#ifndef vtkIsodiamondPoints_h
#define vtkIsodiamondPoints_h

#include "vtkIsodiamondFiltersModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory>

namespace vtkIsodiamond
{
class InputShares;
}

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondPoints : public vtkPolyDataAlgorithm
{
public:
  static vtkIsodiamondPoints* New();
  vtkTypeMacro(vtkIsodiamondPoints, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkIsodiamondPoints();
  ~vtkIsodiamondPoints() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  /** Notes the requested piece of the output. */
  int ModifyRequest(vtkInformation* request, int when) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  std::unique_ptr<vtkIsodiamond::InputShares> Shares; ///< of what is requested

  vtkIsodiamondPoints(const vtkIsodiamondPoints&) = delete;
  void operator=(const vtkIsodiamondPoints&) = delete;
};

#endif
