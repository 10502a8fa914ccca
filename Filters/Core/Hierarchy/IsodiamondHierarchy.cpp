// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/IsodiamondHierarchy.h"

#include "Lattice/OccupancyWindow.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace isodiamond
{
namespace
{

void Require(bool condition, const char* message)
{
  if (!condition)
  {
    throw std::invalid_argument(message);
  }
}

/** The grid of an encoding, if looking up its bricks takes memory in proportion: a damaged header
 *  must not request all there is. */
Grid CheckedGrid(const EncodingView& encoding)
{
  const Grid grid(encoding.Header.Dimensions);
  std::int64_t bytes = 0; // of the tables from boxes to bricks
  for (int scale = 0; scale <= grid.Depth(); ++scale)
  {
    bytes += BrickBox(grid.Positions(scale)).Size() * sizeof(std::int32_t);
  }
  constexpr std::int64_t always = std::int64_t{ 1 } << 30;
  Require(bytes <= always || bytes / 64 <= encoding.StorageSize(),
    "the dimensions are too large for what is stored");
  return grid;
}

/** The positions of a brick that can hold a diamond of its scale. */
BrickMask AllowedBits(const Grid& grid, int scale, const Point& origin)
{
  if (scale == grid.Depth())
  {
    return CornerBrick();
  }
  const std::array<int, 3> count = grid.Positions(scale);
  BrickMask mask{};
  for (int z = 0; z < 8; ++z)
  {
    for (int bit = 0; bit < 64; ++bit)
    {
      const Point position = PositionOf(origin, z, bit);
      const bool inside =
        position[0] < count[0] && position[1] < count[1] && position[2] < count[2];
      mask[z] |= static_cast<std::uint64_t>(inside && Parity(position) != 0) << bit;
    }
  }
  return mask;
}

}

std::int64_t EncodingView::StorageSize() const
{
  const std::int64_t insideBytes = this->Header.Region.IsVolume()
    ? SizeOf(this->InsideValues) * BytesOfSample(this->InsideValues)
    : 0;
  return 4 * this->Arrays.BrickCounts.Size + 4 * this->Arrays.BrickIndices.Size +
    8 * this->Arrays.BrickMasks.Size + 2 * this->Arrays.Records.Size +
    this->Arrays.Isovertices.Size + 2 * this->Arrays.InteriorCodes.Size +
    8 * this->Arrays.Followers.Size + insideBytes;
}

IsodiamondHierarchy::IsodiamondHierarchy(
  const EncodingView& encoding, const ParallelFor& parallelFor)
  : IsodiamondHierarchy(encoding, DiamondSet(CheckedGrid(encoding)))
{
  this->CheckHeader();
  this->ReadBricks();
  this->CheckRecords();
  this->CheckFollowers();
  this->Complete(this->DeriveEdges(parallelFor));
}

IsodiamondHierarchy::IsodiamondHierarchy(
  const EncodingView& encoding, DiamondSet diamonds, DiamondEdges edges)
  : IsodiamondHierarchy(encoding, std::move(diamonds))
{
  assert(this->Set.Size() == encoding.Arrays.Records.Size);
  assert(this->Set.Size() == static_cast<std::int64_t>(edges.LowerAndKinds.size()));
  assert(edges.Upper.empty() != this->Region().IsVolume());
  this->Complete(std::move(edges));
}

IsodiamondHierarchy::IsodiamondHierarchy(const EncodingView& encoding, DiamondSet diamonds)
  : View(encoding)
  , TheGrid(encoding.Header.Dimensions)
  , Set(std::move(diamonds))
  , Code(encoding.Header.ErrorScale)
  , InteriorCode(encoding.Header.FieldScale)
{
}

void IsodiamondHierarchy::CheckHeader() const
{
  const EncodingHeader& header = this->Header();
  Require(header.TheModel == Model::Relevant || header.TheModel == Model::Minimal,
    "the encoding is not that of a relevant or minimal isodiamond hierarchy");
  Require(header.ErrorScale > 0.0 && std::isfinite(header.ErrorScale),
    "the error scale is not a positive number");
  Require(header.FieldScale > 0.0 && std::isfinite(header.FieldScale),
    "the field scale is not a positive number");
}

void IsodiamondHierarchy::Complete(DiamondEdges edges)
{
  this->DerivedEdges = std::move(edges);
  this->CountByKind();
  this->CheckOrderOnEdges();
  this->CountInsideValues();
  this->FindHighestThresholds();
}

/** The signs of lattice points in a brick and next to it, at the brick's scale. Diamonds share
 * their vertices: each sign is looked up once. */
class IsodiamondHierarchy::BrickSigns
{
public:
  BrickSigns(const IsodiamondHierarchy& hierarchy, int scale, const Brick& brick)
    : Hierarchy(hierarchy)
    , Scale(scale)
    , Window(hierarchy.Set.Level(scale), hierarchy.Set.Level(scale).Box.Origin(brick.BoxIndex))
  {
    const Point low = hierarchy.Set.Level(scale).Box.Origin(brick.BoxIndex) + Point{ -1, -1, -1 };
    const Point high = low + Point{ Width - 1, Width - 1, Width - 1 };
    const int h = 1 << scale;
    this->IsWhole = hierarchy.TheGrid.IsSampled(h * low) && hierarchy.TheGrid.IsSampled(h * high);
    this->First = OccupancyWindow<Width>::Distance(low);
    this->Above.fill(Unknown);
    hierarchy.Set.ForEachInBrick(scale, brick,
      [&](const Place& place, std::uint32_t rank)
      { this->Above[this->IndexOf(place.Position)] = AboveOf(hierarchy.Sign(rank)); });
  }

  /** The signs of those vertices of a diamond that have samples. */
  DiamondSigns Of(const Place& diamond, std::int64_t rank)
  {
    const Grid& grid = this->Hierarchy.TheGrid;
    const int parity = Parity(diamond.Position);
    const ParityTable& shape = tables::Parities[parity];
    const bool hasCentre = this->IsWhole || grid.IsSampled(Centre(diamond));
    const std::uint32_t sampled =
      this->IsWhole ? (1U << shape.VertexCount) - 1U : SampledVertices(grid, diamond);
    return { this->Hierarchy.Region(), hasCentre ? this->Hierarchy.Sign(rank) : -1, sampled,
      this->AboveAround(diamond.Position, shape, Distances[parity], sampled) };
  }

private:
  static constexpr int Width = 10;
  static constexpr std::uint8_t Unknown = 0x80; ///< in addition to the bits of AboveOf()

  /** A bit for each surface that a point with this sign lies above. */
  static std::uint8_t AboveOf(int sign) { return static_cast<std::uint8_t>((1 << sign) - 1); }

  /** By surface, the vertices that lie above. */
  std::array<std::uint32_t, 2> AboveAround(const Point& position, const ParityTable& shape,
    const std::array<std::int16_t, MaximumVertices>& distances, std::uint32_t sampled)
  {
    std::uint8_t* const centre = this->Above.data() + this->IndexOf(position);
    std::array<std::uint32_t, 2> above{};
    std::uint32_t unknown = 0;
    for (int i = 0; i < MaximumVertices; ++i) // those beyond the last vertex repeat the centre
    {
      const std::uint32_t bits = centre[distances[i]];
      above[0] |= (bits & 1U) << i;
      above[1] |= ((bits >> 1) & 1U) << i;
      unknown |= (bits >> 7) << i;
    }
    ForEachBit(unknown & sampled,
      [&](int vertex)
      {
        const std::uint8_t bits = AboveOf(this->LookUp(position + shape.Offsets[vertex]));
        centre[distances[vertex]] = bits;
        above[0] |= (bits & 1U) << vertex;
        above[1] |= ((bits >> 1) & 1U) << vertex;
      });
    return { above[0] & sampled, above[1] & sampled };
  }

  int LookUp(const Point& position) const
  {
    const std::int64_t rank =
      Parity(position) != 0 ? this->Window.Rank(position) : std::int64_t{ DiamondSet::None };
    return rank != DiamondSet::None ? this->Hierarchy.Sign(rank)
                                    : this->Hierarchy.SignAt({ this->Scale, position });
  }

  int IndexOf(const Point& position) const
  {
    return OccupancyWindow<Width>::Distance(position) - this->First;
  }

  static constexpr auto Distances = MakeVertexDistances<Width>();

  const IsodiamondHierarchy& Hierarchy;
  int Scale;
  BrickWindow Window;
  int First = 0;                                         ///< Distance() of the first point
  bool IsWhole = false;                                  ///< whether all points have samples
  std::array<std::uint8_t, Width * Width * Width> Above; ///< AboveOf(), or Unknown
};

DiamondEdges IsodiamondHierarchy::DeriveEdges(const ParallelFor& parallelFor) const
{
  DiamondEdges edges(this->Set.Size(), this->Region());
  for (int scale = this->Set.ScaleCount() - 1; scale >= 0; --scale)
  {
    const std::vector<Brick>& bricks = this->Set.Level(scale).Bricks;
    ForEachIndex(parallelFor, bricks.size(), 16,
      [&](std::int64_t i)
      {
        BrickSigns signs(*this, scale, bricks[i]);
        this->Set.ForEachInBrick(scale, bricks[i],
          [&](const Place& place, std::uint32_t rank)
          { edges.Set(rank, this->Sign(rank), signs.Of(place, rank)); });
      });
  }
  return edges;
}

/** Where each diamond's isovertices begin, and the counts by kind. */
void IsodiamondHierarchy::CountByKind()
{
  this->FirstIsovertex.Reserve(this->Set.Size());
  for (std::int64_t rank = 0; rank < this->Set.Size(); ++rank)
  {
    this->FirstIsovertex.Append(this->DerivedEdges.IsovertexCount(rank));
    this->Counts[static_cast<int>(this->KindOf(rank))] += rank < 8 ? 0 : 1;
  }
  Require(this->FirstIsovertex.Total() == this->View.Arrays.Isovertices.Size,
    "the number of isovertices does not match the signs");
  Require(this->Header().RelevantCount >= this->Count(Kind::Relevant) + this->Count(Kind::Creation),
    "there are more relevant isodiamonds than the header says");
}

/** Where an edge crosses both surfaces of an interval volume, its isovertices are in the order of
 *  the signs. */
void IsodiamondHierarchy::CheckOrderOnEdges() const
{
  bool valid = true;
  for (std::int64_t rank = 0; this->Region().IsVolume() && rank < this->Set.Size(); ++rank)
  {
    const std::uint32_t lower = this->Edges(rank);
    const std::uint32_t upper = this->UpperEdges(rank);
    const std::uint8_t* const coefficients = this->Isovertices(rank);
    ForEachBit(lower & upper,
      [&](int edge)
      {
        const std::uint32_t before = (1U << edge) - 1U;
        const int onLower = coefficients[PopCount(lower & before)];
        const int onUpper = coefficients[PopCount(lower) + PopCount(upper & before)];
        valid = valid && (this->Sign(rank) == 0 ? onLower <= onUpper : onUpper <= onLower);
      });
  }
  Require(valid, "the isovertices of an edge are in the wrong order");
}

/** Where each brick's inside values begin. */
void IsodiamondHierarchy::CountInsideValues()
{
  if (!this->Region().IsVolume())
  {
    return;
  }
  std::int64_t values = 0;
  for (int scale = this->Set.ScaleCount() - 1; scale >= 0; --scale)
  {
    for (const Brick& brick : this->Set.Level(scale).Bricks)
    {
      this->FirstInside.push_back(values);
      for (std::uint32_t rank = brick.First; rank < brick.First + brick.Size(); ++rank)
      {
        values += this->Sign(rank) == InsideSign ? 1 : 0;
      }
    }
  }
  this->FirstInside.push_back(values);
  Require(values == SizeOf(this->View.InsideValues),
    "the number of inside values does not match the signs");
}

void IsodiamondHierarchy::FindHighestThresholds()
{
  for (int scale = this->Set.ScaleCount() - 1; scale >= 0; --scale)
  {
    for (const Brick& brick : this->Set.Level(scale).Bricks)
    {
      Thresholds highest;
      for (std::uint32_t rank = brick.First; rank < brick.First + brick.Size(); ++rank)
      {
        highest.Surface = std::max(highest.Surface, this->Threshold(rank));
        if (this->RefinesInterior())
        {
          highest.Interior = std::max(highest.Interior, this->InteriorThreshold(rank));
        }
      }
      this->Highest.push_back(highest);
    }
  }
}

std::int64_t IsodiamondHierarchy::DerivedSize() const
{
  std::int64_t size = static_cast<std::int64_t>(2 * this->DerivedEdges.LowerAndKinds.size() +
                        2 * this->DerivedEdges.Upper.size() + 8 * this->FirstInside.size() +
                        sizeof(Thresholds) * this->Highest.size()) +
    this->FirstIsovertex.Bytes();
  for (int scale = 0; scale < this->Set.ScaleCount(); ++scale)
  {
    const BrickLevel& level = this->Set.Level(scale);
    size +=
      static_cast<std::int64_t>(4 * level.Lookup.size() + sizeof(Brick) * level.Bricks.size());
  }
  return size;
}

void IsodiamondHierarchy::ReadBricks()
{
  const EncodingArrays<ArrayView>& arrays = this->View.Arrays;
  Require(arrays.BrickCounts.Size == this->TheGrid.Depth() + 1,
    "the number of scales does not match the dimensions");
  Require(arrays.BrickMasks.Size == 8 * arrays.BrickIndices.Size,
    "the numbers of brick masks and of brick indices do not match");
  std::int64_t brick = 0;
  for (int scale = this->TheGrid.Depth(); scale >= 0; --scale)
  {
    const BrickBox& box = this->Set.Level(scale).Box;
    const std::int64_t end = brick + arrays.BrickCounts[this->TheGrid.Depth() - scale];
    Require(end <= arrays.BrickIndices.Size, "there are fewer bricks than the scales need");
    for (std::int64_t previous = -1; brick < end; ++brick)
    {
      const std::int64_t index = arrays.BrickIndices[brick];
      Require(index > previous && index < box.Size(), "a brick's index is out of order or range");
      previous = index;
      const BrickMask allowed = AllowedBits(this->TheGrid, scale, box.Origin(index));
      BrickMask mask{};
      std::uint64_t any = 0;
      for (int z = 0; z < 8; ++z)
      {
        mask[z] = arrays.BrickMasks[8 * brick + z];
        any |= mask[z];
        Require((mask[z] & ~allowed[z]) == 0, "a brick has a diamond where none can be");
      }
      Require(any != 0, "a brick is empty");
      this->Set.Append(scale, index, mask);
    }
  }
  Require(brick == arrays.BrickIndices.Size, "there are more bricks than the scales need");
  const std::vector<Brick>& corners = this->Set.Level(this->TheGrid.Depth()).Bricks;
  Require(corners.size() == 1 && corners[0].Occupancy == CornerBrick(),
    "the corners of the base cube are missing");
}

void IsodiamondHierarchy::CheckRecords() const
{
  const ArrayView<std::uint16_t>& records = this->View.Arrays.Records;
  Require(records.Size == this->Set.Size(), "the number of records does not match the bricks");
  Require(this->View.Arrays.Isovertices.Size <= std::numeric_limits<std::uint32_t>::max(),
    "more than 2^32 - 1 isovertices");
  // If no descendant has a surface, only an interior tolerance subdivides a diamond.
  const bool interior = this->RefinesInterior();
  Require(!interior ||
      (this->Region().IsVolume() && this->View.Arrays.InteriorCodes.Size == records.Size),
    "the number of interior codes does not match the bricks");
  const ErrorCode::Type least = interior ? ErrorCode::Type{ 0 } : ErrorCode::Least;
  bool valid = true;
  for (std::int64_t rank = 0; rank < records.Size; ++rank)
  {
    valid = valid && Record::Code(records[rank]) >= least &&
      Record::Sign(records[rank]) <= this->Region().SurfaceCount();
  }
  for (std::int64_t rank = 0; interior && rank < records.Size; ++rank)
  {
    valid = valid && this->InteriorThreshold(rank) <= ErrorCode::Always;
  }
  this->Set.ForEach([&](const Place& place, std::uint32_t rank)
    { valid = valid && (this->Sign(rank) == 0 || this->TheGrid.IsSampled(Centre(place))); });
  Require(valid, "a record has an invalid error code or sign");
  for (std::int64_t i = 0; i < this->View.Arrays.Isovertices.Size; ++i)
  {
    valid = valid && this->View.Arrays.Isovertices[i] != 0;
  }
  Require(valid, "an isovertex has the coefficient 0");
}

void IsodiamondHierarchy::CheckFollowers() const
{
  std::uint64_t previous = 0;
  for (std::int64_t i = 0; i < this->Followers().Size; ++i)
  {
    const std::uint64_t code = this->Followers()[i];
    Require(code > previous && code >> 63 == 0,
      "the diamonds that follow their parents are out of order or range");
    previous = code;
    const Place place = PlaceOfCentre(code);
    Require(
      place.Scale < this->TheGrid.Depth() && this->TheGrid.IsValid(place.Position, place.Scale),
      "a diamond that follows its parents lies where none can be");
  }
}

int IsodiamondHierarchy::SignAt(const Place& place) const
{
  // A diamond that is not stored has one sign, that of each of its vertices (theorem 7.1). The
  // vertex with the lowest bit cleared on every axis is sampled if the centre is; the chain ends
  // at the corners of the base cube.
  Point position = place.Position;
  int scale = place.Scale;
  while (true)
  {
    while (scale < this->TheGrid.Depth() && Parity(position) == 0)
    {
      position = { position[0] >> 1, position[1] >> 1, position[2] >> 1 };
      ++scale;
    }
    const std::int64_t rank = this->Set.Rank({ scale, position });
    if (rank != DiamondSet::None)
    {
      return this->Sign(rank);
    }
    position = { position[0] & ~1, position[1] & ~1, position[2] & ~1 };
  }
}

}
