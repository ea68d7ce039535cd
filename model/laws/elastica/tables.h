#pragma once

#include "model/laws/elastica/grid.h"

namespace hoplab::elastica {

// Written by make_tables.cc when the project is built.

/// Coefficients of the splines, [table][arc][load]; those of the energy are what an exported leg
/// takes along.
extern const double kCoefficients[kTableCount][kPhiCount * kLoadCount];
/// b of M61 in each cell of the grid, [cell by arc, then load][power of the place along the arc's
/// cell][power along the load's].
extern const double kCells[kPhiCells * kLoadCells][(kDegree + 1) * (kDegree + 1)];

}  // namespace hoplab::elastica
