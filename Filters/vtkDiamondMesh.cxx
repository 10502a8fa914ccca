// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDiamondMesh.h"

#include "Mesh/DiamondMesh.h"
#include "Private/Common/Arrays.h"
#include "Private/Common/Cells.h"
#include "Private/Common/Task.h"
#include "Private/Extraction/Mesh.h"
#include "Private/Extraction/Share.h"
#include "Private/Query/WorldQuery.h"
#include "Private/State/State.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkShortArray.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <utility>

vtkStandardNewMacro(vtkDiamondMesh);

namespace
{

void AddArray(const char* name, const std::vector<std::int8_t>& values, vtkIsodiamond::Mesh& output)
{
  const auto array =
    vtkIsodiamond::NewArray<vtkShortArray>(name, static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  output.CellData->AddArray(array);
}

}

//------------------------------------------------------------------------------
vtkDiamondMesh::vtkDiamondMesh() = default;

//------------------------------------------------------------------------------
void vtkDiamondMesh::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
vtkIsodiamond::WorldQuery vtkDiamondMesh::GetQuery() const
{
  vtkIsodiamond::WorldQuery query = this->Superclass::GetQuery();
  query.Simplify = false;
  query.SimulationQuality = false;
  return query;
}

//------------------------------------------------------------------------------
void vtkDiamondMesh::WriteMesh(const vtkIsodiamond::State& state,
  const vtkIsodiamond::WorldQuery& /*query*/, const isodiamond::RefinedSet& refined,
  vtkIsodiamond::Task& task, vtkDataObject* data)
{
  task.Begin("Collecting tetrahedra", 0.0, 1.0);
  const isodiamond::DiamondMesh mesh = isodiamond::ExtractDiamondMesh(refined);
  const isodiamond::AffineMap& world = state.World;
  vtkIsodiamond::Mesh output;
  output.Points = vtkSmartPointer<vtkPoints>::New();
  vtkPoints* const points = output.Points;
  points->SetDataType(this->OutputPointsPrecision == SINGLE_PRECISION ? VTK_FLOAT : VTK_DOUBLE);
  points->GetData()->SetNumberOfComponents(3);
  vtkIsodiamond::AllocateTuples(points->GetData(), static_cast<vtkIdType>(mesh.Points.size()));
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    const isodiamond::Point& p = mesh.Points[i];
    points->SetPoint(static_cast<vtkIdType>(i), world(p[0], p[1], p[2]).data());
  }
  output.Cells = vtkIsodiamond::WriteCells(static_cast<std::int64_t>(mesh.Tetrahedra.size()), 4,
    static_cast<std::int64_t>(mesh.Points.size()), task.For(),
    [&](auto* connectivity)
    {
      for (std::array<std::int64_t, 4> ids : mesh.Tetrahedra)
      {
        if (world.Mirrors())
        {
          std::swap(ids[2], ids[3]);
        }
        connectivity = std::copy(ids.begin(), ids.end(), connectivity);
      }
    });
  AddArray("Level", mesh.Levels, output);
  AddArray("Class", mesh.Classes, output);
  vtkIsodiamond::KeepShare(this->GetShare(), output);
  output.Give(vtkUnstructuredGrid::SafeDownCast(data), true);
}
