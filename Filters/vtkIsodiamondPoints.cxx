// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondPoints.h"

#include "Private/Common/Arrays.h"
#include "Private/Common/Cells.h"
#include "Private/Common/Task.h"
#include "Private/Extraction/Mesh.h"
#include "Private/Extraction/Share.h"
#include "Private/Input/Request.h"
#include "Private/Parallel/InputShares.h"
#include "Private/State/State.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkShortArray.h"
#include "vtkSmartPointer.h"

#include <numeric>
#include <stdexcept>
#include <type_traits>

vtkStandardNewMacro(vtkIsodiamondPoints);

namespace
{

/** Calls body(place, rank) for the stored diamonds, which the corners of the base cube are not. */
template <typename Body>
void ForEachIsodiamond(const isodiamond::IsodiamondHierarchy& hierarchy, Body&& body)
{
  hierarchy.Diamonds().ForEach(
    [&, depth = hierarchy.SampleGrid().Depth()](const isodiamond::Place& place, std::uint32_t rank)
    {
      if (place.Scale != depth)
      {
        body(place, rank);
      }
    });
}

void WritePoints(const isodiamond::IsodiamondHierarchy& hierarchy,
  const isodiamond::AffineMap& world, const vtkIsodiamond::Share& share, vtkPolyData* output)
{
  vtkIdType count = 0;
  ForEachIsodiamond(hierarchy, [&](const isodiamond::Place&, std::uint32_t) { ++count; });
  vtkIsodiamond::Mesh mesh;
  mesh.Points = vtkSmartPointer<vtkPoints>::New();
  vtkPoints* const points = mesh.Points;
  const isodiamond::Grid& grid = hierarchy.SampleGrid();
  const isodiamond::Point last = { grid.Last(0), grid.Last(1), grid.Last(2) };
  const bool areFloats = isodiamond::GridGeometry(world).FitsFloats(last);
  points->SetDataType(areFloats ? VTK_FLOAT : VTK_DOUBLE);
  points->GetData()->SetNumberOfComponents(3);
  vtkIsodiamond::AllocateTuples(points->GetData(), count);
  const auto kinds = vtkIsodiamond::NewArray<vtkShortArray>("Kind", count);
  const auto classes = vtkIsodiamond::NewArray<vtkShortArray>("Class", count);
  const auto levels = vtkIsodiamond::NewArray<vtkShortArray>("Level", count);
  const auto errors = vtkIsodiamond::NewArray<vtkDoubleArray>("Error", count);
  const int rootScale = hierarchy.SampleGrid().Depth() - 1;
  vtkIdType id = 0;
  ForEachIsodiamond(hierarchy,
    [&](const isodiamond::Place& place, std::uint32_t rank)
    {
      const isodiamond::Point centre = isodiamond::Centre(place);
      points->SetPoint(id, world(centre[0], centre[1], centre[2]).data());
      kinds->SetValue(id, static_cast<short>(hierarchy.KindOf(rank)));
      classes->SetValue(id, static_cast<short>(isodiamond::ShapeOf(place.Position).DiamondClass));
      levels->SetValue(id, static_cast<short>(rootScale - place.Scale));
      errors->SetValue(id, hierarchy.Codes().Decode(hierarchy.Threshold(rank)));
      ++id;
    });
  mesh.Cells = vtkIsodiamond::WriteCells(count, 1, count, isodiamond::SerialFor,
    [count](auto* connectivity)
    { std::iota(connectivity, connectivity + count, std::decay_t<decltype(*connectivity)>{}); });
  mesh.PointData->SetScalars(kinds);
  mesh.PointData->AddArray(classes);
  mesh.PointData->AddArray(levels);
  mesh.PointData->AddArray(errors);
  vtkIsodiamond::KeepShare(share, mesh);
  output->SetPoints(mesh.Points);
  output->SetVerts(mesh.Cells);
  output->GetPointData()->ShallowCopy(mesh.PointData);
}

}

//------------------------------------------------------------------------------
vtkIsodiamondPoints::vtkIsodiamondPoints()
  : Shares(std::make_unique<vtkIsodiamond::InputShares>())
{
}

//------------------------------------------------------------------------------
vtkIsodiamondPoints::~vtkIsodiamondPoints() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondPoints::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

//------------------------------------------------------------------------------
int vtkIsodiamondPoints::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondPoints::ModifyRequest(vtkInformation* request, int when)
{
  this->Shares->Note(this, request, when);
  return this->Superclass::ModifyRequest(request, when);
}

//------------------------------------------------------------------------------
int vtkIsodiamondPoints::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkIsodiamond::RequestWhole(inputVector[0]->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondPoints::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  return vtkIsodiamond::Execute(this, output,
    [&](vtkIsodiamond::Task&)
    {
      vtkIsodiamond::RemoveState(output->GetFieldData());
      vtkPolyData* const input = vtkPolyData::GetData(inputVector[0]);
      const std::shared_ptr<const vtkIsodiamond::State> state =
        vtkIsodiamondHierarchy::ReadState(input);
      if (!state->Isodiamonds)
      {
        throw std::invalid_argument("A hierarchy of diamonds (HD) stores no isodiamonds; build a "
                                    "relevant or minimal hierarchy from it.");
      }
      vtkIsodiamond::Share share = this->Shares->Of(input);
      share.GhostLevels = 0;
      WritePoints(*state->Isodiamonds, state->World, share, output);
    });
}
