#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace hoplab::testing {

/// Whether every entry of `actual` is within `tolerance` times the largest |expected| of its
/// expected value; names the worst entry if not. NaN is never near.
inline ::testing::AssertionResult MatrixNear(std::span<const double> actual,
                                             std::span<const double> expected, double tolerance) {
  if (actual.size() != expected.size())
    return ::testing::AssertionFailure()
           << actual.size() << " entries, expected " << expected.size();
  double scale = 0.0;
  for (double e : expected) scale = std::max(scale, std::abs(e));
  std::size_t worst = 0;
  double worst_error = -1.0;
  for (std::size_t i = 0; i < actual.size(); ++i) {
    const double error = std::abs(actual[i] - expected[i]);
    if (!(error <= worst_error)) {  // NaN wins and stays
      worst = i;
      worst_error = error;
      if (std::isnan(error)) break;
    }
  }
  if (actual.empty() || worst_error <= tolerance * scale) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "entry " << worst << ": " << actual[worst] << ", expected " << expected[worst]
         << ", off by " << worst_error << " > " << tolerance << " x " << scale;
}

/// Relative difference |a - b|/|b|.
inline double RelativeError(double a, double b) { return std::abs(a - b) / std::abs(b); }

}  // namespace hoplab::testing
