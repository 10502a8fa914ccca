// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IntervalCases_h
#define isodiamond_IntervalCases_h

#include "Hierarchy/IsodiamondHierarchy.h"
#include "Lattice/HalfTetrahedronMasks.h"
#include "Patches/IntervalPatches.h"

#include <array>
#include <cstdint>

namespace isodiamond
{

/** The case of an interval volume in a half-tetrahedron of the diamond with a given rank. */
inline int IntervalCase(
  const IsodiamondHierarchy& hierarchy, std::uint32_t rank, const HalfTetrahedron& half)
{
  // The outer vertices' signs follow from the centre's and the crossings on the way to them.
  const int centre = hierarchy.Sign(rank);
  const std::uint32_t lower = hierarchy.Edges(rank);
  const std::uint32_t upper = hierarchy.UpperEdges(rank);
  PatchSigns signs{ centre, 0, 0, 0 };
  for (int i = 0; i < 3; ++i)
  {
    const int edge = half.Vertices[half.ByAge[i]];
    const int crossesLower = static_cast<int>((lower >> edge) & 1U);
    const int crossesUpper = static_cast<int>((upper >> edge) & 1U);
    const int change =
      (centre > 0 ? -crossesLower : crossesLower) + (centre > 1 ? -crossesUpper : crossesUpper);
    signs[i + 1] = centre + change;
  }
  return PatchCase(signs);
}

/** The same for all half-tetrahedra of a diamond at once, in the words of HalfTetrahedronMasks.h.
 */
class IntervalCases
{
public:
  IntervalCases(const IsodiamondHierarchy& hierarchy, std::uint32_t rank, int type)
    : Centre(hierarchy.Sign(rank))
  {
    // Vertices' signs follow from the centre's and the crossings on the way to them.
    const std::uint32_t lower = hierarchy.Edges(rank);
    const std::uint32_t upper = hierarchy.UpperEdges(rank);
    const VertexMasks& masks = tables::MasksByAge[type];
    this->AboveLower = masks(this->Centre > 0 ? ~lower : lower);
    this->AboveUpper = masks(this->Centre > 1 ? ~upper : upper);
  }

  /** @param half index of the half-tetrahedron */
  int operator()(int half) const
  {
    return this->Centre + CaseOfVertices[(this->AboveLower >> (4 * half)) & 7U] +
      CaseOfVertices[(this->AboveUpper >> (4 * half)) & 7U];
  }

private:
  /** What the outer vertices above one surface, as a mask by age, add to the case. */
  static constexpr std::array<std::int8_t, 8> CaseOfVertices = { 0, PatchCase({ 0, 1, 0, 0 }),
    PatchCase({ 0, 0, 1, 0 }), PatchCase({ 0, 1, 1, 0 }), PatchCase({ 0, 0, 0, 1 }),
    PatchCase({ 0, 1, 0, 1 }), PatchCase({ 0, 0, 1, 1 }), PatchCase({ 0, 1, 1, 1 }) };

  int Centre;
  HalfTetrahedronMask AboveLower = 0; ///< the vertices above the lower surface, by age
  HalfTetrahedronMask AboveUpper = 0;
};

}

#endif
