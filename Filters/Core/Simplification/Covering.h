// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Covering_h
#define isodiamond_Covering_h

#include "Patches/PatchDistance.h"
#include "Simplification/TriangleMesh.h"

#include <algorithm>
#include <array>
#include <cmath>

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
  /** @param mesh,connectivity must outlive it, and be without fault */
  Covering(const TriangleMesh& mesh, const Connectivity& connectivity);

  /** Unit normal of a triangle of the mesh; 0 if it has no area. */
  const Vector& Normal(std::uint32_t triangle) const { return this->Normals[triangle]; }

  /** The triangle at a point of the mesh that is nearest to a place. @pre the point is used */
  std::uint32_t NearestAt(std::uint32_t point, const Vector& place) const;

  /**
   * Cuts a triangle into pieces.
   *
   * @param start a triangle of the mesh nearby
   * @param near a piece that is so near to a triangle of the mesh need not be cut
   * @param use (triangle of the mesh, greatest distance of the piece from it, area of the piece) ->
   *        whether to go on
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

private:
  static constexpr int MostSteps = 1000;
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

    double Area() const
    {
      Vector sum{};
      for (int i = 2; i < this->Count; ++i)
      {
        sum =
          sum + Cross(this->Corners[i - 1] - this->Corners[0], this->Corners[i] - this->Corners[0]);
      }
      return 0.5 * std::sqrt(Dot(sum, sum));
    }
  };

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
    return use(triangle, std::sqrt(squared), piece.Area());
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
