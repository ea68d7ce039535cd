#include "datasets/channel.h"

namespace hoplab {
namespace {

struct ChannelRow {
  const char* name;
  Range range;
};

// Far beyond any hopper, near enough to catch a value in the wrong unit or a broken line.
const ChannelRow& Row(ChannelId id) {
  static const std::array<ChannelRow, kChannelIdCount> kRows = {{
      {"body_x_m", Within(1e6, "m")},
      {"body_y_m", Within(1e6, "m")},
      {"body_vx_m_per_s", Within(1e6, "m/s")},
      {"body_vy_m_per_s", Within(1e6, "m/s")},
      {"leg_angle_rad", Within(1e3, "rad")},
      {"leg_length_m", NonNegative(1e3, "m")},
      {"ground_force_x_N", Within(1e9, "N")},
      {"ground_force_y_N", Within(1e9, "N")},
      {"hip_torque_N_m", Within(1e9, "N m")},
      {"contact", NonNegative(1, "")},
      {"body_ax_m_per_s2", Within(1e6, "m/s^2")},
      {"body_ay_m_per_s2", Within(1e6, "m/s^2")},
      {"imu_ax_m_per_s2", Within(1e6, "m/s^2")},
      {"imu_ay_m_per_s2", Within(1e6, "m/s^2")},
      {"contact_x_m", Within(1e6, "m")},
      {"body_pitch_rad", Within(1e3, "rad")},
      {"leg_angle_1_rad", Within(1e6, "rad")},
      {"leg_angle_2_rad", Within(1e6, "rad")},
      {"leg_angle_3_rad", Within(1e6, "rad")},
      {"leg_angle_4_rad", Within(1e6, "rad")},
      {"hip_torque_1_N_m", Within(1e9, "N m")},
      {"hip_torque_2_N_m", Within(1e9, "N m")},
      {"hip_torque_3_N_m", Within(1e9, "N m")},
      {"hip_torque_4_N_m", Within(1e9, "N m")},
      {"contact_1", NonNegative(1, "")},
      {"contact_2", NonNegative(1, "")},
      {"contact_3", NonNegative(1, "")},
      {"contact_4", NonNegative(1, "")},
  }};
  return kRows[static_cast<std::size_t>(id)];
}

}  // namespace

const char* ChannelName(ChannelId id) { return Row(id).name; }

const char* ChannelUnit(ChannelId id) { return Row(id).range.unit; }

Range ChannelRange(ChannelId id) { return Row(id).range; }

std::optional<ChannelId> ChannelFromName(std::string_view name) {
  for (const ChannelId id : kAllChannels)
    if (name == ChannelName(id)) return id;
  return std::nullopt;
}

std::vector<std::string> ChannelNames() {
  std::vector<std::string> names;
  for (const ChannelId id : kAllChannels) names.emplace_back(ChannelName(id));
  return names;
}

}  // namespace hoplab
