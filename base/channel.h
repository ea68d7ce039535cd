#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/range.h"

namespace hoplab {

/// What can be measured, and what a simulation can tell besides. Forces are those of the ground on
/// the leg, torque is positive when it pushes the hip forward, leg_length_m is the chord, contact
/// is 0 or 1. A robot's motor angles count from the body, positive turning the toe ahead, and so do
/// their torques. Accelerations are those of the body, gravity included (-g in flight); an IMU on
/// it reads them without (0 in flight). A channel without an enumerator has a row (base/channel.cc)
/// and a file in model/channels.
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

/// What is said of a channel once.
struct ChannelInfo {
  const char* name;  // of the column, unit included: "body_x_m"
  Range range;       // what a sample may be; contact must moreover be 0 or 1
  enum class Known { kRecorded, kSimulated } known;  // kRecorded: a trace may have it
  std::string_view word = {};                        // of `hoplab import --map`: "x"
  std::array<std::string_view, 6> titles = {};       // in files of other programs: "height"
};
const ChannelInfo& InfoOf(Channel channel);

inline const char* ChannelName(Channel channel) { return InfoOf(channel).name; }
inline std::string_view NameOf(Channel channel) { return InfoOf(channel).name; }
/// "m"; empty for contact.
inline const char* ChannelUnit(Channel channel) { return InfoOf(channel).range.unit; }
inline Range ChannelRange(Channel channel) { return InfoOf(channel).range; }
/// What a standard deviation of a channel's noise, stated or added, may be in any channel's unit.
inline constexpr double kLeastSigma = 1e-12;  // squares of residuals over it stay far from overflow
inline constexpr double kMostSigma = 1e9;
inline Range SigmaRange(Channel channel) {
  return {kLeastSigma, kMostSigma, false, false, ChannelUnit(channel)};
}

/// Those that a trace may have, in the order of the rows.
std::vector<Channel> RecordedChannels();
/// One that a trace may have, by its name.
std::optional<Channel> ChannelFromName(std::string_view name);
/// The names of all of them.
std::vector<std::string> ChannelNames();

/// A contact column holds events, not a signal with noise: `contact`, and that of each leg.
constexpr bool IsContact(Channel c) {
  return c == Channel::kContact || (c >= Channel::kContact1 && c <= Channel::kContact4);
}
/// Whether it is one of a robot's own.
constexpr bool IsRobotChannel(Channel c) {
  return c >= Channel::kBodyPitch && c <= Channel::kLegForceY4;
}
/// Whether what tracks the body tells it: where it is, how it moves, its pitch.
constexpr bool IsPose(Channel c) { return c <= Channel::kBodyVy || c == Channel::kBodyPitch; }
/// Of a robot's leg.
constexpr bool IsAngleOfLeg(Channel c) {
  return c >= Channel::kLegAngle1 && c <= Channel::kLegAngle4;
}
/// The channel of a leg from that of leg 1.
constexpr Channel OfLeg(Channel first, int leg) {
  return static_cast<Channel>(static_cast<int>(first) + leg);
}
/// The leg, from 0, that a channel of the data format is of; -1 if it is of none.
constexpr int LegOf(Channel c) {
  for (const Channel first : {Channel::kLegAngle1, Channel::kHipTorque1, Channel::kContact1})
    for (int leg = 0; leg < 4; ++leg)
      if (c == OfLeg(first, leg)) return leg;
  return -1;
}

}  // namespace hoplab
