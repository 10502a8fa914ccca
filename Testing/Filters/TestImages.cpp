// SPDX-License-Identifier: BSD-3-Clause
// What users see, against baselines in Data/Baseline. Numbers check the geometry elsewhere; these
// check the look: shading, edges, colours, what is inside and what is outside.
#include "FilterTestTools.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkDataSetMapper.h"
#include "vtkDiamondMesh.h"
#include "vtkExtractGeometry.h"
#include "vtkFloatArray.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkIsodiamondPoints.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTesting.h"

#include <gtest/gtest.h>

namespace
{

/** A window of viewports side by side, each with one view of the ball. */
class Scene
{
public:
  explicit Scene(int views)
    : Views(views)
  {
    this->Window->SetSize(400 * views, 400);
    this->Window->SetMultiSamples(0);
    this->Window->SetOffScreenRendering(1);
  }

  vtkActor* Add(vtkAlgorithmOutput* data)
  {
    vtkNew<vtkRenderer> renderer;
    const double width = 1.0 / this->Views;
    renderer->SetViewport(this->Next * width, 0.0, (this->Next + 1) * width, 1.0);
    ++this->Next;
    renderer->SetBackground(1.0, 1.0, 1.0);
    vtkNew<vtkDataSetMapper> mapper;
    mapper->SetInputConnection(data);
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(0.55, 0.7, 0.85);
    renderer->AddActor(actor);
    renderer->GetActiveCamera()->SetPosition(3, -4, 2.5);
    renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
    renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
    renderer->ResetCamera();
    renderer->GetActiveCamera()->Zoom(1.1);
    this->Window->AddRenderer(renderer);
    return actor;
  }

  void Compare(const std::string& name)
  {
    this->Window->Render();
    vtkNew<vtkTesting> testing;
    testing->AddArgument("-T");
    testing->AddArgument(TEMPORARY_FOLDER);
    testing->AddArgument("-V");
    testing->AddArgument((std::string(BASELINE_FOLDER) + "/" + name + ".png").c_str());
    testing->SetRenderWindow(this->Window);
    EXPECT_EQ(testing->RegressionTest(0.15), vtkTesting::PASSED);
  }

private:
  vtkNew<vtkRenderWindow> Window;
  int Views;
  int Next = 0;
};

void ColourBy(vtkActor* actor, const char* array, int count)
{
  vtkNew<vtkLookupTable> colours;
  colours->SetNumberOfTableValues(count);
  colours->SetHueRange(0.66, 0.0);
  colours->SetTableRange(-0.5, count - 0.5);
  colours->ForceBuild();
  vtkMapper* mapper = actor->GetMapper();
  mapper->ScalarVisibilityOn();
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  mapper->SelectColorArray(array);
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
    scene.Add(contours[i]->GetOutputPort())->GetProperty()->EdgeVisibilityOn();
  }
  scene.Compare("SurfaceAtThreeTolerances");
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
  scene.Compare("LevelsAndKindsAndDiamonds");
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
    ColourBy(actor, "Level", 7);
    actor->GetMapper()->SetScalarModeToUseCellFieldData();
  }
  scene.Compare("RegionOfInterestOnASurface");
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
  scene.Compare("RegionOfInterestOnAnIntervalVolume");
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
  scene.Compare("IntervalVolumes");
}

TEST(Images, ColouredByAnotherArray)
{
  // Stripes by height, the same at full resolution, coarse, and from a hierarchy that carries them.
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
  scene.Compare("ColouredByAnotherArray");
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
    actor->GetMapper()->ScalarVisibilityOn();
    actor->GetMapper()->SetScalarRange(0.0, 0.4);
    actor->GetProperty()->SetEdgeVisibility(i);
  }
  scene.Compare("SeveralIsovalues");
}

TEST(Images, DiamondMeshesOfHierarchiesOfDiamondsAndMinimalOnes)
{
  // The paper's figure 14: an HD's mesh is all of the domain, an MI's what carries the surface.
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
  scene.Compare("DiamondMeshesOfHierarchiesOfDiamondsAndMinimalOnes");
}

TEST(Images, KindsOfIsodiamonds)
{
  // Active, creation and relevant ones of RI; MI has no relevant ones; interval volumes have an
  // inside.
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
  scene.Compare("KindsOfIsodiamonds");
}
