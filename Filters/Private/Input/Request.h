// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Request_h
#define vtkIsodiamond_Request_h

#include "Build/StagedBuild.h"
#include "Field/Peers.h"

#include "vtkSmartPointer.h"

#include <array>

class vtkImageData;
class vtkInformation;

/**
 * @file Request.h
 * Slabs of an image, some slices each, as extents that a pipeline is asked for.
 */
namespace vtkIsodiamond
{

using Slices = isodiamond::StreamedBuild::Slices;

/** Whether upstream can make a part of its whole extent: the Wavelet source, readers of raw files,
 *  .vti and .pvti, for instance. */
bool MakesParts(vtkInformation* input);

///@{
/** Whether upstream reads a file only if all processes read their parts of it at the same time, as
 *  ParaView's readers of raw and NRRD files do. */
bool ReadsTogether(vtkInformation* input);

/** Whether upstream makes arrays at points from those of cells, as ParaView does on request: at the
 *  end of a part these differ from those of the whole. */
bool ConvertsCells(vtkInformation* input);

/** The whole extent, and its number of samples on each axis. */
std::array<int, 6> WholeExtentOf(vtkInformation* input);
std::array<int, 3> WholeDimensionsOf(vtkInformation* input);
///@}

/** Whether an input, which may be null, is an image of which the whole is known. */
bool HasWholeImage(vtkInformation* input);

/** The whole image of which an input is a slab, without its arrays. */
vtkSmartPointer<vtkImageData> WholeImage(vtkInformation* input);

/** A slab without the slices that it shares with others. */
Slices Alone(Slices slices);

/** Which of the peers has a slab. */
int OwnerOf(int slab, int count, const isodiamond::Peers& peers);

/** The slab that upstream gave last, or the first one that a peer has.
 *  @param count of slabs @param peers null if there are none */
Slices SlabAtHand(vtkInformation* input, int count, const isodiamond::Peers* peers);

/** Asks for the whole input: a part of a volume has another hierarchy, and a part of a hierarchy
 *  has no mesh. */
void RequestWhole(vtkInformation* inputInformation);

/** Asks upstream for a slab, to be given at its next update. */
void RequestSlab(vtkInformation* input, const Slices& slices);

/** Asks upstream for the part of the image that ParaView's own filters want in a process.
 *  @return whether there is a part for each of the processes: if not, the request is as it was */
bool RequestPart(vtkInformation* input, const isodiamond::Peers& peers);

///@{
/** Whether upstream has given what it was asked for; and more than all that it said it has, as
 *  where time steps have extents of their own. */
bool IsGiven(vtkInformation* input);
bool IsBeyondWhole(vtkInformation* input);
///@}

}

#endif
