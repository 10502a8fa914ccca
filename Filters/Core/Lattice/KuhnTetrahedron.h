// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_KuhnTetrahedron_h
#define isodiamond_KuhnTetrahedron_h

#include "Lattice/DiamondTables.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{

/**
 * A tetrahedron of class 0 by its corners, in the order of a path along three edges of the cube
 * that it lies in, from one corner of the cube to the opposite one. A Corner has a Position and
 * whatever the caller wants to know there; middle(a, b) makes the corner halfway between two
 * others.
 */
template <typename Corner>
using KuhnTetrahedron = std::array<Corner, 4>;

/** Bisects the edge between the first and another corner. Done for the last corner of a path, then
 *  the second to last and the second, this gives eight paths in cubes of half the size
 *  (Maubach). */
template <typename Corner, typename Middle>
std::array<KuhnTetrahedron<Corner>, 2> Bisect(
  const KuhnTetrahedron<Corner>& whole, int last, const Middle& middle)
{
  std::array<KuhnTetrahedron<Corner>, 2> halves = { whole, whole };
  std::copy(whole.begin() + 1, whole.begin() + last + 1, halves[1].begin());
  halves[0][last] = middle(whole[0], whole[last]);
  halves[1][last] = halves[0][last];
  return halves;
}

/** Calls body(eighth) for the eight paths. */
template <typename Corner, typename Middle, typename Body>
void ForEachEighth(const KuhnTetrahedron<Corner>& whole, const Middle& middle, const Body& body)
{
  for (const KuhnTetrahedron<Corner>& half : Bisect(whole, 3, middle))
  {
    for (const KuhnTetrahedron<Corner>& quarter : Bisect(half, 2, middle))
    {
      for (const KuhnTetrahedron<Corner>& eighth : Bisect(quarter, 1, middle))
      {
        body(eighth);
      }
    }
  }
}

template <typename Corner>
std::int64_t SquaredDistance(const Corner& a, const Corner& b)
{
  std::int64_t sum = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t difference = a.Position[axis] - b.Position[axis];
    sum += difference * difference;
  }
  return sum;
}

/** Bisects the longest edge of a tetrahedron a number of times, down to class 0, and calls
 *  body(path). */
template <typename Corner, typename Middle, typename Body>
void CutIntoPaths(
  KuhnTetrahedron<Corner> whole, int bisections, const Middle& middle, const Body& body)
{
  std::array<int, 2> longest = { 0, 1 };
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      const bool isLonger =
        SquaredDistance(whole[i], whole[j]) > SquaredDistance(whole[longest[0]], whole[longest[1]]);
      longest = isLonger ? std::array<int, 2>{ i, j } : longest;
    }
  }
  std::swap(whole[0], whole[longest[0]]);
  std::swap(whole[3], whole[longest[1]]);
  if (bisections > 0)
  {
    for (const KuhnTetrahedron<Corner>& half : Bisect(whole, 3, middle))
    {
      CutIntoPaths(half, bisections - 1, middle, body);
    }
    return;
  }
  if (SquaredDistance(whole[0], whole[1]) > SquaredDistance(whole[0], whole[2]))
  {
    std::swap(whole[1], whole[2]);
  }
  body(whole);
}

/** Cuts a diamond's tetrahedra into paths along edges of length 2^scale. @param vertices of the
 *  diamond as corners, in the order of its shape */
template <typename Corner, typename Middle, typename Body>
void CutIntoPaths(const TypeTable& shape, const std::array<Corner, MaximumVertices>& vertices,
  const Middle& middle, const Body& body)
{
  const Corner centre = middle(vertices[shape.Spine[0]], vertices[shape.Spine[1]]);
  for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
  {
    const std::array<std::uint8_t, 3>& v = shape.HalfTetrahedra[i].Vertices;
    CutIntoPaths<Corner>({ centre, vertices[v[0]], vertices[v[1]], vertices[v[2]] },
      2 - shape.DiamondClass, middle, body);
  }
}

/** The lattice point halfway between two others. */
inline Point MiddleOf(const Point& a, const Point& b)
{
  const Point sum = a + b;
  return { sum[0] / 2, sum[1] / 2, sum[2] / 2 };
}

}

#endif
