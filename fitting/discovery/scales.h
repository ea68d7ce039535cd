#pragma once

#include "fitting/problem.h"

namespace hoplab {

/// Where something is, from least to most; empty if nothing says where.
struct Extent {
  double least = 0.0, most = 0.0;
  bool empty() const { return !(most > least); }
};

/// Sizes of things in a dataset, which make terms comparable.
struct NaturalScales {
  double length = 0.1;  // the height covered [m]
  double speed = 1.0;   // of a fall from there [m/s]
  double time = 1.0;    // the longest trial [s]
  double force = 1.0;   // the weight [N]
  Extent x, y;          // where the body was [m]
};
NaturalScales ScalesOf(const FitProblem& problem);

/// One significant digit, so that a formula is readable.
double RoundedToOneDigit(double value);

}  // namespace hoplab
