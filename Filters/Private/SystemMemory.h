// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_SystemMemory_h
#define vtkIsodiamond_SystemMemory_h

#include <cstddef>

namespace vtkIsodiamond
{

/** Tells the system that all of some fresh memory is going to be used. Where it has large pages it
 *  hands out these then: zeroing memory page by page takes longer than a mesh in it. */
void PreferLargePages(void* memory, std::size_t bytes);

/** Gives back to the system what has been freed: after a build that is as much as is left of it. */
void ReturnFreeMemory();

}

#endif
