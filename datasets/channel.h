#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/range.h"

namespace hoplab {

/// What can be measured. Forces are those of the ground on the leg, torque is positive when it
/// pushes the hip forward, leg_length_m is the chord, contact is 0 or 1. A robot's motor angles
/// count from the body, positive turning the toe ahead, and so do their torques. Accelerations are
/// those of the body, gravity included (-g in flight); an IMU on it reads them without (0 in
/// flight).
enum class ChannelId {
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
  kContactX,
  // Of a robot alone; leg 1 is the hindmost.
  kBodyPitch,
  kLegAngle1,
  kLegAngle2,
  kLegAngle3,
  kLegAngle4,
  kHipTorque1,
  kHipTorque2,
  kHipTorque3,
  kHipTorque4,
  kContact1,
  kContact2,
  kContact3,
  kContact4,
};

inline constexpr std::size_t kChannelIdCount = 28;

inline constexpr std::array<ChannelId, kChannelIdCount> kAllChannels = {
    ChannelId::kBodyX,        ChannelId::kBodyY,        ChannelId::kBodyVx,
    ChannelId::kBodyVy,       ChannelId::kLegAngle,     ChannelId::kLegLength,
    ChannelId::kGroundForceX, ChannelId::kGroundForceY, ChannelId::kHipTorque,
    ChannelId::kContact,      ChannelId::kBodyAx,       ChannelId::kBodyAy,
    ChannelId::kImuAx,        ChannelId::kImuAy,        ChannelId::kContactX,
    ChannelId::kBodyPitch,    ChannelId::kLegAngle1,    ChannelId::kLegAngle2,
    ChannelId::kLegAngle3,    ChannelId::kLegAngle4,    ChannelId::kHipTorque1,
    ChannelId::kHipTorque2,   ChannelId::kHipTorque3,   ChannelId::kHipTorque4,
    ChannelId::kContact1,     ChannelId::kContact2,     ChannelId::kContact3,
    ChannelId::kContact4};

/// A contact column holds events, not a signal with noise: `contact`, and that of each leg.
constexpr bool IsContact(ChannelId id) {
  return id == ChannelId::kContact || id >= ChannelId::kContact1;
}

/// Name of the column, unit included: "body_x_m".
const char* ChannelName(ChannelId id);
/// "m"; empty for contact.
const char* ChannelUnit(ChannelId id);
/// What a sample may be; contact must moreover be 0 or 1.
Range ChannelRange(ChannelId id);
/// Nothing for a name that is no channel's.
std::optional<ChannelId> ChannelFromName(std::string_view name);
/// All names, in the order of ChannelId.
std::vector<std::string> ChannelNames();

}  // namespace hoplab
