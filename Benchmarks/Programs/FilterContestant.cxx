// SPDX-License-Identifier: BSD-3-Clause
#include "FilterContestant.h"

#include "vtkDataObject.h"
#include "vtkPointSet.h"

namespace benchmark
{

void DescribeMesh(vtkAlgorithm* filter, Figures& figures)
{
  vtkPointSet* mesh = vtkPointSet::SafeDownCast(filter->GetOutputDataObject(0));
  figures.Set("cells", mesh->GetNumberOfCells());
  figures.Set("points", mesh->GetNumberOfPoints());
  figures.Set("output bytes", 1024.0 * mesh->GetActualMemorySize());
}

Contestant FilterContestant(
  const std::string& name, const std::vector<vtkSmartPointer<vtkAlgorithm>>& filters)
{
  Contestant contestant;
  contestant.Name = name;
  contestant.Run = [filters]
  {
    filters.front()->Modified();
    filters.back()->Update();
  };
  contestant.Describe = [filters](Figures& figures) { DescribeMesh(filters.back(), figures); };
  contestant.Release = [filters]
  {
    for (const vtkSmartPointer<vtkAlgorithm>& filter : filters)
    {
      filter->GetOutputDataObject(0)->Initialize();
    }
  };
  return contestant;
}

}
