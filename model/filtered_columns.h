#pragma once

#include <Eigen/Core>
#include <span>

#include "model/effects/effect.h"

namespace hoplab {

/// Columns that go through a filter, a row of `values` each and a column a time. The first is 1
/// everywhere, and what a filter makes of it divides what it makes of the others.
struct FilteredColumns {
  /// What comes out, not yet divided, and its derivative by the logarithm of the filter's time.
  Eigen::ArrayXXd sums, slopes;
};
/// M105, M117, as means over the rows. `times` rise; `step` is what lies between them as a rule
/// [s]. Beyond both ends what `goes_on` does so as the parabola through three rows there; else a
/// filter makes do with the rows it has.
FilteredColumns ThroughFilter(RecordFilter shape, double time, double step,
                              std::span<const double> times, const Eigen::ArrayXXd& values,
                              bool goes_on = true);

/// How far from a row the filter looks for what bears on it [s].
double ReachOf(RecordFilter shape, double time);

}  // namespace hoplab
