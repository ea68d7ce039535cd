#pragma once

#include <optional>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// White noise that went through the filter of M105 before it was logged.
struct FilteredNoise {
  double tau = 0.0;           // of the filter, as the noise tells it [s]
  double strength = 1.0;      // M116: how many times as strong white noise does the same to a
                              // slow motion
  std::vector<double> sigma;  // of each of the problem's channels, as it was logged; NaN: not told
};

/// That of a hopper's or a ball's coordinates, if they were smoothed (FilterTimeOf): from parabolas
/// through the tops of flights, which lie farthest from what a filter makes of a stance. Of the
/// noise they leave a share that M116 tells. None of a robot, whose legs land one by one.
std::optional<FilteredNoise> FindFilteredNoise(const FitProblem& problem);

/// M116; `step` from row to row [s].
double StrengthThroughFilter(double tau, double step);

}  // namespace hoplab
