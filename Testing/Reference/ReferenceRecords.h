// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceRecords_h
#define ReferenceRecords_h

#include "ReferenceMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace reference
{

/** One isodiamond in the paper's encoding: twelve bytes. */
struct Record
{
  std::array<std::uint16_t, 3> Center;
  /** Bits 0 to 13: the error code. From bit 14: the central vertex's sign, 0 without a sample. */
  std::uint16_t SignAndError;
  /** The index of the first isovertex that the diamond owns, or would own. */
  std::uint32_t FirstIsovertex;

  int Sign() const { return this->SignAndError >> 14; }
  int ErrorCode() const { return this->SignAndError & 0x3fff; }
};

static_assert(sizeof(Record) == 12, "the paper's records take twelve bytes");

/** The relevant isodiamond hierarchy RI and the minimal isodiamond hierarchy MI. */
enum class Model
{
  Relevant,
  Minimal
};

/** A hierarchy in the paper's encoding. Records are sorted by depth, then in grid order. */
struct Encoding
{
  /** Bit x + 2y + 4z is the sign of a corner of the base cube, 0 without a sample. */
  std::uint16_t BaseSigns = 0;
  std::vector<Record> Active;
  std::vector<Record> Creation;
  /** Relevant diamonds other than creation diamonds; none in MI. */
  std::vector<Record> Relevant;
  /** The coefficients, first of the active, then of the creation diamonds. The base cube's own
   * edges are not among them. */
  std::vector<std::uint8_t> Isovertices;

  /** 2 + 12 (m_a + m_r) + v_i bytes for RI, 2 + 12 (m_a + m_c) + v_i for MI. */
  std::size_t Bytes() const;
};

/**
 * The isovertices that a diamond owns, those on its subdivision edges: from the central vertex to
 * each of its vertices, in the vertices' grid order, if both ends are sampled and their signs
 * differ.
 */
std::vector<Isovertex> OwnIsovertices(
  const Hierarchy& hierarchy, const ScalarField& field, double isovalue, int diamond);

/** The isovertices on the base cube's own edges. */
std::vector<Isovertex> BaseIsovertices(
  const Hierarchy& hierarchy, const ScalarField& field, double isovalue);

/** @param errorCodes a code of at most 14 bits for every diamond. */
Encoding Encode(const Hierarchy& hierarchy, const ScalarField& field, double isovalue,
  const std::vector<Kind>& kinds, const std::vector<std::uint16_t>& errorCodes, Model model);

}

#endif
