#pragma once

#include <cmath>
#include <functional>

#include "base/random.h"
#include "datasets/dataset.h"
#include "fitting/stray_samples.h"

namespace hoplab::testing {

inline constexpr double kG = 9.81;

/// Heights along a path, with noise, from 0.3 s on: a record does not begin at 0.
inline Samples Sampled(const std::function<double(double)>& height, double until, double rate,
                       double sigma, RandomStream random) {
  Samples s;
  s.step = 1.0 / rate;
  for (std::size_t i = 0; static_cast<double>(i) * s.step <= until; ++i) {
    s.t.push_back(0.3 + static_cast<double>(i) * s.step);
    s.y.push_back(height(static_cast<double>(i) * s.step) + sigma * random.Normal());
    s.row.push_back(i);
  }
  return s;
}

/// Rows a second and noise [m].
struct Sampling {
  double rate, sigma;
};
inline constexpr Sampling kSamplings[] = {{500, 0.0005}, {500, 0.002},  {250, 0.0003},
                                          {120, 0.001},  {1000, 0.001}, {60, 0.0005}};

/// They are all that a trial has.
inline Dataset OneTrial(const MechanismSpec& mechanism, const Samples& heights) {
  Dataset dataset;
  dataset.mechanism = mechanism;
  dataset.channels = {{Channel::kBodyY, 0.0005, {}}};
  Trial trial;
  trial.file = "one.csv";
  trial.mechanism = mechanism;
  trial.touchdown_angle_rad = 0.5;
  trial.trace.time_s = heights.t;
  trial.trace.columns = {{"body_y_m", heights.y}};
  dataset.trials = {trial};
  return dataset;
}

}  // namespace hoplab::testing
