// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondIntervalVolume
 * @brief   the part of a volume between two values as tetrahedra, in one step
 *
 * A volume in, vtkUnstructuredGrid of tetrahedra out: the region lower <= field <= upper, at an
 * error tolerance. Neighbours share whole faces, all volumes are positive, and every face of one
 * tetrahedron alone lies on the lower surface, the upper surface or the volume's boundary. (On a
 * structured grid, volumes are positive as far as its own cells are: tetrahedra keep straight edges
 * where cells bend.) The filter keeps its minimal isodiamond hierarchies; a new tolerance only
 * extracts again. A new input, array or isorange builds a new one, and so does the first interior
 * tolerance; see vtkIsodiamondVolumeAlgorithm.
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
   * The isorange [lower, upper], in field units, its ends included. An end may be infinite, or
   * beyond the data's range: an open side. A range outside of the data's gives an empty volume;
   * lower >= upper and NaN are errors. Default: [0, 1].
   */
  vtkSetVector2Macro(Isorange, double);
  vtkGetVector2Macro(Isorange, double);
  ///@}

  ///@{
  /**
   * The error that is tolerated inside, in field units. No field error is greater than the extent
   * of the array's values; from there on the inside is as coarse as its surfaces let it be.
   * Negative values and NaN are errors. Default: VTK_DOUBLE_MAX.
   */
  vtkSetMacro(InteriorTolerance, double);
  vtkGetMacro(InteriorTolerance, double);
  ///@}

  /** Interior tolerances that are worth trying: up to the extent of the array's values; {0,
   *  VTK_DOUBLE_MAX} while there is no input. */
  double* GetInteriorToleranceRange() VTK_SIZEHINT(2);

  /** The tetrahedra. */
  vtkUnstructuredGrid* GetOutput();

protected:
  vtkIsodiamondIntervalVolume();
  ~vtkIsodiamondIntervalVolume() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void Extract(const vtkIsodiamond::Volume& volume, const vtkIsodiamond::WorldQuery& query,
    vtkIsodiamond::Task& task, vtkDataObject* output) override;

  double Isorange[2] = { 0.0, 1.0 };
  double InteriorTolerance = VTK_DOUBLE_MAX;
  double InteriorToleranceRange[2] = { 0.0, VTK_DOUBLE_MAX };

private:
  vtkIsodiamondIntervalVolume(const vtkIsodiamondIntervalVolume&) = delete;
  void operator=(const vtkIsodiamondIntervalVolume&) = delete;
};

#endif
