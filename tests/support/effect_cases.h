#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "model/effects/effect.h"
#include "tests/support/diagnosis_cases.h"

namespace hoplab::testing {

/// One way an effect may deviate from null: sizes in units of delta80 along `step`.
struct EffectDirection {
  Eigen::VectorXd step;  // one delta80, own units
  /// Largest of kSizes that lies within the bounds and lets every trial run to its end.
  double largest = 0.0;
  std::string limit;  // what ends it, empty if all sizes are possible

  std::vector<double> Values(const Effect& effect, double size) const;
};

/// Sizes the suite plants, in delta80.
inline constexpr std::array kSizes = {0.5, 1.0, 1.5, 2.0, 4.0, 16.0};
/// Chi-square threshold delta80 refers to: delta80 = (sqrt(7.85) + 0.84)/sqrt(V) = 3.64/sqrt(V).
inline constexpr double kDelta80Threshold = 7.85;

/// An effect under a law.
struct EffectCase {
  Law law = Law::kLargeDeflection;
  const Effect* effect = nullptr;
  std::vector<EffectDirection> directions;
  std::string excluded;  // why it is not among the cases; empty if it is
  /// Only the stated initial states show it (a delay, an offset along x): with free initial states
  /// the data would hold less than a twentieth of its information. The model extended by it
  /// predicts alike.
  bool through_initial_states = false;

  /// Directions that allow `size`.
  std::vector<const EffectDirection*> At(double size) const;
};

/// Every effect of the catalogue that applies to the law, with delta80 at the true values.
std::vector<EffectCase> EffectCasesOf(Law law);
/// Of all laws; computed once.
const std::vector<EffectCase>& AllEffectCases();

}  // namespace hoplab::testing
