#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace hoplab {

/// What a trace can measure, in the order of the data format.
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
  kContact
};
inline constexpr int kChannelCount = 10;

/// Column name of a channel in the data format, unit included.
std::string_view NameOf(Channel channel);
std::optional<Channel> FindChannel(std::string_view name);

/// One instant as the sensors would see it; SI, angles in radians, contact 0 or 1. A channel the
/// mechanism does not have is NaN.
template <class T>
struct Observation {
  std::array<T, kChannelCount> channel;
  T& operator[](Channel c) { return channel[static_cast<std::size_t>(c)]; }
  const T& operator[](Channel c) const { return channel[static_cast<std::size_t>(c)]; }
};

}  // namespace hoplab
