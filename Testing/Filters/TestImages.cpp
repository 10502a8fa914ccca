// SPDX-License-Identifier: BSD-3-Clause
// What users see, against baselines in Data/Baseline. Other tests check the geometry by numbers;
// these check the look: shading, edges, colours, what is inside and what is outside.
#include "FilterTestTools.h"
#include "ImageTestTools.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkDiamondMesh.h"
#include "vtkExtractGeometry.h"
#include "vtkFloatArray.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkIsodiamondPoints.h"
#include "vtkLookupTable.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

#include <gtest/gtest.h>

namespace
{

using test::ColourBy;
using test::Scene;

/** Expects a picture to be like the baseline with the current test's name. Then plants faults in
 * what is drawn, one at a time: none may go unnoticed. */
void Compare(const Scene& scene)
{
  const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto baseline = test::Baseline(name);
  const auto right = scene.Draw();
  if (!test::AreLike(right, baseline))
  {
    const std::string file = std::string(TEMPORARY_FOLDER) + "/" + name;
    test::Write(right, file + ".png");
    test::Write(test::Difference(right, baseline), file + ".difference.png");
    FAIL() << file << ".png is not like the baseline";
  }
  for (std::size_t view = 0; view < scene.Actors().size(); ++view)
  {
    SCOPED_TRACE("view " + std::to_string(view));
    const test::ViewFault none = test::NoFaultOf(scene.Actors()[view]);
    none.Plant();
    EXPECT_TRUE(test::AreLike(scene.Draw(), baseline));
    none.Undo();
    for (const test::ViewFault& fault : test::FaultsOf(scene.Actors()[view]))
    {
      fault.Plant();
      const auto wrong = scene.Draw();
      // A picture need not show a fault that can hardly be seen.
      const bool isHidden = fault.MayBeHidden && test::CountChanged(wrong, right) < 50;
      EXPECT_TRUE(isHidden || !test::AreLike(wrong, baseline)) << fault.Name;
      fault.Undo();
    }
    EXPECT_EQ(test::CountChanged(scene.Draw(), right), 0);
  }
}

}

TEST(Images, SurfaceAtThreeTolerances)
{
  Scene scene(3);
  vtkNew<vtkIsodiamondContour> contours[3];
  const double tolerances[3] = { 0.0, 0.02, 0.1 };
  for (int i = 0; i < 3; ++i)
  {
    contours[i]->SetInputData(test::BallImage({ 29, 29, 29 }));
    contours[i]->SetValue(0, 0.0);
    contours[i]->SetErrorMetricToField();
    contours[i]->SetErrorTolerance(tolerances[i]);
    vtkActor* actor = scene.Add(contours[i]->GetOutputPort());
    actor->GetProperty()->EdgeVisibilityOn();
    actor->GetProperty()->BackfaceCullingOn();
  }
  Compare(scene);
}

TEST(Images, LevelsAndKindsAndDiamonds)
{
  Scene scene(3);
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(test::BallImage({ 33, 33, 33 }));
  builder->SetModelToRelevant();
  vtkNew<vtkIsodiamondExtractor> surface;
  surface->SetInputConnection(builder->GetOutputPort());
  surface->SetErrorTolerance(0.02);
  vtkActor* actor = scene.Add(surface->GetOutputPort());
  ColourBy(actor, "Level", 6);
  actor->GetMapper()->SetScalarModeToUseCellFieldData();
  actor->GetProperty()->BackfaceCullingOn();
  vtkNew<vtkIsodiamondPoints> points;
  points->SetInputConnection(builder->GetOutputPort());
  actor = scene.Add(points->GetOutputPort());
  ColourBy(actor, "Kind", 3);
  actor->GetMapper()->SetScalarModeToUsePointFieldData();
  actor->GetProperty()->SetPointSize(2.0);
  // Half of the diamond mesh.
  vtkNew<vtkDiamondMesh> mesh;
  mesh->SetInputConnection(builder->GetOutputPort());
  mesh->SetErrorTolerance(0.1);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(16.0, 16.0, 16.0);
  plane->SetNormal(0.0, -1.0, 0.0);
  vtkNew<vtkExtractGeometry> half;
  half->SetInputConnection(mesh->GetOutputPort());
  half->SetImplicitFunction(plane);
  actor = scene.Add(half->GetOutputPort());
  ColourBy(actor, "Class", 3);
  actor->GetMapper()->SetScalarModeToUseCellFieldData();
  actor->GetProperty()->EdgeVisibilityOn();
  Compare(scene);
}

// Full detail in a box, coarse outside, coloured by level: a surface, and half of an interval
// volume.
TEST(Images, RegionOfInterestOnASurface)
{
  Scene scene(2);
  vtkNew<vtkIsodiamondContour> contours[2];
  const double outsideTolerances[2] = { VTK_DOUBLE_MAX, 0.5 };
  for (int i = 0; i < 2; ++i)
  {
    contours[i]->SetInputData(test::BallImage({ 33, 33, 33 }));
    contours[i]->SetValue(0, 0.0);
    contours[i]->UseRegionOfInterestOn();
    contours[i]->SetRegionOfInterest(18, 34, -2, 34, 14, 34);
    contours[i]->SetOutsideErrorTolerance(outsideTolerances[i]);
    vtkActor* actor = scene.Add(contours[i]->GetOutputPort());
    actor->GetProperty()->EdgeVisibilityOn();
    actor->GetProperty()->BackfaceCullingOn();
    ColourBy(actor, "Level", 7);
    actor->GetMapper()->SetScalarModeToUseCellFieldData();
  }
  Compare(scene);
}

TEST(Images, RegionOfInterestOnAnIntervalVolume)
{
  Scene scene(1);
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(test::BallImage({ 33, 33, 33 }));
  volume->SetIsorange(0.0, 10.0);
  volume->UseRegionOfInterestOn();
  volume->SetRegionOfInterest(20, 34, -2, 34, 18, 34);
  volume->SetOutsideErrorTolerance(1.0);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(16.0, 16.0, 16.0);
  plane->SetNormal(0.0, -1.0, 0.0);
  vtkNew<vtkExtractGeometry> half;
  half->SetInputConnection(volume->GetOutputPort());
  half->SetImplicitFunction(plane);
  vtkActor* actor = scene.Add(half->GetOutputPort());
  actor->GetProperty()->EdgeVisibilityOn();
  ColourBy(actor, "Level", 6);
  actor->GetMapper()->SetScalarModeToUseCellFieldData();
  Compare(scene);
}

// Clipped by whole cells: the inside coarse and graded, then refined where the field asks for it.
TEST(Images, IntervalVolumes)
{
  Scene scene(2);
  vtkNew<vtkIsodiamondIntervalVolume> volumes[2];
  vtkNew<vtkExtractGeometry> halves[2];
  const double interiorTolerances[2] = { VTK_DOUBLE_MAX, 0.005 };
  for (int i = 0; i < 2; ++i)
  {
    volumes[i]->SetInputData(test::BallImage({ 33, 33, 33 }));
    volumes[i]->SetIsorange(0.0, 10.0);
    volumes[i]->SetErrorMetricToField();
    volumes[i]->SetErrorTolerance(0.02);
    volumes[i]->SetInteriorTolerance(interiorTolerances[i]);
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(16.0, 16.0, 16.0);
    plane->SetNormal(0.0, -1.0, 0.0);
    halves[i]->SetInputConnection(volumes[i]->GetOutputPort());
    halves[i]->SetImplicitFunction(plane);
    vtkActor* actor = scene.Add(halves[i]->GetOutputPort());
    actor->GetProperty()->EdgeVisibilityOn();
    ColourBy(actor, "Level", 6);
    actor->GetMapper()->SetScalarModeToUseCellFieldData();
  }
  Compare(scene);
}

TEST(Images, ColouredByAnotherArray)
{
  // Stripes by height: the same at full resolution, coarse, and from a hierarchy that carries them.
  const auto image = test::BallImage({ 33, 33, 33 });
  vtkNew<vtkFloatArray> stripes;
  stripes->SetName("stripes");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    stripes->InsertNextValue(static_cast<float>(image->GetPoint(i)[2] / 4.0));
  }
  image->GetPointData()->AddArray(stripes);
  Scene scene(3);
  vtkNew<vtkIsodiamondContour> contours[2];
  for (int i = 0; i < 2; ++i)
  {
    contours[i]->SetInputData(image);
    contours[i]->SetValue(0, 0.0);
    contours[i]->SetErrorTolerance(0.5 * i);
    vtkActor* actor = scene.Add(contours[i]->GetOutputPort());
    ColourBy(actor, "stripes", 8);
    actor->GetMapper()->SetScalarModeToUsePointFieldData();
    actor->GetProperty()->SetEdgeVisibility(i);
    actor->GetProperty()->BackfaceCullingOn();
  }
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetErrorMetricToDistance();
  builder->AddPointArray("stripes");
  builder->ComputeNormalsOn();
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->SetErrorTolerance(0.2);
  vtkActor* actor = scene.Add(extractor->GetOutputPort());
  ColourBy(actor, "stripes", 8);
  actor->GetMapper()->SetScalarModeToUsePointFieldData();
  actor->GetProperty()->BackfaceCullingOn();
  Compare(scene);
}

TEST(Images, SeveralIsovalues)
{
  // Three shells, cut open, each in the colour of its value.
  Scene scene(2);
  vtkNew<vtkIsodiamondContour> contours[2];
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(16.0, 16.0, 16.0);
  plane->SetNormal(0.0, -1.0, 0.0);
  vtkNew<vtkExtractGeometry> halves[2];
  for (int i = 0; i < 2; ++i)
  {
    contours[i]->SetInputData(test::BallImage({ 33, 33, 33 }));
    contours[i]->SetValue(0, 0.0);
    contours[i]->SetValue(1, 0.2);
    contours[i]->SetValue(2, 0.4);
    contours[i]->SetErrorTolerance(0.4 * i);
    halves[i]->SetInputConnection(contours[i]->GetOutputPort());
    halves[i]->SetImplicitFunction(plane);
    vtkActor* actor = scene.Add(halves[i]->GetOutputPort());
    vtkNew<vtkLookupTable> colours;
    colours->SetNumberOfTableValues(3);
    colours->SetTableRange(-0.1, 0.5);
    colours->ForceBuild();
    actor->GetMapper()->ScalarVisibilityOn();
    actor->GetMapper()->SetLookupTable(colours);
    actor->GetMapper()->UseLookupTableScalarRangeOn();
    actor->GetProperty()->SetEdgeVisibility(i);
  }
  Compare(scene);
}

TEST(Images, DiamondMeshesOfHierarchiesOfDiamondsAndMinimalOnes)
{
  // The paper's figure 14: an HD's mesh fills the grid, an MI's is only what carries the surface.
  Scene scene(2);
  vtkNew<vtkIsodiamondBuilder> builders[2];
  vtkNew<vtkDiamondMesh> meshes[2];
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(16.0, 16.0, 16.0);
  plane->SetNormal(0.0, -1.0, 0.0);
  vtkNew<vtkExtractGeometry> halves[2];
  for (int i = 0; i < 2; ++i)
  {
    builders[i]->SetInputData(test::BallImage({ 33, 33, 33 }));
    builders[i]->SetModel(
      i == 0 ? vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS : vtkIsodiamondHierarchy::MINIMAL);
    meshes[i]->SetInputConnection(builders[i]->GetOutputPort());
    meshes[i]->SetErrorTolerance(0.05);
    halves[i]->SetInputConnection(meshes[i]->GetOutputPort());
    halves[i]->SetImplicitFunction(plane);
    vtkActor* actor = scene.Add(halves[i]->GetOutputPort());
    ColourBy(actor, "Level", 5);
    actor->GetMapper()->SetScalarModeToUseCellFieldData();
    actor->GetProperty()->EdgeVisibilityOn();
  }
  Compare(scene);
}

TEST(Images, KindsOfIsodiamonds)
{
  // An RI's active, creation and relevant ones; an MI, which has no relevant ones; an interval
  // volume's, which has an inside.
  Scene scene(3);
  vtkNew<vtkIsodiamondBuilder> builders[3];
  vtkNew<vtkIsodiamondPoints> points[3];
  const auto image = test::PhantomImage({ 33, 33, 33 }, 0.0);
  for (int i = 0; i < 3; ++i)
  {
    builders[i]->SetInputData(image);
    builders[i]->SetModel(
      i == 0 ? vtkIsodiamondHierarchy::RELEVANT : vtkIsodiamondHierarchy::MINIMAL);
    builders[i]->SetShape(i == 2 ? 1 : 0);
    builders[i]->SetIsovalue(50.0);
    builders[i]->SetIsorange(50.0, 1e9);
    points[i]->SetInputConnection(builders[i]->GetOutputPort());
    vtkActor* actor = scene.Add(points[i]->GetOutputPort());
    ColourBy(actor, "Kind", 3);
    actor->GetMapper()->SetScalarModeToUsePointFieldData();
    actor->GetProperty()->SetPointSize(4.0);
  }
  Compare(scene);
}
