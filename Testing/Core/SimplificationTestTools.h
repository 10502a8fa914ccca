// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SimplificationTestTools_h
#define isodiamond_SimplificationTestTools_h

#include "DistanceTestTools.h"
#include "Simplification/AllowedMesh.h"
#include "Simplification/MeshPart.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

/**
 * @file SimplificationTestTools.h
 * Meshes to be simplified, and what has to hold of them.
 */
namespace test
{

/** Surfaces with thin walls, holes and specks, and a border. */
std::vector<Field> SurfacesToSimplify();

/** A field's surface at a tolerance, all of whose triangles have one allowance. */
isodiamond::AllowedMesh MeshOf(const Field& field, double tolerance, double allowed);

SurfaceTriangles TrianglesOf(const isodiamond::TriangleMesh& mesh);

std::vector<std::array<std::int32_t, 3>> IdsOf(const isodiamond::TriangleMesh& mesh);

/** The edges of one triangle. Expects no edge of three. */
std::vector<std::pair<std::uint32_t, std::uint32_t>> BorderOf(const isodiamond::TriangleMesh& mesh);

/** Whether two triangles have the same points. */
bool HasTwins(const isodiamond::TriangleMesh& mesh);

/** Border edges are on walls, as they were, or the same. */
void ExpectBorder(const isodiamond::AllowedMesh& before, const isodiamond::TriangleMesh& after);

/** A mesh as a part of itself of which nothing is known yet. */
isodiamond::MeshPart WholePart(const isodiamond::AllowedMesh& mesh);

/** The triangles that are left of some. @param numbers are given theirs */
std::vector<isodiamond::Triangle> TrianglesLeft(
  const isodiamond::LinkedTriangles& mesh, std::vector<std::uint32_t>* numbers = nullptr);

/** Across each edge is what goes along it the other way, and knows of it. */
void ExpectLinks(const isodiamond::LinkedTriangles& mesh);

}

#endif
