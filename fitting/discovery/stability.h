#pragma once

#include <cstdint>
#include <vector>

#include "fitting/diagnosis/linearisation.h"

namespace hoplab {

/// Columns (one a term) that the data cannot tell apart: places of equal ones, each list led by its
/// first. Two are equal if their parts beside the fitted values agree to `alike`, sign apart; what
/// the fitted values leave nothing of is in no list.
std::vector<std::vector<int>> EqualColumns(const Linearisation& at, double alike = 0.999);

/// Which terms a search by the linear model would take, the best first, each with the nats it gains
/// beside those before it.
struct LinearPick {
  int column = 0;
  double gain = 0.0;
};
std::vector<LinearPick> PickForward(const Linearisation& at, const std::vector<int>& columns,
                                    int most, double least_gain);

/// How often each of `wanted` lists of columns has a member among the `most` terms picked, over
/// `draws` resamples of the trials with replacement, the fitted values' part taken out of each
/// resample anew. Needs two trials at least; else empty.
std::vector<double> ShareOfResamples(const Linearisation& at, const std::vector<int>& columns,
                                     const std::vector<std::vector<int>>& wanted, int most,
                                     double least_gain, std::uint64_t seed, int draws = 200);

}  // namespace hoplab
