#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace hoplab {

/// What a trace can measure, in the order of the data format, and what a simulation can tell
/// besides.
enum class Channel {
  kBodyX,
  kBodyY,
  kBodyVx,
  kBodyVy,
  kLegAngle,
  kLegLength,
  kGroundForceX,
  kGroundForceY,
  kHipTorque,
  kContact,
  kBodyAx,
  kBodyAy,
  kImuAx,
  kImuAy,
  kContactX,  // where the ground carries the leg, in flight would carry it [m]
  // What only a simulation knows, in stance.
  kContactY,   // [m]
  kContactArc  // phi [rad], of a half circle
};
/// Those of the data format come first.
inline constexpr int kChannelCount = 15;
inline constexpr int kSeenCount = 17;
/// Whether it tells an acceleration.
constexpr bool IsAcceleration(Channel c) { return c >= Channel::kBodyAx && c <= Channel::kImuAy; }

/// Column name of a channel, unit included.
std::string_view NameOf(Channel channel);
/// The channel of the data format of that name.
std::optional<Channel> FindChannel(std::string_view name);

/// One instant as the sensors would see it; SI, angles in radians, contact 0 or 1. A channel the
/// mechanism does not have is NaN.
template <class T>
struct Observation {
  std::array<T, kSeenCount> channel;
  T& operator[](Channel c) { return channel[static_cast<std::size_t>(c)]; }
  const T& operator[](Channel c) const { return channel[static_cast<std::size_t>(c)]; }
};

}  // namespace hoplab
