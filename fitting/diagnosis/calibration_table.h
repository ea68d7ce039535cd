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
    734, 5.177, {-2.222, -0.3372, -0.06836, -0.3411, -0.7567, -3.004, 1.656, -1.187, -0.166}};

}  // namespace hoplab
