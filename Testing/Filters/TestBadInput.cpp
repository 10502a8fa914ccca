// SPDX-License-Identifier: BSD-3-Clause
// Bad input: one error that names the cause, an empty and valid output, and a filter that works
// again afterwards.
#include "FilterTestTools.h"

#include "vtkBitArray.h"
#include "vtkDiamondMesh.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkIsodiamondPoints.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRTAnalyticSource.h"
#include "vtkRectilinearGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace
{

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

/** Runs the filters that take images; each must report `cause` once and give nothing. */
void ExpectRefusal(const std::function<void(vtkAlgorithm*)>& prepare, const std::string& cause)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(test::BallImage({ 9, 9, 9 }));
  contour->SetValue(0, 0.0);
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(test::BallImage({ 9, 9, 9 }));
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(test::BallImage({ 9, 9, 9 }));
  for (vtkAlgorithm* filter : { static_cast<vtkAlgorithm*>(contour),
         static_cast<vtkAlgorithm*>(builder), static_cast<vtkAlgorithm*>(volume) })
  {
    filter->Update(); // a good run first: nothing of it may remain
    prepare(filter);
    const auto messages = test::Watch(filter);
    filter->Update();
    EXPECT_EQ(messages->ErrorCount, 1) << messages->Errors;
    EXPECT_NE(messages->Errors.find(cause), std::string::npos) << messages->Errors;
    EXPECT_EQ(vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfCells(), 0);
    EXPECT_EQ(filter->GetOutputDataObject(0)->GetFieldData()->GetNumberOfArrays(), 0);
    // And it works again.
    filter->SetInputDataObject(0, test::BallImage({ 9, 9, 9 }));
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "density");
    filter->Update();
    EXPECT_EQ(messages->ErrorCount, 1) << messages->Errors;
    EXPECT_GT(vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfCells(), 0);
  }
}

}

TEST(BadInput, ImagesThatHaveNoSurface)
{
  ExpectRefusal([](vtkAlgorithm* filter)
    { filter->SetInputDataObject(0, vtkSmartPointer<vtkImageData>::New()); },
    "empty");
  ExpectRefusal(
    [](vtkAlgorithm* filter) {
      filter->SetInputDataObject(0, test::BallImage({ 9, 9, 1 }));
    },
    "9 x 9 x 1");
  ExpectRefusal(
    [](vtkAlgorithm* filter) {
      filter->SetInputDataObject(0, test::BallImage({ 1, 9, 9 }));
    },
    "1 x 9 x 9");
}

TEST(BadInput, ImagesThatAreNowhere)
{
  for (const double wrong : { HUGE_VAL, std::nan("") })
  {
    const auto image = test::BallImage({ 9, 9, 9 });
    image->SetOrigin(0.0, wrong, 0.0);
    ExpectRefusal([&](vtkAlgorithm* filter) { filter->SetInputDataObject(0, image); }, "finite");
  }
}

TEST(BadInput, ArraysThatCannotBeContoured)
{
  ExpectRefusal(
    [](vtkAlgorithm* filter) {
      filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "nowhere");
    },
    "no such point data array. It has \"");
  ExpectRefusal(
    [](vtkAlgorithm* filter)
    {
      const auto image = test::BallImage({ 9, 9, 9 });
      vtkNew<vtkFloatArray> velocity;
      velocity->SetName("velocity");
      velocity->SetNumberOfComponents(3);
      velocity->SetNumberOfTuples(image->GetNumberOfPoints());
      velocity->Fill(1.0);
      vtkNew<vtkFloatArray> ofCells;
      ofCells->SetName("cells");
      ofCells->SetNumberOfTuples(image->GetNumberOfCells());
      image->GetPointData()->Initialize();
      image->GetPointData()->AddArray(velocity);
      image->GetCellData()->AddArray(ofCells);
      filter->SetInputDataObject(0, image);
    },
    "It has \"velocity\" with 3 components. Cell data have to be converted");
  ExpectRefusal(
    [](vtkAlgorithm* filter)
    {
      const auto image = test::BallImage({ 9, 9, 9 });
      vtkNew<vtkFloatArray> vectors;
      vectors->SetName("velocity");
      vectors->SetNumberOfComponents(3);
      vectors->SetNumberOfTuples(image->GetNumberOfPoints());
      vectors->Fill(1.0);
      image->GetPointData()->SetScalars(vectors);
      filter->SetInputDataObject(0, image);
      filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "velocity");
    },
    "3 components");
  ExpectRefusal(
    [](vtkAlgorithm* filter)
    {
      const auto image = test::BallImage({ 9, 9, 9 });
      vtkNew<vtkFloatArray> values;
      values->SetName("cells");
      values->SetNumberOfTuples(image->GetNumberOfCells());
      values->Fill(1.0);
      image->GetCellData()->SetScalars(values);
      filter->SetInputDataObject(0, image);
      filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "cells");
    },
    "not point data");
  ExpectRefusal(
    [](vtkAlgorithm* filter)
    {
      const auto image = test::BallImage({ 9, 9, 9 });
      vtkNew<vtkBitArray> bits;
      bits->SetName("bits");
      bits->SetNumberOfTuples(image->GetNumberOfPoints());
      bits->Fill(1.0);
      image->GetPointData()->SetScalars(bits);
      filter->SetInputDataObject(0, image);
      filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "bits");
    },
    "not supported");
}

TEST(BadInput, OtherArraysThatAreTooShortAreLeftOut)
{
  const auto image = test::BallImage({ 9, 9, 9 });
  for (const int tuples : { 0, 5 })
  {
    vtkNew<vtkFloatArray> values;
    values->SetName(tuples == 0 ? "empty" : "short");
    values->SetNumberOfTuples(tuples);
    image->GetPointData()->AddArray(values);
  }
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->Update();
  EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_FALSE(contour->GetOutput()->GetPointData()->HasArray("empty"));
  EXPECT_FALSE(contour->GetOutput()->GetPointData()->HasArray("short"));
}

TEST(BadInput, GhostArraysOfAnotherSize)
{
  for (const bool isOfCells : { true, false })
  {
    for (const auto& [tuples, components] : { std::array<int, 2>{ 5, 1 }, { 9 * 9 * 9, 2 } })
    {
      const int size[] = { tuples, components };
      ExpectRefusal(
        [&](vtkAlgorithm* filter)
        {
          const auto image = test::BallImage({ 9, 9, 9 });
          vtkNew<vtkUnsignedCharArray> ghosts;
          ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
          ghosts->SetNumberOfComponents(size[1]);
          ghosts->SetNumberOfTuples(size[0]);
          ghosts->Fill(0.0);
          vtkDataSetAttributes* data = isOfCells
            ? static_cast<vtkDataSetAttributes*>(image->GetCellData())
            : static_cast<vtkDataSetAttributes*>(image->GetPointData());
          data->AddArray(ghosts);
          filter->SetInputDataObject(0, image);
        },
        "ghost array");
    }
  }
}

// A getter that may be called at any time.
TEST(BadInput, NeverHarmsWhoAsksForTheRangeOfTolerances)
{
  vtkNew<vtkIsodiamondContour> contour;
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(3, 3, 3); // without coordinates
  contour->SetInputData(grid);
  for (const int unit : { 0, 1 })
  {
    contour->SetToleranceUnit(unit);
    EXPECT_GT(contour->GetErrorToleranceRange()[1], 0.0);
  }
  // What was known of slabs does not count for another input, or for none.
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(0, 20, 0, 20, 0, 40);
  vtkNew<vtkIsodiamondContour> inSlabs;
  inSlabs->SetInputConnection(source->GetOutputPort());
  inSlabs->SetNumberOfBlocks(4);
  inSlabs->SetValue(0, 150.0);
  inSlabs->Update();
  ASSERT_EQ(inSlabs->GetNumberOfSlabs(), 4);
  EXPECT_GT(inSlabs->GetErrorToleranceRange()[1], 0.9);
  inSlabs->SetInputData(grid);
  EXPECT_EQ(inSlabs->GetErrorToleranceRange()[1], contour->GetErrorToleranceRange()[1]);
  vtkNew<vtkImageData> image;
  image->SetDimensions(101, 1, 1);
  inSlabs->SetInputData(image);
  EXPECT_DOUBLE_EQ(inSlabs->GetErrorToleranceRange()[1], 2.0);
  inSlabs->RemoveAllInputConnections(0);
  EXPECT_EQ(inSlabs->GetErrorToleranceRange()[1], 1.0);
  // A block without points has no part in it.
  const auto small = test::BallImage({ 5, 5, 5 });
  contour->SetInputData(small);
  const double range = contour->GetErrorToleranceRange()[1];
  EXPECT_LT(range, 1.0);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, small);
  blocks->SetBlock(1, vtkNew<vtkImageData>());
  contour->SetInputData(blocks);
  EXPECT_EQ(contour->GetErrorToleranceRange()[1], range);
}

TEST(BadInput, NoInputAtAll)
{
  vtkNew<vtkIsodiamondContour> contour;
  vtkNew<vtkIsodiamondExtractor> extractor;
  for (vtkAlgorithm* filter :
    { static_cast<vtkAlgorithm*>(contour), static_cast<vtkAlgorithm*>(extractor) })
  {
    const auto messages = test::Watch(filter);
    vtkNew<test::Messages> executive;
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
    filter->Update();
    EXPECT_GT(messages->ErrorCount + executive->ErrorCount, 0); // the pipeline's own error
    EXPECT_EQ(vtkPointSet::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
  }
}

TEST(BadInput, NoIsovalue)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(test::BallImage({ 9, 9, 9 }));
  contour->SetNumberOfContours(0);
  const auto messages = test::Watch(contour);
  contour->Update();
  EXPECT_EQ(messages->WarningCount, 1);
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
  contour->SetValue(0, 0.0);
  contour->Update();
  EXPECT_EQ(messages->WarningCount, 1);
}

TEST(BadInput, TolerancesAndIsovalues)
{
  for (const double tolerance : { -1.0, NotANumber })
  {
    vtkNew<vtkIsodiamondContour> contour;
    contour->SetInputData(test::BallImage({ 9, 9, 9 }));
    contour->SetValue(0, 0.0);
    contour->SetErrorTolerance(tolerance);
    auto messages = test::Watch(contour);
    contour->Update();
    EXPECT_EQ(messages->ErrorCount, 1);
    EXPECT_NE(messages->Errors.find("tolerance"), std::string::npos);
    EXPECT_EQ(messages->Errors.find("1.0"), std::string::npos); // as a person would write it
    EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);

    vtkNew<vtkIsodiamondBuilder> builder;
    builder->SetInputData(test::BallImage({ 9, 9, 9 }));
    vtkNew<vtkIsodiamondExtractor> extractor;
    vtkNew<vtkDiamondMesh> mesh;
    for (vtkIsodiamondExtractor* filter : { static_cast<vtkIsodiamondExtractor*>(extractor),
           static_cast<vtkIsodiamondExtractor*>(mesh) })
    {
      filter->SetInputConnection(builder->GetOutputPort());
      filter->SetErrorTolerance(tolerance);
      messages = test::Watch(filter);
      filter->Update();
      EXPECT_EQ(messages->ErrorCount, 1);
      EXPECT_NE(messages->Errors.find("tolerance"), std::string::npos);
      EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
    }
  }
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(test::BallImage({ 9, 9, 9 }));
  builder->SetIsovalue(NotANumber);
  auto messages = test::Watch(builder);
  builder->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  // Outside the range there is no surface, and no error.
  builder->SetIsovalue(1000.0);
  builder->Update();
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  messages = test::Watch(extractor);
  extractor->Update();
  EXPECT_EQ(messages->ErrorCount, 0);
  EXPECT_EQ(extractor->GetOutput()->GetNumberOfCells(), 0);
}

TEST(BadInput, ThingsThatAreNotHierarchies)
{
  vtkNew<vtkPolyData> plain;
  vtkNew<vtkIsodiamondExtractor> extractor;
  vtkNew<vtkIsodiamondPoints> points;
  vtkNew<vtkIsodiamondBuilder> builder;
  for (vtkAlgorithm* filter : { static_cast<vtkAlgorithm*>(extractor),
         static_cast<vtkAlgorithm*>(points), static_cast<vtkAlgorithm*>(builder) })
  {
    filter->SetInputDataObject(0, plain);
    const auto messages = test::Watch(filter);
    filter->Update();
    EXPECT_EQ(messages->ErrorCount, 1);
    EXPECT_NE(messages->Errors.find("not an isodiamond hierarchy"), std::string::npos);
  }
  // HD has no isodiamonds; RI and MI no samples.
  vtkNew<vtkIsodiamondBuilder> scalars;
  scalars->SetInputData(test::BallImage({ 9, 9, 9 }));
  scalars->SetModelToHierarchyOfDiamonds();
  points->SetInputConnection(scalars->GetOutputPort());
  auto messages = test::Watch(points);
  points->Update();
  EXPECT_NE(messages->Errors.find("stores no isodiamonds"), std::string::npos);
  vtkNew<vtkIsodiamondBuilder> minimal;
  minimal->SetInputData(test::BallImage({ 9, 9, 9 }));
  builder->SetInputConnection(minimal->GetOutputPort());
  messages = test::Watch(builder);
  builder->Update();
  EXPECT_NE(messages->Errors.find("one isovalue"), std::string::npos);
}

TEST(BadInput, DamagedHierarchies)
{
  for (const bool scalars : { false, true })
  {
    vtkNew<vtkIsodiamondBuilder> builder;
    builder->SetInputData(test::BallImage({ 9, 9, 9 }));
    builder->SetModel(scalars ? 0 : 2);
    builder->Update();
    vtkFieldData* good = builder->GetOutput()->GetFieldData();
    for (int i = 0; i < good->GetNumberOfArrays(); ++i)
    {
      const std::string name = good->GetArrayName(i);
      if (name.rfind("Isodiamond", 0) != 0 || name == "IsodiamondArrayName")
      {
        continue; // numbers for users to read, or only a name
      }
      for (int damage = 0; damage < 3; ++damage)
      {
        vtkNew<vtkPolyData> bad;
        bad->DeepCopy(builder->GetOutput());
        if (damage == 0)
        {
          bad->GetFieldData()->RemoveArray(name.c_str());
        }
        else if (damage == 1)
        {
          vtkDataArray* array = bad->GetFieldData()->GetArray(name.c_str());
          array->SetNumberOfTuples(array->GetNumberOfTuples() - 1);
        }
        else
        {
          vtkNew<vtkDoubleArray> other;
          other->SetName(name.c_str());
          other->SetNumberOfComponents(2);
          other->SetNumberOfTuples(good->GetArray(name.c_str())->GetNumberOfTuples());
          other->Fill(1.0);
          bad->GetFieldData()->RemoveArray(name.c_str());
          bad->GetFieldData()->AddArray(other);
        }
        vtkNew<vtkIsodiamondExtractor> extractor;
        extractor->SetInputData(bad);
        const auto messages = test::Watch(extractor);
        extractor->Update();
        EXPECT_EQ(messages->ErrorCount, 1) << name << " damage " << damage;
        EXPECT_EQ(extractor->GetOutput()->GetNumberOfCells(), 0);
      }
    }
  }
}

TEST(BadInput, HeadersThatMakeNoSense)
{
  for (const bool scalars : { false, true })
  {
    vtkNew<vtkIsodiamondBuilder> builder;
    builder->SetInputData(test::BallImage({ 9, 9, 9 }));
    builder->SetModel(scalars ? 0 : 2);
    builder->Update();
    // Version, model, shape, metric, exactness, whether distances are two-sided (with the field
    // metric, they cannot be), topology, sizes; an HD with distances, topology or removed pieces.
    std::vector<std::pair<vtkIdType, double>> faults = { { 0, 1 }, { 0, 2 }, { 0, 4 }, { 1, 3 },
      { 2, 2 }, { 7, 2 }, { 8, 77 }, { 7, scalars ? 1 : -1 }, { 9, 1 }, { 9, 2 }, { 10, 2 },
      { 10, -1 }, { 11, -1 }, { 12, -1 } };
    if (scalars)
    {
      faults.insert(faults.end(), { { 10, 1 }, { 11, 5 }, { 12, 5 } });
    }
    for (const auto& [index, value] : faults)
    {
      vtkNew<vtkPolyData> bad;
      bad->DeepCopy(builder->GetOutput());
      bad->GetFieldData()->GetArray("IsodiamondHeader")->SetTuple1(index, value);
      vtkNew<vtkIsodiamondExtractor> extractor;
      extractor->SetInputData(bad);
      const auto messages = test::Watch(extractor);
      extractor->Update();
      EXPECT_EQ(messages->ErrorCount, 1) << "header " << index << " " << value;
      EXPECT_EQ(extractor->GetOutput()->GetNumberOfCells(), 0);
    }
  }
}

TEST(BadInput, PieceSizes)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetMinimumPieceSize(-5);
  EXPECT_EQ(contour->GetMinimumPieceSize(), 0);
  vtkNew<vtkIsodiamondBuilder> scalars;
  scalars->SetMinimumPieceSize(-5);
  EXPECT_EQ(scalars->GetMinimumPieceSize(), 0);
  // An HD holds all samples, and a hierarchy built from it is of all of them: no piece can go.
  scalars->SetInputData(test::BallImage({ 9, 9, 9 }));
  scalars->SetModelToHierarchyOfDiamonds();
  vtkNew<vtkIsodiamondBuilder> minimal;
  minimal->SetInputConnection(scalars->GetOutputPort());
  for (vtkIsodiamondBuilder* builder : { scalars.Get(), minimal.Get() })
  {
    const auto messages = test::Watch(builder);
    builder->SetMinimumPieceSize(2);
    builder->Update();
    EXPECT_EQ(messages->ErrorCount, 1);
    EXPECT_EQ(builder->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(builder->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
    builder->SetMinimumPieceSize(1); // no piece is smaller
    builder->Update();
    EXPECT_EQ(messages->ErrorCount, 1) << messages->Errors;
    EXPECT_EQ(builder->GetOutput()->GetNumberOfCells(), 12);
  }
}
