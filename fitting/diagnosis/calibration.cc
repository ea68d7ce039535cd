#include "fitting/diagnosis/calibration.h"

#include <cmath>

#include "fitting/diagnosis/calibration_table.h"

namespace hoplab {

std::array<double, NameFeatures::kCount> NameFeatures::Values() const {
  return {gap, left_gain, left_share, remainder, heterogeneity, gain, decided, others, group};
}

std::array<std::string_view, NameFeatures::kCount> NameFeatures::Names() {
  return {"gap",  "left_gain", "left_share", "remainder", "heterogeneity",
          "gain", "decided",   "others",     "group"};
}

double CalibratedProbability(const NameFeatures& features) {
  const auto values = features.Values();
  double logit = kCalibration.intercept;
  for (std::size_t k = 0; k < values.size(); ++k) logit += kCalibration.weights[k] * values[k];
  return 1.0 / (1.0 + std::exp(-logit));
}

int CalibrationCases() { return kCalibration.cases; }

}  // namespace hoplab
