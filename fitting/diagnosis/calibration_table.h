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
    922, 5.65, {-2.248, -0.8238, -1.392, -3.912, 1.909, -1.169, -0.06562}};

}  // namespace hoplab
