// SPDX-License-Identifier: BSD-3-Clause
#ifndef EncodingBytes_h
#define EncodingBytes_h

#include "Hierarchy/IsodiamondHierarchy.h"
#include "Hierarchy/ScalarHierarchy.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/**
 * Hierarchies as rows of bytes for the fuzzer: any bytes are some hierarchy, mostly a damaged one.
 * Numbers that are missing at the end are 0, and arrays are only as long as the bytes left.
 */
namespace fuzz
{

/** The arrays that a hierarchy of any model is made of. */
struct Arrays
{
  /** An RI or MI; of an HD only dimensions, region and scale count. */
  isodiamond::Encoding Isodiamonds;
  std::vector<std::uint16_t> Errors; ///< of an HD, like those below
  isodiamond::AnyValues Samples;
  isodiamond::AnyValues Minima;
  isodiamond::AnyValues Maxima;
  /** What to ask of it. */
  double Tolerance = 0.0;
  double InteriorTolerance = 0.0;
  std::array<double, 6> Region{};
};

/** @throws std::invalid_argument where no region can have such an isorange */
Arrays Read(const std::uint8_t* data, std::size_t size);
std::vector<std::uint8_t> Write(const Arrays& arrays);

}

#endif
