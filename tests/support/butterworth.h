#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "datasets/dataset.h"

namespace hoplab::testing {

/// A Butterworth filter of order 2, by the bilinear transform, run to and fro over a column that is
/// turned about its ends there: what tools for motion capture do.
class Butterworth {
 public:
  explicit Butterworth(double cut_off_times_step) {
    const double k = std::tan(std::numbers::pi * cut_off_times_step);
    const double norm = 1.0 / (1.0 + std::numbers::sqrt2 * k + k * k);
    b_ = k * k * norm;
    a1_ = 2.0 * (k * k - 1.0) * norm;
    a2_ = (1.0 - std::numbers::sqrt2 * k + k * k) * norm;
  }
  /// Forward alone, as the samples come in: what comes out is late.
  std::vector<double> Forward(const std::vector<double>& column) const { return Once(column); }
  std::vector<double> ToAndFro(const std::vector<double>& column) const {
    const std::size_t n = column.size(), beyond = std::min<std::size_t>(n - 1, 200);
    std::vector<double> y;
    for (std::size_t i = beyond; i > 0; --i) y.push_back(2.0 * column.front() - column[i]);
    y.insert(y.end(), column.begin(), column.end());
    for (std::size_t i = 1; i <= beyond; ++i) y.push_back(2.0 * column.back() - column[n - 1 - i]);
    for (int way = 0; way < 2; ++way) {
      y = Once(y);
      std::reverse(y.begin(), y.end());
    }
    return {y.begin() + static_cast<std::ptrdiff_t>(beyond),
            y.begin() + static_cast<std::ptrdiff_t>(beyond + n)};
  }

 private:
  std::vector<double> Once(const std::vector<double>& x) const {
    double x1 = x.front(), x2 = x1, y1 = x1, y2 = x1;
    std::vector<double> y;
    for (const double value : x) {
      y.push_back(b_ * (value + 2.0 * x1 + x2) - a1_ * y1 - a2_ * y2);
      x2 = x1;
      x1 = value;
      y2 = y1;
      y1 = y.back();
    }
    return y;
  }
  double b_, a1_, a2_;
};

/// The columns of a body's place and pitch through `filter`(column, step), each trial by itself.
template <class Filter>
Dataset Filtered(Dataset dataset, const Filter& filter) {
  for (Trial& trial : dataset.trials) {
    const double step = trial.trace.time_s[1] - trial.trace.time_s[0];
    for (TraceColumn& column : trial.trace.columns)
      if (column.name.starts_with("body_")) column.values = filter(column.values, step);
  }
  return dataset;
}
inline Dataset Smoothed(const Dataset& dataset, double cut_off_Hz) {
  return Filtered(dataset, [cut_off_Hz](const std::vector<double>& column, double step) {
    return Butterworth(cut_off_Hz * step).ToAndFro(column);
  });
}
/// As they are logged by a filter that runs with the machine.
inline Dataset SmoothedLate(const Dataset& dataset, double cut_off_Hz) {
  return Filtered(dataset, [cut_off_Hz](const std::vector<double>& column, double step) {
    return Butterworth(cut_off_Hz * step).Forward(column);
  });
}
/// Each sample the mean of `samples`, an odd number, about it; of fewer at the ends.
inline Dataset Averaged(const Dataset& dataset, std::size_t samples) {
  return Filtered(dataset, [samples](const std::vector<double>& column, double) {
    std::vector<double> means;
    for (std::size_t i = 0; i < column.size(); ++i) {
      const std::size_t reach = std::min({samples / 2, i, column.size() - 1 - i});
      double sum = 0.0;
      for (std::size_t k = i - reach; k <= i + reach; ++k) sum += column[k];
      means.push_back(sum / static_cast<double>(2 * reach + 1));
    }
    return means;
  });
}
/// Its time constant (M105) [s].
inline double FilterTime(double cut_off_Hz) { return 0.5 / (std::numbers::pi * cut_off_Hz); }

/// Every `nth` sample of a set.
inline Dataset Thinned(Dataset dataset, std::size_t nth) {
  const auto thin = [&](std::vector<double>& values) {
    std::vector<double> kept;
    for (std::size_t i = 0; i < values.size(); i += nth) kept.push_back(values[i]);
    values = kept;
  };
  for (Trial& trial : dataset.trials) {
    thin(trial.trace.time_s);
    for (TraceColumn& column : trial.trace.columns) thin(column.values);
  }
  return dataset;
}

}  // namespace hoplab::testing
