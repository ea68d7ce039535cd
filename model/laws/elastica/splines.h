#pragma once

#include "model/laws/elastica/grid.h"

namespace hoplab::elastica {

inline constexpr int kSpan = kDegree + 1;  // splines that a cell sees

// What they are in a cell, as polynomials of x in (0, 1): [order of the derivative][power][spline].
struct Polynomials {
  double of[4][kSpan][kSpan] = {};

  constexpr Polynomials() {
    // Cox and de Boor on uniform knots: spline i of a degree began degree - i cells ago.
    double splines[kSpan][kSpan] = {};  // [spline][power]
    splines[0][0] = 1.0;
    for (int degree = 1; degree <= kDegree; ++degree) {
      double raised[kSpan][kSpan] = {};
      for (int i = 0; i <= degree; ++i) {
        const double since = degree - i, left = degree + 1 - since;
        for (int m = 0; m < degree; ++m) {
          const double begun = i > 0 ? splines[i - 1][m] / degree : 0.0;
          const double ending = i < degree ? splines[i][m] / degree : 0.0;
          raised[i][m] += since * begun + left * ending;
          raised[i][m + 1] += begun - ending;
        }
      }
      for (int i = 0; i < kSpan; ++i) {
        for (int m = 0; m < kSpan; ++m) splines[i][m] = raised[i][m];
      }
    }
    for (int i = 0; i < kSpan; ++i) {
      for (int m = 0; m < kSpan; ++m) of[0][m][i] = splines[i][m];
    }
    for (int order = 1; order < 4; ++order) {
      for (int m = 0; m + 1 < kSpan; ++m) {
        for (int i = 0; i < kSpan; ++i) of[order][m][i] = (m + 1) * of[order - 1][m + 1][i];
      }
    }
  }
};
inline constexpr Polynomials kPolynomials;

}  // namespace hoplab::elastica
