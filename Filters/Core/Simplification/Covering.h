// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Covering_h
#define isodiamond_Covering_h

#include "Patches/PatchDistance.h"
#include "Simplification/TriangleMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace isodiamond
{

/**
 * Shows that all of a triangle is near to a mesh.
 *
 * The points within a distance of a triangle form a convex set: a piece whose corners lie in it
 * does as a whole. So the triangle is cut into pieces, each assigned to one triangle of the mesh,
 * by walking over the mesh: what lies beyond an edge of a mesh triangle is cut off along the plane
 * through the edge and the mean of the two normals there, and passed on to the neighbour. Whatever
 * the planes, the pieces make up the whole triangle, so the distances of their corners bound those
 * of all its points; the planes only make the bound a good one.
 */
class Covering
{
public:
  static constexpr int MostCorners = 16;

  /** A convex polygon. */
  struct Piece
  {
    std::array<Vector, MostCorners> Corners;
    int Count = 0;

    void Add(const Vector& corner)
    {
      if (this->Count < MostCorners)
      {
        this->Corners[this->Count] = corner;
      }
      ++this->Count;
    }

    double Area() const { return AreaOf(this->Corners.data(), this->Count); }
  };

  /** @param positions,mesh must outlive it and stay as they are */
  Covering(const std::vector<Vector>& positions, const LinkedTriangles& mesh);

  /** Of a polygon. */
  static double AreaOf(const Vector* corners, int count)
  {
    Vector sum{};
    for (int i = 2; i < count; ++i)
    {
      sum = sum + Cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
    }
    return 0.5 * std::sqrt(Dot(sum, sum));
  }

  /** Unit normal of a triangle of the mesh; 0 if it has no area. */
  Vector Normal(std::uint32_t triangle) { return this->Of(triangle).Normal; }

  /** From a triangle of the mesh to a place. */
  double SquaredDistance(std::uint32_t triangle, const Vector& place)
  {
    return this->Of(triangle).Distance.Squared(place);
  }

  /** Whether a place is over a triangle of the mesh, seen along its normal. */
  bool IsOver(std::uint32_t triangle, const Vector& place)
  {
    return this->Of(triangle).Distance.IsOver(place);
  }

  /** Whether all corners of a piece are within a distance of a triangle of the mesh. */
  bool IsNear(std::uint32_t triangle, const Vector* corners, int count, double allowed)
  {
    const TriangleDistance& distance = this->Of(triangle).Distance;
    return std::all_of(corners, corners + count,
      [&](const Vector& corner) { return distance.Squared(corner) <= allowed * allowed; });
  }

  /** Which of some triangles of the mesh is nearest to a place. @pre there is one */
  template <typename Triangles>
  std::uint32_t NearestOf(const Triangles& triangles, const Vector& place)
  {
    std::uint32_t nearest = *triangles.begin();
    double least = HUGE_VAL;
    for (const std::uint32_t triangle : triangles)
    {
      const double squared = this->Of(triangle).Distance.Squared(place);
      if (squared < least)
      {
        least = squared;
        nearest = triangle;
      }
    }
    return nearest;
  }

  /**
   * Cuts a triangle into pieces.
   *
   * @param start a triangle of the mesh nearby
   * @param near a piece within this distance of a triangle of the mesh need not be cut
   * @param use (triangle of the mesh, piece) -> whether to go on
   * @return whether all pieces were used; false if the way is too long
   */
  template <typename Use>
  bool Cut(const std::array<Vector, 3>& corners, std::uint32_t start, double near, Use&& use)
  {
    Piece piece;
    piece.Count = 3;
    std::copy(corners.begin(), corners.end(), piece.Corners.begin());
    Way way;
    way.Near = near * near;
    return this->Walk(piece, start, way, use);
  }

  /**
   * The same, but a piece that is not near to the triangle where its walk ended is compared with
   * those around that triangle.
   *
   * @param allowed how far away a piece may be
   * @param begin called before the pieces are used, and again before a second attempt if that fails
   * @param use (triangle of the mesh, corners of a piece, their count) -> whether it is near enough
   */
  template <typename Begin, typename Use>
  bool Covers(const std::array<Vector, 3>& corners, std::uint32_t start, double allowed,
    Begin&& begin, Use&& use)
  {
    const auto lookAround = [&](const std::array<Vector, 3>& piece, std::uint32_t from, int depth)
    {
      return this->LookAround(piece, from, allowed, depth,
        [&](std::uint32_t triangle, const std::array<Vector, 3>& part)
        { return use(triangle, part.data(), 3); });
    };
    begin();
    bool isFar = false;
    const bool isCovered = this->Cut(corners, start, UncutPart * allowed,
      [&](std::uint32_t triangle, const Piece& piece)
      {
        if (use(triangle, piece.Corners.data(), piece.Count))
        {
          return true;
        }
        for (int i = 2; i < piece.Count && !isFar; ++i)
        {
          isFar = !lookAround(
            { piece.Corners[0], piece.Corners[i - 1], piece.Corners[i] }, triangle, DepthOfPiece);
        }
        return !isFar;
      });
    if (!isCovered)
    {
      begin();
    }
    return isCovered || lookAround(corners, start, isFar ? DepthOfPiece : DepthOfWhole);
  }

  /** Cuts a triangle in four until each piece is near to one of some triangles of the mesh.
   *  @param around these triangles @param reachOf (triangle) -> how far away it is of interest
   *  @param depth how often it is cut at most
   *  @param use (triangle of the mesh, piece) -> whether the piece is near enough to it */
  template <typename ReachOf, typename Use>
  bool IsNearAround(const std::array<Vector, 3>& corners, const std::vector<std::uint32_t>& around,
    const ReachOf& reachOf, int depth, Use&& use)
  {
    // The nearest to the middle first.
    const auto [middle, radius] = BallAround(corners);
    std::vector<std::pair<double, std::uint32_t>> near;
    bool isAnyInReach = false;
    for (const std::uint32_t triangle : around)
    {
      const double squared = this->Of(triangle).Distance.Squared(middle);
      const double reach = reachOf(triangle);
      isAnyInReach = isAnyInReach || squared <= reach * reach;
      if (squared <= (reach + radius) * (reach + radius))
      {
        near.emplace_back(squared, triangle);
      }
    }
    if (!isAnyInReach)
    {
      return false;
    }
    std::sort(near.begin(), near.end());
    std::vector<std::uint32_t> left;
    for (const auto& [squared, triangle] : near)
    {
      const double reach = reachOf(triangle);
      if (squared <= reach * reach && use(triangle, corners))
      {
        return true;
      }
      left.push_back(triangle);
    }
    if (depth == 0)
    {
      return false;
    }
    const std::array<Vector, 3> sides = { 0.5 * (corners[0] + corners[1]),
      0.5 * (corners[1] + corners[2]), 0.5 * (corners[2] + corners[0]) };
    return this->IsNearAround(sides, left, reachOf, depth - 1, use) &&
      this->IsNearAround({ corners[0], sides[0], sides[2] }, left, reachOf, depth - 1, use) &&
      this->IsNearAround({ corners[1], sides[1], sides[0] }, left, reachOf, depth - 1, use) &&
      this->IsNearAround({ corners[2], sides[2], sides[1] }, left, reachOf, depth - 1, use);
  }

private:
  /** Pieces nearer than this part of the allowed distance are not cut any further. */
  static constexpr double UncutPart = 0.3;
  /** How often a piece found by walking is cut in four, and a triangle that is too large to walk
   * over: where a piece was already too far away, more cuts are not worth it. */
  static constexpr int DepthOfPiece = 3;
  static constexpr int DepthOfWhole = 5;

  struct Ball
  {
    Vector Middle;
    double Radius = 0.0;
  };
  static Ball BallAround(const std::array<Vector, 3>& corners)
  {
    Ball ball{ (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]) };
    for (const Vector& corner : corners)
    {
      const Vector way = corner - ball.Middle;
      ball.Radius = std::max(ball.Radius, std::sqrt(Dot(way, way)));
    }
    return ball;
  }

  /** For where walking finds no good pieces; takes longer: IsNearAround() of the triangles around
   *  where it ended. */
  template <typename Use>
  bool LookAround(
    const std::array<Vector, 3>& corners, std::uint32_t start, double reach, int depth, Use&& use)
  {
    const std::vector<std::uint32_t> around = this->Around(corners, start, reach);
    return this->IsNearAround(
      corners, around, [reach](std::uint32_t) { return reach; }, depth, use);
  }

  /** Triangles that may be within reach, connected to the start. */
  std::vector<std::uint32_t> Around(
    const std::array<Vector, 3>& corners, std::uint32_t start, double reach);

  static constexpr int MostSteps = 1000;

  /** The inward normal of the plane through an edge. */
  Vector PlaneOf(std::uint32_t triangle, int edge, std::uint32_t neighbour)
  {
    const Vector along = this->Corner(triangle, (edge + 1) % 3) - this->Corner(triangle, edge);
    return Cross(this->Normal(triangle) + this->Normal(neighbour), along);
  }

  /** Cuts a piece in two by a plane. @return whether anything lies beyond */
  static bool Split(
    const Piece& piece, const Vector& at, const Vector& normal, Piece& inside, Piece& beyond);

  /** From the start to the triangle where a piece is. No triangle is on it twice: otherwise it
   *  could go in circles around a sharp point. */
  struct Way
  {
    static constexpr int Longest = 100;
    std::array<std::uint32_t, Longest> Triangles;
    int Length = 0;
    int Steps = 0;     ///< of all ways so far
    double Near = 0.0; ///< squared

    bool Has(std::uint32_t triangle) const
    {
      const auto end = this->Triangles.begin() + this->Length;
      return std::find(this->Triangles.begin(), end, triangle) != end;
    }
  };

  double SquaredDistance(std::uint32_t triangle, const Piece& piece)
  {
    const TriangleDistance& distance = this->Of(triangle).Distance;
    double squared = 0.0;
    for (int i = 0; i < piece.Count; ++i)
    {
      squared = std::max(squared, distance.Squared(piece.Corners[i]));
    }
    return squared;
  }

  template <typename Use>
  bool Walk(Piece& piece, std::uint32_t triangle, Way& way, Use&& use)
  {
    if (++way.Steps > MostSteps || way.Length == Way::Longest)
    {
      return false;
    }
    if (this->SquaredDistance(triangle, piece) > way.Near)
    {
      way.Triangles[way.Length++] = triangle;
      for (int edge = 0; edge < 3; ++edge)
      {
        const std::uint32_t neighbour = this->Mesh.Neighbours[triangle][edge];
        Piece inside;
        Piece beyond;
        if (neighbour == None || way.Has(neighbour) ||
          !Split(piece, this->Corner(triangle, edge), this->PlaneOf(triangle, edge, neighbour),
            inside, beyond))
        {
          continue;
        }
        if (inside.Count > MostCorners || beyond.Count > MostCorners ||
          !this->Walk(beyond, neighbour, way, use))
        {
          return false;
        }
        piece = inside;
        if (inside.Count == 0)
        {
          --way.Length;
          return true;
        }
      }
      --way.Length;
    }
    return use(triangle, piece);
  }

  const Vector& Corner(std::uint32_t triangle, int i) const
  {
    return this->Positions[this->Mesh.Triangles[triangle][i]];
  }

  /** What distances from a triangle are computed with. */
  struct Base
  {
    std::uint32_t Triangle = None;
    Vector Normal{};
    TriangleDistance Distance;
  };
  /** A part's triangles are numbered across the whole mesh: with fewer slots, neighbours would
   *  evict each other. */
  static constexpr std::size_t MostRecent = 2048;

  /** Kept for those used last, one in each slot: neighbours are asked for again and again. */
  const Base& Of(std::uint32_t triangle)
  {
    Base& base = this->Recent[triangle % MostRecent];
    if (base.Triangle != triangle)
    {
      const auto [a, b, c] = this->Mesh.Corners(this->Positions, triangle);
      base = { triangle, Unit(Cross(b - a, c - a)), { a, b, c } };
    }
    return base;
  }

  const std::vector<Vector>& Positions;
  const LinkedTriangles& Mesh;
  std::vector<Base> Recent;
  std::vector<std::uint32_t> Looks; ///< by triangle: the last look around that came across it
  std::uint32_t LookCount = 0;
};

}

#endif
