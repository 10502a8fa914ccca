// SPDX-License-Identifier: BSD-3-Clause
#include "ImageTestTools.h"

#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCell.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetMapper.h"
#include "vtkExtractCells.h"
#include "vtkIdList.h"
#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkReverseSense.h"
#include "vtkUnstructuredGrid.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <set>

namespace test
{
namespace
{

using Position = std::array<double, 3>;

/** Where all views are drawn from. */
constexpr Position Camera = { 3.0, -4.0, 2.5 };

/** The colour of views that show no array. */
constexpr Position PlainColour = { 0.55, 0.7, 0.85 };

/** How many pixels of a picture may differ between drivers, and how many squares of four: only thin
 * lines differ, which fill few squares. Versions of VTK were seen to differ in 121 pixels and no
 * square. */
constexpr int MostDifferent = 250;
constexpr int MostSquares = 5;

using Pixel = unsigned char[3];

Pixel* PixelsOf(vtkImageData* picture)
{
  return static_cast<Pixel*>(picture->GetScalarPointer());
}

bool HaveSameSize(vtkImageData* a, vtkImageData* b)
{
  return std::equal(a->GetDimensions(), a->GetDimensions() + 3, b->GetDimensions()) &&
    a->GetNumberOfScalarComponents() == 3 && b->GetNumberOfScalarComponents() == 3;
}

bool AreLikeColours(const Pixel& a, const Pixel& b)
{
  return std::abs(a[0] - b[0]) < 26 && std::abs(a[1] - b[1]) < 26 && std::abs(a[2] - b[2]) < 26;
}

/** Whether a pixel is like the one at its place in another picture, or one next to that. */
bool IsAround(const Pixel& pixel, vtkImageData* other, int x, int y)
{
  const int* size = other->GetDimensions();
  for (int v = std::max(0, y - 1); v < std::min(size[1], y + 2); ++v)
  {
    for (int u = std::max(0, x - 1); u < std::min(size[0], x + 2); ++u)
    {
      if (AreLikeColours(pixel, PixelsOf(other)[v * size[0] + u]))
      {
        return true;
      }
    }
  }
  return false;
}

/** The number of squares of four pixels all of which differ. */
int CountSquares(vtkImageData* difference)
{
  const int* size = difference->GetDimensions();
  const auto* different = static_cast<unsigned char*>(difference->GetScalarPointer());
  int squares = 0;
  for (int y = 0; y + 1 < size[1]; ++y)
  {
    for (int x = 0; x + 1 < size[0]; ++x)
    {
      const auto* lower = different + y * size[0] + x;
      const auto* upper = lower + size[0];
      squares += lower[0] != 0 && lower[1] != 0 && upper[0] != 0 && upper[1] != 0 ? 1 : 0;
    }
  }
  return squares;
}

//--- Faults -------------------------------------------------------------------

/** Other data in a view. */
ViewFault OtherData(vtkActor* actor, const std::string& name, vtkDataSet* data)
{
  const vtkSmartPointer<vtkDataSet> drawn = data;
  vtkMapper* mapper = actor->GetMapper();
  const int port = mapper->GetInputConnection(0, 0)->GetIndex();
  const vtkSmartPointer<vtkAlgorithm> producer = mapper->GetInputAlgorithm();
  return { name, false, [=]() { mapper->SetInputDataObject(drawn); },
    [=]() { mapper->SetInputConnection(producer->GetOutputPort(port)); } };
}

Position MiddleOf(vtkCell* cell)
{
  double bounds[6];
  cell->GetBounds(bounds);
  return { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
    0.5 * (bounds[4] + bounds[5]) };
}

/** All cells but some that are close together, in front of everything. */
vtkSmartPointer<vtkDataSet> WithoutNearest(vtkDataSet* data, vtkIdType missing)
{
  std::vector<Position> middles;
  std::vector<vtkIdType> cells;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    middles.push_back(MiddleOf(data->GetCell(i)));
    cells.push_back(i);
  }
  const Position nearest = *std::max_element(middles.begin(), middles.end(),
    [](const Position& a, const Position& b)
    { return vtkMath::Dot(a.data(), Camera.data()) < vtkMath::Dot(b.data(), Camera.data()); });
  const auto isCloser = [&](vtkIdType a, vtkIdType b)
  {
    return vtkMath::Distance2BetweenPoints(middles[a].data(), nearest.data()) <
      vtkMath::Distance2BetweenPoints(middles[b].data(), nearest.data());
  };
  std::nth_element(cells.begin(), cells.begin() + missing, cells.end(), isCloser);
  std::sort(cells.begin() + missing, cells.end());
  vtkNew<vtkIdList> left;
  std::for_each(
    cells.begin() + missing, cells.end(), [&](vtkIdType cell) { left->InsertNextId(cell); });
  vtkNew<vtkExtractCells> extract;
  extract->SetInputData(data);
  extract->SetCellList(left);
  extract->Update();
  return extract->GetOutput();
}

ViewFault MissingCells(vtkActor* actor, vtkDataSet* data)
{
  // A patch of cells; of points a fifth, since some look like others behind them.
  const bool isOfPoints = data->GetCell(0)->GetCellDimension() == 0;
  const vtkIdType missing = isOfPoints ? data->GetNumberOfCells() / 5 : 24;
  return OtherData(actor, "cells are missing", WithoutNearest(data, missing));
}

ViewFault TurnedTriangles(vtkActor* actor, vtkPolyData* surface, bool andNormals)
{
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(surface);
  reverse->ReverseCellsOn();
  reverse->SetReverseNormals(andNormals);
  reverse->Update();
  return OtherData(actor, andNormals ? "inside out" : "triangles turned", reverse->GetOutput());
}

vtkSmartPointer<vtkDataSet> WithNormalsFlipped(vtkDataSet* data)
{
  auto flipped = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  flipped->DeepCopy(data);
  vtkDataArray* normals = flipped->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    double normal[3];
    normals->GetTuple(i, normal);
    normals->SetTuple3(i, -normal[0], -normal[1], -normal[2]);
  }
  return flipped;
}

ViewFault OtherPlainColour(vtkActor* actor)
{
  return { "red and blue are swapped", false,
    [=]() { actor->GetProperty()->SetColor(PlainColour[2], PlainColour[1], PlainColour[0]); },
    [=]() { actor->GetProperty()->SetColor(PlainColour[0], PlainColour[1], PlainColour[2]); } };
}

/** The places in a table of colours that a view's values use. */
std::set<vtkIdType> UsedColours(vtkMapper* mapper, vtkLookupTable* colours)
{
  int isOfCells = 0;
  vtkDataArray* values = vtkAbstractMapper::GetScalars(mapper->GetInput(), mapper->GetScalarMode(),
    mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), isOfCells);
  std::set<vtkIdType> used;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    used.insert(colours->GetIndex(values->GetTuple1(i)));
  }
  return used;
}

/** For each colour, a fault that shows the next one instead. */
void AddWrongColours(vtkMapper* mapper, std::vector<ViewFault>& faults)
{
  vtkLookupTable* colours = vtkLookupTable::SafeDownCast(mapper->GetLookupTable());
  const std::set<vtkIdType> used = UsedColours(mapper, colours);
  for (auto i = used.begin(); i != used.end(); ++i)
  {
    const vtkIdType place = *i;
    const vtkIdType next = std::next(i) == used.end() ? *used.begin() : *std::next(i);
    std::array<double, 4> right{};
    std::array<double, 4> wrong{};
    colours->GetTableValue(place, right.data());
    colours->GetTableValue(next, wrong.data());
    faults.push_back({ "colour " + std::to_string(place) + " is " + std::to_string(next), true,
      [=]() { colours->SetTableValue(place, wrong.data()); },
      [=]() { colours->SetTableValue(place, right.data()); } });
  }
}

/** Without points that no cell has: VTK 9.1's vtkExtractGeometry leaves some. */
vtkBoundingBox BoundsOfCells(vtkDataSet* data)
{
  vtkBoundingBox box;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    box.AddBounds(data->GetCell(cell)->GetBounds());
  }
  return box;
}

}

Scene::Scene(int views)
  : Views(views)
{
  this->Window->SetSize(400 * views, 400);
  this->Window->SetMultiSamples(0);
  this->Window->SetOffScreenRendering(1);
}

vtkActor* Scene::Add(vtkAlgorithmOutput* data)
{
  vtkNew<vtkRenderer> renderer;
  const double width = 1.0 / this->Views;
  const auto place = static_cast<double>(this->AllActors.size());
  renderer->SetViewport(place * width, 0.0, (place + 1.0) * width, 1.0);
  renderer->SetBackground(1.0, 1.0, 1.0);
  vtkNew<vtkDataSetMapper> mapper;
  mapper->SetInputConnection(data);
  mapper->ScalarVisibilityOff();
  mapper->Update();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(PlainColour[0], PlainColour[1], PlainColour[2]);
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->SetPosition(Camera[0], Camera[1], Camera[2]);
  renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  double bounds[6];
  BoundsOfCells(mapper->GetInput()).GetBounds(bounds);
  renderer->ResetCamera(bounds);
  renderer->GetActiveCamera()->Zoom(1.1);
  this->Window->AddRenderer(renderer);
  this->AllActors.emplace_back(actor);
  return actor;
}

vtkSmartPointer<vtkImageData> Scene::Draw() const
{
  this->Window->Render();
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(this->Window);
  picture->ReadFrontBufferOff();
  picture->ShouldRerenderOff();
  picture->Update();
  return picture->GetOutput();
}

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

vtkSmartPointer<vtkImageData> Baseline(const std::string& name)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((std::string(BASELINE_FOLDER) + "/" + name + ".png").c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkImageData> Difference(vtkImageData* picture, vtkImageData* other)
{
  auto difference = vtkSmartPointer<vtkImageData>::New();
  const int* size = picture->GetDimensions();
  difference->SetDimensions(size);
  difference->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* result = static_cast<unsigned char*>(difference->GetScalarPointer());
  const bool haveSameSize = HaveSameSize(picture, other);
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      const int i = y * size[0] + x;
      result[i] = haveSameSize && IsAround(PixelsOf(picture)[i], other, x, y) ? 0 : 255;
    }
  }
  return difference;
}

bool AreLike(vtkImageData* a, vtkImageData* b)
{
  for (const auto& difference : { Difference(a, b), Difference(b, a) })
  {
    const auto* first = static_cast<unsigned char*>(difference->GetScalarPointer());
    const auto different = std::count(first, first + difference->GetNumberOfPoints(), 255);
    if (different > MostDifferent || CountSquares(difference) > MostSquares)
    {
      return false;
    }
  }
  return true;
}

int CountChanged(vtkImageData* a, vtkImageData* b)
{
  int changed = 0;
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    changed += AreLikeColours(PixelsOf(a)[i], PixelsOf(b)[i]) ? 0 : 1;
  }
  return changed;
}

void Write(vtkImageData* picture, const std::string& file)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(picture);
  writer->SetFileName(file.c_str());
  writer->Write();
}

std::vector<ViewFault> FaultsOf(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  mapper->Update();
  vtkDataSet* data = mapper->GetInputAsDataSet();
  std::vector<ViewFault> faults = { MissingCells(actor, data) };
  vtkProperty* property = actor->GetProperty();
  if (data->GetPointData()->GetNormals() != nullptr)
  {
    faults.push_back(OtherData(actor, "normals flipped", WithNormalsFlipped(data)));
  }
  vtkPolyData* surface = vtkPolyData::SafeDownCast(data);
  if (surface != nullptr && property->GetBackfaceCulling())
  {
    faults.push_back(TurnedTriangles(actor, surface, false));
    faults.push_back(TurnedTriangles(actor, surface, true));
  }
  if (mapper->GetScalarVisibility())
  {
    AddWrongColours(mapper, faults);
  }
  else
  {
    faults.push_back(OtherPlainColour(actor));
  }
  if (property->GetEdgeVisibility())
  {
    faults.push_back({ "no edges", false, [=]() { property->EdgeVisibilityOff(); },
      [=]() { property->EdgeVisibilityOn(); } });
  }
  return faults;
}

ViewFault NoFaultOf(vtkActor* actor)
{
  return OtherData(actor, "none", WithoutNearest(actor->GetMapper()->GetInputAsDataSet(), 0));
}

}
