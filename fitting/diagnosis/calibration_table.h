#pragma once

#include <array>

#include "fitting/diagnosis/calibration.h"

namespace hoplab {

// Written by the statistics suite (tools/statistics); not by hand.
struct CalibrationTable {
  int cases;
  double intercept;
  std::array<double, NameFeatures::kCount> weights;
};
inline constexpr CalibrationTable kCalibration = {
    337, 4.028, {-0.8983, -0.2759, -0.05788, -0.2917, -0.6748, -2.487, 1.025, -1.739, -0.1489}};

}  // namespace hoplab
