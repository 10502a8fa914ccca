// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondPoints.h"

#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondShare.h"
#include "vtkIsodiamondState.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSignedCharArray.h"

#include <stdexcept>

vtkStandardNewMacro(vtkIsodiamondPoints);

//------------------------------------------------------------------------------
vtkIsodiamondPoints::vtkIsodiamondPoints() = default;

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
  vtkIsodiamond::NoteShare(this, request, when, this->Share);
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
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  try
  {
    const std::shared_ptr<const vtkIsodiamond::State> state =
      vtkIsodiamondHierarchy::ReadState(input);
    if (!state->Isodiamonds)
    {
      throw std::invalid_argument("A hierarchy of diamonds (HD) stores no isodiamonds; build a "
                                  "relevant or minimal hierarchy from it.");
    }
    const isodiamond::IsodiamondHierarchy& hierarchy = *state->Isodiamonds;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> vertices;
    vtkNew<vtkSignedCharArray> kinds;
    vtkNew<vtkSignedCharArray> classes;
    vtkNew<vtkSignedCharArray> levels;
    vtkNew<vtkDoubleArray> errors;
    kinds->SetName("Kind");
    classes->SetName("Class");
    levels->SetName("Level");
    errors->SetName("Error");
    const int depth = hierarchy.Domain().Depth();
    hierarchy.Diamonds().ForEach(
      [&](const isodiamond::Place& place, std::uint32_t rank)
      {
        if (place.Scale == depth)
        {
          return; // the corners of the base cube are not diamonds
        }
        const isodiamond::Point centre = isodiamond::Centre(place);
        const vtkIdType id =
          points->InsertNextPoint(state->World(centre[0], centre[1], centre[2]).data());
        vertices->InsertNextCell(1, &id);
        kinds->InsertNextValue(static_cast<signed char>(hierarchy.KindOf(rank)));
        classes->InsertNextValue(
          static_cast<signed char>(isodiamond::ShapeOf(place.Position).DiamondClass));
        levels->InsertNextValue(static_cast<signed char>(depth - 1 - place.Scale));
        errors->InsertNextValue(hierarchy.Codes().Decode(hierarchy.Threshold(rank)));
      });
    output->SetPoints(points);
    output->SetVerts(vertices);
    output->GetPointData()->SetScalars(kinds);
    output->GetPointData()->AddArray(classes);
    output->GetPointData()->AddArray(levels);
    output->GetPointData()->AddArray(errors);
    vtkIsodiamond::KeepShare(output, this->Share);
  }
  catch (const std::exception& problem)
  {
    output->Initialize();
    vtkErrorMacro(<< problem.what());
  }
  return 1;
}
