// SPDX-License-Identifier: BSD-3-Clause
// A first speed check: extraction at full resolution against contouring anew, one thread each.
#include "FilterTestTools.h"

#include "vtkFlyingEdges3D.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace
{

double Milliseconds(vtkAlgorithm* filter)
{
  filter->Modified();
  const auto start = std::chrono::steady_clock::now();
  filter->Update();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
    .count();
}

double Median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

}

TEST(Speed, ExtractionIsNotSlowerThanFlyingEdges)
{
  const auto image = test::BallImage({ 256, 256, 256 });
  vtkNew<vtkFlyingEdges3D> flyingEdges;
  flyingEdges->SetInputData(image);
  flyingEdges->SetValue(0, 0.0);
  flyingEdges->ComputeNormalsOff();
  flyingEdges->ComputeScalarsOff();
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->SetNumberOfThreads(1);
  extractor->Update();
  std::vector<double> theirs;
  std::vector<double> ours;
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1, "Sequential", false },
    [&]
    {
      for (int i = 0; i < 7; ++i) // interleaved, so that drift cancels
      {
        theirs.push_back(Milliseconds(flyingEdges));
        ours.push_back(Milliseconds(extractor));
      }
    });
  std::cout << "vtkFlyingEdges3D " << Median(theirs) << " ms for "
            << flyingEdges->GetOutput()->GetNumberOfCells() << " triangles; extraction "
            << Median(ours) << " ms for " << extractor->GetOutput()->GetNumberOfCells()
            << " triangles; ratio " << Median(ours) / Median(theirs) << "\n";
  EXPECT_LE(Median(ours), Median(theirs));
}
