// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondVolumeAlgorithm
 * @brief   what the filters have that go from a volume to a mesh in one step
 *
 * The input is a volume: a vtkImageData (vtkUniformGrid too), a vtkRectilinearGrid or a
 * vtkStructuredGrid with two or more samples on each axis, and a point array of one component.
 * Composite inputs are worked on block by block; blocks without the array have no mesh. The filter
 * keeps the minimal isodiamond hierarchies that it builds: a new tolerance, region of interest or
 * viewpoint only extracts again, and so do blocks, time steps, isovalues and isoranges that it has
 * seen before, while they are kept (CacheSize).
 *
 * Blanked cells, cells at blanked points and ghost cells count as absent. Distances are the world's
 * on images and rectilinear grids, however these are spaced; on structured grids tolerances are by
 * the field metric. Full resolution needs no metric.
 *
 * The whole input is requested, or slab after slab of it if memory is short (NumberOfBlocks). In
 * parallel every process makes its share of the cells of each isosurface, or of the interval
 * volume: all pieces together are the mesh, with each cell once. Where the input can come in slabs,
 * each process asks for its share of these only, and measures its share of the errors.
 *
 * @sa vtkIsodiamondContour vtkIsodiamondIntervalVolume
 */

#ifndef vtkIsodiamondVolumeAlgorithm_h
#define vtkIsodiamondVolumeAlgorithm_h

#include "vtkIsodiamondAlgorithm.h"
#include "vtkIsodiamondFiltersModule.h" // for export macro
#include "vtkIsodiamondHierarchy.h"     // for the metrics

#include <memory> // for the cache and the plan
#include <vector> // for regions

class vtkDataSet;
namespace isodiamond
{
struct BuildOptions;
class GridGeometry;
class Isoregion;
}
namespace vtkIsodiamond
{
class Cache;
struct InputArray;
struct Mesh;
struct MeshOptions;
class SlabPlan;
class Task;
struct Volume;
struct VolumePointData;
}

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondVolumeAlgorithm : public vtkIsodiamondAlgorithm
{
public:
  vtkTypeMacro(vtkIsodiamondVolumeAlgorithm, vtkIsodiamondAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How the error of a tolerance is measured. *Distance*: in world units; no point of the mesh
   * is farther from the full-resolution surface than the tolerance, and no vertex of that from the
   * mesh. *Field* (the paper's): in field units, between the field and its linear interpolant.
   * Default: distance.
   */
  vtkSetClampMacro(
    ErrorMetric, int, vtkIsodiamondHierarchy::FIELD, vtkIsodiamondHierarchy::DISTANCE);
  vtkGetMacro(ErrorMetric, int);
  void SetErrorMetricToField() { this->SetErrorMetric(vtkIsodiamondHierarchy::FIELD); }
  void SetErrorMetricToDistance() { this->SetErrorMetric(vtkIsodiamondHierarchy::DISTANCE); }
  ///@}

  /** Units of tolerances. */
  enum ToleranceUnits
  {
    WORLD_UNITS = 0,
    VOXELS = 1
  };

  ///@{
  /**
   * What 1 is in ErrorTolerance and OutsideErrorTolerance by the distance metric: a world unit, or
   * a voxel, which is the smallest spacing of the grid. Default: world units.
   */
  vtkSetClampMacro(ToleranceUnit, int, WORLD_UNITS, VOXELS);
  vtkGetMacro(ToleranceUnit, int);
  void SetToleranceUnitToWorldUnits() { this->SetToleranceUnit(WORLD_UNITS); }
  void SetToleranceUnitToVoxels() { this->SetToleranceUnit(VOXELS); }
  ///@}

  ///@{
  /**
   * Measure errors no farther than the mesh that is asked for needs: it comes in a fifth to two
   * fifths of the time that it takes with all of them, but so does that of every other tolerance,
   * region of interest or viewpoint, where all are there at once else. For scripts, and for time
   * steps that are looked at once. The mesh keeps the tolerances as any does, mostly with a few
   * cells less. The field data have no table of tolerances.
   *
   * By the distance metric. Without effect with a target, an interior tolerance, of interval
   * volumes with SimulationQuality or hidden cells: these need all errors. Default: off.
   */
  vtkSetMacro(OneTolerance, bool);
  vtkGetMacro(OneTolerance, bool);
  vtkBooleanMacro(OneTolerance, bool);
  ///@}

  ///@{
  /**
   * Put every vertex on the full-resolution surface, to 1/256 of its lattice edge (2/256 where an
   * edge carries both surfaces of an interval volume). Off, vertices lie where the field would
   * cross the isovalue if it were linear along the edge, as in the paper; at full resolution both
   * are the same. Default: on.
   */
  vtkSetMacro(ExactIsovertices, bool);
  vtkGetMacro(ExactIsovertices, bool);
  vtkBooleanMacro(ExactIsovertices, bool);
  ///@}

  ///@{
  /**
   * With the distance metric, keep the promise of the tolerance for thin things too: every vertex
   * of the full-resolution surface has a part of the mesh to count with, so what is thinner than
   * the tolerance stays. Matters from tolerances on that exceed a feature's size, where it leaves a
   * floor of triangles. Off, what is thinner may vanish, and the promise with it; whole pieces do
   * not with PreserveTopology. Default: on.
   */
  vtkSetMacro(PreserveFeatures, bool);
  vtkGetMacro(PreserveFeatures, bool);
  vtkBooleanMacro(PreserveFeatures, bool);
  ///@}

  ///@{
  /**
   * Keep the topology of the full-resolution surface: the mesh of every tolerance, infinity
   * included, with any region and viewpoint, has the same pieces, holes and boundary loops, by
   * either metric. The diamonds whose subdivision changes the topology are always subdivided, which
   * takes more triangles the larger the tolerance is. Default: on.
   */
  vtkSetMacro(PreserveTopology, bool);
  vtkGetMacro(PreserveTopology, bool);
  vtkBooleanMacro(PreserveTopology, bool);
  ///@}

  ///@{
  /**
   * Remove pieces of fewer samples, noise for instance, before all else: connected sets of samples
   * above the isovalue count as below it, then holes in what is left as above; those at the
   * volume's boundary too. Of an interval volume the same for each of its surfaces. Samples are
   * connected as the full-resolution mesh connects them. 0 and 1 keep all. Default: 0.
   */
  vtkSetClampMacro(MinimumPieceSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(MinimumPieceSize, int);
  ///@}

  ///@{
  /**
   * Interpolate all other point arrays of the input at the mesh's points, trilinearly; integers
   * become floats. Default: on.
   */
  vtkSetMacro(InterpolateAttributes, vtkTypeBool);
  vtkGetMacro(InterpolateAttributes, vtkTypeBool);
  vtkBooleanMacro(InterpolateAttributes, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Up to how many MiB of hierarchies are kept beside those that the last execution used. What was
   * used longest ago goes first. Default: 512.
   */
  vtkSetClampMacro(CacheSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(CacheSize, int);
  ///@}

  ///@{
  /**
   * Into how many slabs of slices the input is cut, so that no more than one of them is in memory:
   * each is asked for three times, for signs, isovertices and point data, when a hierarchy is
   * built, and before for the minimum if the boundary is closed. The mesh is the same however it is
   * cut. 0: one, or as many as keep the input within the memory that is free. Slabs are for images
   * without blanked cells from sources that make parts of an image; else the input comes at once,
   * with a warning if more than one was asked for. Hierarchies are known again by upstream's
   * modification times then, not by content. Default: 0.
   */
  vtkSetClampMacro(NumberOfBlocks, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfBlocks, int);
  ///@}

  /** How many slabs the last execution asked for; 1 if the input came at once. */
  int GetNumberOfSlabs();

  ///@{
  /** How many hierarchies this filter has built so far, and keeps. */
  vtkIdType GetNumberOfBuilds();
  vtkIdType GetNumberOfCachedHierarchies();
  ///@}

  /** How many pieces MinimumPieceSize removed in the last execution, from all isovalues and blocks
   *  together. 0 before the first one and after an error. Unless that size is 0, each mesh has its
   *  own in the field data, `NumberOfRemovedPieces`. */
  vtkGetMacro(NumberOfRemovedPieces, vtkIdType);

  double* GetErrorToleranceRange() VTK_SIZEHINT(2) override;

protected:
  vtkIsodiamondVolumeAlgorithm();
  ~vtkIsodiamondVolumeAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  /** Blocks of one execution come after it. */
  int ModifyRequest(vtkInformation* request, int when) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /** Whether the volume is padded. */
  virtual bool ClosesBoundary() const { return false; }

  /** What meshes are to be extracted of. @throws std::invalid_argument if it makes no sense */
  virtual std::vector<isodiamond::Isoregion> GetRegions() const = 0;

  /** What points are to have of the volume. */
  virtual vtkIsodiamond::VolumePointData GetPointDataWanted() const = 0;

  /** What the mesh consists of, in words. */
  virtual const char* GetNameOfCells() const = 0;

  /** Makes the output, from hierarchies of the cache, which is ready for the volume. Runs in a
   *  scope of vtkSMPTools. @throws std::exception that says what is wrong */
  virtual void Extract(const vtkIsodiamond::Volume& volume, const vtkIsodiamond::WorldQuery& query,
    vtkIsodiamond::Task& task, vtkDataObject* output) = 0;

  /** The mesh of a region: its hierarchy is one of the cache, refined by a query. Its points have
   *  what GetPointDataWanted() says. */
  vtkIsodiamond::Mesh ExtractMesh(const vtkIsodiamond::Volume& volume,
    const isodiamond::Isoregion& region, const vtkIsodiamond::WorldQuery& query,
    vtkIsodiamond::MeshOptions options, vtkIsodiamond::Task& task);

  vtkIsodiamond::InputArray FindInputArray(vtkDataSet* input);

  int ErrorMetric = vtkIsodiamondHierarchy::DISTANCE;
  int ToleranceUnit = WORLD_UNITS;
  bool OneTolerance = false;
  bool ExactIsovertices = true;
  bool PreserveFeatures = true;
  bool PreserveTopology = true;
  int MinimumPieceSize = 0;
  vtkTypeBool InterpolateAttributes = 1;
  int CacheSize = 512;
  int NumberOfBlocks = 0;

private:
  vtkIsodiamondVolumeAlgorithm(const vtkIsodiamondVolumeAlgorithm&) = delete;
  void operator=(const vtkIsodiamondVolumeAlgorithm&) = delete;

  isodiamond::BuildOptions GetOptions(
    const isodiamond::GridGeometry& world, const vtkIsodiamond::WorldQuery& query) const;
  double GetUnit(double voxel) const;
  vtkIsodiamond::CountedTolerance Aim(const vtkIsodiamond::Volume& volume,
    const vtkIsodiamond::WorldQuery& query, vtkIsodiamond::Task& task);
  void WriteTable(const vtkIsodiamond::Volume& volume, const vtkIsodiamond::WorldQuery& query,
    double unit, vtkIsodiamond::Task& task, vtkDataObject* output);
  void ExtractAtTolerance(const vtkIsodiamond::Volume& volume,
    const vtkIsodiamond::WorldQuery& query, double unit, vtkIsodiamond::Task& task,
    vtkDataObject* output);

  void BuildTogether(const vtkIsodiamond::Volume& volume, const vtkIsodiamond::WorldQuery& query,
    vtkIsodiamond::Task& task);

  std::unique_ptr<vtkIsodiamond::Cache> Hierarchies;
  std::unique_ptr<vtkIsodiamond::SlabPlan> Plan;
  /** Of a composite input: whether some have it. The others then have no mesh; else nobody has it,
   *  which is an error. */
  bool HaveBlocksTheArray = false;
  vtkIdType NumberOfRemovedPieces = 0;
  vtkIdType RemovedFromBlock = 0; ///< counts as soon as all of the block is well
};

#endif
