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
    922, 5.328, {-1.676, -1.018, -1.794, -3.83, 1.585, -1.016, -0.109}};

}  // namespace hoplab
