// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondHierarchy.h"

#include "Private/State/State.h"

#include "vtkFieldData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <exception>

vtkStandardNewMacro(vtkIsodiamondHierarchy);

//------------------------------------------------------------------------------
vtkIsodiamondHierarchy::vtkIsodiamondHierarchy() = default;

//------------------------------------------------------------------------------
vtkIsodiamondHierarchy::~vtkIsodiamondHierarchy() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondHierarchy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  if (!vtkIsodiamond::HasHierarchy(this->GetFieldData()) || !this->GetState())
  {
    os << indent << "Model: (none)\n";
    return;
  }
  os << indent << "Model: " << this->GetModel() << "\n";
  os << indent << "Shape: " << this->GetShape() << "\n";
  os << indent << "ErrorMetric: " << this->GetErrorMetric() << "\n";
  os << indent << "TwoSidedDistances: " << this->GetTwoSidedDistances() << "\n";
  os << indent << "PreservesTopology: " << this->GetPreservesTopology() << "\n";
  os << indent << "MinimumPieceSize: " << this->GetMinimumPieceSize() << "\n";
  os << indent << "NumberOfRemovedPieces: " << this->GetNumberOfRemovedPieces() << "\n";
  os << indent << "ArrayName: " << this->GetArrayName() << "\n";
  os << indent << "Isovalue: " << this->GetIsovalue() << "\n";
  double isorange[2];
  this->GetIsorange(isorange);
  os << indent << "Isorange: " << isorange[0] << ", " << isorange[1] << "\n";
  os << indent << "NumberOfActiveIsodiamonds: " << this->GetNumberOfActiveIsodiamonds() << "\n";
  os << indent << "NumberOfRelevantIsodiamonds: " << this->GetNumberOfRelevantIsodiamonds() << "\n";
  os << indent << "NumberOfCreationIsodiamonds: " << this->GetNumberOfCreationIsodiamonds() << "\n";
  os << indent << "NumberOfIsovertices: " << this->GetNumberOfIsovertices() << "\n";
  os << indent << "StorageSize: " << this->GetStorageSize() << "\n";
}

//------------------------------------------------------------------------------
std::shared_ptr<const vtkIsodiamond::State> vtkIsodiamondHierarchy::ReadState(
  vtkPolyData* polyData, int numberOfThreads)
{
  vtkIsodiamondHierarchy* hierarchy = vtkIsodiamondHierarchy::SafeDownCast(polyData);
  if (!hierarchy)
  {
    return vtkIsodiamond::ReadState(polyData->GetFieldData(), numberOfThreads);
  }
  if (!hierarchy->State || !vtkIsodiamond::IsCurrent(*hierarchy->State, polyData->GetFieldData()))
  {
    hierarchy->State = vtkIsodiamond::ReadState(polyData->GetFieldData(), numberOfThreads);
  }
  return hierarchy->State;
}

//------------------------------------------------------------------------------
const vtkIsodiamond::State* vtkIsodiamondHierarchy::GetState()
{
  try
  {
    return vtkIsodiamondHierarchy::ReadState(this).get();
  }
  catch (const std::exception& problem)
  {
    vtkErrorMacro(<< problem.what());
    return nullptr;
  }
}

//------------------------------------------------------------------------------
int vtkIsodiamondHierarchy::GetModel()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state ? state->Model : -1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondHierarchy::GetShape()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state ? static_cast<int>(state->Chosen.Shape) : -1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondHierarchy::GetErrorMetric()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state ? static_cast<int>(state->Metric) : -1;
}

//------------------------------------------------------------------------------
bool vtkIsodiamondHierarchy::GetTwoSidedDistances()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state && state->Isodiamonds && state->Isodiamonds->Header().TwoSided;
}

//------------------------------------------------------------------------------
bool vtkIsodiamondHierarchy::GetPreservesTopology()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state && state->Isodiamonds && state->Isodiamonds->Header().PreservesTopology;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondHierarchy::GetMinimumPieceSize()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state && state->Isodiamonds ? state->Isodiamonds->Header().MinimumPieceSize : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondHierarchy::GetNumberOfRemovedPieces()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state && state->Isodiamonds ? state->Isodiamonds->Header().RemovedPieces : 0;
}

//------------------------------------------------------------------------------
std::string vtkIsodiamondHierarchy::GetArrayName()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state ? state->ArrayName : std::string();
}

//------------------------------------------------------------------------------
double vtkIsodiamondHierarchy::GetIsovalue()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state ? state->Chosen.Isovalue : 0.0;
}

//------------------------------------------------------------------------------
void vtkIsodiamondHierarchy::GetIsorange(double isorange[2])
{
  const vtkIsodiamond::State* state = this->GetState();
  const vtkIsodiamond::Choice choice = state ? state->Chosen : vtkIsodiamond::Choice();
  std::copy(choice.Isorange.begin(), choice.Isorange.end(), isorange);
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondHierarchy::GetNumberOfActiveIsodiamonds()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state && state->Isodiamonds ? state->Isodiamonds->Count(isodiamond::Kind::Active) : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondHierarchy::GetNumberOfRelevantIsodiamonds()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state && state->Isodiamonds ? state->Isodiamonds->Header().RelevantCount : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondHierarchy::GetNumberOfCreationIsodiamonds()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state && state->Isodiamonds ? state->Isodiamonds->Count(isodiamond::Kind::Creation) : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondHierarchy::GetNumberOfIsovertices()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state && state->Isodiamonds ? state->Isodiamonds->IsovertexCount() : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondHierarchy::GetStorageSize()
{
  const vtkIsodiamond::State* state = this->GetState();
  return state ? state->StorageSize : 0;
}

//------------------------------------------------------------------------------
vtkIsodiamondHierarchy* vtkIsodiamondHierarchy::FromPolyData(vtkPolyData* polyData)
{
  if (!polyData || !vtkIsodiamond::HasHierarchy(polyData->GetFieldData()))
  {
    return nullptr;
  }
  vtkIsodiamondHierarchy* hierarchy = vtkIsodiamondHierarchy::New();
  hierarchy->ShallowCopy(polyData);
  return hierarchy;
}

//------------------------------------------------------------------------------
void vtkIsodiamondHierarchy::Initialize()
{
  this->Superclass::Initialize();
  this->State.reset();
}

//------------------------------------------------------------------------------
void vtkIsodiamondHierarchy::CopyState(vtkDataObject* source)
{
  vtkIsodiamondHierarchy* hierarchy = vtkIsodiamondHierarchy::SafeDownCast(source);
  this->State = hierarchy ? hierarchy->State : nullptr;
}

//------------------------------------------------------------------------------
void vtkIsodiamondHierarchy::ShallowCopy(vtkDataObject* source)
{
  this->Superclass::ShallowCopy(source);
  this->CopyState(source);
}

//------------------------------------------------------------------------------
void vtkIsodiamondHierarchy::DeepCopy(vtkDataObject* source)
{
  this->Superclass::DeepCopy(source);
  this->CopyState(nullptr); // the copied arrays are others; read again when needed
}
