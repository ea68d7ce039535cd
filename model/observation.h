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
  kContactY,    // [m]
  kContactArc,  // phi [rad], of a half circle
  // What only a robot has, all of the data format; leg 1 is the hindmost.
  kBodyPitch,  // [rad], nose up positive
  kLegAngle1,  // of a motor relative to the body [rad], positive turns the toe ahead
  kLegAngle2,
  kLegAngle3,
  kLegAngle4,
  kHipTorque1,  // of a motor, positive turns its angle up [N m]
  kHipTorque2,
  kHipTorque3,
  kHipTorque4,
  kContact1,  // whether the ground carries the leg
  kContact2,
  kContact3,
  kContact4,
  // What only a simulation knows of a robot's leg that stands: where the ground carries it [m], the
  // arc between clamp and contact [rad], the ground's force on it [N].
  kLegContactX1,
  kLegContactX2,
  kLegContactX3,
  kLegContactX4,
  kLegContactY1,
  kLegContactY2,
  kLegContactY3,
  kLegContactY4,
  kLegArc1,
  kLegArc2,
  kLegArc3,
  kLegArc4,
  kLegForceX1,
  kLegForceX2,
  kLegForceX3,
  kLegForceX4,
  kLegForceY1,
  kLegForceY2,
  kLegForceY3,
  kLegForceY4
};
/// Those of the data format that every mechanism may have come first.
inline constexpr int kChannelCount = 15;
inline constexpr int kSeenCount = 17;
/// What a robot has beside them follows, those of the data format first.
inline constexpr int kRobotChannelCount = 13;
inline constexpr int kRobotSeenCount = kRobotChannelCount + 20;
inline constexpr int kAllChannelCount = kSeenCount + kRobotSeenCount;
/// The channel of a leg from that of leg 1.
constexpr Channel OfLeg(Channel first, int leg) {
  return static_cast<Channel>(static_cast<int>(first) + leg);
}
/// Whether it is one of a robot's own.
constexpr bool IsRobotChannel(Channel c) { return c >= Channel::kBodyPitch; }
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
  std::optional<std::array<T, kRobotSeenCount>> robot = std::nullopt;  // where there is one

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
