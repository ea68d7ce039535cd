#pragma once

#include <array>
#include <optional>

#include "base/channel.h"

namespace hoplab {

/// Channels that an automaton tells of any mechanism, and those of a robot beside them.
inline constexpr int kSeenCount = static_cast<int>(Channel::kBodyPitch);
inline constexpr int kRobotSeenCount = static_cast<int>(Channel::kLegForceY4) + 1 - kSeenCount;

/// One instant as the sensors would see it; SI, angles in radians, contact 0 or 1. A channel the
/// mechanism does not have is NaN.
template <class T>
struct Observation {
  std::array<T, kSeenCount> channel;
  std::optional<std::array<T, kRobotSeenCount>> robot = std::nullopt;  // where there is one
  T pitch_rate{0.0};                                                   // of a robot's body [rad/s]

  T& operator[](Channel c) {
    return IsRobotChannel(c) ? (*robot)[static_cast<std::size_t>(c) - kSeenCount]
                             : channel[static_cast<std::size_t>(c)];
  }
  const T& operator[](Channel c) const {
    return IsRobotChannel(c) ? (*robot)[static_cast<std::size_t>(c) - kSeenCount]
                             : channel[static_cast<std::size_t>(c)];
  }
  /// Whether the mechanism can say anything of the channel.
  bool Has(Channel c) const { return !IsRobotChannel(c) || robot.has_value(); }
};

}  // namespace hoplab
