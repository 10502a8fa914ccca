// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SimplificationTestTools_h
#define isodiamond_SimplificationTestTools_h

#include "Simplification/AllowedMesh.h"
#include "Simplification/MeshPart.h"
#include "Tools/DistanceTestTools.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

/**
 * @file SimplificationTestTools.h
 * Meshes to simplify, and what must hold of them.
 */
namespace test
{

/** Fields whose surfaces have thin walls, holes, specks and a border. */
std::vector<Field> SurfacesToSimplify();

/** A field's surface at a tolerance, with the same allowance for all triangles. */
isodiamond::AllowedMesh MeshOf(const Field& field, double tolerance, double allowed);

SurfaceTriangles TrianglesOf(const isodiamond::TriangleMesh& mesh);

std::vector<std::array<std::int32_t, 3>> IdsOf(const isodiamond::TriangleMesh& mesh);

/** The edges with only one triangle. Expects that no edge has two on the same side. */
std::vector<std::pair<std::uint32_t, std::uint32_t>> BorderOf(const isodiamond::TriangleMesh& mesh);

/** Whether two triangles have the same points. */
bool HasTwins(const isodiamond::TriangleMesh& mesh);

/** A corner of polygons in whole numbers, at most 2^14. */
using WholePoint = std::array<std::int64_t, 3>;

/** Whether two convex flat polygons have no point in common, by lines along which their shadows are
 *  apart: exact. */
bool AreApart(const std::vector<WholePoint>& a, const std::vector<WholePoint>& b);

/** How many pairs of triangles have a point in common but for corners and edges that they share.
 *  Positions have to be multiples of 1/256 below 64. */
int CountIntersections(const isodiamond::TriangleMesh& mesh);

/** Expects that each border edge lies on a wall, or was one before. */
void ExpectBorder(const isodiamond::AllowedMesh& before, const isodiamond::TriangleMesh& after);

/** The whole of a mesh as a part that is not simplified yet. */
isodiamond::MeshPart WholePart(const isodiamond::AllowedMesh& mesh);

/** The triangles that are still there. @param numbers receives theirs */
std::vector<isodiamond::Triangle> TrianglesLeft(
  const isodiamond::LinkedTriangles& mesh, std::vector<std::uint32_t>* numbers = nullptr);

/** Expects that a triangle's neighbour across an edge runs along it the other way, and has the
 *  triangle as its own neighbour there. */
void ExpectLinks(const isodiamond::LinkedTriangles& mesh);

}

#endif
