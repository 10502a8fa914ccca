// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondBuilder
 * @brief   build a multiresolution hierarchy of an isosurface or interval volume from an image
 *
 * Input: a vtkImageData with a one-component point array of any scalar type (chosen with
 * SetInputArrayToProcess(0, port, connection, association, name); the point scalars by default) and
 * at least two samples on every axis; or a hierarchy of diamonds (HD) that another builder made,
 * from which RI and MI are made without the image. Output: a vtkIsodiamondHierarchy.
 *
 * An isosurface separates samples above the isovalue from the others; an interval volume holds the
 * samples within the isorange, its ends included. NaN counts as below. Errors, and so the
 * tolerances of queries, are in the units of the error metric.
 *
 * The whole extent of the input is requested, or slab after slab of it (NumberOfBlocks). In
 * parallel every piece holds the whole hierarchy, as extractors need all of it, but only the first
 * has its outline.
 *
 * @warning A sample that equals the isovalue counts as below it; surfaces that only touch samples
 * are empty.
 * @warning 64-bit integers beyond 2^53 are compared after rounding to double.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", IEEE TVCG 2010, sections 4, 5 and 7.
 */

#ifndef vtkIsodiamondBuilder_h
#define vtkIsodiamondBuilder_h

#include "vtkIsodiamondFiltersModule.h" // for export macro
#include "vtkIsodiamondHierarchy.h"     // for the models
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for what was built
#include "vtkTimeStamp.h"    // for when

#include <memory> // for the plan
#include <string> // for the names of arrays
#include <vector> // for the names of arrays

class vtkImageData;
namespace isodiamond
{
struct AffineMap;
struct BuildOptions;
}
namespace vtkIsodiamond
{
struct Choice;
struct InputArray;
class InputShares;
class SlabPlan;
class Slabs;
class Task;
}

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondBuilder : public vtkPolyDataAlgorithm
{
public:
  static vtkIsodiamondBuilder* New();
  vtkTypeMacro(vtkIsodiamondBuilder, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** In addition to vtkIsodiamondHierarchy::ErrorMetrics: field for an HD, otherwise distance. */
  static constexpr int AUTOMATIC = vtkIsodiamondHierarchy::DISTANCE + 1;

  ///@{
  /**
   * Which hierarchy: of diamonds (HD: any isovalue later, about 3 bytes per voxel in addition to
   * the samples), relevant (RI) or minimal (MI, the smallest). Default: minimal.
   */
  vtkSetClampMacro(
    Model, int, vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS, vtkIsodiamondHierarchy::MINIMAL);
  vtkGetMacro(Model, int);
  void SetModelToHierarchyOfDiamonds()
  {
    this->SetModel(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  }
  void SetModelToRelevant() { this->SetModel(vtkIsodiamondHierarchy::RELEVANT); }
  void SetModelToMinimal() { this->SetModel(vtkIsodiamondHierarchy::MINIMAL); }
  ///@}

  ///@{
  /**
   * What the hierarchy represents; for an HD, the default of later queries. Default: isosurface.
   */
  vtkSetClampMacro(
    Shape, int, vtkIsodiamondHierarchy::ISOSURFACE, vtkIsodiamondHierarchy::INTERVAL_VOLUME);
  vtkGetMacro(Shape, int);
  void SetShapeToIsosurface() { this->SetShape(vtkIsodiamondHierarchy::ISOSURFACE); }
  void SetShapeToIntervalVolume() { this->SetShape(vtkIsodiamondHierarchy::INTERVAL_VOLUME); }
  ///@}

  ///@{
  /**
   * The isovalue of an isosurface, in field units; for an HD, the default of later queries. Outside
   * the data's range the surface is empty. Default: 0.
   */
  vtkSetMacro(Isovalue, double);
  vtkGetMacro(Isovalue, double);
  ///@}

  ///@{
  /**
   * The isorange [lower, upper] of an interval volume, in field units; for an HD, the default of
   * later queries. An end that is infinite or beyond the data's range leaves that side open. A
   * range outside the data's gives an empty volume; lower >= upper and NaN are errors.
   * Default: [0, 1].
   */
  vtkSetVector2Macro(Isorange, double);
  vtkGetVector2Macro(Isorange, double);
  ///@}

  ///@{
  /**
   * What tolerances measure. *Distance*: in world units; no point of the mesh is farther from the
   * full-resolution surface than the tolerance, and no vertex of that surface is farther from the
   * mesh. *Field* (the paper's): in field units, between the field and its linear interpolant; the
   * only one for an HD, as distances need an isovalue. *Automatic*: field for an HD, otherwise
   * distance. Default: field.
   */
  vtkSetClampMacro(ErrorMetric, int, vtkIsodiamondHierarchy::FIELD, AUTOMATIC);
  vtkGetMacro(ErrorMetric, int);
  void SetErrorMetricToField() { this->SetErrorMetric(vtkIsodiamondHierarchy::FIELD); }
  void SetErrorMetricToDistance() { this->SetErrorMetric(vtkIsodiamondHierarchy::DISTANCE); }
  void SetErrorMetricToAutomatic() { this->SetErrorMetric(AUTOMATIC); }
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
   * tolerance, the more triangles this adds. For an HD, queries decide: see
   * vtkIsodiamondExtractor's PreserveTopology. Default: off.
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
   * Sizes above 1 are an error for an HD, which holds the samples, and for what is made from one.
   * 0 and 1 keep all. Default: 0.
   */
  vtkSetClampMacro(MinimumPieceSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(MinimumPieceSize, int);
  ///@}

  ///@{
  /**
   * Whether an interval volume can be refined inside, where no surface is: keeps every diamond with
   * all vertices inside, and its field error, for vtkIsodiamondExtractor's InteriorTolerance. Takes
   * memory in proportion to the volume inside. An HD does not need it. Default: off.
   */
  vtkSetMacro(RefineInterior, bool);
  vtkGetMacro(RefineInterior, bool);
  vtkBooleanMacro(RefineInterior, bool);
  ///@}

  ///@{
  /**
   * Close every surface whose isovalue is above the data's minimum: the volume counts as padded on
   * all six sides by a layer of that minimum, so caps lie less than a voxel outside the image. When
   * off, the surface ends at the image's boundary, as with any contour filter. Has no effect on an
   * interval volume, which is closed by the image's faces, or with an HD as input. An HD is closed
   * or not for all that is extracted from it: with the shape of an isosurface, volumes reach the
   * caps, too; with that of an interval volume, surfaces stay open. Default: off.
   */
  vtkSetMacro(CloseBoundary, bool);
  vtkGetMacro(CloseBoundary, bool);
  vtkBooleanMacro(CloseBoundary, bool);
  ///@}

  ///@{
  /**
   * Other point arrays of the image that the hierarchy is to carry, so that its meshes can be
   * coloured by them: one value for every stored isovertex, and for every lattice point inside an
   * interval volume, interpolated trilinearly. An array that the image lacks is an error. For an
   * HD, and for what is made from one, this warns and has no effect. Default: none.
   */
  void AddPointArray(const char* name);
  void ClearPointArrays();
  int GetNumberOfPointArrays();
  const char* GetPointArray(int i);
  ///@}

  ///@{
  /**
   * Whether the hierarchy is to carry surface normals, from the full-resolution gradient: 12 bytes
   * per point. As above, not for an HD. Default: off.
   */
  vtkSetMacro(ComputeNormals, bool);
  vtkGetMacro(ComputeNormals, bool);
  vtkBooleanMacro(ComputeNormals, bool);
  ///@}

  ///@{
  /**
   * Into how many slabs, of 8 slices or more, an image is cut at most, so that no more than one is
   * in memory: each is requested twice, once more if the hierarchy carries point arrays or normals,
   * and with CloseBoundary once beforehand, to find the minimum. The hierarchy is the same however
   * the image is cut. 0: one, in parallel one for each process, or as many as keep the image within
   * the free memory. For relevant and minimal hierarchies of images without blanked cells, from
   * sources that can give parts of an image; otherwise the image is read at once, with a warning if
   * more than one was asked for. Default: 0.
   */
  vtkSetClampMacro(NumberOfBlocks, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfBlocks, int);
  ///@}

  /** How many slabs the last execution requested; 1 if the input was read at once. */
  int GetNumberOfSlabs();

  ///@{
  /**
   * Threads to use; 0 for all cores. The result does not depend on it. Default: 0.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /** The output, as a vtkIsodiamondHierarchy. */
  vtkIsodiamondHierarchy* GetHierarchy();

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkIsodiamondBuilder();
  ~vtkIsodiamondBuilder() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  /** Notes the requested piece of the output. */
  int ModifyRequest(vtkInformation* request, int when) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Model = vtkIsodiamondHierarchy::MINIMAL;
  int Shape = vtkIsodiamondHierarchy::ISOSURFACE;
  double Isovalue = 0.0;
  double Isorange[2] = { 0.0, 1.0 };
  int ErrorMetric = vtkIsodiamondHierarchy::FIELD;
  bool ExactIsovertices = true;
  bool PreserveFeatures = true;
  bool PreserveTopology = false;
  int MinimumPieceSize = 0;
  bool RefineInterior = false;
  bool CloseBoundary = false;
  std::vector<std::string> PointArrays;
  bool ComputeNormals = false;
  int NumberOfBlocks = 0;
  int NumberOfThreads = 0;

private:
  vtkIsodiamondBuilder(const vtkIsodiamondBuilder&) = delete;
  void operator=(const vtkIsodiamondBuilder&) = delete;

  vtkIsodiamond::InputArray FindInputArray(vtkDataObject* input);
  vtkIsodiamond::Choice GetChoice() const;
  isodiamond::BuildOptions GetOptions(const isodiamond::AffineMap& world) const;
  void CheckModel() const;
  void WarnWithoutPointArrays();
  bool ClosesBoundary() const;
  bool CanBeCut() const;
  void BuildFromImage(vtkImageData* image, vtkIsodiamond::Task& task, vtkPolyData* output);
  void BuildFromSlabs(
    const vtkIsodiamond::Slabs& slabs, vtkIsodiamond::Task& task, vtkPolyData* output);
  void BuildFromHierarchy(vtkPolyData* input, vtkIsodiamond::Task& task, vtkPolyData* output);
  void Build(vtkDataObject* input, vtkIsodiamond::Task& task, vtkPolyData* output);

  std::unique_ptr<vtkIsodiamond::InputShares> Shares;
  std::unique_ptr<vtkIsodiamond::SlabPlan> Plan;
  /** What was built, from what, and when: in parallel, extractors request the hierarchy as a single
   *  piece, and whatever displays it requests one of several. Both are the same hierarchy. */
  vtkSmartPointer<vtkIsodiamondHierarchy> Built;
  vtkDataObject* BuiltOf = nullptr; ///< for comparison only, may no longer exist
  vtkTimeStamp BuiltAt;
};

#endif
