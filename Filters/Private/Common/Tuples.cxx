// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Common/Tuples.h"

#include "Private/Common/Arrays.h"

#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkPoints.h"

#include <algorithm>

namespace vtkIsodiamond
{
namespace
{

vtkSmartPointer<vtkDataArray> TuplesOf(vtkDataArray* array, const std::vector<vtkIdType>& ids)
{
  const vtkSmartPointer<vtkDataArray> all = InRow(array);
  vtkSmartPointer<vtkDataArray> some = NewLike(array, static_cast<vtkIdType>(ids.size()));
  const vtkIdType bytes = vtkIdType{ array->GetNumberOfComponents() } * array->GetDataTypeSize();
  const char* from = static_cast<const char*>(all->GetVoidPointer(0));
  char* to = static_cast<char*>(some->GetVoidPointer(0));
  for (const vtkIdType id : ids)
  {
    to = std::copy_n(from + id * bytes, bytes, to);
  }
  return some;
}

}

vtkSmartPointer<vtkPoints> PointsOf(vtkPoints* points, const std::vector<vtkIdType>& ids)
{
  auto some = vtkSmartPointer<vtkPoints>::New();
  some->SetData(TuplesOf(points->GetData(), ids));
  return some;
}

void KeepTuples(vtkDataSetAttributes* data, const std::vector<vtkIdType>& ids)
{
  vtkNew<vtkDataSetAttributes> some;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    const int added = some->AddArray(TuplesOf(data->GetArray(i), ids));
    if (const int attribute = data->IsArrayAnAttribute(i); attribute >= 0)
    {
      some->SetActiveAttribute(added, attribute);
    }
  }
  data->ShallowCopy(some);
}

}
