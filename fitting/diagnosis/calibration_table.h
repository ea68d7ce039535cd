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
    922, 6.547, {-2.444, -0.8163, -1.378, -4.673, 2.09, -1.147, -0.1256}};

}  // namespace hoplab
