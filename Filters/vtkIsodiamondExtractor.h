// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondExtractor
 * @brief   extract a crack-free isosurface from an isodiamond hierarchy at an error tolerance
 *
 * Input: a vtkIsodiamondHierarchy, or any vtkPolyData that holds one (as a reader gives back).
 * Output: triangles, with normals to lower values; point data: the isovalue under the name of the
 * array that the hierarchy was built from; cell data: `Level` of the diamond that a triangle lies
 * in, 0 for the coarsest.
 *
 * The surface has no cracks at any tolerance, and the three models give the same one. A coarser
 * tolerance costs less time, in proportion to what it returns.
 *
 * @warning With an open boundary, edges on the image's boundary have one triangle.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", IEEE TVCG 2010, section 6.
 */

#ifndef vtkIsodiamondExtractor_h
#define vtkIsodiamondExtractor_h

#include "vtkIsodiamondFiltersModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondExtractor : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkIsodiamondExtractor* New();
  vtkTypeMacro(vtkIsodiamondExtractor, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The error that is tolerated, in field units: at every sample in a tetrahedron that carries
   * the surface, field and interpolant differ by no more. 0 is full resolution; infinity the
   * coarsest. Negative values and NaN are errors. Default: 0.
   */
  vtkSetMacro(ErrorTolerance, double);
  vtkGetMacro(ErrorTolerance, double);
  ///@}

  /** From 0 to the extent of the field's values, beyond which a tolerance changes nothing; {0, 1}
   *  while there is no hierarchy. */
  double* GetErrorToleranceRange() VTK_SIZEHINT(2);

  ///@{
  /**
   * Another isovalue than the hierarchy's own default, for an HD. SetIsovalue turns UseIsovalue
   * on. RI and MI are of one isovalue: with them it warns and has no effect. Default: off.
   */
  void SetIsovalue(double isovalue);
  vtkGetMacro(Isovalue, double);
  vtkSetMacro(UseIsovalue, bool);
  vtkGetMacro(UseIsovalue, bool);
  vtkBooleanMacro(UseIsovalue, bool);
  ///@}

  ///@{
  /**
   * Threads to use; 0 for all cores. The result does not depend on it. Default: 0.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

protected:
  vtkIsodiamondExtractor();
  ~vtkIsodiamondExtractor() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  double ErrorTolerance = 0.0;
  double Isovalue = 0.0;
  bool UseIsovalue = false;
  int NumberOfThreads = 0;
  double ErrorToleranceRange[2] = { 0.0, 1.0 };

private:
  vtkIsodiamondExtractor(const vtkIsodiamondExtractor&) = delete;
  void operator=(const vtkIsodiamondExtractor&) = delete;
};

#endif
