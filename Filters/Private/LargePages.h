// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_LargePages_h
#define vtkIsodiamond_LargePages_h

#include <cstddef>

namespace vtkIsodiamond
{

/** Tells the system that all of some fresh memory is going to be used. Where it has large pages it
 *  hands out these then: zeroing memory page by page takes longer than a mesh in it. */
void PreferLargePages(void* memory, std::size_t bytes);

}

#endif
