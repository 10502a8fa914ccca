// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondHierarchy
 * @brief   a multiresolution hierarchy of an isosurface or interval volume, as a vtkPolyData
 *
 * What vtkIsodiamondBuilder makes and vtkIsodiamondExtractor reads. The geometry is the outline of
 * the volume; all content is in field-data arrays, so any pipeline passes it on, any standard
 * writer (.vtp) saves it, and the plain vtkPolyData that a reader returns is just as good: filters
 * accept both, and FromPolyData() restores the type. Not in ASCII, though: there VTK does not read
 * infinite numbers, which hierarchies of diamonds and of open ranges have.
 *
 * Contents are read and checked on first use, and then kept; copies share them.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", IEEE TVCG 2010, sections 5 to 7.
 */

#ifndef vtkIsodiamondHierarchy_h
#define vtkIsodiamondHierarchy_h

#include "vtkIsodiamondFiltersModule.h" // for export macro
#include "vtkPolyData.h"

#include <memory> // for the shared state
#include <string> // for the array's name

namespace vtkIsodiamond
{
struct State;
}

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondHierarchy : public vtkPolyData
{
public:
  static vtkIsodiamondHierarchy* New();
  vtkTypeMacro(vtkIsodiamondHierarchy, vtkPolyData);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The three models of the paper. */
  enum Models
  {
    HIERARCHY_OF_DIAMONDS = 0, ///< HD: the scalar field, any isovalue later
    RELEVANT = 1,              ///< RI: active, creation and relevant isodiamonds
    MINIMAL = 2                ///< MI: active and creation isodiamonds
  };

  /** What is extracted. */
  enum Shapes
  {
    ISOSURFACE = 0,     ///< of an isovalue: triangles
    INTERVAL_VOLUME = 1 ///< of an isorange: tetrahedra
  };

  /** How the errors of its diamonds were measured. */
  enum ErrorMetrics
  {
    FIELD = 0,   ///< in field units, the paper's
    DISTANCE = 1 ///< in world units
  };

  ///@{
  /**
   * What the hierarchy represents; for an HD the shape is the default of queries. -1 if the arrays
   * are missing or damaged (one error says why).
   */
  int GetModel();
  int GetShape();
  ///@}

  /** The metric of its errors, and so of tolerances; -1 as above. */
  int GetErrorMetric();

  /** Whether its distances hold both ways, from the full-resolution surface to a mesh and back. */
  bool GetTwoSidedDistances();

  /** Whether all its meshes have the topology of the full-resolution surface. Not for an HD, where
   *  queries decide. */
  bool GetPreservesTopology();

  ///@{
  /**
   * The size in samples below which pieces were removed from what it was built from, and how many
   * were removed. 0 for an HD.
   */
  vtkIdType GetMinimumPieceSize();
  vtkIdType GetNumberOfRemovedPieces();
  ///@}

  /** Name of the array that the hierarchy was built from. */
  std::string GetArrayName();

  ///@{
  /**
   * The isovalue and the isorange: for RI and MI, the one that belongs to their shape; for HD, the
   * defaults of queries.
   */
  double GetIsovalue();
  void GetIsorange(double isorange[2]);
  ///@}

  ///@{
  /**
   * The paper's counts m_a, m_r (including creation diamonds, as in the paper; an MI has this count
   * too, though it stores only the creation ones) and m_c. All 0 for an HD.
   */
  vtkIdType GetNumberOfActiveIsodiamonds();
  vtkIdType GetNumberOfRelevantIsodiamonds();
  vtkIdType GetNumberOfCreationIsodiamonds();
  ///@}

  /** The number of stored isovertices, v_i. */
  vtkIdType GetNumberOfIsovertices();

  /** Size of the encoding in bytes: the sum over its arrays. What is derived from them for queries,
   *  and kept besides, is not counted. */
  vtkIdType GetStorageSize();

  /**
   * The hierarchy in a data set, for instance one that a reader returned; null if it holds none.
   * Arrays are shared, not copied.
   */
  VTK_NEWINSTANCE static vtkIsodiamondHierarchy* FromPolyData(vtkPolyData* polyData);

  void Initialize() override;
  void ShallowCopy(vtkDataObject* source) override;
  void DeepCopy(vtkDataObject* source) override;

#ifndef __VTK_WRAP__
  /**
   * The checked contents of a data set that holds a hierarchy; a vtkIsodiamondHierarchy keeps its
   * own. For filters. @param numberOfThreads 0 for as many as VTK would use
   * @throws std::exception that says what is wrong.
   */
  static std::shared_ptr<const vtkIsodiamond::State> ReadState(
    vtkPolyData* polyData, int numberOfThreads = 0);
#endif

protected:
  vtkIsodiamondHierarchy();
  ~vtkIsodiamondHierarchy() override;

private:
  vtkIsodiamondHierarchy(const vtkIsodiamondHierarchy&) = delete;
  void operator=(const vtkIsodiamondHierarchy&) = delete;

  const vtkIsodiamond::State* GetState();
  void CopyState(vtkDataObject* source);

  std::shared_ptr<const vtkIsodiamond::State> State;
};

#endif
