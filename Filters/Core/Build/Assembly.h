// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Assembly_h
#define isodiamond_Assembly_h

#include "Field/PeerPortion.h"
#include "Hierarchy/IsodiamondHierarchy.h"

namespace isodiamond
{

/**
 * Puts a hierarchy together of the portions that peers have of it: each gives what it owns, and all
 * of them have the whole in the end. By all of them.
 *
 * @param portion that this process has
 * @param own the encoding of its portion, an RI, and the hierarchy that was made of it
 * @param kept the diamonds that are to be in the whole: all, or those of an MI
 */
Encoding Assemble(const PeerPortion& portion, Encoding own, const IsodiamondHierarchy& hierarchy,
  const DiamondSet& kept);

}

#endif
