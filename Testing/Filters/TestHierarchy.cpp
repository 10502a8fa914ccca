// SPDX-License-Identifier: BSD-3-Clause
// Builder, hierarchy, extractor, points and diamond mesh.
#include "FilterTestTools.h"

#include "vtkCellData.h"
#include "vtkDiamondMesh.h"
#include "vtkFieldData.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondPoints.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <sstream>
#include <string>

namespace
{

vtkSmartPointer<vtkIsodiamondBuilder> MakeBuilder(int model)
{
  auto builder = vtkSmartPointer<vtkIsodiamondBuilder>::New();
  builder->SetInputData(test::BallImage({ 33, 29, 31 }));
  builder->SetModel(model);
  return builder;
}

std::set<std::string> NamesOf(vtkDataObject* data)
{
  std::set<std::string> names;
  for (int i = 0; i < data->GetFieldData()->GetNumberOfArrays(); ++i)
  {
    names.insert(data->GetFieldData()->GetAbstractArray(i)->GetName());
  }
  return names;
}

vtkSmartPointer<vtkUnstructuredGrid> Extract(vtkAlgorithmOutput* hierarchy, double tolerance)
{
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(hierarchy);
  extractor->SetErrorTolerance(tolerance);
  extractor->Update();
  return extractor->GetOutput();
}

}

// An image can have been made from a hierarchy, whose field data came along.
TEST(Hierarchy, IsNotDisturbedByAnotherInTheFieldDataOfTheImage)
{
  const auto image = test::BallImage({ 17, 17, 17 });
  vtkNew<vtkIsodiamondBuilder> other;
  other->SetInputData(image);
  other->SetShapeToIntervalVolume();
  other->SetIsorange(-0.5, 0.5);
  other->RefineInteriorOn();
  other->ComputeNormalsOn();
  other->Update();
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->Update();
  const std::set<std::string> names = NamesOf(builder->GetHierarchy());
  const vtkIdType cells = Extract(builder->GetOutputPort(), 0.0)->GetNumberOfCells();
  image->GetFieldData()->ShallowCopy(other->GetHierarchy()->GetFieldData());
  image->Modified();
  builder->Update();
  EXPECT_EQ(NamesOf(builder->GetHierarchy()), names);
  EXPECT_EQ(Extract(builder->GetOutputPort(), 0.0)->GetNumberOfCells(), cells);
}

TEST(Hierarchy, KnowsWhatItHolds)
{
  const auto minimal = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
  minimal->Update();
  vtkIsodiamondHierarchy* mi = minimal->GetHierarchy();
  ASSERT_NE(mi, nullptr);
  EXPECT_EQ(mi->GetModel(), vtkIsodiamondHierarchy::MINIMAL);
  EXPECT_EQ(mi->GetShape(), vtkIsodiamondHierarchy::ISOSURFACE);
  EXPECT_EQ(mi->GetArrayName(), "density");
  EXPECT_GT(mi->GetNumberOfActiveIsodiamonds(), 1000);
  const auto relevant = MakeBuilder(vtkIsodiamondHierarchy::RELEVANT);
  relevant->Update();
  vtkIsodiamondHierarchy* ri = relevant->GetHierarchy();
  EXPECT_EQ(ri->GetNumberOfActiveIsodiamonds(), mi->GetNumberOfActiveIsodiamonds());
  EXPECT_EQ(ri->GetNumberOfIsovertices(), mi->GetNumberOfIsovertices());
  EXPECT_EQ(ri->GetNumberOfCreationIsodiamonds(), mi->GetNumberOfCreationIsodiamonds());
  EXPECT_GT(ri->GetNumberOfRelevantIsodiamonds(), ri->GetNumberOfCreationIsodiamonds());
  EXPECT_EQ(mi->GetNumberOfRelevantIsodiamonds(), ri->GetNumberOfRelevantIsodiamonds());
  EXPECT_GT(ri->GetStorageSize(), mi->GetStorageSize());
  const auto number = [&](const char* name)
  { return static_cast<vtkIdType>(mi->GetFieldData()->GetArray(name)->GetTuple1(0)); };
  EXPECT_EQ(number("NumberOfActiveIsodiamonds"), mi->GetNumberOfActiveIsodiamonds());
  EXPECT_EQ(number("NumberOfRelevantIsodiamonds"), mi->GetNumberOfRelevantIsodiamonds());
  EXPECT_EQ(number("NumberOfCreationIsodiamonds"), mi->GetNumberOfCreationIsodiamonds());
  EXPECT_EQ(number("NumberOfIsovertices"), mi->GetNumberOfIsovertices());
  EXPECT_EQ(number("NumberOfRemovedPieces"), mi->GetNumberOfRemovedPieces());
  EXPECT_EQ(number("StorageSize"), mi->GetStorageSize());
  const auto scalars = MakeBuilder(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  scalars->Update();
  vtkIsodiamondHierarchy* hd = scalars->GetHierarchy();
  EXPECT_EQ(hd->GetModel(), vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  EXPECT_EQ(hd->GetNumberOfActiveIsodiamonds(), 0);
  EXPECT_LE(hd->GetStorageSize(), 8 * 34 * 30 * 32); // 8 bytes a voxel
  // The geometry is the outline.
  double bounds[6];
  hd->GetBounds(bounds);
  EXPECT_EQ(bounds[1], 32.0);
  EXPECT_EQ(hd->GetNumberOfLines(), 12);
  std::ostringstream text;
  mi->Print(text);
  EXPECT_NE(text.str().find("NumberOfIsovertices"), std::string::npos);
}

TEST(Hierarchy, StorageSizeIsTheSumOfTheArrays)
{
  const auto builder = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
  builder->Update();
  vtkFieldData* arrays = builder->GetHierarchy()->GetFieldData();
  vtkIdType size = 0;
  for (const char* name : { "IsodiamondBrickCounts", "IsodiamondBrickIndices",
         "IsodiamondBrickMasks", "IsodiamondRecords", "IsodiamondIsovertices" })
  {
    vtkDataArray* array = arrays->GetArray(name);
    ASSERT_NE(array, nullptr);
    size += array->GetNumberOfValues() * array->GetDataTypeSize();
  }
  EXPECT_EQ(builder->GetHierarchy()->GetStorageSize(), size);
}

TEST(Hierarchy, ThreeModelsGiveTheSameSurface)
{
  const auto hd = MakeBuilder(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  const auto ri = MakeBuilder(vtkIsodiamondHierarchy::RELEVANT);
  const auto mi = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
  vtkNew<vtkIsodiamondBuilder> fromScalars; // MI from the HD, without the image
  fromScalars->SetInputConnection(hd->GetOutputPort());
  for (const double tolerance : { 0.0, 0.02, 0.2, 1e9 })
  {
    const auto expected = test::SortedTriangles(Extract(mi->GetOutputPort(), tolerance));
    EXPECT_EQ(test::SortedTriangles(Extract(ri->GetOutputPort(), tolerance)), expected);
    EXPECT_EQ(test::SortedTriangles(Extract(hd->GetOutputPort(), tolerance)), expected);
    EXPECT_EQ(test::SortedTriangles(Extract(fromScalars->GetOutputPort(), tolerance)), expected);
  }
}

TEST(Hierarchy, GivesSurfacesAsPolyData)
{
  const auto mi = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(mi->GetOutputPort());
  extractor->SetErrorTolerance(0.02);
  extractor->Update();
  ASSERT_NE(extractor->GetOutput(), nullptr);
  EXPECT_EQ(extractor->GetPolyDataOutput(), nullptr);
  EXPECT_EQ(extractor->GetOutput()->GetPointData()->GetScalars(), nullptr);
  const auto expected = test::SortedTriangles(extractor->GetOutput());
  extractor->SetOutputTypeToPolyData();
  extractor->Update();
  ASSERT_NE(extractor->GetPolyDataOutput(), nullptr);
  EXPECT_EQ(extractor->GetOutput(), nullptr);
  EXPECT_EQ(test::SortedTriangles(extractor->GetPolyDataOutput()), expected);
  EXPECT_NE(extractor->GetPolyDataOutput()->GetPointData()->GetArray("density"), nullptr);
  auto messages = test::Watch(extractor);
  mi->SetShapeToIntervalVolume();
  mi->SetIsorange(-0.1, 0.1);
  extractor->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_NE(messages->Errors.find("unstructured grid"), std::string::npos);
  EXPECT_EQ(extractor->GetPolyDataOutput()->GetNumberOfPoints(), 0);
  extractor->SetOutputTypeToUnstructuredGrid();
  extractor->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_GT(extractor->GetOutput()->GetNumberOfCells(), 0);
}

TEST(Hierarchy, WarnsOfValuesThatAreSetButNotUsed)
{
  const auto hd = MakeBuilder(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(hd->GetOutputPort());
  auto messages = test::Watch(extractor);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 0);
  extractor->StoreIsovalue(0.125); // what a panel starts with
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 0);
  hd->SetIsovalue(0.25);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 0) << "the hierarchy has another one now";
  extractor->StoreIsovalue(0.3);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 1);
  EXPECT_NE(messages->Warnings.find("UseIsovalue"), std::string::npos);
  extractor->UseIsovalueOn();
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 1);
  extractor->UseIsovalueOff();
  extractor->SetShapeToIntervalVolume();
  extractor->StoreIsorange(-0.2, 0.2);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 1);
  extractor->StoreIsorange(-0.1, 0.1);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 2);
  EXPECT_NE(messages->Warnings.find("UseIsorange"), std::string::npos);
  extractor->UseIsorangeOn();
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 2);
}

TEST(Hierarchy, WarnsOfWhatOtherShapesHave)
{
  const auto hd = MakeBuilder(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(hd->GetOutputPort());
  const auto messages = test::Watch(extractor);
  extractor->SetIsorange(-0.1, 0.1);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 1);
  EXPECT_NE(messages->Warnings.find("no isorange"), std::string::npos);
  extractor->SetShapeToIntervalVolume();
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 1);
  extractor->SetIsovalue(0.1);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 2);
  EXPECT_NE(messages->Warnings.find("no isovalue"), std::string::npos);
  extractor->UseIsorangeOff();
  extractor->SetShapeToIsosurface();
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 2);
  extractor->SetInteriorTolerance(0.1);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 3);
  EXPECT_NE(messages->Warnings.find("no inside"), std::string::npos);
}

TEST(Hierarchy, TellsItsValuesToWhoLooks)
{
  const auto hd = MakeBuilder(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  hd->SetIsovalue(0.25);
  hd->SetIsorange(-0.5, 0.75);
  const auto mi = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
  mi->SetIsovalue(0.125);
  for (const auto& [builder, isovalue] : { std::pair(hd, 0.25), std::pair(mi, 0.125) })
  {
    builder->Update();
    vtkFieldData* own = builder->GetOutput()->GetFieldData();
    ASSERT_NE(own->GetArray("Isovalue"), nullptr);
    EXPECT_EQ(own->GetArray("Isovalue")->GetTuple1(0), isovalue);
  }
  vtkDataArray* range = hd->GetOutput()->GetFieldData()->GetArray("Isorange");
  ASSERT_NE(range, nullptr);
  EXPECT_EQ(range->GetTuple1(0), -0.5);
  EXPECT_EQ(range->GetTuple1(1), 0.75);
  EXPECT_EQ(Extract(mi->GetOutputPort(), 0.0)->GetFieldData()->GetArray("Isovalue"), nullptr);
}

TEST(Hierarchy, OfDiamondsAnswersOtherIsovalues)
{
  const auto hd = MakeBuilder(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(hd->GetOutputPort());
  for (const double isovalue : { -0.3, 0.1, 0.4 })
  {
    extractor->SetIsovalue(isovalue);
    extractor->Update();
    const auto mi = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
    mi->SetIsovalue(isovalue);
    EXPECT_EQ(test::SortedTriangles(extractor->GetOutput()),
      test::SortedTriangles(Extract(mi->GetOutputPort(), 0.0)));
    EXPECT_FLOAT_EQ(
      extractor->GetOutput()->GetPointData()->GetArray("density")->GetTuple1(0), isovalue);
  }
  extractor->UseIsovalueOff();
  extractor->Update();
  EXPECT_EQ(test::SortedTriangles(extractor->GetOutput()),
    test::SortedTriangles(Extract(hd->GetOutputPort(), 0.0)));
}

TEST(Hierarchy, AnotherIsovalueOnMinimalWarnsOnceAndHasNoEffect)
{
  const auto mi = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(mi->GetOutputPort());
  extractor->SetIsovalue(0.3);
  const auto messages = test::Watch(extractor);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 1);
  EXPECT_EQ(messages->ErrorCount, 0);
  EXPECT_EQ(test::SortedTriangles(extractor->GetOutput()),
    test::SortedTriangles(Extract(mi->GetOutputPort(), 0.0)));
}

TEST(Hierarchy, SurvivesFilesAndCopies)
{
  for (const int model : { vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS,
         vtkIsodiamondHierarchy::RELEVANT, vtkIsodiamondHierarchy::MINIMAL })
  {
    const auto builder = MakeBuilder(model);
    const std::string path = std::string(TEMPORARY_FOLDER) + "/hierarchy.vtp";
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetDataModeToBinary(); // see README.md on files
    writer->SetInputConnection(builder->GetOutputPort());
    writer->Write();
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    const auto expected = test::SortedTriangles(Extract(builder->GetOutputPort(), 0.05));
    EXPECT_EQ(test::SortedTriangles(Extract(reader->GetOutputPort(), 0.05)), expected);
    const auto restored = vtkSmartPointer<vtkIsodiamondHierarchy>::Take(
      vtkIsodiamondHierarchy::FromPolyData(reader->GetOutput()));
    ASSERT_NE(restored, nullptr);
    EXPECT_EQ(restored->GetModel(), model);
    EXPECT_EQ(restored->GetStorageSize(), builder->GetHierarchy()->GetStorageSize());
    EXPECT_EQ(
      restored->GetNumberOfIsovertices(), builder->GetHierarchy()->GetNumberOfIsovertices());
    vtkNew<vtkIsodiamondHierarchy> copy;
    copy->DeepCopy(restored);
    EXPECT_EQ(copy->GetStorageSize(), restored->GetStorageSize());
    copy->Initialize();
    EXPECT_EQ(copy->GetFieldData()->GetNumberOfArrays(), 0);
  }
  vtkNew<vtkPolyData> other;
  EXPECT_EQ(vtkIsodiamondHierarchy::FromPolyData(other), nullptr);
  EXPECT_EQ(vtkIsodiamondHierarchy::FromPolyData(nullptr), nullptr);
}

TEST(Hierarchy, OfVersion2IsReadAsWhatItIs)
{
  for (const std::string name : { "00", "01", "10", "11", "20", "21" })
  {
    vtkNew<vtkXMLPolyDataReader> old;
    old->SetFileName((std::string(DATA_FOLDER) + "/Files/version-2-" + name + ".vtp").c_str());
    old->Update();
    const auto hierarchy = vtkSmartPointer<vtkIsodiamondHierarchy>::Take(
      vtkIsodiamondHierarchy::FromPolyData(old->GetOutput()));
    ASSERT_NE(hierarchy, nullptr);
    EXPECT_EQ(hierarchy->GetFieldData()->GetArray("IsodiamondHeader")->GetTuple1(0), 2);
    EXPECT_EQ(hierarchy->GetModel(), name[0] - '0');
    EXPECT_EQ(hierarchy->GetShape(), name[1] - '0');
    vtkNew<vtkXMLPolyDataReader> current; // the same, as MakeFiles made it
    current->SetFileName((std::string(DATA_FOLDER) + "/Files/" + name + "-ascii.vtp").c_str());
    for (const double tolerance : { 0.0, 0.3 })
    {
      const auto expected = Extract(current->GetOutputPort(), tolerance);
      const auto mesh = Extract(old->GetOutputPort(), tolerance);
      EXPECT_GT(expected->GetNumberOfCells(), 0);
      EXPECT_EQ(test::Difference(mesh, expected), "");
    }
  }
}

TEST(Hierarchy, IsNotCarriedAlongByMeshes)
{
  const auto builder = MakeBuilder(vtkIsodiamondHierarchy::RELEVANT);
  builder->Update();
  vtkNew<vtkPolyData> hierarchy;
  hierarchy->ShallowCopy(builder->GetOutput());
  vtkNew<vtkStringArray> note;
  note->SetName("note");
  note->InsertNextValue("anyone's");
  hierarchy->GetFieldData()->AddArray(note);
  vtkNew<vtkIsodiamondExtractor> extractor;
  vtkNew<vtkDiamondMesh> tetrahedra;
  vtkNew<vtkIsodiamondPoints> points;
  for (vtkAlgorithm* filter : { static_cast<vtkAlgorithm*>(extractor),
         static_cast<vtkAlgorithm*>(tetrahedra), static_cast<vtkAlgorithm*>(points) })
  {
    filter->SetInputDataObject(0, hierarchy);
    filter->Update();
    vtkDataObject* output = filter->GetOutputDataObject(0);
    EXPECT_GT(output->GetNumberOfElements(vtkDataObject::CELL), 0);
    EXPECT_EQ(output->GetFieldData()->GetNumberOfArrays(), 1) << filter->GetClassName();
    EXPECT_NE(output->GetFieldData()->GetAbstractArray("note"), nullptr);
  }
  EXPECT_GT(hierarchy->GetFieldData()->GetNumberOfArrays(), 5); // it keeps its own
}

TEST(Hierarchy, MadeFromAnHDHasNothingOfIt)
{
  const auto scalars = MakeBuilder(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  const auto direct = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
  vtkNew<vtkIsodiamondBuilder> indirect;
  indirect->SetInputConnection(scalars->GetOutputPort());
  indirect->SetModel(vtkIsodiamondHierarchy::MINIMAL);
  direct->Update();
  indirect->Update();
  EXPECT_EQ(NamesOf(indirect->GetOutput()), NamesOf(direct->GetOutput()));
  EXPECT_EQ(test::Difference(
              Extract(indirect->GetOutputPort(), 0.1), Extract(direct->GetOutputPort(), 0.1)),
    "");
}

TEST(Hierarchy, HDFromAnHDHasItsOwnDefaultsOfQueries)
{
  const auto first = MakeBuilder(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  vtkNew<vtkIsodiamondBuilder> second;
  second->SetInputConnection(first->GetOutputPort());
  second->SetModel(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  second->SetIsovalue(0.2);
  second->SetShapeToIntervalVolume();
  second->SetIsorange(0.1, 0.4);
  second->ExactIsoverticesOff();
  second->ComputeNormalsOn();
  const auto messages = test::Watch(second);
  second->Update();
  EXPECT_EQ(messages->WarningCount, 1) << messages->Warnings; // an HD has no normals
  vtkIsodiamondHierarchy* hierarchy = second->GetHierarchy();
  EXPECT_EQ(hierarchy->GetIsovalue(), 0.2);
  EXPECT_EQ(hierarchy->GetShape(), vtkIsodiamondHierarchy::INTERVAL_VOLUME);
  EXPECT_EQ(NamesOf(second->GetOutput()), NamesOf(first->GetOutput()));
  EXPECT_EQ(first->GetHierarchy()->GetIsovalue(), 0.0);
  EXPECT_EQ(first->GetHierarchy()->GetShape(), vtkIsodiamondHierarchy::ISOSURFACE);
  const auto direct = MakeBuilder(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
  direct->SetShapeToIntervalVolume();
  direct->SetIsorange(0.1, 0.4);
  direct->ExactIsoverticesOff();
  EXPECT_EQ(
    test::Difference(Extract(second->GetOutputPort(), 0.1), Extract(direct->GetOutputPort(), 0.1)),
    "");
}

TEST(Hierarchy, IsReadAgainWhenItsArraysChange)
{
  const auto builder = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
  builder->Update();
  vtkIsodiamondHierarchy* hierarchy = builder->GetHierarchy();
  vtkFieldData* fieldData = hierarchy->GetFieldData();
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputData(hierarchy);
  const auto messages = test::Watch(extractor);
  const auto update = [&]
  {
    extractor->Modified();
    extractor->Update();
    return extractor->GetOutput()->GetNumberOfCells();
  };
  const vtkIdType cells = update();
  EXPECT_GT(cells, 100);
  vtkDataArray* header = fieldData->GetArray("IsodiamondHeader");
  header->SetTuple1(0, 99);
  header->Modified();
  EXPECT_EQ(update(), 0);
  EXPECT_EQ(messages->ErrorCount, 1) << messages->Errors;
  header->SetTuple1(0, 3);
  header->Modified();
  EXPECT_EQ(update(), cells);
  fieldData->GetArray("IsodiamondIsovertices")->Initialize(); // its memory is gone
  fieldData->GetArray("IsodiamondIsovertices")->Modified();
  EXPECT_EQ(update(), 0);
  EXPECT_EQ(messages->ErrorCount, 2) << messages->Errors;
}

TEST(Hierarchy, OfVersion2HasOneSidedDistancesAndAllPieces)
{
  const auto builder = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
  builder->SetErrorMetricToDistance();
  builder->PreserveTopologyOn();
  builder->SetMinimumPieceSize(3);
  builder->Update();
  vtkNew<vtkPolyData> old;
  old->DeepCopy(builder->GetOutput());
  vtkDataArray* header = old->GetFieldData()->GetArray("IsodiamondHeader");
  EXPECT_EQ(header->GetNumberOfTuples(), 13);
  header->SetTuple1(0, 2);
  header->SetNumberOfTuples(9);
  const auto hierarchy =
    vtkSmartPointer<vtkIsodiamondHierarchy>::Take(vtkIsodiamondHierarchy::FromPolyData(old));
  EXPECT_EQ(hierarchy->GetErrorMetric(), vtkIsodiamondHierarchy::DISTANCE);
  EXPECT_FALSE(hierarchy->GetTwoSidedDistances());
  EXPECT_FALSE(hierarchy->GetPreservesTopology());
  EXPECT_EQ(hierarchy->GetMinimumPieceSize(), 0);
  EXPECT_EQ(hierarchy->GetNumberOfRemovedPieces(), 0);
  EXPECT_EQ(builder->GetHierarchy()->GetMinimumPieceSize(), 3);
  EXPECT_TRUE(builder->GetHierarchy()->GetPreservesTopology());
  EXPECT_TRUE(builder->GetHierarchy()->GetTwoSidedDistances());
  vtkNew<vtkIsodiamondExtractor> extractors[2];
  extractors[0]->SetInputData(builder->GetOutput());
  extractors[1]->SetInputData(old);
  EXPECT_LT(extractors[0]->GetErrorToleranceRange()[1], 2.0); // 2 % of the diagonal
  EXPECT_EQ(extractors[0]->GetErrorToleranceRange()[1], extractors[1]->GetErrorToleranceRange()[1]);
  // An old header with the current version's number is refused.
  header->SetTuple1(0, 3);
  header->Modified();
  old->Modified();
  const auto messages = test::Watch(extractors[1]);
  extractors[1]->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_NE(messages->Errors.find("version"), std::string::npos);
}

TEST(Points, HaveOneForEachStoredIsodiamond)
{
  const auto builder = MakeBuilder(vtkIsodiamondHierarchy::RELEVANT);
  vtkNew<vtkIsodiamondPoints> points;
  points->SetInputConnection(builder->GetOutputPort());
  points->Update();
  vtkIsodiamondHierarchy* hierarchy = builder->GetHierarchy();
  vtkPolyData* output = points->GetOutput();
  EXPECT_EQ(output->GetNumberOfPoints(),
    hierarchy->GetNumberOfActiveIsodiamonds() + hierarchy->GetNumberOfRelevantIsodiamonds());
  EXPECT_EQ(output->GetNumberOfVerts(), output->GetNumberOfPoints());
  std::array<vtkIdType, 3> kinds{};
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    ++kinds.at(static_cast<int>(output->GetPointData()->GetArray("Kind")->GetTuple1(i)));
    ASSERT_LE(output->GetPointData()->GetArray("Class")->GetTuple1(i), 2);
    ASSERT_LE(output->GetPointData()->GetArray("Level")->GetTuple1(i), 4);
    ASSERT_GT(output->GetPointData()->GetArray("Error")->GetTuple1(i), 0.0);
  }
  EXPECT_EQ(kinds[0], hierarchy->GetNumberOfActiveIsodiamonds());
  EXPECT_EQ(kinds[1], hierarchy->GetNumberOfCreationIsodiamonds());
  EXPECT_EQ(kinds[1] + kinds[2], hierarchy->GetNumberOfRelevantIsodiamonds());
}

TEST(DiamondMesh, FillsTheDomainOnlyForHierarchiesThatHoldIt)
{
  for (const int model : { vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS,
         vtkIsodiamondHierarchy::RELEVANT, vtkIsodiamondHierarchy::MINIMAL })
  {
    vtkNew<vtkIsodiamondBuilder> builder;
    builder->SetInputData(test::BallImage({ 17, 17, 17 }));
    builder->SetModel(model);
    vtkNew<vtkDiamondMesh> mesh;
    mesh->SetInputConnection(builder->GetOutputPort());
    mesh->SetErrorTolerance(0.1);
    mesh->Update();
    double six = 0.0;
    vtkUnstructuredGrid* output = mesh->GetOutput();
    ASSERT_GT(output->GetNumberOfCells(), 0);
    for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
    {
      ASSERT_EQ(output->GetCellType(i), VTK_TETRA);
      vtkPoints* p = output->GetCell(i)->GetPoints();
      double a[3];
      double b[3];
      double c[3];
      vtkMath::Subtract(p->GetPoint(1), p->GetPoint(0), a);
      p->GetPoint(2, b);
      p->GetPoint(3, c);
      double o[3];
      p->GetPoint(0, o);
      vtkMath::Subtract(b, o, b);
      vtkMath::Subtract(c, o, c);
      p->GetPoint(1, a);
      vtkMath::Subtract(a, o, a);
      const double part = vtkMath::Determinant3x3(a, b, c);
      ASSERT_GT(part, 0.0);
      six += part;
    }
    if (model == vtkIsodiamondHierarchy::MINIMAL)
    {
      EXPECT_LT(six, 0.9 * 6 * 16 * 16 * 16);
    }
    else
    {
      EXPECT_DOUBLE_EQ(six, 6.0 * 16 * 16 * 16);
    }
    EXPECT_NE(output->GetCellData()->GetArray("Level"), nullptr);
    EXPECT_NE(output->GetCellData()->GetArray("Class"), nullptr);
  }
}

TEST(DiamondMesh, HasThePrecisionThatIsAskedFor)
{
  const auto builder = MakeBuilder(vtkIsodiamondHierarchy::MINIMAL);
  vtkNew<vtkDiamondMesh> mesh;
  mesh->SetInputConnection(builder->GetOutputPort());
  for (const auto& [precision, type] :
    { std::array<int, 2>{ vtkAlgorithm::SINGLE_PRECISION, VTK_FLOAT },
      { vtkAlgorithm::DOUBLE_PRECISION, VTK_DOUBLE },
      { vtkAlgorithm::DEFAULT_PRECISION, VTK_DOUBLE } })
  {
    mesh->SetOutputPointsPrecision(precision);
    mesh->Update();
    EXPECT_GT(mesh->GetOutput()->GetNumberOfPoints(), 100);
    EXPECT_EQ(mesh->GetOutput()->GetPoints()->GetDataType(), type);
  }
}

// At coordinates of maps: floats that are 5 million are half a voxel apart.
TEST(Hierarchy, HasItsPlaceFarFromTheOrigin)
{
  const auto image = test::BallImage({ 17, 18, 19 });
  image->SetSpacing(0.1, 0.1, 0.1);
  image->SetOrigin(500000.0, -5400000.0, 250.0);
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  vtkNew<vtkIsodiamondPoints> points;
  points->SetInputConnection(builder->GetOutputPort());
  points->Update();
  double bounds[6];
  builder->GetOutput()->GetBounds(bounds);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], image->GetBounds()[i], 1e-6) << i;
  }
  std::set<std::array<double, 3>> places;
  for (vtkIdType i = 0; i < points->GetOutput()->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> place;
    points->GetOutput()->GetPoint(i, place.data());
    places.insert(place);
  }
  EXPECT_GT(places.size(), 100U);
  EXPECT_EQ(places.size(), static_cast<std::size_t>(points->GetOutput()->GetNumberOfPoints()));
  image->SetOrigin(0.0, 0.0, 0.0);
  points->Update();
  EXPECT_EQ(points->GetOutput()->GetPoints()->GetDataType(), VTK_FLOAT);
}
