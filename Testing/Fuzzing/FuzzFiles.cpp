// SPDX-License-Identifier: BSD-3-Clause
// Whole .vtp files: whatever is in them, a filter gives an error or a mesh.
#include "vtkDiamondMesh.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondPoints.h"

#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataReader.h"

#include <cstddef>
#include <cstdint>
#include <new>
#include <string>

namespace
{

void Run(vtkAlgorithm* filter, vtkPolyData* input)
{
  filter->SetInputDataObject(input);
  filter->Update();
  vtkDataSet* output = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); i += 97)
  {
    double bounds[6];
    output->GetCellBounds(i, bounds);
  }
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(std::string(reinterpret_cast<const char*>(data), size));
  try
  {
    reader->Update();
  }
  catch (const std::bad_alloc&) // VTK believes any size that a file states
  {
    return 0;
  }
  for (const double tolerance : { 0.0, 0.5 })
  {
    vtkNew<vtkIsodiamondExtractor> extractor;
    extractor->SetErrorTolerance(tolerance);
    Run(extractor, reader->GetOutput());
    extractor->SetSimplify(true);
    Run(extractor, reader->GetOutput());
    vtkNew<vtkDiamondMesh> mesh;
    mesh->SetErrorTolerance(tolerance);
    Run(mesh, reader->GetOutput());
  }
  vtkNew<vtkIsodiamondPoints> points;
  Run(points, reader->GetOutput());
  return 0;
}
