// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Assembly_h
#define isodiamond_Assembly_h

#include "Field/PeerPortion.h"
#include "Hierarchy/IsodiamondHierarchy.h"

namespace isodiamond
{

/**
 * Puts a hierarchy together from the peers' portions: each gives what it owns, and in the end all
 * have the whole. To be called by all of them.
 *
 * @param portion that this process has
 * @param own the encoding of its portion, an RI; hierarchy was made from it
 * @param kept the diamonds that are to be in the whole: all, or those of an MI
 */
Encoding Assemble(const PeerPortion& portion, Encoding own, const IsodiamondHierarchy& hierarchy,
  const DiamondSet& kept);

}

#endif
