// SPDX-License-Identifier: BSD-3-Clause
// Builds the hierarchy of an isosurface once, then extracts it at several error tolerances.
#include "vtkDataArray.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkNew.h"
#include "vtkRTAnalyticSource.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataWriter.h"

#include <iostream>

int main(int argc, char* argv[])
{
  vtkNew<vtkRTAnalyticSource> volume;
  volume->SetWholeExtent(-40, 40, -40, 40, -40, 40);

  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputConnection(volume->GetOutputPort());
  builder->SetIsovalue(157.0);

  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  for (const double tolerance : { 0.0, 5.0, 10.0, 20.0 })
  {
    extractor->SetErrorTolerance(tolerance);
    extractor->Update();
    std::cout << "tolerance " << tolerance << ": " << extractor->GetOutput()->GetNumberOfCells()
              << " triangles\n";
  }

  // The hierarchy is a vtkPolyData: any VTK program can read it back.
  if (argc > 1)
  {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputConnection(builder->GetOutputPort());
    writer->SetFileName(argv[1]);
    writer->SetDataModeToBinary(); // see README.md on files
    return writer->Write() == 1 ? 0 : 1;
  }
  return 0;
}
