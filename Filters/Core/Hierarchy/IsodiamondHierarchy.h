// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IsodiamondHierarchy_h
#define isodiamond_IsodiamondHierarchy_h

#include "Field/Parallel.h"
#include "Hierarchy/DiamondEdges.h"
#include "Hierarchy/ErrorCode.h"
#include "Hierarchy/IsovertexStarts.h"
#include "Lattice/DiamondSet.h"

#include <cassert>
#include <cstdint>
#include <vector>

/**
 * @file IsodiamondHierarchy.h
 * The relevant (RI) and the minimal (MI) isodiamond hierarchy of an isosurface or interval volume.
 *
 * There are two forms. The *encoding* is what is kept and saved: flat arrays of bricks, 2-byte
 * records and 1-byte isovertices. The *hierarchy* is a view of an encoding, with what queries need
 * at hand derived from it and checked: the rank of every brick and, for each isodiamond, the mask
 * of its active subdivision edges. Coordinates, edges, vertex signs and kinds are not stored: bits
 * and records imply them.
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

/** How the error of a diamond is measured. */
enum class ErrorMetric : int
{
  Field = 0,   ///< in field units: the field against its interpolant (the paper's), FieldError.h
  Distance = 1 ///< in world units: the full-resolution surface against the patches, DistanceError.h
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

  const T& operator[](std::int64_t i) const
  {
    assert(i >= 0 && i < this->Size);
    return this->Data[i];
  }
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
  Model TheModel = Model::Minimal;
  std::array<int, 3> Dimensions = { 2, 2, 2 };
  Isoregion Region = 0.0;
  ErrorMetric Metric = ErrorMetric::Field;
  double ErrorScale = 1.0; ///< of the records' ErrorCode, in the metric's units
  double FieldScale = 1.0; ///< of the interior codes' ErrorCode, in field units
  bool ExactIsovertices = true;
  /** Whether distances were measured both ways: from full resolution to the patches, and back. */
  bool TwoSided = false;
  /** Whether every mesh is homeomorphic to that of full resolution. */
  bool PreservesTopology = false;
  /** The size, in samples, below which solids and cavities were removed, and how many were. */
  std::int64_t MinimumPieceSize = 0;
  std::int64_t RemovedPieces = 0;
  /** Whether it holds the subdivided diamonds of one query only, not all that lead to the surface;
   *  never so in files. */
  bool IsAnswer = false;
  /** m_r: the number of relevant isodiamonds, creation ones included, stored or not. */
  std::int64_t RelevantCount = 0;
  /** m_a and m_c, as known from building; a hierarchy counts what it stores. */
  std::int64_t ActiveCount = 0;
  std::int64_t CreationCount = 0;
};

/** A diamond's centre as a number. */
inline std::uint64_t CentreCode(const Place& place)
{
  return PackedPoint(Centre(place));
}

/** The diamond of such a code, which must not be 0. */
inline Place PlaceOfCentre(std::uint64_t code)
{
  const auto coordinate = [&](int axis)
  { return static_cast<std::uint32_t>(code >> (21 * axis)) & 0x1fffffU; };
  const std::array<std::uint32_t, 3> centre = { coordinate(0), coordinate(1), coordinate(2) };
  const int scale = LowestBit(centre[0] | centre[1] | centre[2]);
  return { scale,
    { static_cast<int>(centre[0] >> scale), static_cast<int>(centre[1] >> scale),
      static_cast<int>(centre[2] >> scale) } };
}

/**
 * The arrays of an encoding. Scales run from N, the base cube's corners, down to 0; bricks of a
 * scale by their index in its box; diamonds by bit; isovertices by diamond and edge.
 */
template <template <typename> class Array>
struct EncodingArrays
{
  Array<std::uint32_t> BrickCounts;  ///< N + 1: bricks of each scale, from N to 0
  Array<std::uint32_t> BrickIndices; ///< one per brick: its index in its scale's box
  Array<std::uint64_t> BrickMasks;   ///< eight per brick
  Array<std::uint16_t> Records;      ///< one per diamond: error code and sign of the centre
  /** Coefficients, by diamond: those of its edges that cross surface 0, then surface 1. */
  Array<std::uint8_t> Isovertices;
  /** For an interval volume that is to be refined inside: one per diamond, the code of the interior
   *  tolerance below which it is subdivided, 0 for never. Otherwise empty. */
  Array<ErrorCode::Type> InteriorCodes;
  /** The CentreCode(), ascending, of the diamonds whose own error exceeds their threshold: wherever
   *  something other than a threshold subdivides a parent, they have to follow, stored or not. None
   *  for field errors. */
  Array<std::uint64_t> Followers;
};

template <typename T>
using OwnedArray = std::vector<T>;

struct Encoding
{
  EncodingHeader Header;
  EncodingArrays<OwnedArray> Arrays;
  /** The samples at the diamonds' centres that lie inside the interval volume, by rank; none for
   *  an isosurface. */
  AnyValues InsideValues;
};

/** The result of encoding, and what is known of its diamonds, if that is wanted. */
struct Encoded
{
  isodiamond::Encoding Encoding;
  DiamondSet Diamonds;
  DiamondEdges Edges;
};

struct EncodingView
{
  EncodingHeader Header;
  EncodingArrays<ArrayView> Arrays;
  AnySamples InsideValues; ///< a row

  EncodingView() = default;
  EncodingView(const Encoding& encoding) // NOLINT(google-explicit-constructor): it is a view
    : Header(encoding.Header)
    , Arrays{ encoding.Arrays.BrickCounts, encoding.Arrays.BrickIndices, encoding.Arrays.BrickMasks,
      encoding.Arrays.Records, encoding.Arrays.Isovertices, encoding.Arrays.InteriorCodes,
      encoding.Arrays.Followers }
    , InsideValues(ViewOf(encoding.InsideValues))
  {
  }

  /** Sum of the arrays' sizes in bytes. */
  std::int64_t StorageSize() const;
};

/** An encoding, ready for queries: checked, unless it was just made. Its arrays must outlive it. */
class IsodiamondHierarchy
{
public:
  /** Checks the encoding and derives what it implies.
   *  @throws std::invalid_argument naming what is wrong with the encoding. */
  IsodiamondHierarchy(const EncodingView& encoding, const ParallelFor& parallelFor);

  /** For an encoding that was just made of these diamonds, with these edges: takes all as it is.
   *  Never for an encoding that comes from elsewhere. */
  IsodiamondHierarchy(const EncodingView& encoding, DiamondSet diamonds, DiamondEdges edges);

  const EncodingHeader& Header() const { return this->View.Header; }
  const Grid& SampleGrid() const { return this->TheGrid; }
  const DiamondSet& Diamonds() const { return this->Set; }
  const isodiamond::ErrorCode& Codes() const { return this->Code; }
  const isodiamond::ErrorCode& InteriorCodes() const { return this->InteriorCode; }

  const Isoregion& Region() const { return this->View.Header.Region; }

  /** Threshold of the diamond of a rank. Corners of the base cube have the top code. */
  ErrorCode::Type Threshold(std::int64_t rank) const
  {
    return Record::Code(this->View.Arrays.Records[rank]);
  }
  int Sign(std::int64_t rank) const { return Record::Sign(this->View.Arrays.Records[rank]); }

  /** Whether diamonds have thresholds for an interior tolerance. */
  bool RefinesInterior() const { return this->View.Arrays.InteriorCodes.Size > 0; }
  ErrorCode::Type InteriorThreshold(std::int64_t rank) const
  {
    return this->View.Arrays.InteriorCodes[rank];
  }

  /** The diamonds that are to be subdivided wherever a parent is, by CentreCode(). */
  const ArrayView<std::uint64_t>& Followers() const { return this->View.Arrays.Followers; }

  /** The highest thresholds of a brick's diamonds: queries skip a brick where these are too low.
   *  @param brick numbered as by AllBricks() */
  struct Thresholds
  {
    ErrorCode::Type Surface = 0;
    ErrorCode::Type Interior = 0; ///< 0 if there are none
  };
  const Thresholds& HighestOfBrick(std::int64_t brick) const { return this->Highest[brick]; }

  /** Mask of the subdivision edges that the isosurface, or the lower surface, crosses. */
  std::uint32_t Edges(std::int64_t rank) const { return this->DerivedEdges.LowerOf(rank); }

  /** Mask of the subdivision edges that the upper surface crosses; interval volumes only. */
  std::uint32_t UpperEdges(std::int64_t rank) const { return this->DerivedEdges.Upper[rank]; }

  /** The subdivision edges that make a half-tetrahedron carry something if it has any of them. All
   *  if the centre lies inside the interval volume. */
  std::uint32_t CarryingEdges(std::int64_t rank) const
  {
    if (!this->Region().IsVolume())
    {
      return this->Edges(rank);
    }
    return this->Sign(rank) == InsideSign ? AllEdges : this->Edges(rank) | this->UpperEdges(rank);
  }
  /** The edges of all diamonds, by rank. */
  const DiamondEdges& EdgesByRank() const { return this->DerivedEdges; }
  Kind KindOf(std::int64_t rank) const { return this->DerivedEdges.KindOf(rank); }

  /** The coefficients of a diamond's isovertices, in the order of its edges: those on surface 0,
   *  then those on surface 1. */
  const std::uint8_t* Isovertices(std::int64_t rank) const
  {
    assert(rank >= 0 && rank < this->Set.Size() && "the rank of a stored diamond");
    return this->View.Arrays.Isovertices.Data + this->FirstIsovertex[rank];
  }

  /** The number of isovertices before those of the diamond of a rank, and the coefficient of an
   *  isovertex by its number. */
  std::int64_t FirstIsovertexOf(std::int64_t rank) const { return this->FirstIsovertex[rank]; }
  std::uint8_t Isovertex(std::int64_t number) const
  {
    return this->View.Arrays.Isovertices[number];
  }

  /** The samples inside the interval volume, by rank of the centres, as a row. */
  const AnySamples& InsideValues() const { return this->View.InsideValues; }

  /** The number of those in the bricks before a brick, numbered as by AllBricks(). */
  std::int64_t FirstInsideValue(std::int64_t brick) const { return this->FirstInside[brick]; }

  /** Counts of the isodiamonds by kind; corners of the base cube do not count. */
  std::int64_t Count(Kind kind) const { return this->Counts[static_cast<int>(kind)]; }
  std::int64_t IsovertexCount() const { return this->View.Arrays.Isovertices.Size; }
  std::int64_t StorageSize() const { return this->View.StorageSize(); }

  /** Bytes of what was derived from the encoding and lives beside it. */
  std::int64_t DerivedSize() const;

private:
  class BrickSigns;

  IsodiamondHierarchy(const EncodingView& encoding, DiamondSet diamonds);
  void CheckHeader() const;
  void ReadBricks();
  void CheckRecords() const;
  void CheckFollowers() const;
  DiamondEdges DeriveEdges(const ParallelFor& parallelFor) const;
  void Complete(DiamondEdges edges);
  void CountByKind();
  void CheckOrderOnEdges() const;
  void CountInsideValues();
  void FindHighestThresholds();
  int SignAt(const Place& place) const;

  EncodingView View;
  Grid TheGrid;
  DiamondSet Set;
  isodiamond::ErrorCode Code;
  isodiamond::ErrorCode InteriorCode;
  DiamondEdges DerivedEdges;
  std::vector<std::int64_t> FirstInside; ///< interval volumes only: by brick, and the total
  IsovertexStarts FirstIsovertex;
  std::vector<Thresholds> Highest; ///< by brick
  std::array<std::int64_t, 3> Counts{};
};

}

#endif
