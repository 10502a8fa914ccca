// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/TriangleIntersection.h"

#include "Simplification/Orientation.h"

#include <algorithm>
#include <array>

namespace isodiamond
{
namespace
{

using Places = std::array<Vector, 3>;
using Signs = std::array<int, 3>;

bool AreAll(const Signs& signs, int sign)
{
  return std::all_of(signs.begin(), signs.end(), [sign](int each) { return each == sign; });
}

/** How a plane is seen along one of the axes. */
class View
{
public:
  /** Along the first axis along which a triangle has an area, if there is one. */
  explicit View(const Places& triangle)
  {
    while (this->Axis < 3 && this->Turn(triangle[0], triangle[1], triangle[2]) == 0)
    {
      ++this->Axis;
    }
  }

  bool IsThere() const { return this->Axis < 3; }

  int Turn(const Vector& a, const Vector& b, const Vector& c) const
  {
    return Orientation(this->See(a), this->See(b), this->See(c));
  }

private:
  PlanePoint See(const Vector& point) const
  {
    return { point[(this->Axis + 1) % 3], point[(this->Axis + 2) % 3] };
  }

  int Axis = 0;
};

/** Whether an edge in the plane of a triangle meets it: no line along a side of the triangle, or
 * along the edge, separates them. */
bool MeetsInPlane(const Vector& from, const Vector& to, const Places& triangle)
{
  const View view(triangle);
  if (!view.IsThere())
  {
    return false; // its own edges tell
  }
  const int inside = view.Turn(triangle[0], triangle[1], triangle[2]);
  Signs sides{};
  for (int i = 0; i < 3; ++i)
  {
    const Vector& next = triangle[(i + 1) % 3];
    if (view.Turn(triangle[i], next, from) == -inside &&
      view.Turn(triangle[i], next, to) == -inside)
    {
      return false;
    }
    sides[i] = view.Turn(from, to, triangle[i]);
  }
  return !AreAll(sides, 1) && !AreAll(sides, -1);
}

/** Two triangles, and on which side of the other one's plane each corner is. */
class Pair
{
public:
  Pair(const Places& a, const Places& b)
    : A(a)
    , B(b)
    , SidesOfA(SidesOf(a, b))
    , SidesOfB(SidesOf(b, a))
  {
  }

  /** Whether edge i of a triangle, from its corner i to the next one, meets the other triangle. */
  bool DoesEdgeOfAMeet(int i) const { return DoesEdgeMeet(this->A, this->SidesOfA, i, this->B); }
  bool DoesEdgeOfBMeet(int i) const { return DoesEdgeMeet(this->B, this->SidesOfB, i, this->A); }

private:
  static Signs SidesOf(const Places& corners, const Places& plane)
  {
    Signs sides{};
    for (int i = 0; i < 3; ++i)
    {
      sides[i] = Orientation(plane[0], plane[1], plane[2], corners[i]);
    }
    return sides;
  }

  static bool DoesEdgeMeet(const Places& corners, const Signs& sides, int i, const Places& triangle)
  {
    const int next = (i + 1) % 3;
    if (sides[i] * sides[next] > 0)
    {
      return false;
    }
    if (sides[i] == 0 && sides[next] == 0)
    {
      return MeetsInPlane(corners[i], corners[next], triangle);
    }
    // The edge's line meets the plane in one point, which is inside if it passes all sides alike.
    Signs turns{};
    for (int k = 0; k < 3; ++k)
    {
      turns[k] = Orientation(corners[i], corners[next], triangle[k], triangle[(k + 1) % 3]);
    }
    return std::count(turns.begin(), turns.end(), 1) == 0 ||
      std::count(turns.begin(), turns.end(), -1) == 0;
  }

  const Places& A;
  const Places& B;
  Signs SidesOfA;
  Signs SidesOfB;
};

/** Whether two triangles with a common edge lie on each other. @param a,b the edge @param c,d what
 *  is opposite to it */
bool AreFolded(const Vector& a, const Vector& b, const Vector& c, const Vector& d)
{
  if (Orientation(a, b, c, d) != 0)
  {
    return false;
  }
  const View view({ a, b, c });
  return !view.IsThere() || view.Turn(a, b, c) != -view.Turn(a, b, d);
}

}

bool Intersect(const std::vector<Vector>& positions, const Triangle& a, const Triangle& b)
{
  const auto placesOf = [&](const Triangle& triangle) -> Places {
    return { positions[triangle[0]], positions[triangle[1]], positions[triangle[2]] };
  };
  const Places placesOfA = placesOf(a);
  const Places placesOfB = placesOf(b);
  // Corners in common, and the last place in each that is not, or is.
  int common = 0;
  std::array<int, 2> same{};
  std::array<int, 2> other{ 3, 3 }; // the sum of all places
  for (int i = 0; i < 3; ++i)
  {
    const auto at = std::find(b.begin(), b.end(), a[i]);
    if (at != b.end())
    {
      ++common;
      same = { i, static_cast<int>(at - b.begin()) };
      other = { other[0] - same[0], other[1] - same[1] };
    }
  }
  if (common == 3)
  {
    return true;
  }
  if (common == 2)
  {
    const int place = other[0];
    return AreFolded(placesOfA[(place + 1) % 3], placesOfA[(place + 2) % 3], placesOfA[place],
      placesOfB[other[1]]);
  }
  const Pair pair(placesOfA, placesOfB);
  if (common == 1)
  {
    // What else they have in common reaches an edge opposite to that corner.
    return pair.DoesEdgeOfAMeet((same[0] + 1) % 3) || pair.DoesEdgeOfBMeet((same[1] + 1) % 3);
  }
  for (int i = 0; i < 3; ++i)
  {
    if (pair.DoesEdgeOfAMeet(i) || pair.DoesEdgeOfBMeet(i))
    {
      return true;
    }
  }
  return false;
}

}
