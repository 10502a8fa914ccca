// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondBuilder
 * @brief   build a multiresolution hierarchy of an isosurface or interval volume from an image
 *
 * Input: a vtkImageData with a one-component point array of any scalar type (chosen with
 * SetInputArrayToProcess(0, port, connection, association, name); the point scalars by default)
 * and at least two samples on every axis; or a hierarchy of diamonds (HD) that another builder
 * made, from which RI and MI come without the image. Output: a vtkIsodiamondHierarchy.
 *
 * An isosurface separates samples above the isovalue from the others; an interval volume holds the
 * samples within the isorange, its ends included. NaN counts as below. Errors, and so the
 * tolerances of queries, are in the units of the error metric.
 *
 * The whole extent of the input is requested. In parallel every piece holds the whole hierarchy,
 * as extractors need it, but only the first one its outline.
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

  /** Beside vtkIsodiamondHierarchy::ErrorMetrics: distance, but for an HD field. */
  static constexpr int AUTOMATIC = vtkIsodiamondHierarchy::DISTANCE + 1;

  ///@{
  /**
   * Which hierarchy: of diamonds (HD: any isovalue later, about 3 bytes a voxel beyond the
   * samples), relevant (RI) or minimal (MI, the smallest). Default: minimal.
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
   * What to build the hierarchy of; for HD the default of later queries. Default: isosurface.
   */
  vtkSetClampMacro(
    Shape, int, vtkIsodiamondHierarchy::ISOSURFACE, vtkIsodiamondHierarchy::INTERVAL_VOLUME);
  vtkGetMacro(Shape, int);
  void SetShapeToIsosurface() { this->SetShape(vtkIsodiamondHierarchy::ISOSURFACE); }
  void SetShapeToIntervalVolume() { this->SetShape(vtkIsodiamondHierarchy::INTERVAL_VOLUME); }
  ///@}

  ///@{
  /**
   * The isovalue of an isosurface, in field units; for HD the default of later queries. Outside of
   * the data's range the surface is empty. Default: 0.
   */
  vtkSetMacro(Isovalue, double);
  vtkGetMacro(Isovalue, double);
  ///@}

  ///@{
  /**
   * The isorange [lower, upper] of an interval volume, in field units; for HD the default of later
   * queries. An end may be infinite, or beyond the data's range: an open side. A range outside of
   * the data's gives an empty volume; lower >= upper and NaN are errors. Default: [0, 1].
   */
  vtkSetVector2Macro(Isorange, double);
  vtkGetVector2Macro(Isorange, double);
  ///@}

  ///@{
  /**
   * How the error of a tolerance is measured. *Distance*: in world units; no point of the mesh
   * is farther from the full-resolution surface than the tolerance, and no vertex of that from the
   * mesh. *Field* (the paper's): in field units, between the field and its linear interpolant. An
   * HD has the field's only: distances need an isovalue. *Automatic*: distance, but for an HD
   * field. Default: field.
   */
  vtkSetClampMacro(ErrorMetric, int, vtkIsodiamondHierarchy::FIELD, AUTOMATIC);
  vtkGetMacro(ErrorMetric, int);
  void SetErrorMetricToField() { this->SetErrorMetric(vtkIsodiamondHierarchy::FIELD); }
  void SetErrorMetricToDistance() { this->SetErrorMetric(vtkIsodiamondHierarchy::DISTANCE); }
  void SetErrorMetricToAutomatic() { this->SetErrorMetric(AUTOMATIC); }
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
   * takes more triangles the larger the tolerance is. Of an
   * HD it is a matter of the query: vtkIsodiamondExtractor's PreserveTopology. Default: off.
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
   * connected as the full-resolution mesh connects them. Not for an HD, nor from one, which holds
   * samples: with them sizes above 1 are an error. 0 and 1 keep all. Default: 0.
   */
  vtkSetClampMacro(MinimumPieceSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(MinimumPieceSize, int);
  ///@}

  ///@{
  /**
   * Whether an interval volume can be refined inside, where no surface is: keeps every diamond
   * that has all vertices inside, with its field error, for vtkIsodiamondExtractor's
   * InteriorTolerance. Takes memory in proportion to the volume inside. An HD can without.
   * Default: off.
   */
  vtkSetMacro(RefineInterior, bool);
  vtkGetMacro(RefineInterior, bool);
  vtkBooleanMacro(RefineInterior, bool);
  ///@}

  ///@{
  /**
   * Close every surface above the data's minimum: the volume counts as padded on all six sides by
   * a layer of that minimum, so caps lie less than a voxel outside of the image. Off, the surface
   * ends at the image's boundary as with any contour filter. No effect on an interval volume,
   * which is closed by the image's faces, and on an HD input. Default: off.
   */
  vtkSetMacro(CloseBoundary, bool);
  vtkGetMacro(CloseBoundary, bool);
  vtkBooleanMacro(CloseBoundary, bool);
  ///@}

  ///@{
  /**
   * Other point arrays of the image that the hierarchy is to carry, so that its meshes can be
   * coloured by them: one value for every stored isovertex, and for every lattice point inside an
   * interval volume, interpolated trilinearly. An array that the image lacks is an error. Not for
   * an HD, nor from one: with them it warns and has no effect. Default: none.
   */
  void AddPointArray(const char* name);
  void ClearPointArrays();
  int GetNumberOfPointArrays();
  const char* GetPointArray(int i);
  ///@}

  ///@{
  /**
   * Whether the hierarchy is to carry the surface's normals of the full-resolution gradient: 12
   * bytes a point. As above not for an HD. Default: off.
   */
  vtkSetMacro(ComputeNormals, bool);
  vtkGetMacro(ComputeNormals, bool);
  vtkBooleanMacro(ComputeNormals, bool);
  ///@}

  ///@{
  /**
   * Into how many slabs of slices an image is cut, so that no more than one of them is in memory:
   * each is asked for twice, once more if the hierarchy carries point arrays, and before for the
   * minimum with CloseBoundary. The hierarchy is the same however it is cut. 0: one, or as many as
   * keep the image within the memory that is free. For relevant and minimal hierarchies of
   * images without blanked cells from sources that make parts of them; else the image comes at
   * once, with a warning if more than one was asked for. Default: 0.
   */
  vtkSetClampMacro(NumberOfBlocks, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfBlocks, int);
  ///@}

  /** How many slabs the last execution asked for; 1 if the input came at once. */
  int GetNumberOfSlabs();

  ///@{
  /**
   * Threads to use; 0 for all cores. The result does not depend on it. Default: 0.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /** The output, with its type. */
  vtkIsodiamondHierarchy* GetHierarchy();

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkIsodiamondBuilder();
  ~vtkIsodiamondBuilder() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  /** Notes the piece of the output that is asked for. */
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
  int Piece[3] = { 0, 1, 0 }; ///< asked for: its number, how many, ghost levels

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

  std::unique_ptr<vtkIsodiamond::SlabPlan> Plan;
  /** What was built, of what, and when: in parallel extractors ask for the only piece of the
   *  hierarchy, and whoever shows it for one of several. That is the same hierarchy. */
  vtkSmartPointer<vtkIsodiamondHierarchy> Built;
  vtkDataObject* BuiltOf = nullptr; ///< to compare with, may be gone
  vtkTimeStamp BuiltAt;
};

#endif
