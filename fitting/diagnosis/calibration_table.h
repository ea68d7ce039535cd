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
    367, 4.413, {-1.949, -0.343, -0.01315, -0.3134, -0.7913, -2.486, 1.513, -1.189, -0.107}};

}  // namespace hoplab
