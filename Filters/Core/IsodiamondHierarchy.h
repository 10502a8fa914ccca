// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IsodiamondHierarchy_h
#define isodiamond_IsodiamondHierarchy_h

#include "DiamondSet.h"
#include "ErrorCode.h"
#include "Parallel.h"

#include <cstdint>
#include <vector>

/**
 * @file IsodiamondHierarchy.h
 * The relevant (RI) and the minimal (MI) isodiamond hierarchy of one isosurface.
 *
 * There are two forms. The *encoding* is what is kept and saved: flat arrays of bricks, 2-byte
 * records and 1-byte isovertices. The *hierarchy* is a view of an encoding with what queries want
 * at hand, derived from it and checked: the rank of every brick and, for each isodiamond, the
 * mask of its active subdivision edges. Coordinates, edges, vertex signs and kinds are nowhere
 * stored: bits and records imply them.
 *
 * Weiss & De Floriani, TVCG 2010, sections 5 to 7.
 */
namespace isodiamond
{

/** Which of the three hierarchies. */
enum class Model : int
{
  HierarchyOfDiamonds = 0, ///< HD: all diamonds of the scalar field, any isovalue
  Relevant = 1,            ///< RI: active, creation and relevant isodiamonds
  Minimal = 2              ///< MI: active and creation isodiamonds
};

/** The kind of an isodiamond (paper, sections 4 and 7). */
enum class Kind : int
{
  Active = 0,
  Creation = 1,
  Relevant = 2
};

/** A read-only view of an array. */
template <typename T>
struct ArrayView
{
  const T* Data = nullptr;
  std::int64_t Size = 0;

  ArrayView() = default;
  ArrayView(const T* data, std::int64_t size)
    : Data(data)
    , Size(size)
  {
  }
  ArrayView(const std::vector<T>& values) // NOLINT(google-explicit-constructor): it is a view
    : Data(values.data())
    , Size(static_cast<std::int64_t>(values.size()))
  {
  }

  const T& operator[](std::int64_t i) const { return this->Data[i]; }
};

/** 14 bits of error code and 2 bits of sign. */
struct Record
{
  static std::uint16_t Pack(ErrorCode::Type code, int sign)
  {
    return static_cast<std::uint16_t>((code << 2) | (sign & 3));
  }
  static ErrorCode::Type Code(std::uint16_t record)
  {
    return static_cast<ErrorCode::Type>(record >> 2);
  }
  static int Sign(std::uint16_t record) { return record & 3; }
};

/** What describes an encoding besides its arrays. */
struct EncodingHeader
{
  Model Kind = Model::Minimal;
  std::array<int, 3> Dimensions = { 2, 2, 2 };
  double Isovalue = 0.0;
  double ErrorScale = 1.0; ///< of ErrorCode
  /** m_r: the relevant isodiamonds that there are, creation ones included, stored or not. */
  std::int64_t RelevantCount = 0;
};

/**
 * The arrays of an encoding. Scales run from N, the base cube's corners, down to 0; bricks of a
 * scale by their index in its box; diamonds by bit; isovertices by diamond and edge.
 */
template <template <typename> class Array>
struct EncodingArrays
{
  Array<std::uint32_t> BrickCounts;  ///< N + 1: bricks of each scale, from N to 0
  Array<std::uint32_t> BrickIndices; ///< one a brick: its index in its scale's box
  Array<std::uint64_t> BrickMasks;   ///< eight a brick
  Array<std::uint16_t> Records;      ///< one a diamond: error code and sign of the centre
  Array<std::uint8_t> Isovertices;   ///< one an active subdivision edge: its coefficient
};

template <typename T>
using OwnedArray = std::vector<T>;

struct Encoding
{
  EncodingHeader Header;
  EncodingArrays<OwnedArray> Arrays;
};

struct EncodingView
{
  EncodingHeader Header;
  EncodingArrays<ArrayView> Arrays;

  EncodingView() = default;
  EncodingView(const Encoding& encoding) // NOLINT(google-explicit-constructor): it is a view
    : Header(encoding.Header)
    , Arrays{ encoding.Arrays.BrickCounts, encoding.Arrays.BrickIndices, encoding.Arrays.BrickMasks,
      encoding.Arrays.Records, encoding.Arrays.Isovertices }
  {
  }

  /** Sum of the arrays' sizes in bytes. */
  std::int64_t StorageSize() const;
};

/** A checked encoding, ready for queries. The encoding's arrays must outlive it. */
class IsodiamondHierarchy
{
public:
  /** Checks the encoding and derives what it implies.
   *  @throws std::invalid_argument naming what is wrong with the encoding. */
  IsodiamondHierarchy(const EncodingView& encoding, const ParallelFor& parallelFor);

  const EncodingHeader& Header() const { return this->View.Header; }
  const Grid& Domain() const { return this->TheGrid; }
  const DiamondSet& Diamonds() const { return this->Set; }
  const isodiamond::ErrorCode& Codes() const { return this->Code; }

  /** Threshold of the diamond of a rank. Corners of the base cube have the top code. */
  ErrorCode::Type Threshold(std::int64_t rank) const
  {
    return Record::Code(this->View.Arrays.Records[rank]);
  }
  int Sign(std::int64_t rank) const { return Record::Sign(this->View.Arrays.Records[rank]); }

  /** Mask of the subdivision edges that the surface crosses. */
  std::uint32_t Edges(std::int64_t rank) const { return this->EdgesAndKinds[rank] & 0x3ffU; }
  Kind KindOf(std::int64_t rank) const
  {
    return static_cast<Kind>(this->EdgesAndKinds[rank] >> 12);
  }

  /** The coefficients of a diamond's isovertices, in the order of its edges. */
  const std::uint8_t* Isovertices(std::int64_t rank) const
  {
    return this->View.Arrays.Isovertices.Data + this->FirstIsovertex[rank];
  }

  /** Counts of the isodiamonds by kind; corners of the base cube do not count. */
  std::int64_t Count(Kind kind) const { return this->Counts[static_cast<int>(kind)]; }
  std::int64_t IsovertexCount() const { return this->View.Arrays.Isovertices.Size; }
  std::int64_t StorageSize() const { return this->View.StorageSize(); }

  /** Bytes of what was derived from the encoding and lives beside it. */
  std::int64_t DerivedSize() const;

private:
  void ReadBricks();
  void CheckRecords() const;
  int SignAt(const Place& place) const;
  void DeriveEdges(int scale, const Brick& brick);
  std::uint16_t DeriveDiamond(const Place& place, std::int64_t rank) const;

  EncodingView View;
  Grid TheGrid;
  DiamondSet Set;
  isodiamond::ErrorCode Code;
  std::vector<std::uint16_t> EdgesAndKinds;
  std::vector<std::uint32_t> FirstIsovertex;
  std::array<std::int64_t, 3> Counts{};
};

/** The brick of the base cube's eight corners, at scale N. */
inline BrickMask CornerBrick()
{
  return { 0x303, 0x303, 0, 0, 0, 0, 0, 0 };
}

}

#endif
