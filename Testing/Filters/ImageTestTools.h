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

/** Pictures that are compared with baselines, and faults to see that the comparison notices. */
namespace test
{

/** A window of viewports side by side, each with one view of what a filter gives. */
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

/** Draws in colours for the whole numbers from 0 to count - 1 of an array. */
void ColourBy(vtkActor* actor, const char* array, int count);

/** The picture of this name in Data/Baseline. */
vtkSmartPointer<vtkImageData> Baseline(const std::string& name);

/** The pixels of a picture that are not as in another one: 255, and 0 elsewhere.
 *
 *  A pixel is as in the other one if that has its colour there or in a pixel beside it, since
 *  drivers do not agree on where a line is. Colours are the same if no part of them differs by more
 *  than a tenth. vtkTesting's comparison is of no use here: it takes two colours for the same that
 *  differ by 105 of 255 in each part. */
vtkSmartPointer<vtkImageData> Difference(vtkImageData* picture, vtkImageData* other);

/** Whether each of two pictures is as the other one, but for some pixels of thin lines. */
bool AreLike(vtkImageData* a, vtkImageData* b);

/** The number of pixels that have another colour, in pictures of the same driver. */
int CountChanged(vtkImageData* a, vtkImageData* b);

/** Writes a picture to a file. */
void Write(vtkImageData* picture, const std::string& file);

/** Something wrong with one view that can be put right again. */
struct ViewFault
{
  std::string Name;
  bool MayBeHidden = false; ///< of what may be behind something else
  std::function<void()> Plant;
  std::function<void()> Undo;
};

/** All faults that make sense for what a view shows. */
std::vector<ViewFault> FaultsOf(vtkActor* actor);

/** No fault, planted in the same way. */
ViewFault NoFaultOf(vtkActor* actor);

}

#endif
