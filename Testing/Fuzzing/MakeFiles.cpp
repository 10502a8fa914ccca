// SPDX-License-Identifier: BSD-3-Clause
// Writes what the fuzzer of files begins with: small hierarchies in encodings of VTK's writer.
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondHierarchy.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkXMLPolyDataWriter.h"

#include <cmath>
#include <string>

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    return 1;
  }
  vtkNew<vtkImageData> image;
  image->SetDimensions(5, 4, 5);
  vtkNew<vtkFloatArray> values;
  values->SetName("wave");
  vtkNew<vtkFloatArray> heights;
  heights->SetName("height");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    heights->InsertNextValue(static_cast<float>(x[2]));
    values->InsertNextValue(static_cast<float>(std::sin(1.1 * x[0]) + std::cos(0.8 * x[1] + x[2])));
  }
  image->GetPointData()->SetScalars(values);
  image->GetPointData()->AddArray(heights);
  for (int model = 0; model < 3; ++model)
  {
    for (int shape = 0; shape < 2; ++shape)
    {
      vtkNew<vtkIsodiamondBuilder> builder;
      builder->SetInputData(image);
      builder->SetModel(model);
      builder->SetShape(shape);
      builder->SetIsovalue(0.2);
      builder->SetIsorange(-0.3, 0.4);
      if (model != vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS)
      {
        builder->AddPointArray("height");
      }
      vtkNew<vtkXMLPolyDataWriter> writer;
      writer->SetInputConnection(builder->GetOutputPort());
      writer->SetCompressorTypeToNone();
      const std::string name =
        std::string(argv[1]) + "/" + std::to_string(model) + std::to_string(shape);
      writer->SetDataModeToAscii();
      writer->SetFileName((name + "-ascii.vtp").c_str());
      writer->Write();
      writer->SetDataModeToAppended();
      writer->SetEncodeAppendedData(shape);
      writer->SetFileName((name + "-appended.vtp").c_str());
      writer->Write();
    }
  }
  return 0;
}
