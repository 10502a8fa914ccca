// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondIntervalVolume
 * @brief   the part of a volume between two values, as tetrahedra, in one step
 *
 * A volume in, vtkUnstructuredGrid of tetrahedra out: the region lower <= field <= upper, at an
 * error tolerance. Neighbours share whole faces, all volumes are positive, and every face of only
 * one tetrahedron lies on the lower surface, the upper surface or the volume's boundary. (With the
 * field metric, long tetrahedra can turn over where a grid's steps differ; with both, thin ones can
 * in single cells of a structured grid that bend a lot.) The filter keeps its minimal isodiamond
 * hierarchies: for a new tolerance it only extracts again. For a new input, array or isorange it
 * builds a new one, and so it does for the first interior tolerance; see
 * vtkIsodiamondVolumeAlgorithm.
 *
 * Point data: the field's value under the input array's name, `Surface`, and all other point arrays
 * of the input (InterpolateAttributes); cell data: `Level`; see vtkIsodiamondExtractor.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", IEEE TVCG 2010.
 *
 * @sa vtkIsodiamondBuilder vtkIsodiamondExtractor vtkIsodiamondContour
 */

#ifndef vtkIsodiamondIntervalVolume_h
#define vtkIsodiamondIntervalVolume_h

#include "vtkIsodiamondFiltersModule.h" // for export macro
#include "vtkIsodiamondVolumeAlgorithm.h"

class vtkUnstructuredGrid;

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondIntervalVolume : public vtkIsodiamondVolumeAlgorithm
{
public:
  static vtkIsodiamondIntervalVolume* New();
  vtkTypeMacro(vtkIsodiamondIntervalVolume, vtkIsodiamondVolumeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The isorange [lower, upper], in field units, including its ends. An end that is infinite or
   * beyond the data's range leaves that side open. A range outside the data's gives an empty
   * volume; lower >= upper and NaN are errors. Default: [0, 1].
   */
  vtkSetVector2Macro(Isorange, double);
  vtkGetVector2Macro(Isorange, double);
  ///@}

  ///@{
  /**
   * The tolerated error inside, in field units. When off, or not less than the extent of the
   * array's values, the inside is as coarse as the surfaces let it be. SetInteriorTolerance turns
   * UseInteriorTolerance on. Negative values and NaN are errors. Default: off.
   */
  void SetInteriorTolerance(double tolerance);
  /** The same, but leaves UseInteriorTolerance as it is: for user interfaces that set both. */
  void StoreInteriorTolerance(double tolerance);
  vtkGetMacro(InteriorTolerance, double);
  vtkSetMacro(UseInteriorTolerance, bool);
  vtkGetMacro(UseInteriorTolerance, bool);
  vtkBooleanMacro(UseInteriorTolerance, bool);
  ///@}

  ///@{
  /**
   * The gradient of the full-resolution field at every point, in world space. Default: off. There
   * are no normals: where a surface meets the grid's boundary, a point would need two.
   */
  vtkSetMacro(ComputeGradients, vtkTypeBool);
  vtkGetMacro(ComputeGradients, vtkTypeBool);
  vtkBooleanMacro(ComputeGradients, vtkTypeBool);
  ///@}

  /** Interior tolerances worth trying: up to the extent of the array's values; {0, VTK_DOUBLE_MAX}
   *  while there is no input. */
  double* GetInteriorToleranceRange() VTK_SIZEHINT(2);

  /** The tetrahedra. */
  vtkUnstructuredGrid* GetOutput();

protected:
  vtkIsodiamondIntervalVolume();
  ~vtkIsodiamondIntervalVolume() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkIsodiamond::WorldQuery GetQuery() const override;
  std::vector<isodiamond::Isoregion> GetRegions() const override;
  vtkIsodiamond::VolumePointData GetPointDataWanted() const override;
  const char* GetNameOfCells() const override { return "Tetrahedra"; }
  void Extract(const vtkIsodiamond::Volume& volume, const vtkIsodiamond::WorldQuery& query,
    vtkIsodiamond::Task& task, vtkDataObject* output) override;

  double Isorange[2] = { 0.0, 1.0 };
  double InteriorTolerance = 1.0;
  bool UseInteriorTolerance = false;
  vtkTypeBool ComputeGradients = 0;
  double InteriorToleranceRange[2] = { 0.0, VTK_DOUBLE_MAX };

private:
  vtkIsodiamondIntervalVolume(const vtkIsodiamondIntervalVolume&) = delete;
  void operator=(const vtkIsodiamondIntervalVolume&) = delete;
};

#endif
