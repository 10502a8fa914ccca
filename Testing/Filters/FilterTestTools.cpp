// SPDX-License-Identifier: BSD-3-Clause
#include "FilterTestTools.h"

#include "vtkAlgorithm.h"
#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFeatureEdges.h"
#include "vtkFloatArray.h"
#include "vtkImplicitPolyDataDistance.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>

namespace test
{

vtkSmartPointer<vtkImageData> MakeImage(
  const std::array<int, 3>& dims, const std::function<double(double, double, double)>& function)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(dims.data());
  vtkNew<vtkFloatArray> density;
  density->SetName("density");
  for (int z = 0; z < dims[2]; ++z)
  {
    for (int y = 0; y < dims[1]; ++y)
    {
      for (int x = 0; x < dims[0]; ++x)
      {
        density->InsertNextValue(static_cast<float>(function(x, y, z)));
      }
    }
  }
  image->GetPointData()->SetScalars(density);
  return image;
}

vtkSmartPointer<vtkImageData> BallImage(const std::array<int, 3>& dims)
{
  return MakeImage(dims,
    [&](double x, double y, double z)
    {
      const double u = 2.0 * x / (dims[0] - 1) - 1.0;
      const double v = 2.0 * y / (dims[1] - 1) - 1.0;
      const double w = 2.0 * z / (dims[2] - 1) - 1.0;
      return 0.71 - std::sqrt(u * u + v * v + w * w) +
        0.07 * std::sin(7.0 * u) * std::sin(6.0 * v) * std::cos(5.0 * w);
    });
}

vtkSmartPointer<vtkImageData> PhantomImage(const std::array<int, 3>& dims, double noise)
{
  std::mt19937 random(2010);
  std::normal_distribution<double> normal(0.0, 1.0);
  const double size = dims[0] - 1;
  return MakeImage(dims,
    [&](double x, double y, double z)
    {
      // Signed distances in voxels, negative inside: a block, less two bores and a slot.
      const auto box = [&](double cx, double cy, double cz, double rx, double ry, double rz)
      {
        return std::max({ std::fabs(x - cx * size) - rx * size,
          std::fabs(y - cy * size) - ry * size, std::fabs(z - cz * size) - rz * size });
      };
      const auto bore = [&](double a, double b, double ca, double cb, double r)
      { return std::hypot(a - ca * size, b - cb * size) - r * size; };
      const double part =
        std::max({ box(0.5, 0.5, 0.5, 0.36, 0.3, 0.33), -bore(x, z, 0.35, 0.5, 0.13),
          -bore(y, z, 0.5, 0.62, 0.09), -box(0.72, 0.5, 0.4, 0.03, 0.2, 0.4) });
      return 100.0 / (1.0 + std::exp(2.0 * part)) + noise * normal(random);
    });
}

vtkSmartPointer<vtkImageData> SampleVolume(const char* name, const std::array<int, 3>& dims)
{
  const char* folder = std::getenv("ISODIAMONDS_DATA_DIR");
  vtkNew<vtkUnsignedCharArray> values;
  values->SetName("density");
  values->SetNumberOfValues(vtkIdType{ 1 } * dims[0] * dims[1] * dims[2]);
  std::ifstream file(std::string(folder ? folder : "") + "/" + name, std::ios::binary);
  if (!folder ||
    !file.read(reinterpret_cast<char*>(values->GetPointer(0)), values->GetNumberOfValues()))
  {
    return nullptr;
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(dims.data());
  image->GetPointData()->SetScalars(values);
  return image;
}

void Messages::Execute(vtkObject*, unsigned long event, void* data)
{
  const char* text = static_cast<const char*>(data);
  if (event == vtkCommand::ErrorEvent)
  {
    this->Errors += text;
    ++this->ErrorCount;
  }
  else if (event == vtkCommand::WarningEvent)
  {
    this->Warnings += text;
    ++this->WarningCount;
  }
}

vtkSmartPointer<Messages> Watch(vtkAlgorithm* algorithm)
{
  auto messages = vtkSmartPointer<Messages>::New();
  algorithm->AddObserver(vtkCommand::ErrorEvent, messages);
  algorithm->AddObserver(vtkCommand::WarningEvent, messages);
  return messages;
}

namespace
{

template <typename Body>
void ForEachTriangle(vtkPointSet* mesh, Body&& body)
{
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkIdList* ids = mesh->GetCell(i)->GetPointIds();
    std::array<std::array<double, 3>, 3> corners{};
    for (int j = 0; j < 3; ++j)
    {
      mesh->GetPoint(ids->GetId(j), corners[j].data());
    }
    body(corners);
  }
}

}

double SixVolume(vtkPointSet* mesh)
{
  double sum = 0.0;
  ForEachTriangle(mesh,
    [&](const std::array<std::array<double, 3>, 3>& t)
    { sum += vtkMath::Determinant3x3(t[0].data(), t[1].data(), t[2].data()); });
  return sum;
}

double Area(vtkPointSet* mesh)
{
  double sum = 0.0;
  ForEachTriangle(mesh,
    [&](const std::array<std::array<double, 3>, 3>& t)
    {
      double a[3];
      double b[3];
      double normal[3];
      vtkMath::Subtract(t[1].data(), t[0].data(), a);
      vtkMath::Subtract(t[2].data(), t[0].data(), b);
      vtkMath::Cross(a, b, normal);
      sum += 0.5 * vtkMath::Norm(normal);
    });
  return sum;
}

Triangles SortedTriangles(vtkPointSet* mesh)
{
  Triangles triangles;
  ForEachTriangle(mesh,
    [&](std::array<std::array<double, 3>, 3> t)
    {
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      triangles.push_back(t);
    });
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

vtkSmartPointer<vtkRectilinearGrid> Rectilinear(
  vtkImageData* image, const std::function<double(int, int)>& place)
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  const int* dims = image->GetDimensions();
  grid->SetDimensions(dims);
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkNew<vtkDoubleArray> coordinates;
    for (int i = 0; i < dims[axis]; ++i)
    {
      coordinates->InsertNextValue(place(axis, i));
    }
    (axis == 0      ? grid->SetXCoordinates(coordinates)
        : axis == 1 ? grid->SetYCoordinates(coordinates)
                    : grid->SetZCoordinates(coordinates));
  }
  grid->GetPointData()->ShallowCopy(image->GetPointData());
  return grid;
}

vtkSmartPointer<vtkStructuredGrid> Structured(
  vtkImageData* image, const std::function<std::array<double, 3>(double, double, double)>& place)
{
  const auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  const int* dims = image->GetDimensions();
  grid->SetDimensions(dims);
  vtkNew<vtkPoints> points;
  for (int z = 0; z < dims[2]; ++z)
  {
    for (int y = 0; y < dims[1]; ++y)
    {
      for (int x = 0; x < dims[0]; ++x)
      {
        points->InsertNextPoint(place(x, y, z).data());
      }
    }
  }
  grid->SetPoints(points);
  grid->GetPointData()->ShallowCopy(image->GetPointData());
  return grid;
}

std::array<double, 3> BentPlace(double x, double y, double z)
{
  const double angle = 0.05 * x;
  return { (10 + 0.5 * y) * std::sin(angle), (10 + 0.5 * y) * std::cos(angle), 0.7 * z + 0.1 * x };
}

double UnevenPlace(int axis, int index)
{
  if (axis == 0)
  {
    return 0.4 * (std::pow(1.06, index) - 1.0) / 0.06;
  }
  if (axis == 1)
  {
    return 10.0 - 0.5 * index - 0.03 * index * index;
  }
  const int triple = index / 3;
  const std::array<double, 3> inTriple = { 0.0, 0.4, 1.6 };
  return 4.8 * triple + inTriple[index % 3] - 7.0;
}

double LargestDistance(vtkPolyData* from, vtkPolyData* to)
{
  vtkNew<vtkImplicitPolyDataDistance> distance;
  distance->SetInput(to);
  double largest = 0.0;
  for (vtkIdType i = 0; i < from->GetNumberOfPoints(); ++i)
  {
    largest = std::max(largest, std::fabs(distance->EvaluateFunction(from->GetPoint(i))));
  }
  return largest;
}

namespace
{

bool AreEqual(vtkAbstractArray* a, vtkAbstractArray* b)
{
  if (!a || !b)
  {
    return a == b;
  }
  if (a->GetDataType() != b->GetDataType() || a->GetNumberOfValues() != b->GetNumberOfValues() ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents())
  {
    return false;
  }
  if (!vtkDataArray::SafeDownCast(a))
  {
    return a->GetNumberOfValues() == 0 || a->GetVariantValue(0) == b->GetVariantValue(0);
  }
  const std::size_t bytes = static_cast<std::size_t>(a->GetNumberOfValues()) * a->GetDataTypeSize();
  return bytes == 0 || std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0), bytes) == 0;
}

bool AreEqual(vtkCellArray* a, vtkCellArray* b)
{
  return a->GetNumberOfCells() == b->GetNumberOfCells() &&
    (a->GetNumberOfCells() == 0 ||
      (AreEqual(a->GetOffsetsArray(), b->GetOffsetsArray()) &&
        AreEqual(a->GetConnectivityArray(), b->GetConnectivityArray())));
}

bool HaveEqualCells(vtkDataSet* a, vtkDataSet* b)
{
  vtkPolyData* polyData = vtkPolyData::SafeDownCast(a);
  vtkPolyData* otherPolyData = vtkPolyData::SafeDownCast(b);
  if (polyData && otherPolyData)
  {
    return AreEqual(polyData->GetPolys(), otherPolyData->GetPolys()) &&
      AreEqual(polyData->GetVerts(), otherPolyData->GetVerts()) &&
      AreEqual(polyData->GetLines(), otherPolyData->GetLines());
  }
  vtkUnstructuredGrid* grid = vtkUnstructuredGrid::SafeDownCast(a);
  vtkUnstructuredGrid* otherGrid = vtkUnstructuredGrid::SafeDownCast(b);
  if (!grid || !otherGrid || grid->GetNumberOfCells() == 0)
  {
    return grid && otherGrid && otherGrid->GetNumberOfCells() == 0;
  }
  return AreEqual(grid->GetCells(), otherGrid->GetCells()) &&
    AreEqual(grid->GetCellTypesArray(), otherGrid->GetCellTypesArray());
}

std::string DifferentArray(vtkFieldData* a, vtkFieldData* b)
{
  if (a->GetNumberOfArrays() != b->GetNumberOfArrays())
  {
    return "numbers of arrays ";
  }
  for (int i = 0; i < a->GetNumberOfArrays(); ++i)
  {
    const char* name = a->GetArrayName(i);
    if (!AreEqual(a->GetAbstractArray(i), b->GetAbstractArray(name)))
    {
      return std::string("array ") + name + " ";
    }
  }
  return {};
}

}

std::string Difference(vtkDataSet* a, vtkDataSet* b)
{
  vtkPointSet* pointsA = vtkPointSet::SafeDownCast(a);
  vtkPointSet* pointsB = vtkPointSet::SafeDownCast(b);
  if (!pointsA || !pointsB || a->GetDataObjectType() != b->GetDataObjectType())
  {
    return "types of data ";
  }
  std::string difference;
  if (a->GetNumberOfPoints() != b->GetNumberOfPoints() ||
    (a->GetNumberOfPoints() > 0 &&
      !AreEqual(pointsA->GetPoints()->GetData(), pointsB->GetPoints()->GetData())))
  {
    difference += "points ";
  }
  if (!HaveEqualCells(a, b))
  {
    difference += "cells ";
  }
  return difference + DifferentArray(a->GetPointData(), b->GetPointData()) +
    DifferentArray(a->GetCellData(), b->GetCellData()) +
    DifferentArray(a->GetFieldData(), b->GetFieldData());
}

vtkIdType BoundaryEdges(vtkPolyData* mesh)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(mesh);
  edges->BoundaryEdgesOn();
  edges->NonManifoldEdgesOn();
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells();
}

}
