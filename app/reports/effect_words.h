#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "app/records/effect_record.h"

namespace hoplab {

/// In the order in which effects are listed.
inline constexpr std::array kEffectKinds = {EffectKind::kForce, EffectKind::kParameter,
                                            EffectKind::kGuard, EffectKind::kObservation};
/// "When contact begins".
std::string_view TitleOf(EffectKind kind);

/// "Air slows the body with the square of its speed."
std::string SentenceOf(const Effect& effect);

/// "ball only", "laws thesis, no_slip", "massless legs only"; empty where it goes with everything.
std::string RestrictionOf(const Effect& effect);

/// "; part of elastica, where it is not tried and 0 takes it away"; empty where no law has it in
/// itself.
std::string PartOfText(const Effect& effect);

}  // namespace hoplab
