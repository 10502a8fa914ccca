// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondVolumeAlgorithm
 * @brief   base of the filters that go from a volume to a mesh in one step
 *
 * The input is a volume: a vtkImageData (vtkUniformGrid too), a vtkRectilinearGrid or a
 * vtkStructuredGrid, with two or more samples on each axis and a point array of one component.
 * Composite inputs are processed block by block; blocks without the array have no mesh. The filter
 * keeps the minimal isodiamond hierarchies that it builds: for a new tolerance, region of interest
 * or viewpoint it only extracts again, and also for blocks, time steps, isovalues and isoranges
 * that it has seen before, while their hierarchies are kept (CacheSize).
 *
 * Blanked cells, cells at blanked points and ghost cells count as absent. Distances are the world's
 * on all of these grids, whatever their spacing and however they are bent.
 *
 * The whole input is requested, or slab after slab of it if memory is short (NumberOfBlocks). In
 * parallel every process makes its share of the cells of each isosurface, or of the interval
 * volume: all pieces together are the mesh, with each cell once. If the input can be read in slabs,
 * each process requests only its share of them, and measures its share of the errors.
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
   * What tolerances measure. *Distance*: in world units; no point of the mesh is farther from the
   * full-resolution surface than the tolerance, and no vertex of that surface is farther from the
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
   * The unit of ErrorTolerance and OutsideErrorTolerance with the distance metric: world units, or
   * voxels (the smallest spacing of the grid). Default: world units.
   */
  vtkSetClampMacro(ToleranceUnit, int, WORLD_UNITS, VOXELS);
  vtkGetMacro(ToleranceUnit, int);
  void SetToleranceUnitToWorldUnits() { this->SetToleranceUnit(WORLD_UNITS); }
  void SetToleranceUnitToVoxels() { this->SetToleranceUnit(VOXELS); }
  ///@}

  ///@{
  /**
   * Measure only the errors that the current mesh needs: the mesh takes a sixth to two fifths of
   * the time that it takes with all of them, but so does the mesh of every other tolerance, region
   * of interest or viewpoint, while with all errors these come at once. For scripts, and for time
   * steps that are looked at once only. The mesh keeps the tolerances as any other does, mostly
   * with a few cells fewer. The field data have no table of tolerances.
   *
   * For the distance metric. Has no effect with a target or an interior tolerance, or for interval
   * volumes with SimulationQuality or hidden cells: these need all errors. Default: off.
   */
  vtkSetMacro(OneTolerance, bool);
  vtkGetMacro(OneTolerance, bool);
  vtkBooleanMacro(OneTolerance, bool);
  ///@}

  ///@{
  /**
   * Put every vertex on the full-resolution surface, to within 1/256 of its lattice edge (2/256
   * where an edge carries both surfaces of an interval volume). When off, vertices lie where the
   * field would cross the isovalue if it were linear along the edge, as in the paper; at full
   * resolution both are the same. Default: on.
   */
  vtkSetMacro(ExactIsovertices, bool);
  vtkGetMacro(ExactIsovertices, bool);
  vtkBooleanMacro(ExactIsovertices, bool);
  ///@}

  ///@{
  /**
   * With the distance metric, keep the promise of the tolerance for thin things too: every vertex
   * of the full-resolution surface has a part of the mesh to be measured against, so what is
   * thinner than the tolerance stays. Changes nothing at tolerances below a feature's size; above
   * it, a minimum of triangles remains. When off, thin things may vanish, and the promise with
   * them; no piece vanishes altogether while PreserveTopology is on. Default: on.
   */
  vtkSetMacro(PreserveFeatures, bool);
  vtkGetMacro(PreserveFeatures, bool);
  vtkBooleanMacro(PreserveFeatures, bool);
  ///@}

  ///@{
  /**
   * Keep the topology of the full-resolution surface: the mesh at every tolerance, even infinity,
   * with any region and viewpoint, has the same pieces, holes and boundary loops, with either
   * metric. Diamonds whose subdivision changes the topology are always subdivided: the larger the
   * tolerance, the more triangles this adds. Default: on.
   */
  vtkSetMacro(PreserveTopology, bool);
  vtkGetMacro(PreserveTopology, bool);
  vtkBooleanMacro(PreserveTopology, bool);
  ///@}

  ///@{
  /**
   * Remove pieces of fewer samples than this, noise for instance, before anything else: such
   * connected sets of samples above the isovalue count as below it, then such cavities in what is
   * left count as above; those at the volume's boundary, too. For an interval volume the same is
   * done for each of its surfaces. Samples are connected as the full-resolution mesh connects them.
   * 0 and 1 keep all. Default: 0.
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
   * Up to how many MiB of hierarchies, with the arrays at their points, are kept besides those that
   * the last execution used: the most recently used that fit. Default: 512.
   */
  vtkSetClampMacro(CacheSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(CacheSize, int);
  ///@}

  ///@{
  /**
   * Into how many slabs, of 8 slices or more, the input is cut at most, so that no more than one is
   * in memory: when a hierarchy is built, each is requested twice, once more for point data, and if
   * the boundary is closed once beforehand, to find the minimum. The mesh is the same however the
   * input is cut. 0: one, in parallel one for each process, or as many as keep the input within the
   * free memory. Slabs are for images without blanked cells, from sources that can give parts of an
   * image; otherwise the input is read at once, with a warning if more than one was asked for. With
   * slabs, hierarchies are recognized by upstream's modification times, not by content. Default: 0.
   */
  vtkSetClampMacro(NumberOfBlocks, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfBlocks, int);
  ///@}

  /** How many slabs the last execution requested; 1 if the input was read at once. */
  int GetNumberOfSlabs();

  ///@{
  /** How many hierarchies this filter has built so far, and how many it keeps. */
  vtkIdType GetNumberOfBuilds();
  vtkIdType GetNumberOfCachedHierarchies();
  ///@}

  /** How many pieces MinimumPieceSize removed in the last execution, over all isovalues and blocks
   *  together. 0 before the first execution and after an error. Unless MinimumPieceSize is 0, each
   *  mesh has its own number in its field data, `NumberOfRemovedPieces`. */
  vtkGetMacro(NumberOfRemovedPieces, vtkIdType);

  double* GetErrorToleranceRange() VTK_SIZEHINT(2) override;

protected:
  vtkIsodiamondVolumeAlgorithm();
  ~vtkIsodiamondVolumeAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  /** Runs before the blocks of an execution. */
  int ModifyRequest(vtkInformation* request, int when) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /** Whether the volume is padded. */
  virtual bool ClosesBoundary() const { return false; }

  /** What meshes are to be extracted from. @throws std::invalid_argument if it makes no sense */
  virtual std::vector<isodiamond::Isoregion> GetRegions() const = 0;

  /** What points are to have from the volume. */
  virtual vtkIsodiamond::VolumePointData GetPointDataWanted() const = 0;

  /** What the mesh consists of, in words. */
  virtual const char* GetNameOfCells() const = 0;

  /** Makes the output, from hierarchies of the cache, which has been prepared for the volume. Runs
   *  in a scope of vtkSMPTools. @throws std::exception that says what is wrong */
  virtual void Extract(const vtkIsodiamond::Volume& volume, const vtkIsodiamond::WorldQuery& query,
    vtkIsodiamond::Task& task, vtkDataObject* output) = 0;

  /** The mesh of a region, from its hierarchy in the cache, refined by a query. Its points have
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

  struct OneInput;

  /** @return false if a block among others has no such array: it has no mesh
   *  @throws std::exception that says what is wrong */
  bool Open(vtkInformation* information, OneInput& input);
  /** @param query in the units that users gave */
  void ExtractFrom(const OneInput& input, vtkIsodiamond::WorldQuery query,
    vtkIsodiamond::Task& task, vtkDataObject* output);
  isodiamond::BuildOptions GetOptions(
    const isodiamond::GridGeometry& world, const vtkIsodiamond::WorldQuery& query) const;
  /** @param samples null if they are not at hand */
  static bool RefinesInterior(const vtkIsodiamond::WorldQuery& query,
    const vtkIsodiamond::Volume& volume, vtkDataArray* samples);
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
  /** Whether some blocks of a composite input have the array. The others then have no mesh; if no
   *  block has it, that is an error. */
  bool HaveBlocksTheArray = false;
  bool HasFailed = false; ///< in the current or last execution, for one block at least
  vtkIdType NumberOfRemovedPieces = 0;
  vtkIdType RemovedFromBlock = 0; ///< counts only once the whole block has succeeded
};

#endif
