#include "fitting/diagnosis/calibration.h"

#include <algorithm>
#include <cmath>

#include "fitting/diagnosis/calibration_table.h"

namespace hoplab {

namespace {

constexpr double kPlainlySeen = 3.0;  // a remainder from here on is no accident
constexpr double kMostGain = 3.0;     // the largest among the simulated cases

}  // namespace

std::array<double, NameFeatures::kCount> NameFeatures::Values() const {
  const double left = (left_share + 4.0) * std::min(remainder / kPlainlySeen, 1.0);
  const double known_gain = std::min(gain, kMostGain);
  return {gap, left, heterogeneity, known_gain, known_gain * gap, others, group};
}

std::array<std::string_view, NameFeatures::kCount> NameFeatures::Names() {
  return {"gap", "left", "heterogeneity", "gain", "decided", "others", "group"};
}

double CalibratedProbability(const NameFeatures& features) {
  const auto values = features.Values();
  double logit = kCalibration.intercept;
  for (std::size_t k = 0; k < values.size(); ++k) logit += kCalibration.weights[k] * values[k];
  return ProbabilityOf(logit);
}

double LogOddsOf(double probability) { return std::log(probability / (1.0 - probability)); }
double ProbabilityOf(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

int CalibrationCases() { return kCalibration.cases; }

}  // namespace hoplab
