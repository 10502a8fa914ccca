// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceTopology_h
#define ReferenceTopology_h

#include "ReferenceMesh.h"

#include <functional>
#include <set>
#include <vector>

/**
 * Which diamonds change the topology of a surface when they are bisected, from the definition of
 * Gerstner and Pajarola ("Topology preserving and controlled topology simplifying multiresolution
 * isosurface extraction", IEEE Visualization 2000): the surfaces before and after are made and
 * compared.
 */
namespace reference
{

/** Whether a vertex lies above the surface. */
using SideOfVertex = std::function<bool(const Point&)>;

/** A connected component of the marching-tetrahedra surface in a diamond's domain, as a complex:
 *  its vertices are crossed edges, its faces triangles and quadrilaterals. */
struct DomainPiece
{
  /** Vertices less edges plus faces. */
  int EulerNumber = 0;
  /** The connected components of those edges that have only one face. */
  int BoundaryLoops = 0;
  /** The crossed edges that bisection of the diamond leaves as they are: edges between vertices of
   *  the diamond, except the spine. They are all on the boundary of the domain. */
  std::set<Isovertex> OuterEdges;
};

bool operator==(const DomainPiece& a, const DomainPiece& b);
bool operator<(const DomainPiece& a, const DomainPiece& b);

/**
 * The pieces of the surface in a diamond's domain, sorted. All vertices must have samples.
 * @param isBisected true for the surface in the halves of the diamond's tetrahedra
 */
std::vector<DomainPiece> PiecesInDomain(
  const Hierarchy& hierarchy, int diamond, const SideOfVertex& isAbove, bool isBisected);

/**
 * Whether bisection changes the topology of the surface in the domain of a diamond, which must not
 * stick out of the grid: whether the pieces, or the outer edges that each meets, differ before and
 * after.
 */
bool IsCritical(const Hierarchy& hierarchy, int diamond, const SideOfVertex& isAbove);

}

#endif
