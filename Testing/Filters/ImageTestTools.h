// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageTestTools_h
#define ImageTestTools_h

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkActor;
class vtkAlgorithmOutput;

/** Pictures to compare with baselines, and faults that the comparison has to notice. */
namespace test
{

/** A window of viewports side by side, each with one view of a filter's output. */
class Scene
{
public:
  explicit Scene(int views);

  vtkActor* Add(vtkAlgorithmOutput* data);

  /** One for each view. */
  const std::vector<vtkSmartPointer<vtkActor>>& Actors() const { return this->AllActors; }

  vtkSmartPointer<vtkImageData> Draw() const;

private:
  vtkNew<vtkRenderWindow> Window;
  int Views;
  std::vector<vtkSmartPointer<vtkActor>> AllActors;
};

/** Colours an actor by an array of whole numbers from 0 to count - 1. */
void ColourBy(vtkActor* actor, const char* array, int count);

/** The picture of this name in Data/Baseline. */
vtkSmartPointer<vtkImageData> Baseline(const std::string& name);

/** 255 for the pixels of a picture that differ from another picture, 0 elsewhere.
 *
 *  A pixel differs unless the other picture has its colour there or in a pixel next to that, since
 *  drivers do not agree on where a line is. Colours differ if one of their components does by more
 *  than a tenth. vtkTesting's comparison is of no use here: it treats colours as the same even if
 *  they differ by 105 of 255 in each component. */
vtkSmartPointer<vtkImageData> Difference(vtkImageData* picture, vtkImageData* other);

/** Whether neither of two pictures differs from the other, except in some pixels of thin lines. */
bool AreLike(vtkImageData* a, vtkImageData* b);

/** The number of pixels whose colours differ between two pictures by the same driver. */
int CountChanged(vtkImageData* a, vtkImageData* b);

/** Writes a picture to a file. */
void Write(vtkImageData* picture, const std::string& file);

/** Something wrong with one view that can be put right again. */
struct ViewFault
{
  std::string Name;
  bool MayBeHidden = false; ///< what it changes may be behind something else
  std::function<void()> Plant;
  std::function<void()> Undo;
};

/** All faults that make sense for what a view shows. */
std::vector<ViewFault> FaultsOf(vtkActor* actor);

/** No fault, planted in the same way. */
ViewFault NoFaultOf(vtkActor* actor);

}

#endif
