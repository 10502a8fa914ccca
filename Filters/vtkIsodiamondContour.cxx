// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondContour.h"

#include "Builder.h"
#include "GradientNormals.h"
#include "vtkIsodiamondInput.h"
#include "vtkIsodiamondQuery.h"
#include "vtkIsodiamondSurface.h"
#include "vtkIsodiamondThreads.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSignedCharArray.h"

#include <algorithm>
#include <map>

vtkStandardNewMacro(vtkIsodiamondContour);

//------------------------------------------------------------------------------
// The hierarchies of the current volume, by isovalue. Volumes count as the same when array
// (object and time), dimensions and padding are: geometry is applied on extraction.
class vtkIsodiamondContour::Cache
{
public:
  struct Entry
  {
    isodiamond::Encoding Encoding;
    std::unique_ptr<isodiamond::IsodiamondHierarchy> Hierarchy;
  };

  // Forgets what does not belong to the volume or to the isovalues.
  void Prepare(vtkImageData* image, vtkDataArray* array, bool closed, vtkContourValues* values)
  {
    std::array<int, 3> dimensions{};
    image->GetDimensions(dimensions.data());
    if (array != this->Array || array->GetMTime() != this->ArrayTime ||
      dimensions != this->Dimensions || closed != this->Closed)
    {
      this->Entries.clear();
      this->Array = array;
      this->ArrayTime = array->GetMTime();
      this->Dimensions = dimensions;
      this->Closed = closed;
    }
    const double* begin = values->GetValues();
    const double* end = begin + values->GetNumberOfContours();
    for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
    {
      entry =
        std::find(begin, end, entry->first) == end ? this->Entries.erase(entry) : std::next(entry);
    }
  }

  std::map<double, Entry> Entries;

private:
  vtkSmartPointer<vtkDataArray> Array; // held, so that no other array can get its address
  vtkMTimeType ArrayTime = 0;
  std::array<int, 3> Dimensions{};
  bool Closed = false;
};

//------------------------------------------------------------------------------
vtkIsodiamondContour::vtkIsodiamondContour()
  : Hierarchies(std::make_unique<Cache>())
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkIsodiamondContour::~vtkIsodiamondContour() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondContour::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n";
  os << indent << "ComputeNormals: " << (this->ComputeNormals ? "On" : "Off") << "\n";
  os << indent << "ComputeScalars: " << (this->ComputeScalars ? "On" : "Off") << "\n";
  os << indent << "CloseBoundary: " << (this->CloseBoundary ? "On" : "Off") << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "NumberOfBuilds: " << this->NumberOfBuilds << "\n";
  os << indent << "ContourValues:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
}

//------------------------------------------------------------------------------
vtkMTimeType vtkIsodiamondContour::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

//------------------------------------------------------------------------------
double* vtkIsodiamondContour::GetErrorToleranceRange()
{
  this->ErrorToleranceRange[1] = 1.0;
  vtkDataObject* input =
    this->GetNumberOfInputConnections(0) > 0 ? this->GetInputDataObject(0, 0) : nullptr;
  vtkDataArray* array = this->FindInputArray(input).Array;
  if (array && array->GetNumberOfComponents() == 1 && array->GetNumberOfTuples() > 0)
  {
    double range[2];
    array->GetFiniteRange(range);
    if (range[1] > range[0])
    {
      this->ErrorToleranceRange[1] = range[1] - range[0];
    }
  }
  return this->ErrorToleranceRange;
}

//------------------------------------------------------------------------------
int vtkIsodiamondContour::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondContour::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkIsodiamond::RequestWholeExtent(inputVector[0]->GetInformationObject(0));
  return 1;
}

namespace
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkFloatArray> Normals(const vtkIsodiamond::Volume& volume, vtkPoints* points)
{
  vtkSmartPointer<vtkFloatArray> normals = vtkSmartPointer<vtkFloatArray>::New();
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(points->GetNumberOfPoints());
  isodiamond::WriteGradientNormals(volume.Samples, volume.World,
    vtkFloatArray::SafeDownCast(points->GetData())->GetPointer(0), points->GetNumberOfPoints(),
    normals->GetPointer(0), vtkIsodiamond::SMPFor());
  return normals;
}

}

//------------------------------------------------------------------------------
int vtkIsodiamondContour::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (!vtkIsodiamond::IsFirstPiece(outputVector->GetInformationObject(0)))
  {
    return 1; // the first piece has all of it
  }
  try
  {
    vtkIsodiamond::CheckTolerance(this->ErrorTolerance);
    vtkImageData* image = vtkImageData::GetData(inputVector[0]);
    const vtkIsodiamond::InputArray array = this->FindInputArray(image);
    const vtkIsodiamond::Volume volume =
      vtkIsodiamond::ReadVolume(image, array, this->CloseBoundary);
    this->Hierarchies->Prepare(image, array.Array, this->CloseBoundary, this->ContourValues);
    vtkNew<vtkAppendPolyData> append;
    vtkIsodiamond::RunThreaded(this->NumberOfThreads,
      [&]
      {
        for (int i = 0; i < this->ContourValues->GetNumberOfContours(); ++i)
        {
          append->AddInputData(this->ExtractContour(volume, this->ContourValues->GetValue(i)));
        }
      });
    if (append->GetNumberOfInputConnections(0) == 1)
    {
      output->ShallowCopy(append->GetInput(0));
    }
    else if (append->GetNumberOfInputConnections(0) > 1)
    {
      append->Update();
      output->ShallowCopy(append->GetOutput());
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
vtkIsodiamond::InputArray vtkIsodiamondContour::FindInputArray(vtkDataObject* input)
{
  vtkIsodiamond::InputArray found;
  if (input)
  {
    found.Array = this->GetInputArrayToProcess(0, input, found.Association);
  }
  return vtkIsodiamond::OrScalars(found, this->GetInputArrayInformation(0), input);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> vtkIsodiamondContour::ExtractContour(
  const vtkIsodiamond::Volume& volume, double isovalue)
{
  if (!std::isfinite(isovalue))
  {
    throw std::invalid_argument("An isovalue is not a finite number.");
  }
  Cache::Entry& entry = this->Hierarchies->Entries[isovalue];
  if (!entry.Hierarchy)
  {
    entry.Encoding = isodiamond::BuildIsodiamonds(
      isodiamond::Model::Minimal, volume.Samples, isovalue, vtkIsodiamond::SMPFor());
    entry.Hierarchy =
      std::make_unique<isodiamond::IsodiamondHierarchy>(entry.Encoding, vtkIsodiamond::SMPFor());
    ++this->NumberOfBuilds;
  }
  const vtkIsodiamond::Surface surface =
    vtkIsodiamond::ExtractSurface(*entry.Hierarchy, volume.World, this->ErrorTolerance);
  vtkSmartPointer<vtkPolyData> contour = vtkSmartPointer<vtkPolyData>::New();
  contour->SetPoints(surface.Points);
  contour->SetPolys(surface.Triangles);
  contour->GetCellData()->AddArray(surface.Levels);
  if (this->ComputeScalars)
  {
    contour->GetPointData()->SetScalars(vtkIsodiamond::ConstantScalars(
      volume.ArrayName, surface.Points->GetNumberOfPoints(), isovalue));
  }
  if (this->ComputeNormals)
  {
    contour->GetPointData()->SetNormals(Normals(volume, surface.Points));
  }
  return contour;
}
