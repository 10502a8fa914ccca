// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDiamondMesh
 * @brief   the tetrahedra of the current diamond mesh of a query
 *
 * Input: a hierarchy; properties: those of vtkIsodiamondExtractor, but Simplify, SimulationQuality
 * and OutputType have no effect, and a target counts the extractor's cells. Output: the tetrahedra
 * under the front at the tolerance, with the cell arrays `Level` and `Class` of the diamond that
 * each lies in (the paper's figure 14). From HD and RI they tile the domain; from MI they are only
 * those that carry the surface. Tetrahedra that stick out of the image are left out.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", IEEE TVCG 2010, section 6.
 */

#ifndef vtkDiamondMesh_h
#define vtkDiamondMesh_h

#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondFiltersModule.h" // for export macro

class VTKISODIAMONDFILTERS_EXPORT vtkDiamondMesh : public vtkIsodiamondExtractor
{
public:
  static vtkDiamondMesh* New();
  vtkTypeMacro(vtkDiamondMesh, vtkIsodiamondExtractor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkDiamondMesh();
  ~vtkDiamondMesh() override = default;

  void WriteMesh(const vtkIsodiamond::State& state, const vtkIsodiamond::WorldQuery& query,
    const isodiamond::RefinedSet& refined, vtkIsodiamond::Task& task,
    vtkDataObject* output) override;
  /** The query, without simplification. */
  vtkIsodiamond::WorldQuery GetQuery() const override;
  /** Tetrahedra need an unstructured grid. */
  bool GivesPolyData() const override { return false; }

private:
  vtkDiamondMesh(const vtkDiamondMesh&) = delete;
  void operator=(const vtkDiamondMesh&) = delete;
};

#endif
