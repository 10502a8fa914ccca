// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/CutMesh.h"

#include "Mesh/PatchPoints.h"
#include "Mesh/VertexWindow.h"
#include "Patches/IntervalCases.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

/** Numbers lattice points in the order in which they come: a hash table with open addressing. */
class VertexNumbers
{
public:
  /** @return the number, and whether it is new */
  std::pair<std::uint32_t, bool> operator()(const Point& position)
  {
    if (2 * std::size_t{ this->Count } >= this->Slots.size())
    {
      this->Grow();
    }
    const std::uint64_t key = PackedPoint(position);
    Slot& slot = this->Find(key);
    if (slot.Key == key)
    {
      return { slot.Number, false };
    }
    slot = { key, this->Count++ };
    return { slot.Number, true };
  }

private:
  static constexpr std::uint64_t NoKey = ~std::uint64_t{ 0 };
  struct Slot
  {
    std::uint64_t Key = NoKey;
    std::uint32_t Number = 0;
  };

  /** The slot of a key, or the free one where it would be. */
  Slot& Find(std::uint64_t key)
  {
    const std::size_t last = this->Slots.size() - 1;
    // The product's highest bits depend on all coordinates.
    std::size_t i = (key * 0x9e3779b97f4a7c15U) >> (64 - this->Bits);
    while (this->Slots[i].Key != key && this->Slots[i].Key != NoKey)
    {
      i = (i + 1) & last;
    }
    return this->Slots[i];
  }

  void Grow()
  {
    const std::vector<Slot> before = std::move(this->Slots);
    ++this->Bits;
    this->Slots.assign(std::size_t{ 1 } << this->Bits, {});
    for (const Slot& slot : before)
    {
      if (slot.Key != NoKey)
      {
        this->Find(slot.Key) = slot;
      }
    }
  }

  std::vector<Slot> Slots;
  int Bits = 9; ///< of the number of slots, once there are any
  std::uint32_t Count = 0;
};

/** A leaf whose vertices have no numbers yet. */
struct FoundLeaf
{
  CutMesh::Tetrahedron Tetrahedron;
  std::array<CutMesh::Vertex, 4> Corners;
};

/** Whether a leaf lies in a hidden cell: there it is of full resolution, and in a single cell. */
bool LiesIn(const HiddenCells& hidden, const FoundLeaf& leaf)
{
  Point least = leaf.Corners[0].Position;
  for (const CutMesh::Vertex& corner : leaf.Corners)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      least[axis] = std::min(least[axis], corner.Position[axis]);
    }
  }
  return hidden(least);
}

bool IsCornerOf(const HiddenCells& hidden, const Point& sample)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    if (hidden(sample + Point{ -(corner & 1), -((corner >> 1) & 1), -(corner >> 2) }))
    {
      return true;
    }
  }
  return false;
}

/** Finds the leaves of one brick. */
class LeafReader
{
public:
  LeafReader(const ExtractionPasses& passes, std::int64_t brick)
    : Hierarchy(passes.Hierarchy())
    , Window(passes, brick)
    , Places(PointsByAge())
  {
  }

  template <typename Use>
  void Read(const LeafParent& parent, Use&& use) const
  {
    const IntervalCases cases(this->Hierarchy, parent.Rank, parent.Type);
    const int level = this->Hierarchy.SampleGrid().Depth() - 1 - parent.LeafScale();
    const DiamondPoints* own = this->Window.At(parent.At.Position);
    parent.ForEachLeaf(
      [&](int half)
      {
        FoundLeaf leaf;
        leaf.Tetrahedron.IsOdd = parent.Shape().HalfTetrahedra[half].OddByAge;
        leaf.Tetrahedron.Level = static_cast<std::int8_t>(level);
        this->ReadCorners(parent, half, cases(half), own, leaf);
        this->ReadCuts(this->Places[parent.Type][half], own, leaf);
        use(leaf);
      });
  }

private:
  void ReadCorners(
    const LeafParent& parent, int half, int code, const DiamondPoints* own, FoundLeaf& leaf) const
  {
    const HalfTetrahedron& shape = parent.Shape().HalfTetrahedra[half];
    const AgePointPlaces& places = this->Places[parent.Type][half];
    const int h = 1 << parent.At.Scale;
    for (int i = 0; i < 4; ++i)
    {
      CutMesh::Vertex& corner = leaf.Corners[i];
      corner.Position = h * parent.At.Position;
      if (i > 0)
      {
        const int vertex = shape.Vertices[shape.ByAge[i - 1]];
        corner.Position = corner.Position + h * parent.Shape().Offsets[vertex];
      }
      corner.Sign = static_cast<std::uint8_t>(code % 3);
      code /= 3;
      if (corner.Sign == InsideSign)
      {
        corner.PointId = own[places[i].Distance].Id(places[i].Bit);
      }
    }
  }

  static void ReadCuts(const AgePointPlaces& places, const DiamondPoints* own, FoundLeaf& leaf)
  {
    constexpr int bitsOfSurface = DiamondPoints::Isovertex(1, 0) - DiamondPoints::Isovertex(0, 0);
    for (int younger = 0; younger < 3; ++younger)
    {
      for (int older = younger + 1; older < 4; ++older)
      {
        const int low = std::min(leaf.Corners[younger].Sign, leaf.Corners[older].Sign);
        const int high = std::max(leaf.Corners[younger].Sign, leaf.Corners[older].Sign);
        const PatchPointPlace& place = places[EdgeByAge(younger, older)];
        for (int surface = 0; surface < 2; ++surface)
        {
          leaf.Tetrahedron.Cuts[CutEdge(younger, older)][surface] = low <= surface && high > surface
            ? own[place.Distance].Id(place.Bit + surface * bitsOfSurface)
            : CutMesh::None;
        }
      }
    }
  }

  const IsodiamondHierarchy& Hierarchy;
  const VertexWindow Window;
  const PatchPointTable<AgePointPlaces>& Places;
};

}

void Pin(CutMesh& mesh, const std::vector<std::uint64_t>& positions)
{
  for (CutMesh::Vertex& vertex : mesh.Vertices)
  {
    const auto [first, last] =
      std::equal_range(positions.begin(), positions.end(), PackedPoint(vertex.Position));
    vertex.Pins = static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(last - first, 255));
  }
}

int PinsOf(const CutMesh& mesh, std::size_t leaf)
{
  const auto& vertices = mesh.Tetrahedra[leaf].Vertices;
  int pins = 255;
  for (const std::uint32_t vertex : vertices)
  {
    pins = std::min<int>(pins, mesh.Vertices[vertex].Pins);
  }
  return pins;
}

std::vector<Vector> VerticesInWorld(const CutMesh& mesh, const GridGeometry& world)
{
  std::vector<Vector> positions;
  positions.reserve(mesh.Vertices.size());
  for (const CutMesh::Vertex& vertex : mesh.Vertices)
  {
    const Point& at = vertex.Position;
    positions.push_back(world({ 1.0 * at[0], 1.0 * at[1], 1.0 * at[2] }));
  }
  return positions;
}

std::optional<Place> DiamondOf(const CutMesh& mesh, std::size_t leaf, const Grid& grid)
{
  std::int64_t longest = 0;
  Point twice{}; // the middle of the longest edge
  for (const std::uint32_t a : mesh.Tetrahedra[leaf].Vertices)
  {
    for (const std::uint32_t b : mesh.Tetrahedra[leaf].Vertices)
    {
      const Point& from = mesh.Vertices[a].Position;
      const Point& to = mesh.Vertices[b].Position;
      std::int64_t squared = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        squared += std::int64_t{ to[axis] - from[axis] } * (to[axis] - from[axis]);
      }
      if (squared > longest)
      {
        longest = squared;
        twice = from + to;
      }
    }
  }
  if (Parity(twice) != 0)
  {
    return std::nullopt;
  }
  const Point middle = { twice[0] / 2, twice[1] / 2, twice[2] / 2 };
  const int scale = grid.Scale(middle);
  return Place{ scale, { middle[0] >> scale, middle[1] >> scale, middle[2] >> scale } };
}

CutMesh MakeCutMesh(const ExtractionPasses& passes, const HiddenCells* hidden)
{
  const bool anyHidden = hidden != nullptr && hidden->Any();
  // Bricks are read independently; then vertices are numbered in the bricks' order.
  const std::int64_t bricks = passes.BrickCount();
  std::vector<std::vector<FoundLeaf>> leaves(bricks);
  passes.ForEachBrickWithCells(passes.AllCells(),
    [&](std::int64_t brick, const CellRange& /*own*/)
    {
      const LeafReader reader(passes, brick);
      passes.ForEachLeafParent(brick,
        [&](const LeafParent& parent)
        {
          reader.Read(parent,
            [&](const FoundLeaf& leaf)
            {
              if (!anyHidden || !LiesIn(*hidden, leaf))
              {
                leaves[brick].push_back(leaf);
              }
            });
        });
    });
  std::size_t count = 0;
  for (const std::vector<FoundLeaf>& some : leaves)
  {
    count += some.size();
  }
  CutMesh mesh;
  mesh.Tetrahedra.reserve(count);
  VertexNumbers numberOf;
  for (std::vector<FoundLeaf>& some : leaves)
  {
    for (const FoundLeaf& leaf : some)
    {
      mesh.Tetrahedra.push_back(leaf.Tetrahedron);
      for (int i = 0; i < 4; ++i)
      {
        const auto [number, isNew] = numberOf(leaf.Corners[i].Position);
        mesh.Tetrahedra.back().Vertices[i] = number;
        if (isNew)
        {
          mesh.Vertices.push_back(leaf.Corners[i]);
          mesh.Vertices.back().IsFixed = anyHidden && IsCornerOf(*hidden, leaf.Corners[i].Position);
        }
      }
    }
    some = {}; // so that no more than the result is held twice
  }
  return mesh;
}

}
