// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondTables_h
#define isodiamond_DiamondTables_h

#include "Lattice/Lattice.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

/**
 * @file DiamondTables.h
 * The shapes of the three classes of diamonds, generated from the lattice rules at compile time.
 *
 * A diamond is the set of tetrahedra around one longest edge, its *spine*; it is named by the
 * spine's midpoint, its *central vertex*. With h = 2^scale all of its vertices lie at offsets
 * h * {-1, 0, 1}^3 from there. Everything follows from six bits, the diamond's *type*: the lowest
 * two bits of its position (coordinates >> scale). The low bits say on which axes the position is
 * odd (the *parity*):
 *
 * @verbatim
 *   class 0, three odd axes     class 1, two odd axes      class 2, one odd axis
 *        o--------o                    o                       o----o----o
 *       /|       /|                   /|\                      |\   |   /|
 *      o--------o |              o---/-+-\---o                 | \  |  / |   spine: along the odd
 *      | |  c   | |               \ /  c  \ /                  o----c----o   axis, through c
 *      | o------|-o                o-------o                   |  / | \  |   (above and below the
 *      |/       |/                  \  |  /                    | /  |  \ |   plane drawn here)
 *      o--------o                      o                       o----o----o
 *   spine: cube diagonal       spine: face diagonal         spine: cube edge
 *   6 tetrahedra, 8 vertices   4 tetrahedra, 6 vertices     8 tetrahedra, 10 vertices
 * @endverbatim
 *
 * and the high bits which of the diagonals is the spine. The edges from c to the vertices are the
 * diamond's *subdivision edges*, which come into being with its subdivision; every edge of the
 * hierarchy belongs to the diamond centred at its younger end. Edges are numbered like the
 * vertices: bit i of an edge mask is the edge to vertex i. The order depends on the parity only.
 *
 * The 8 corners of the base cube follow the same rules at scale N: seven of them own the cube's
 * edges, face diagonals and its spine, and the root diamond is their child. So the base mesh
 * needs no code of its own.
 *
 * Weiss & De Floriani, TVCG 2010, sections 3 and 4.
 */
namespace isodiamond
{

/** The most vertices, half-tetrahedra and children that any diamond has. */
inline constexpr int MaximumVertices = 10;
inline constexpr int MaximumHalfTetrahedra = 16;
inline constexpr int MaximumChildren = 8;

/** The mask of all subdivision edges, or vertices, of any diamond. */
inline constexpr std::uint32_t AllEdges = (1U << MaximumVertices) - 1U;

/** What depends on the parity alone: vertices, in the order of the edge masks. */
struct ParityTable
{
  int DiamondClass = 0;
  int VertexCount = 0;
  std::array<Point, MaximumVertices> Offsets{};
};

/** An edge between two vertices of a diamond, named by the diamond that owns it. */
struct OuterEdge
{
  std::uint8_t OwnerVertex = 0; ///< index of the younger end among this diamond's vertices
  std::uint8_t OwnerStep = 0;   ///< the owner's scale minus this diamond's: 0 or 1
  std::uint8_t OwnerEdge = 0;   ///< index of the edge in the owner's edge mask
};

/**
 * Half of a bisected tetrahedron: the central vertex and three vertices of the diamond, such that
 * (centre, V[0], V[1], V[2]) is positively oriented.
 */
struct HalfTetrahedron
{
  std::array<std::uint8_t, 3> Vertices{};
  std::uint16_t Mask = 0;                ///< the three vertices as an edge mask
  std::uint8_t Child = 0;                ///< index of the child diamond that it belongs to
  std::array<OuterEdge, 3> OuterEdges{}; ///< edge i lies opposite to vertex i
  /** Indices of Vertices from the youngest to the oldest; the centre is younger than all. */
  std::array<std::uint8_t, 3> ByAge{};
  bool OddByAge = false; ///< whether that is an odd permutation
};

/** All that follows from a diamond's type. */
struct TypeTable
{
  bool Valid = false;
  int DiamondClass = 0;
  int VertexCount = 0;
  std::array<Point, MaximumVertices> Offsets{};
  std::array<std::uint8_t, 2> Spine{}; ///< vertex indices of the spine's ends

  /** Children sit at position + offset in the same scale (class 0, 1), or at
   *  2 * position + offset in the next finer one (class 2). */
  int ChildCount = 0;
  int ChildStep = 0; ///< 0, or 1 when the children are of the next finer scale
  std::array<Point, MaximumChildren> ChildOffsets{};
  std::array<std::uint16_t, MaximumChildren> ChildMasks{}; ///< vertices of the duet as edge mask
  /** Half-tetrahedra come sorted by child, the same number for every child. */
  int HalfTetrahedraPerChild = 0;
  int HalfTetrahedronCount = 0;
  std::array<HalfTetrahedron, MaximumHalfTetrahedra> HalfTetrahedra{};

  /** Parents sit at position + offset in the same scale (class 1, 2), or at
   *  (position + offset) / 2 in the next coarser one (class 0); they are vertices. */
  int ParentCount = 0;
  int ParentStep = 0; ///< 0, or 1 when the parents are of the next coarser scale
  std::array<Point, 4> ParentOffsets{};
};

namespace tables
{

inline constexpr bool IsVertexOffset(int parity, const Point& offset)
{
  int oddMoves = 0;
  int evenMoves = 0;
  int oddAxes = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool odd = ((parity >> axis) & 1) != 0;
    oddAxes += odd ? 1 : 0;
    oddMoves += (odd && offset[axis] != 0) ? 1 : 0;
    evenMoves += (!odd && offset[axis] != 0) ? 1 : 0;
  }
  switch (oddAxes)
  {
    case 3: // the corners of the cube
      return oddMoves == 3;
    case 2: // the square's corners and the two apices
      return (oddMoves == 2 && evenMoves == 0) || (oddMoves == 0 && evenMoves == 1);
    case 1: // the spine, and the ring of eight around it
      return (oddMoves == 1 && evenMoves == 0) || (oddMoves == 0 && evenMoves > 0);
    default:
      return false;
  }
}

inline constexpr ParityTable MakeParity(int parity)
{
  ParityTable table;
  table.DiamondClass = 3 - ((parity & 1) + ((parity >> 1) & 1) + ((parity >> 2) & 1));
  for (int code = 0; code < 27; ++code)
  {
    const Point offset = { code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1 };
    if (IsVertexOffset(parity, offset))
    {
      table.Offsets[table.VertexCount++] = offset;
    }
  }
  return table;
}

inline constexpr std::array<ParityTable, 8> MakeParities()
{
  std::array<ParityTable, 8> all{};
  for (int parity = 1; parity < 8; ++parity)
  {
    all[parity] = MakeParity(parity);
  }
  return all;
}

inline constexpr std::array<ParityTable, 8> Parities = MakeParities();

inline constexpr int FindOffset(int parity, const Point& offset)
{
  for (int i = 0; i < Parities[parity].VertexCount; ++i)
  {
    const Point& candidate = Parities[parity].Offsets[i];
    if (candidate[0] == offset[0] && candidate[1] == offset[1] && candidate[2] == offset[2])
    {
      return i;
    }
  }
  return -1;
}

/** FindOffset() as a table: by parity, then by 9 z + 3 y + x, each plus 1. */
inline constexpr std::array<std::array<std::int8_t, 27>, 8> MakeOffsetIndices()
{
  std::array<std::array<std::int8_t, 27>, 8> indices{};
  for (int parity = 1; parity < 8; ++parity)
  {
    for (int code = 0; code < 27; ++code)
    {
      indices[parity][code] = static_cast<std::int8_t>(
        FindOffset(parity, { code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1 }));
    }
  }
  return indices;
}

inline constexpr std::array<std::array<std::int8_t, 27>, 8> OffsetIndices = MakeOffsetIndices();

inline constexpr int SquaredLength(const Point& a, const Point& b)
{
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
    (a[2] - b[2]) * (a[2] - b[2]);
}

inline constexpr int Determinant(const Point& a, const Point& b, const Point& c)
{
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/** The spine's first end: on every odd axis the end at an odd multiple of 2h. */
inline constexpr Point SpineEnd(int parity, int highBits)
{
  Point end = { 0, 0, 0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    if (((parity >> axis) & 1) != 0)
    {
      end[axis] = ((highBits >> axis) & 1) != 0 ? -1 : 1;
    }
  }
  return end;
}

/** Whether two ring vertices and the spine span a tetrahedron. */
inline constexpr bool IsRingEdge(int diamondClass, const Point& a, const Point& b)
{
  const int squaredLength = SquaredLength(a, b);
  return diamondClass == 0 ? squaredLength == 4
                           : (diamondClass == 1 ? squaredLength == 3 : squaredLength == 1);
}

/** Age and parity of a vertex at an offset; a smaller Age is younger. */
struct VertexAge
{
  int Step = 0; ///< its scale minus the diamond's; 2 stands for 2 and more
  int Parity = 0;
  int Age = 0;
};

inline constexpr VertexAge AgeOf(int parity, int highBits, const Point& offset)
{
  int low = 0;
  int high = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int position = ((parity >> axis) & 1) + 2 * ((highBits >> axis) & 1) + offset[axis] + 4;
    low |= (position & 1) << axis;
    high |= ((position >> 1) & 1) << axis;
  }
  VertexAge age;
  age.Step = low != 0 ? 0 : (high != 0 ? 1 : 2);
  age.Parity = low != 0 ? low : high;
  age.Age = 3 * age.Step + (age.Step == 2 ? 0 : 2 - Parities[age.Parity].DiamondClass);
  return age;
}

inline constexpr OuterEdge MakeOuterEdge(int parity, int highBits, int first, int second)
{
  const ParityTable& shape = Parities[parity];
  const VertexAge ageOfFirst = AgeOf(parity, highBits, shape.Offsets[first]);
  const VertexAge ageOfSecond = AgeOf(parity, highBits, shape.Offsets[second]);
  const bool firstOwns = ageOfFirst.Age < ageOfSecond.Age;
  const int owner = firstOwns ? first : second;
  const int other = firstOwns ? second : first;
  const VertexAge& age = firstOwns ? ageOfFirst : ageOfSecond;
  Point offset = { 0, 0, 0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    offset[axis] = (shape.Offsets[other][axis] - shape.Offsets[owner][axis]) / (1 << age.Step);
  }
  OuterEdge edge;
  edge.OwnerVertex = static_cast<std::uint8_t>(owner);
  edge.OwnerStep = static_cast<std::uint8_t>(age.Step);
  edge.OwnerEdge = static_cast<std::uint8_t>(FindOffset(age.Parity, offset));
  return edge;
}

/** The child that a half-tetrahedron belongs to: twice the offset of its longest edge's middle. */
inline constexpr Point ChildOf(const std::array<Point, 4>& corners)
{
  int longest = 0;
  Point middle = { 0, 0, 0 };
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      if (SquaredLength(corners[i], corners[j]) > longest)
      {
        longest = SquaredLength(corners[i], corners[j]);
        middle = corners[i] + corners[j];
      }
    }
  }
  return middle;
}

/** Sorts the vertices of a half-tetrahedron by age; all ages in a tetrahedron differ. */
inline constexpr void SortByAge(HalfTetrahedron& half, int parity, int highBits)
{
  std::array<int, 3> ages{};
  for (int i = 0; i < 3; ++i)
  {
    ages[i] = AgeOf(parity, highBits, Parities[parity].Offsets[half.Vertices[i]]).Age;
    half.ByAge[i] = static_cast<std::uint8_t>(i);
  }
  for (const int i : { 0, 1, 0 })
  {
    if (ages[half.ByAge[i]] > ages[half.ByAge[i + 1]])
    {
      const std::uint8_t older = half.ByAge[i];
      half.ByAge[i] = half.ByAge[i + 1];
      half.ByAge[i + 1] = older;
      half.OddByAge = !half.OddByAge;
    }
  }
}

inline constexpr HalfTetrahedron MakeHalf(int parity, int highBits, int end, int r1, int r2)
{
  const ParityTable& shape = Parities[parity];
  const bool positive = Determinant(shape.Offsets[end], shape.Offsets[r1], shape.Offsets[r2]) > 0;
  const int second = positive ? r1 : r2;
  const int third = positive ? r2 : r1;
  HalfTetrahedron half;
  half.Vertices = { static_cast<std::uint8_t>(end), static_cast<std::uint8_t>(second),
    static_cast<std::uint8_t>(third) };
  half.Mask = static_cast<std::uint16_t>((1 << end) | (1 << r1) | (1 << r2));
  half.OuterEdges = { MakeOuterEdge(parity, highBits, second, third),
    MakeOuterEdge(parity, highBits, third, end), MakeOuterEdge(parity, highBits, end, second) };
  SortByAge(half, parity, highBits);
  return half;
}

inline constexpr void AddHalfTetrahedra(TypeTable& table, int parity, int highBits)
{
  std::array<HalfTetrahedron, MaximumHalfTetrahedra> halves{};
  std::array<Point, MaximumHalfTetrahedra> children{};
  int count = 0;
  for (int r1 = 0; r1 < table.VertexCount; ++r1)
  {
    for (int r2 = r1 + 1; r2 < table.VertexCount; ++r2)
    {
      const bool onSpine = r1 == table.Spine[0] || r1 == table.Spine[1] || r2 == table.Spine[0] ||
        r2 == table.Spine[1];
      if (onSpine || !IsRingEdge(table.DiamondClass, table.Offsets[r1], table.Offsets[r2]))
      {
        continue;
      }
      for (int side = 0; side < 2; ++side)
      {
        const int end = table.Spine[side];
        halves[count] = MakeHalf(parity, highBits, end, r1, r2);
        children[count] =
          ChildOf({ Point{ 0, 0, 0 }, table.Offsets[end], table.Offsets[r1], table.Offsets[r2] });
        ++count;
      }
    }
  }
  // Sort by child; a child's first half-tetrahedron makes it known.
  table.HalfTetrahedronCount = 0;
  for (int first = 0; first < count; ++first)
  {
    bool known = false;
    for (int i = 0; i < first; ++i)
    {
      known = known || SquaredLength(children[i], children[first]) == 0;
    }
    for (int i = first; i < count && !known; ++i)
    {
      if (SquaredLength(children[i], children[first]) == 0)
      {
        HalfTetrahedron half = halves[i];
        half.Child = static_cast<std::uint8_t>(table.ChildCount);
        table.HalfTetrahedra[table.HalfTetrahedronCount++] = half;
        table.ChildMasks[table.ChildCount] |= half.Mask;
      }
    }
    if (!known)
    {
      const int unit = table.ChildStep == 0 ? 2 : 1;
      table.ChildOffsets[table.ChildCount++] = { children[first][0] / unit,
        children[first][1] / unit, children[first][2] / unit };
    }
  }
  table.HalfTetrahedraPerChild = table.HalfTetrahedronCount / table.ChildCount;
}

/** Parents are centred at the vertices whose diamonds made this diamond's tetrahedra: by the rules
 *  of the lattice those at +-h on the even axes (class 1 and 2), or the class 2 corners (class
 *  0). */
inline constexpr void AddParents(TypeTable& table, int parity, int highBits)
{
  table.ParentStep = table.DiamondClass == 0 ? 1 : 0;
  for (int i = 0; i < table.VertexCount; ++i)
  {
    const VertexAge age = AgeOf(parity, highBits, table.Offsets[i]);
    const int parentClass = table.DiamondClass == 0 ? 2 : table.DiamondClass - 1;
    if (age.Step == table.ParentStep && Parities[age.Parity].DiamondClass == parentClass)
    {
      table.ParentOffsets[table.ParentCount++] = table.Offsets[i];
    }
  }
}

inline constexpr TypeTable MakeType(int parity, int highBits)
{
  TypeTable table;
  if (parity == 0)
  {
    return table;
  }
  table.Valid = true;
  table.DiamondClass = Parities[parity].DiamondClass;
  table.VertexCount = Parities[parity].VertexCount;
  table.Offsets = Parities[parity].Offsets;
  table.ChildStep = table.DiamondClass == 2 ? 1 : 0;
  const Point end = SpineEnd(parity, highBits);
  table.Spine = { static_cast<std::uint8_t>(FindOffset(parity, end)),
    static_cast<std::uint8_t>(FindOffset(parity, -1 * end)) };
  AddHalfTetrahedra(table, parity, highBits);
  AddParents(table, parity, highBits);
  return table;
}

/** One constant per type: compilers limit the work that goes into a single one. */
template <std::size_t Type>
inline constexpr TypeTable TableOfType = MakeType(Type & 7, Type >> 3);

template <std::size_t... Type>
inline constexpr std::array<TypeTable, 64> MakeTypes(std::index_sequence<Type...> /*types*/)
{
  return { TableOfType<Type>... };
}

inline constexpr std::array<TypeTable, 64> Types = MakeTypes(std::make_index_sequence<64>());

}

/** The type of the diamond at a position: parity, then the next bit of every coordinate. */
inline constexpr int TypeOf(const Point& position)
{
  return Parity(position) | (Parity({ position[0] >> 1, position[1] >> 1, position[2] >> 1 }) << 3);
}

/** A position of a type, with room for parents on all sides. */
inline constexpr Point PositionOfType(int type)
{
  return { 8 + (type & 1) + ((type >> 2) & 2), 8 + ((type >> 1) & 1) + ((type >> 3) & 2),
    8 + ((type >> 2) & 1) + ((type >> 4) & 2) };
}

/** The shape of the diamond at a position; invalid where all three coordinates are even. */
inline constexpr const TypeTable& ShapeOf(const Point& position)
{
  return tables::Types[TypeOf(position)];
}

/** The result of make(position) for a diamond of each type, indexed by TypeOf. */
template <typename Make>
auto MakeByType(const Make& make)
{
  std::array<decltype(make(Point{})), 64> all{};
  for (int type = 0; type < 64; ++type)
  {
    const Point example = PositionOfType(type);
    if (ShapeOf(example).Valid)
    {
      all[type] = make(example);
    }
  }
  return all;
}

/** The index of a diamond's vertex at an offset, where there must be one. */
inline constexpr int VertexIndex(const Point& position, const Point& offset)
{
  return tables::OffsetIndices[Parity(position)][9 * offset[2] + 3 * offset[1] + offset[0] + 13];
}

/** A diamond's place: its position and the scale that the position belongs to. */
struct Place
{
  int Scale = 0;
  Point Position{};
};

/** A diamond's central vertex. */
inline constexpr Point Centre(const Place& place)
{
  return (1 << place.Scale) * place.Position;
}

/** A lattice point at an offset from a diamond's position, in its scale: a vertex, mostly. */
inline constexpr Point VertexAt(const Place& place, const Point& offset)
{
  return (1 << place.Scale) * (place.Position + offset);
}

/** The place of a child; Scale -1 for children below full resolution. */
inline constexpr Place ChildPlace(const TypeTable& shape, const Place& parent, int child)
{
  return { parent.Scale - shape.ChildStep,
    (1 << shape.ChildStep) * parent.Position + shape.ChildOffsets[child] };
}

/** The place of a parent. */
inline constexpr Place ParentPlace(const TypeTable& shape, const Place& child, int parent)
{
  const Point position = child.Position + shape.ParentOffsets[parent];
  const int step = shape.ParentStep;
  return { child.Scale + step, { position[0] >> step, position[1] >> step, position[2] >> step } };
}

/** The vertices of a diamond that have a sample, as an edge mask. */
inline std::uint32_t SampledVertices(const Grid& grid, const Place& place)
{
  const ParityTable& shape = tables::Parities[Parity(place.Position)];
  if (grid.IsSampled(VertexAt(place, { -1, -1, -1 })) &&
    grid.IsSampled(VertexAt(place, { 1, 1, 1 })))
  {
    return (1U << shape.VertexCount) - 1U;
  }
  std::uint32_t mask = 0;
  for (int i = 0; i < shape.VertexCount; ++i)
  {
    const Point vertex = VertexAt(place, shape.Offsets[i]);
    mask |= static_cast<std::uint32_t>(grid.IsSampled(vertex)) << i;
  }
  return mask;
}

}

#endif
