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
    1008, 6.904, {-2.585, -0.7185, -1.556, -4.889, 2.15, -1.139, -0.1048}};

}  // namespace hoplab
