#pragma once

#include <array>
#include <string_view>

namespace hoplab {

/// What is seen of a name beside its evidence. Evidence cannot know causes outside the list: one of
/// them is mimicked by a listed one, which then wins by far; what gives it away is what is left.
struct NameFeatures {
  double gap = 0.0;            // log(1 + nats to the best model without the name's group, 0..50)
  double left_gain = 0.0;      // log(1 + nats a discrepancy gains beside the extension)
  double left_share = -4.0;    // log10 of the share of the misfit that is left, -4..0
  double remainder = 0.0;      // - log10 of the chance of what is left under noise, 0..10
  double heterogeneity = 0.0;  // - log10 of the chance that trials agree on its size, 0..3, times
                               // their spread in halves of the effect's size, 0..1
  double gain = 0.0;           // log10(1 + nats the extension gains over the null fit)
  double others = 0.0;         // causes in the extension beside it, 0..2
  double group = 0.0;          // names that do as well beside it

  static constexpr std::size_t kCount = 7;
  /// What the regression weighs: gap, left, heterogeneity, gain, decided, others, group.
  /// `left` is the share in decades above 1e-4, times how plainly it is seen, 0..1 (remainder up to
  /// 3); `decided` is gain times gap; gain ends where the simulated cases end, at 3. None of them
  /// grows without end with the rows of a recording, as nats of what is left would: of twice the
  /// rows the same error, however small beside what is explained, would be twice the doubt.
  std::array<double, kCount> Values() const;
  static std::array<std::string_view, kCount> Names();
};

/// Probability that a name is right, of simulated cases that looked like this one: a logistic
/// regression on the features, fitted to cases with the cause in the catalogue and with it taken
/// out (docs/statistics/diagnosis.md; tools/statistics).
double CalibratedProbability(const NameFeatures& features);

/// log(p/(1 - p)), and back.
double LogOddsOf(double probability);
double ProbabilityOf(double log_odds);

/// Simulated cases behind the calibration.
int CalibrationCases();

}  // namespace hoplab
