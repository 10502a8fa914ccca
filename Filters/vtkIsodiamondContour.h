// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondContour
 * @brief   isosurfaces of a volume at an error tolerance, in one step
 *
 * A drop-in replacement for a contour filter, with an error tolerance: a volume in, vtkPolyData of
 * triangles out. The filter keeps one minimal isodiamond hierarchy per isovalue: for a new
 * tolerance, region of interest or viewpoint it only extracts again. For a new input, array,
 * isovalue, boundary option or error metric, for other isovertices, features, topology or smallest
 * pieces, and with the distance metric for another spacing or direction, it builds what is missing;
 * see vtkIsodiamondVolumeAlgorithm.
 *
 * Point data: the isovalue under the input array's name (ComputeScalars), "Normals" toward lower
 * values (ComputeNormals) and "Gradient" (ComputeGradients), both from the full-resolution field,
 * and all other point arrays of the input (InterpolateAttributes). Cell data: "Level", see
 * vtkIsodiamondExtractor.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", IEEE TVCG 2010.
 *
 * @sa vtkIsodiamondBuilder vtkIsodiamondExtractor vtkContourFilter
 */

#ifndef vtkIsodiamondContour_h
#define vtkIsodiamondContour_h

#include "vtkContourValues.h"           // for the inline methods
#include "vtkIsodiamondFiltersModule.h" // for export macro
#include "vtkIsodiamondVolumeAlgorithm.h"
#include "vtkNew.h" // for the contour values

class vtkPolyData;

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondContour : public vtkIsodiamondVolumeAlgorithm
{
public:
  static vtkIsodiamondContour* New();
  vtkTypeMacro(vtkIsodiamondContour, vtkIsodiamondVolumeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The isovalues, in field units. Default: one, 0, as in vtkContourFilter; without any the output
   * is empty.
   */
  void SetValue(int i, double value) { this->ContourValues->SetValue(i, value); }
  double GetValue(int i) { return this->ContourValues->GetValue(i); }
  double* GetValues() { return this->ContourValues->GetValues(); }
  void GetValues(double* values) { this->ContourValues->GetValues(values); }
  void SetNumberOfContours(int number) { this->ContourValues->SetNumberOfContours(number); }
  vtkIdType GetNumberOfContours() { return this->ContourValues->GetNumberOfContours(); }
  void GenerateValues(int number, double range[2])
  {
    this->ContourValues->GenerateValues(number, range);
  }
  void GenerateValues(int number, double first, double last)
  {
    this->ContourValues->GenerateValues(number, first, last);
  }
  ///@}

  ///@{
  /**
   * Point normals from the gradient of the full-resolution field; with Simplify, means of these.
   * Default: on.
   */
  vtkSetMacro(ComputeNormals, vtkTypeBool);
  vtkGetMacro(ComputeNormals, vtkTypeBool);
  vtkBooleanMacro(ComputeNormals, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The gradient of the full-resolution field at every point, in world space. Default: off.
   */
  vtkSetMacro(ComputeGradients, vtkTypeBool);
  vtkGetMacro(ComputeGradients, vtkTypeBool);
  vtkBooleanMacro(ComputeGradients, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The isovalue as point scalars. Default: on.
   */
  vtkSetMacro(ComputeScalars, vtkTypeBool);
  vtkGetMacro(ComputeScalars, vtkTypeBool);
  vtkBooleanMacro(ComputeScalars, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Simplify the mesh: a part of the tolerance (three tenths; less if it is below 3/4 voxel) goes
   * to the hierarchy, the rest to collapsing and flipping edges; the result is measured, both ways
   * and over all of every triangle, and undone where it is too far away or passes through something
   * else. So the tolerance still holds, the topology is kept and no two triangles of an isosurface
   * intersect, with a fraction of the triangles, which take longer to make.
   * Points are some of those that the surface would have had, with their data, except for normals,
   * which are means over what a point stands for. What ends at the grid's boundary still does,
   * along the same face. The cell array `Level` is left out. Needs the distance metric.
   * Default: off.
   */
  vtkSetMacro(Simplify, bool);
  vtkGetMacro(Simplify, bool);
  vtkBooleanMacro(Simplify, bool);
  ///@}

  ///@{
  /**
   * Close surfaces at the image's boundary; see vtkIsodiamondBuilder. Default: off.
   */
  vtkSetMacro(CloseBoundary, bool);
  vtkGetMacro(CloseBoundary, bool);
  vtkBooleanMacro(CloseBoundary, bool);
  ///@}

  /** The surface. */
  vtkPolyData* GetOutput();

  vtkMTimeType GetMTime() override;

protected:
  vtkIsodiamondContour();
  ~vtkIsodiamondContour() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkIsodiamond::WorldQuery GetQuery() const override;
  bool ClosesBoundary() const override { return this->CloseBoundary; }
  std::vector<isodiamond::Isoregion> GetRegions() const override;
  vtkIsodiamond::VolumePointData GetPointDataWanted() const override;
  const char* GetNameOfCells() const override { return "Triangles"; }
  void Extract(const vtkIsodiamond::Volume& volume, const vtkIsodiamond::WorldQuery& query,
    vtkIsodiamond::Task& task, vtkDataObject* output) override;

  vtkNew<vtkContourValues> ContourValues;
  vtkTypeBool ComputeNormals = 1;
  vtkTypeBool ComputeGradients = 0;
  vtkTypeBool ComputeScalars = 1;
  bool Simplify = false;
  bool CloseBoundary = false;

private:
  vtkIsodiamondContour(const vtkIsodiamondContour&) = delete;
  void operator=(const vtkIsodiamondContour&) = delete;
};

#endif
