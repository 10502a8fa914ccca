// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondBuilder.h"

#include "Builder.h"
#include "vtkIsodiamondInput.h"
#include "vtkIsodiamondState.h"
#include "vtkIsodiamondThreads.h"

#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <stdexcept>

vtkStandardNewMacro(vtkIsodiamondBuilder);

//------------------------------------------------------------------------------
vtkIsodiamondBuilder::vtkIsodiamondBuilder()
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Model: " << this->Model << "\n";
  os << indent << "Shape: " << this->Shape << "\n";
  os << indent << "Isovalue: " << this->Isovalue << "\n";
  os << indent << "Isorange: " << this->Isorange[0] << " " << this->Isorange[1] << "\n";
  os << indent << "ErrorMetric: " << this->ErrorMetric << "\n";
  os << indent << "ExactIsovertices: " << (this->ExactIsovertices ? "On" : "Off") << "\n";
  os << indent << "PreserveFeatures: " << (this->PreserveFeatures ? "On" : "Off") << "\n";
  os << indent << "RefineInterior: " << (this->RefineInterior ? "On" : "Off") << "\n";
  os << indent << "CloseBoundary: " << (this->CloseBoundary ? "On" : "Off") << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

//------------------------------------------------------------------------------
vtkIsodiamondHierarchy* vtkIsodiamondBuilder::GetHierarchy()
{
  return vtkIsodiamondHierarchy::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkIsodiamondBuilder::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkIsodiamondBuilder::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    if (!vtkIsodiamondHierarchy::SafeDownCast(info->Get(vtkDataObject::DATA_OBJECT())))
    {
      vtkNew<vtkIsodiamondHierarchy> output;
      info->Set(vtkDataObject::DATA_OBJECT(), output);
    }
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkIsodiamondBuilder::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkIsodiamond::RequestWholeExtent(inputVector[0]->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondBuilder::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (!vtkIsodiamond::IsFirstPiece(outputVector->GetInformationObject(0)))
  {
    return 1;
  }
  try
  {
    this->CheckModel();
    if (vtkPolyData* hierarchy = vtkPolyData::GetData(inputVector[0]))
    {
      this->BuildFromHierarchy(hierarchy, output);
    }
    else
    {
      this->BuildFromImage(inputVector, output);
    }
  }
  catch (const std::exception& problem)
  {
    output->Initialize();
    vtkErrorMacro(<< problem.what());
  }
  return 1;
}

//------------------------------------------------------------------------------
vtkIsodiamond::InputArray vtkIsodiamondBuilder::FindInputArray(vtkDataObject* input)
{
  vtkIsodiamond::InputArray found;
  if (input)
  {
    found.Array = this->GetInputArrayToProcess(0, input, found.Association);
  }
  return vtkIsodiamond::OrScalars(found, this->GetInputArrayInformation(0), input);
}

//------------------------------------------------------------------------------
vtkIsodiamond::Choice vtkIsodiamondBuilder::GetChoice() const
{
  return { static_cast<isodiamond::Shape>(this->Shape), this->Isovalue,
    { this->Isorange[0], this->Isorange[1] } };
}

//------------------------------------------------------------------------------
isodiamond::BuildOptions vtkIsodiamondBuilder::GetOptions(const isodiamond::AffineMap& world) const
{
  return { static_cast<isodiamond::ErrorMetric>(this->ErrorMetric), this->ExactIsovertices,
    this->PreserveFeatures, this->RefineInterior, world };
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::CheckModel() const
{
  if (this->Model == vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS &&
    this->ErrorMetric == vtkIsodiamondHierarchy::DISTANCE)
  {
    throw std::invalid_argument("A hierarchy of diamonds (HD) supports the field metric only: the "
                                "distance metric needs an isovalue or isorange.");
  }
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::BuildFromImage(vtkInformationVector** inputVector, vtkPolyData* output)
{
  vtkImageData* image = vtkImageData::GetData(inputVector[0]);
  const vtkIsodiamond::Choice choice = this->GetChoice();
  const isodiamond::Isoregion region = choice.Region();
  const vtkIsodiamond::Volume volume = vtkIsodiamond::ReadVolume(
    image, this->FindInputArray(image), this->CloseBoundary && !region.IsVolume());
  if (this->Model == vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS)
  {
    isodiamond::ScalarEncoding encoding;
    vtkIsodiamond::RunThreaded(this->NumberOfThreads,
      [&]
      { encoding = isodiamond::BuildScalarHierarchy(volume.Samples, vtkIsodiamond::SMPFor()); });
    vtkIsodiamond::WriteScalars(encoding, choice, this->ExactIsovertices, volume, output);
    return;
  }
  const isodiamond::BuildOptions options = this->GetOptions(volume.World);
  isodiamond::Encoding encoding;
  vtkIsodiamond::RunThreaded(this->NumberOfThreads,
    [&]
    {
      encoding = isodiamond::BuildIsodiamonds(static_cast<isodiamond::Model>(this->Model),
        volume.Samples, region, vtkIsodiamond::SMPFor(), options);
    });
  vtkIsodiamond::WriteIsodiamonds(encoding, choice, volume.World, volume.ArrayName, output);
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::BuildFromHierarchy(vtkPolyData* input, vtkPolyData* output)
{
  const std::shared_ptr<const vtkIsodiamond::State> state =
    vtkIsodiamondHierarchy::ReadState(input);
  if (!state->Scalars)
  {
    throw std::invalid_argument(
      "The input hierarchy is relevant or minimal: those are made for "
      "one isovalue or isorange, others come from an HD or from the image.");
  }
  if (this->Model == vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS)
  {
    output->ShallowCopy(input);
    return;
  }
  const vtkIsodiamond::Choice choice = this->GetChoice();
  const isodiamond::BuildOptions options = this->GetOptions(state->World);
  isodiamond::Encoding encoding;
  vtkIsodiamond::RunThreaded(this->NumberOfThreads,
    [&]
    {
      encoding = isodiamond::BuildIsodiamonds(static_cast<isodiamond::Model>(this->Model),
        *state->Scalars, choice.Region(), vtkIsodiamond::SMPFor(), options);
    });
  vtkIsodiamond::WriteIsodiamonds(encoding, choice, state->World, state->ArrayName, output);
}
