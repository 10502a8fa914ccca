// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Covering_h
#define isodiamond_Covering_h

#include "Patches/PatchDistance.h"
#include "Simplification/TriangleMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isodiamond
{

/**
 * Shows that a triangle is near to a mesh, all of it.
 *
 * What lies within a distance of a triangle is convex: a piece whose corners do does so as a whole.
 * So the triangle is cut into pieces, each of which belongs to one triangle of the mesh, by walking
 * over the mesh: what lies beyond an edge of a mesh's triangle is cut off along the plane through
 * the edge and the mean of the two normals there, and goes on to the neighbour. Whatever planes
 * cut, the pieces are all of the triangle, so the distances of their corners bound those of all
 * points; the planes only make the bound a good one.
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

  /** @param mesh,connectivity must outlive it, and be without fault */
  Covering(const TriangleMesh& mesh, const Connectivity& connectivity);

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
  const Vector& Normal(std::uint32_t triangle) const { return this->Normals[triangle]; }

  /** Whether all corners of a piece are so near to a triangle of the mesh. */
  bool IsNear(std::uint32_t triangle, const Vector* corners, int count, double allowed) const
  {
    const TriangleDistance& distance = this->Distances[triangle];
    return std::all_of(corners, corners + count,
      [&](const Vector& corner) { return distance.Squared(corner) <= allowed * allowed; });
  }

  /** The triangle at a point of the mesh that is nearest to a place. @pre the point is used */
  std::uint32_t NearestAt(std::uint32_t point, const Vector& place) const;

  /**
   * Cuts a triangle into pieces.
   *
   * @param start a triangle of the mesh nearby
   * @param near a piece that is so near to a triangle of the mesh need not be cut
   * @param use (triangle of the mesh, greatest distance of the piece from it, piece) -> whether to
   * go on
   * @return whether all pieces were used; not if the way is too long
   */
  template <typename Use>
  bool Cut(const std::array<Vector, 3>& corners, std::uint32_t start, double near, Use&& use) const
  {
    Piece piece;
    piece.Count = 3;
    std::copy(corners.begin(), corners.end(), piece.Corners.begin());
    Way way;
    way.Near = near * near;
    return this->Walk(piece, start, way, use);
  }

  /**
   * The same where walking finds no good pieces, which takes longer: a triangle is cut in four
   * until each piece is near to any of the triangles around.
   *
   * @param reach how far away from it triangles are of interest
   * @param use (triangle of the mesh, piece) -> whether the piece is near enough to it
   * @return whether all pieces were
   */
  template <typename Use>
  bool LookAround(
    const std::array<Vector, 3>& corners, std::uint32_t start, double reach, Use&& use) const
  {
    const std::vector<std::uint32_t> around = this->Around(corners, start, reach);
    return this->IsNearAround(corners, around, reach, 0, use);
  }

  /**
   * Both: what is not near to the triangle that it was walked to is looked at around that.
   *
   * @param allowed how far away a piece may be
   * @param use (triangle of the mesh, corners of a piece, their count) -> whether it is near enough
   */
  template <typename Use>
  bool Covers(
    const std::array<Vector, 3>& corners, std::uint32_t start, double allowed, Use&& use) const
  {
    const auto lookAround = [&](const std::array<Vector, 3>& piece, std::uint32_t from)
    {
      return this->LookAround(piece, from, allowed,
        [&](std::uint32_t triangle, const std::array<Vector, 3>& part)
        { return use(triangle, part.data(), 3); });
    };
    bool isFar = false;
    return this->Cut(corners, start, UncutPart * allowed,
             [&](std::uint32_t triangle, double /*distance*/, const Piece& piece)
             {
               if (use(triangle, piece.Corners.data(), piece.Count))
               {
                 return true;
               }
               for (int i = 2; i < piece.Count && !isFar; ++i)
               {
                 isFar = !lookAround(
                   { piece.Corners[0], piece.Corners[i - 1], piece.Corners[i] }, triangle);
               }
               return !isFar;
             }) ||
      lookAround(corners, start);
  }

private:
  /** Pieces that are nearer than this part of what is allowed are not cut any further. */
  static constexpr double UncutPart = 0.3;
  static constexpr int MostDepth = 5;

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

  /** Triangles that may be within reach, connected to the start. */
  std::vector<std::uint32_t> Around(
    const std::array<Vector, 3>& corners, std::uint32_t start, double reach) const;

  template <typename Use>
  bool IsNearAround(const std::array<Vector, 3>& corners, const std::vector<std::uint32_t>& around,
    double reach, int depth, Use&& use) const
  {
    // Those nearest to the middle first.
    const auto [middle, radius] = BallAround(corners);
    std::vector<std::pair<double, std::uint32_t>> near;
    for (const std::uint32_t triangle : around)
    {
      const double squared = this->Distances[triangle].Squared(middle);
      if (squared <= (reach + radius) * (reach + radius))
      {
        near.emplace_back(squared, triangle);
      }
    }
    std::sort(near.begin(), near.end());
    if (near.empty() || near.front().first > reach * reach)
    {
      return false;
    }
    std::vector<std::uint32_t> left;
    for (const auto& [squared, triangle] : near)
    {
      if (squared <= reach * reach && use(triangle, corners))
      {
        return true;
      }
      left.push_back(triangle);
    }
    if (depth == MostDepth)
    {
      return false;
    }
    const std::array<Vector, 3> sides = { 0.5 * (corners[0] + corners[1]),
      0.5 * (corners[1] + corners[2]), 0.5 * (corners[2] + corners[0]) };
    return this->IsNearAround(sides, left, reach, depth + 1, use) &&
      this->IsNearAround({ corners[0], sides[0], sides[2] }, left, reach, depth + 1, use) &&
      this->IsNearAround({ corners[1], sides[1], sides[0] }, left, reach, depth + 1, use) &&
      this->IsNearAround({ corners[2], sides[2], sides[1] }, left, reach, depth + 1, use);
  }

  static constexpr int MostSteps = 1000;

  /** The inward normal of the plane through an edge. */
  Vector PlaneOf(std::uint32_t triangle, int edge, std::uint32_t neighbour) const
  {
    const Vector along =
      this->Mesh.Corner(triangle, (edge + 1) % 3) - this->Mesh.Corner(triangle, edge);
    return Cross(this->Normals[triangle] + this->Normals[neighbour], along);
  }

  /** Cuts a piece in two by a plane. @return whether anything lies beyond */
  static bool Split(
    const Piece& piece, const Vector& at, const Vector& normal, Piece& inside, Piece& beyond);

  /** From the start to the triangle where a piece is. No triangle is on it twice: around a sharp
   *  point it could lead in circles. */
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

  double SquaredDistance(const Piece& piece, std::uint32_t triangle) const
  {
    double squared = 0.0;
    for (int i = 0; i < piece.Count; ++i)
    {
      squared = std::max(squared, this->Distances[triangle].Squared(piece.Corners[i]));
    }
    return squared;
  }

  template <typename Use>
  bool Walk(Piece& piece, std::uint32_t triangle, Way& way, Use&& use) const
  {
    if (++way.Steps > MostSteps || way.Length == Way::Longest)
    {
      return false;
    }
    double squared = this->SquaredDistance(piece, triangle);
    if (squared > way.Near)
    {
      way.Triangles[way.Length++] = triangle;
      for (int edge = 0; edge < 3; ++edge)
      {
        const std::uint32_t neighbour = this->Links.Neighbour(triangle, edge);
        Piece inside;
        Piece beyond;
        if (neighbour == Connectivity::None || way.Has(neighbour) ||
          !Split(piece, this->Mesh.Corner(triangle, edge), this->PlaneOf(triangle, edge, neighbour),
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
      squared = this->SquaredDistance(piece, triangle);
    }
    return use(triangle, std::sqrt(squared), piece);
  }

  const TriangleMesh& Mesh;
  const Connectivity& Links;
  std::vector<Vector> Normals;
  std::vector<TriangleDistance> Distances;
};

/**
 * Visits the triangles of a mesh, each with a triangle of another one nearby: those with a place
 * first, then those at points that the other mesh has, too, then their neighbours, from where each
 * of them ended.
 *
 * @param links,otherLinks of the mesh, and of the other one, which cover is over
 * @param places by triangle: of the other mesh; None where nothing is known
 * @param waiting triangles with a place
 * @param visit (triangle, place): may change the place to where it ended
 */
template <typename Visit>
void ForEachFromPlace(const TriangleMesh& mesh, const Connectivity& links,
  const Connectivity& otherLinks, const Covering& cover, std::vector<std::uint32_t>& places,
  std::vector<std::uint32_t>& waiting, Visit&& visit)
{
  const auto count = static_cast<std::uint32_t>(mesh.Triangles.size());
  for (std::uint32_t i = 0; i < count; ++i)
  {
    for (const std::uint32_t point : mesh.Triangles[i])
    {
      if (places[i] == Connectivity::None && otherLinks.IsUsed(point))
      {
        places[i] = cover.NearestAt(point, mesh.Middle(i));
        waiting.push_back(i);
      }
    }
  }
  for (std::size_t at = 0; at < waiting.size(); ++at)
  {
    const std::uint32_t i = waiting[at];
    visit(i, places[i]);
    for (int edge = 0; edge < 3; ++edge)
    {
      const std::uint32_t neighbour = links.Neighbour(i, edge);
      if (neighbour != Connectivity::None && places[neighbour] == Connectivity::None)
      {
        places[neighbour] = places[i];
        waiting.push_back(neighbour);
      }
    }
  }
}

}

#endif
