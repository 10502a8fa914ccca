// SPDX-License-Identifier: BSD-3-Clause
#ifndef PaperFigures_h
#define PaperFigures_h

#include "Results.h"

namespace benchmark
{

/** A line of the paper's Table 2. NaN if the volume has no such hierarchy. */
struct PaperFigures
{
  double Isovertices = NAN; ///< v_i
  double Relevant = NAN;    ///< m_r, including creation ones
  double Creation = NAN;    ///< m_c
  double Active = NAN;      ///< m_a
  double Points = NAN;      ///< v, of the full resolution
  double Cells = NAN;       ///< t
  double MIFormula = NAN;   ///< bytes in the paper's encoding
  double RIFormula = NAN;
  double MIBytes = NAN; ///< bytes in ours
  double RIBytes = NAN;
  double MeshBytes = NAN; ///< of the indexed mesh: 12 a point, 12 a triangle, 16 a tetrahedron
};

inline PaperFigures FindPaperFigures(const VolumeResult& volume, Shape shape)
{
  const Table& table = volume.Of(shape);
  const auto ofMI = [&](const char* figure) { return table.Get("MI build, field", figure); };
  PaperFigures found;
  found.Isovertices = ofMI("isovertices");
  found.Relevant = ofMI("relevant");
  found.Creation = ofMI("creation");
  found.Active = ofMI("active");
  found.Points = table.Get("MI extract, field", "points", 0.0);
  found.Cells = table.Get("MI extract, field", "cells", 0.0);
  found.MIFormula = 2.0 + 12.0 * (found.Active + found.Creation) + found.Isovertices;
  found.RIFormula = 2.0 + 12.0 * (found.Active + found.Relevant) + found.Isovertices;
  found.MIBytes = ofMI("bytes");
  found.RIBytes = table.Get("RI build, field", "bytes");
  found.MeshBytes = 12.0 * found.Points + (shape == Shape::Isosurface ? 12.0 : 16.0) * found.Cells;
  return found;
}

}

#endif
