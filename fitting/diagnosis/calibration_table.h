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
    333, 5.569, {-1.337, -0.3742, -0.04594, -0.2273, -0.6048, -3.432, 1.351, -1.539, -0.2415}};

}  // namespace hoplab
