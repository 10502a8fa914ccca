// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondExtractor
 * @brief   extract a crack-free mesh from an isodiamond hierarchy at an error tolerance
 *
 * Input: a vtkIsodiamondHierarchy, or any vtkPolyData that holds one (such as a reader returns).
 * Output: triangles for an isosurface, with normals toward lower values; tetrahedra for an interval
 * volume. Point data: the field's value, under the name of the array that the hierarchy was built
 * from (the isovalue on a surface, the sample inside; the point scalars for a volume only); for an
 * interval volume also `Surface`: -1 on the lower surface, 1 on the upper one, 0 inside; and the
 * other arrays that the hierarchy carries. Cell data: `Level` of the diamond that a cell lies in,
 * 0 for the coarsest.
 *
 * The mesh has no cracks at any tolerance, and the three models give the same mesh. A coarser mesh
 * takes less time, in proportion to its size. All tetrahedra have positive volume; every face of
 * one is also a face of another, or lies on a surface or the image's boundary.
 *
 * In parallel every process needs the whole hierarchy, and makes its share of the mesh's cells: all
 * pieces together are the mesh, with each cell once.
 *
 * @warning With an open boundary, a surface's edges on the image's boundary have only one triangle.
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
   * How many stored diamonds the last execution subdivided (but for those that SimulationQuality
   * refines afterwards), and the size of its active front: the
   * diamonds that were not subdivided but have a subdivided parent, or the root alone. For HD and
   * RI all diamonds of the domain count; for MI, stored ones with a stored parent. 0 before the
   * first execution and after an error. Both are counted on demand, since counting the front takes
   * about as long as the extraction; for this the filter keeps the hierarchy alive until it
   * executes again.
   */
  vtkIdType GetNumberOfSubdividedDiamonds();
  vtkIdType GetNumberOfFrontDiamonds();
  ///@}

  double* GetErrorToleranceRange() VTK_SIZEHINT(2) override;

  /** Interior tolerances worth trying, in field units; the maximum, which acts as infinity, is
   *  VTK_DOUBLE_MAX while there is no hierarchy. */
  double* GetInteriorToleranceRange() VTK_SIZEHINT(2);

  /** Types of the output. */
  enum OutputTypes
  {
    UNSTRUCTURED_GRID = 0,
    POLY_DATA = 1
  };

  ///@{
  /**
   * The type of the output: an unstructured grid, or poly data for filters and writers that take
   * surfaces. Poly data is an error for an interval volume. Default: unstructured grid.
   */
  vtkSetClampMacro(OutputType, int, UNSTRUCTURED_GRID, POLY_DATA);
  vtkGetMacro(OutputType, int);
  void SetOutputTypeToUnstructuredGrid() { this->SetOutputType(UNSTRUCTURED_GRID); }
  void SetOutputTypeToPolyData() { this->SetOutputType(POLY_DATA); }
  ///@}

  ///@{
  /**
   * The tolerated error inside an interval volume, where no surface is, in field units. It
   * holds in tetrahedra whose diamond has all vertices inside; in others ErrorTolerance does, in
   * its own metric. When off, the inside is as coarse as the surfaces let it be.
   * SetInteriorTolerance turns UseInteriorTolerance on. Needs an HD or vtkIsodiamondBuilder's
   * RefineInterior. Default: off.
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
   * A shape other than the hierarchy's own, for an HD. RI and MI are of one shape: with them this
   * warns and has no effect. Default: -1, the hierarchy's own.
   */
  vtkSetClampMacro(Shape, int, -1, vtkIsodiamondHierarchy::INTERVAL_VOLUME);
  vtkGetMacro(Shape, int);
  void SetShapeToIsosurface() { this->SetShape(vtkIsodiamondHierarchy::ISOSURFACE); }
  void SetShapeToIntervalVolume() { this->SetShape(vtkIsodiamondHierarchy::INTERVAL_VOLUME); }
  ///@}

  ///@{
  /**
   * An isorange other than the hierarchy's own, for an HD. SetIsorange turns UseIsorange on. RI and
   * MI are of one isorange: with them this warns and has no effect. Default: off.
   */
  void SetIsorange(double lower, double upper);
  void SetIsorange(const double isorange[2]) { this->SetIsorange(isorange[0], isorange[1]); }
  /** The same, but leaves UseIsorange as it is: for user interfaces that set both, first to their
   *  initial values. */
  void StoreIsorange(double lower, double upper);
  vtkGetVector2Macro(Isorange, double);
  vtkSetMacro(UseIsorange, bool);
  vtkGetMacro(UseIsorange, bool);
  vtkBooleanMacro(UseIsorange, bool);
  ///@}

  ///@{
  /**
   * An isovalue other than the hierarchy's own default, for an HD. SetIsovalue turns UseIsovalue
   * on. RI and MI are of one isovalue: with them this warns and has no effect. Default: off.
   */
  void SetIsovalue(double isovalue);
  /** The same, but leaves UseIsovalue as it is: for user interfaces that set both, first to their
   *  initial values. */
  void StoreIsovalue(double isovalue);
  vtkGetMacro(Isovalue, double);
  vtkSetMacro(UseIsovalue, bool);
  vtkGetMacro(UseIsovalue, bool);
  vtkBooleanMacro(UseIsovalue, bool);
  ///@}

  ///@{
  /**
   * For an HD, keep the topology of the full-resolution surface at every tolerance: the same
   * pieces, holes and boundary loops. RI and MI are built with it or without
   * (vtkIsodiamondBuilder's PreserveTopology): with one built without, this warns and has no
   * effect. Default: off.
   */
  vtkSetMacro(PreserveTopology, bool);
  vtkGetMacro(PreserveTopology, bool);
  vtkBooleanMacro(PreserveTopology, bool);
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
   * along the same face. The cell array `Level` is left out. Needs the distance metric, and an
   * isosurface. Default: off.
   */
  vtkSetMacro(Simplify, bool);
  vtkGetMacro(Simplify, bool);
  vtkBooleanMacro(Simplify, bool);
  ///@}

  /** The mesh as an unstructured grid, or as poly data; null if OutputType is the other one. */
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

  /** Makes the output of a query: the requested share of it. */
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
