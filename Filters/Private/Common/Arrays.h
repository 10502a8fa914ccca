// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Arrays_h
#define vtkIsodiamond_Arrays_h

#include "Field/SystemMemory.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

/**
 * @file Arrays.h
 * Memory for VTK's arrays, with std::bad_alloc where there is none.
 *
 * An array that cannot allocate ends the program if VTK was built without NDEBUG, as Debian's is.
 * So arrays that can be large are allocated here.
 */
namespace vtkIsodiamond
{

/** Sets the number of tuples of an array with standard memory layout; their values are arbitrary.
 *  @throws std::bad_alloc */
inline void AllocateTuples(vtkDataArray* array, vtkIdType count)
{
  const vtkIdType values = count * array->GetNumberOfComponents();
  if (values <= 0)
  {
    array->SetNumberOfTuples(0);
    return;
  }
  const std::size_t bytes = static_cast<std::size_t>(values) * array->GetDataTypeSize();
  void* memory = std::malloc(bytes);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  isodiamond::PreferLargePages(memory, bytes);
  array->SetVoidArray(memory, values, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
}

/** A named array; its values are arbitrary. @throws std::bad_alloc */
template <typename Array>
vtkSmartPointer<Array> NewArray(const char* name, vtkIdType count, int components = 1)
{
  vtkSmartPointer<Array> array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  AllocateTuples(array, count);
  return array;
}

/** An array with the type, components and name of another; its values are in a row, and arbitrary.
 *  @throws std::bad_alloc */
inline vtkSmartPointer<vtkDataArray> NewLike(vtkDataArray* other, vtkIdType count)
{
  auto array =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(other->GetDataType()));
  array->SetName(other->GetName());
  array->SetNumberOfComponents(other->GetNumberOfComponents());
  AllocateTuples(array, count);
  return array;
}

/** Adds a number to field data, for users who look at them. */
template <typename Array>
void AddNumber(vtkFieldData* fieldData, const char* name, typename Array::ValueType number)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->InsertNextValue(number);
  fieldData->AddArray(array);
}

/**
 * The array, if its values are in a row as vtkAOSDataArrayTemplate has them, or else (structures of
 * arrays, implicit arrays) a copy in a row, of as many bytes as the values take.
 *
 * @throws std::bad_alloc
 */
inline vtkSmartPointer<vtkDataArray> InRow(vtkDataArray* array)
{
  if (array->HasStandardMemoryLayout())
  {
    return array;
  }
  auto copy =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(array->GetDataType()));
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  AllocateTuples(copy, array->GetNumberOfTuples());
  copy->DeepCopy(array);
  return copy;
}

}

#endif
