// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceLattice_h
#define ReferenceLattice_h

#include <array>
#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

/**
 * A slow and plain implementation of isodiamond hierarchies (Weiss and De Floriani, "Isodiamond
 * Hierarchies", TVCG 2010), against which the library is tested. It prefers definitions to
 * formulas: tetrahedra are really bisected, domains are really enumerated, walks are really
 * repeated.
 */
namespace reference
{

/** A lattice point (x, y, z). */
using Point = std::array<int, 3>;

struct PointHash
{
  std::size_t operator()(const Point& point) const;
};

/** The order of the samples in a grid: by z, then y, then x. */
bool InGridOrder(const Point& a, const Point& b);

Point Sum(const Point& a, const Point& b);

/** A tetrahedron of the nested mesh. The order of its vertices means nothing. */
struct Tetrahedron
{
  std::array<Point, 4> Vertices;

  /** The two ends of the longest edge, which bisection never leaves ambiguous. */
  std::array<Point, 2> LongestEdge() const;
};

/**
 * A diamond: all tetrahedra that share their longest edge, the spine. Only tetrahedra that belong
 * to the grid are listed, so diamonds at the grid's border are incomplete.
 */
struct Diamond
{
  /** The central vertex, at the middle of the spine. */
  Point Center;
  std::array<Point, 2> Spine;
  /** The number of bisections that lead from the base cube to this diamond's tetrahedra. */
  int Depth = 0;
  std::vector<Tetrahedron> Tetrahedra;
  /** For every tetrahedron, the parent whose bisection made it; -1 in the root. */
  std::vector<int> Origins;
  /** The vertices of the tetrahedra, in grid order, sampled or not, without the central vertex. */
  std::vector<Point> Vertices;
  /** Indices of the diamonds whose bisection makes tetrahedra of this one, ascending. */
  std::vector<int> Parents;
  /** Indices of the diamonds that hold the halves of this diamond's tetrahedra, ascending. */
  std::vector<int> Children;
  /** Whether one of the vertices has no sample. */
  bool SticksOut = false;

  /** After three steps bisection repeats itself at half the size: one level. */
  int Level() const { return this->Depth / 3; }
  /** 0, 1, 2: the spine is a diagonal of a cube, a diagonal of a face, an edge of a cube. */
  int Class() const { return this->Depth % 3; }
};

/**
 * The hierarchy of all diamonds over a grid: the paper's HD without the field.
 *
 * The samples lie at the integer points from 0 to dims - 1. The base cube [0, 2^N]^3, N >= 1, is
 * the smallest that covers them; it starts as six tetrahedra around the diagonal from the origin.
 * Every tetrahedron is bisected at the middle of its longest edge as long as that is a lattice
 * point. A tetrahedron belongs to the grid if its bounding box shares volume with the sampled box;
 * all others are ignored. So the hierarchy depends on dims alone and knows no field.
 */
class Hierarchy
{
public:
  explicit Hierarchy(const Point& dims);

  const Point& Dims() const { return this->GridDims; }
  /** N of the base cube [0, 2^N]^3. */
  int BaseExponent() const { return this->Exponent; }
  int BaseSize() const { return 1 << this->Exponent; }

  bool IsSampled(const Point& point) const;
  bool BelongsToGrid(const Tetrahedron& tetrahedron) const;

  /** Whether a point is one of the eight corners of the base cube. */
  bool IsBaseCorner(const Point& point) const;
  /** The six tetrahedra of the base cube. They are those of the root too. */
  std::vector<Tetrahedron> BaseTetrahedra() const;
  /** The base cube's own 19 edges, which belong to no diamond, each as (younger, older). */
  std::vector<std::array<Point, 2>> BaseEdges() const;

  /** All diamonds, ancestors before descendants; the root has index 0. */
  const std::vector<Diamond>& Diamonds() const { return this->AllDiamonds; }
  const Diamond& At(int index) const { return this->AllDiamonds[index]; }
  int Size() const { return static_cast<int>(this->AllDiamonds.size()); }
  /** The index of the diamond with this central vertex; -1 if there is none. */
  int Find(const Point& center) const;
  /** The index of the diamond that a tetrahedron lies in; -1 if it is one of full resolution. */
  int DiamondOf(const Tetrahedron& tetrahedron) const;

  /** The two halves of a tetrahedron, cut at the middle of its longest edge. */
  static std::array<Tetrahedron, 2> Bisect(const Tetrahedron& tetrahedron);

  /**
   * When a vertex came into being; larger is younger. For a central vertex this is the depth of its
   * diamond. For the corners of the base cube it is negative, as if the base cube were one of the
   * cubes of an endless lattice.
   */
  int Age(const Point& vertex) const;
  /** An edge as (younger end, older end). */
  std::array<Point, 2> YoungerFirst(const Point& a, const Point& b) const;

private:
  void AddTetrahedron(const Tetrahedron& tetrahedron, int origin, int depth);
  void ListVertices(Diamond& diamond) const;

  Point GridDims;
  int Exponent = 1;
  std::vector<Diamond> AllDiamonds;
  std::unordered_map<Point, int, PointHash> Indices;
};

}

#endif
