// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondExtractor
 * @brief   extract a crack-free mesh from an isodiamond hierarchy at an error tolerance
 *
 * Input: a vtkIsodiamondHierarchy, or any vtkPolyData that holds one (as a reader gives back).
 * Output: of an isosurface triangles, with normals to lower values; of an interval volume
 * tetrahedra. Point data: under the name of the array that the hierarchy was built from the field's
 * value, which is the isovalue on a surface and the sample inside, the point scalars of a volume
 * only; of an interval volume also `Surface`: -1 on the lower surface, 1 on the upper one, 0
 * inside; and the other arrays that the hierarchy carries. Cell data: `Level` of the diamond that a
 * cell lies in, 0 for the coarsest.
 *
 * The mesh has no cracks at any tolerance, and the three models give the same one. A coarser
 * tolerance costs less time, in proportion to what it returns. All tetrahedra have positive
 * volume; every face of one is a face of another, or lies on a surface or the image's boundary.
 *
 * In parallel every process needs the whole hierarchy, and makes its share of the mesh's cells: all
 * pieces together are the mesh, with each cell once.
 *
 * @warning With an open boundary, a surface's edges on the image's boundary have one triangle.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", IEEE TVCG 2010, section 6.
 */

#ifndef vtkIsodiamondExtractor_h
#define vtkIsodiamondExtractor_h

#include "vtkIsodiamondAlgorithm.h"
#include "vtkIsodiamondFiltersModule.h" // for export macro
#include "vtkIsodiamondHierarchy.h"     // for the shapes

#include <array>    // for what it starts with
#include <memory>   // for the last execution
#include <optional> // for what it starts with

namespace isodiamond
{
class RefinedSet;
}
class vtkFieldData;
class vtkPolyData;
class vtkUnstructuredGrid;
namespace vtkIsodiamond
{
struct Mesh;
struct WorldQuery;
struct State;
class Task;
}

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondExtractor : public vtkIsodiamondAlgorithm
{
public:
  static vtkIsodiamondExtractor* New();
  vtkTypeMacro(vtkIsodiamondExtractor, vtkIsodiamondAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Of the last execution: how many stored diamonds were subdivided, and the size of the active
   * front: diamonds that were not but have a subdivided parent, or the root alone. All diamonds of
   * the domain count for HD and RI; of an MI stored ones with a stored parent. 0 before the first
   * execution and after an error. They are counted on demand, since the front takes about as long
   * as the extraction: for that the filter keeps the hierarchy alive until it executes again.
   */
  vtkIdType GetNumberOfSubdividedDiamonds();
  vtkIdType GetNumberOfFrontDiamonds();
  ///@}

  double* GetErrorToleranceRange() VTK_SIZEHINT(2) override;

  /** Interior tolerances that are worth trying, in field units; the maximum, which is as good as
   *  infinity, stays at VTK_DOUBLE_MAX while there is no hierarchy. */
  double* GetInteriorToleranceRange() VTK_SIZEHINT(2);

  /** Data sets for the output. */
  enum OutputTypes
  {
    UNSTRUCTURED_GRID = 0,
    POLY_DATA = 1
  };

  ///@{
  /**
   * The type of the output: an unstructured grid, or poly data for the filters and writers that
   * take surfaces; for an interval volume that is an error. Default: unstructured grid.
   */
  vtkSetClampMacro(OutputType, int, UNSTRUCTURED_GRID, POLY_DATA);
  vtkGetMacro(OutputType, int);
  void SetOutputTypeToUnstructuredGrid() { this->SetOutputType(UNSTRUCTURED_GRID); }
  void SetOutputTypeToPolyData() { this->SetOutputType(POLY_DATA); }
  ///@}

  ///@{
  /**
   * The error that is tolerated where no surface is, inside an interval volume, in field units.
   * In tetrahedra with all vertices inside the error is at most the greater of this and of
   * ErrorTolerance, which holds where their diamond carries a surface. Without it the inside is as
   * coarse as its surfaces let it be. SetInteriorTolerance turns UseInteriorTolerance on. Needs an
   * HD or vtkIsodiamondBuilder's RefineInterior. Default: off.
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
   * Another shape than the hierarchy's own, for an HD. RI and MI are of one shape: with them it
   * warns and has no effect. Default: -1, the hierarchy's own.
   */
  vtkSetClampMacro(Shape, int, -1, vtkIsodiamondHierarchy::INTERVAL_VOLUME);
  vtkGetMacro(Shape, int);
  void SetShapeToIsosurface() { this->SetShape(vtkIsodiamondHierarchy::ISOSURFACE); }
  void SetShapeToIntervalVolume() { this->SetShape(vtkIsodiamondHierarchy::INTERVAL_VOLUME); }
  ///@}

  ///@{
  /**
   * Another isorange than the hierarchy's own, for an HD. SetIsorange turns UseIsorange on. RI and
   * MI are of one isorange: with them it warns and has no effect. Default: off.
   */
  void SetIsorange(double lower, double upper);
  void SetIsorange(double isorange[2]) { this->SetIsorange(isorange[0], isorange[1]); }
  /** The same, but leaves UseIsorange as it is: for user interfaces that set both, first to what
   * they start with. */
  void StoreIsorange(double lower, double upper);
  vtkGetVector2Macro(Isorange, double);
  vtkSetMacro(UseIsorange, bool);
  vtkGetMacro(UseIsorange, bool);
  vtkBooleanMacro(UseIsorange, bool);
  ///@}

  ///@{
  /**
   * Another isovalue than the hierarchy's own default, for an HD. SetIsovalue turns UseIsovalue
   * on. RI and MI are of one isovalue: with them it warns and has no effect. Default: off.
   */
  void SetIsovalue(double isovalue);
  /** The same, but leaves UseIsovalue as it is: for user interfaces that set both, first to what
   * they start with. */
  void StoreIsovalue(double isovalue);
  vtkGetMacro(Isovalue, double);
  vtkSetMacro(UseIsovalue, bool);
  vtkGetMacro(UseIsovalue, bool);
  vtkBooleanMacro(UseIsovalue, bool);
  ///@}

  ///@{
  /**
   * Keep the topology of the full-resolution surface at every tolerance, of an HD: the same pieces,
   * holes and boundary loops. RI and MI are built so or not (vtkIsodiamondBuilder's
   * PreserveTopology): with one that is not it warns and has no effect. Default: off.
   */
  vtkSetMacro(PreserveTopology, bool);
  vtkGetMacro(PreserveTopology, bool);
  vtkBooleanMacro(PreserveTopology, bool);
  ///@}

  ///@{
  /**
   * Simplify the mesh: a part of the tolerance (three tenths, less if it is below 3/4 voxel) goes
   * to the hierarchy, the rest to collapses and flips of edges, whose result is measured, both ways
   * and all of every triangle, and undone where it is too far away. So the tolerance stays what it
   * is, and the topology, with a fraction of the triangles, which take longer to make. Points are
   * some of those that the surface would have had, with their data, but for normals: these are
   * means over what a point stands for. What ends at the grid's boundary does so, along the same
   * face. The cell array `Level` is left out. Needs the distance metric, and an isosurface.
   * Default: off.
   */
  vtkSetMacro(Simplify, bool);
  vtkGetMacro(Simplify, bool);
  vtkBooleanMacro(Simplify, bool);
  ///@}

  /** The mesh as unstructured grid, and as poly data; null if OutputType is the other one. */
  vtkUnstructuredGrid* GetOutput();
  vtkPolyData* GetPolyDataOutput();

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkIsodiamondExtractor();
  ~vtkIsodiamondExtractor() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /** Makes the output of a query: the share of it that is asked for. */
  virtual void WriteMesh(const vtkIsodiamond::State& state, const vtkIsodiamond::WorldQuery& query,
    const isodiamond::RefinedSet& refined, vtkIsodiamond::Task& task, vtkDataObject* output);

  /** Whether the output is poly data. */
  virtual bool GivesPolyData() const { return this->OutputType == POLY_DATA; }

  vtkIsodiamond::WorldQuery GetQuery() const override;

  int OutputType = UNSTRUCTURED_GRID;
  double InteriorTolerance = 1.0;
  bool UseInteriorTolerance = false;
  int Shape = -1;
  double Isorange[2] = { 0.0, 1.0 };
  bool UseIsorange = false;
  double Isovalue = 0.0;
  bool UseIsovalue = false;
  bool PreserveTopology = false;
  bool Simplify = false;
  double InteriorToleranceRange[2] = { 0.0, VTK_DOUBLE_MAX };

private:
  vtkIsodiamondExtractor(const vtkIsodiamondExtractor&) = delete;
  void operator=(const vtkIsodiamondExtractor&) = delete;

  vtkFieldData* FindHierarchy();
  vtkIsodiamond::CountedTolerance Aim(const vtkIsodiamond::State& state,
    const vtkIsodiamond::WorldQuery& query, vtkIsodiamond::Task& task);
  vtkIsodiamond::Mesh MakeMesh(const vtkIsodiamond::State& state,
    const vtkIsodiamond::WorldQuery& query, const isodiamond::RefinedSet& refined,
    const vtkIsodiamond::Share& share, vtkIsodiamond::Task& task) const;
  vtkIsodiamond::WorldQuery GetExtracted(
    const vtkIsodiamond::State& state, const vtkIsodiamond::WorldQuery& query) const;
  void WarnOfUnusedValues(const vtkIsodiamond::State& state);
  void StoreWantedIsovalue(double isovalue);
  void StoreWantedIsorange(double lower, double upper);

  ///@{
  /** What a user interface started with, if there is one. */
  std::optional<double> FirstIsovalue;
  std::optional<std::array<double, 2>> FirstIsorange;
  ///@}

  /** The hierarchy, query and counts of the last execution. */
  struct Execution;
  std::unique_ptr<Execution> Last;
};

#endif
