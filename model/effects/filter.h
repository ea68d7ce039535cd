#pragma once

#include <span>
#include <string_view>

#include "model/effects/effect.h"

namespace hoplab {

/// The entry of a filter that the logged pose went through (M105, M117). It has no hooks: the
/// simulated pose goes through it as a whole (model/pose_filter.h).
constexpr EffectInfo FilterInfo(std::string_view name, RecordFilter filter,
                                std::span<const EffectParameter> parameters,
                                std::string_view equation, std::string_view sentence) {
  return {.name = name,
          .kind = EffectKind::kObservation,
          .equation = equation,
          .sentence = sentence,
          .for_legs = true,
          .for_ball = true,
          .dissipative = false,
          .has_threshold = true,
          .parameters = parameters,
          .for_robot = true,
          .filter = filter};
}

}  // namespace hoplab
