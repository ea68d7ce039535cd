#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

/// What a reader of a diagnosis may do about an effect that it names.
struct EffectAdvice {
  std::string effect;
  std::string check;  // a sentence: what on the rig shows it, or removes it
  /// Effects that moved the data alike, "a, b", nearest first: of four hops of six trials under the
  /// speed controller, law large_deflection, fitted values and initial states projected out, the
  /// columns of two of their parameters had a cosine beyond kAlikeCosine. Other trials may tell
  /// them apart.
  std::string look_alikes;
};
inline constexpr double kAlikeCosine = 0.93;

/// Null for an effect nobody has written about.
const EffectAdvice* AdviceOn(std::string_view effect);
/// Read from app/reports/texts/effects.txt when first asked for.
const std::vector<EffectAdvice>& AllAdvice();

}  // namespace hoplab
