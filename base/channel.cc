#include "base/channel.h"

#include <array>

namespace hoplab {
namespace {

using enum ChannelInfo::Known;

// One row a channel: name, range, whether a trace may have it, what `hoplab import` calls it,
// titles that leave no doubt. Ranges are far beyond any hopper, near enough to catch a value in the
// wrong unit or a broken line. First those of the enumerators, in their order; then those that
// model/channels reads from what a simulation tells, in any.
constexpr auto kRows = std::to_array<ChannelInfo>({
    {"body_x_m", Within(1e6, "m"), kRecorded, "x", {"body_x"}},
    {"body_y_m", Within(1e6, "m"), kRecorded, "y", {"body_y", "height"}},
    {"body_vx_m_per_s",
     Within(1e6, "m/s"),
     kRecorded,
     "vx",
     {"body_vx", "vx", "v_x", "vel_x", "velocity_x", "xdot"}},
    {"body_vy_m_per_s",
     Within(1e6, "m/s"),
     kRecorded,
     "vy",
     {"body_vy", "vy", "v_y", "vel_y", "velocity_y", "ydot"}},
    {"leg_angle_rad", Within(1e3, "rad"), kRecorded, "leg_angle", {"leg_angle", "leg angle"}},
    {"leg_length_m", NonNegative(1e3, "m"), kRecorded, "leg_length", {"leg_length", "leg length"}},
    {"ground_force_x_N",
     Within(1e9, "N"),
     kRecorded,
     "fx",
     {"ground_force_x", "ground_force_vx", "fx", "grf_x", "f_x"}},
    {"ground_force_y_N",
     Within(1e9, "N"),
     kRecorded,
     "fy",
     {"ground_force_y", "ground_force_vy", "fy", "grf_y", "f_y"}},
    {"hip_torque_N_m", Within(1e9, "N m"), kRecorded, "torque", {"hip_torque", "hip torque"}},
    {"contact", NonNegative(1, ""), kRecorded, "contact", {"contact", "in_contact", "stance"}},
    {"body_ax_m_per_s2", Within(1e6, "m/s^2"), kRecorded, "ax"},
    {"body_ay_m_per_s2", Within(1e6, "m/s^2"), kRecorded, "ay"},
    {"imu_ax_m_per_s2", Within(1e6, "m/s^2"), kRecorded, "imu_ax"},
    {"imu_ay_m_per_s2", Within(1e6, "m/s^2"), kRecorded, "imu_ay"},
    {"contact_x_m", Within(1e6, "m"), kRecorded, "contact_x"},
    {"contact_y_m", Within(1e6, "m"), kSimulated},
    {"contact_arc_rad", Within(1e3, "rad"), kSimulated},
    {"body_pitch_rad", Within(1e3, "rad"), kRecorded},
    {"leg_angle_1_rad", Within(1e6, "rad"), kRecorded},
    {"leg_angle_2_rad", Within(1e6, "rad"), kRecorded},
    {"leg_angle_3_rad", Within(1e6, "rad"), kRecorded},
    {"leg_angle_4_rad", Within(1e6, "rad"), kRecorded},
    {"hip_torque_1_N_m", Within(1e9, "N m"), kRecorded},
    {"hip_torque_2_N_m", Within(1e9, "N m"), kRecorded},
    {"hip_torque_3_N_m", Within(1e9, "N m"), kRecorded},
    {"hip_torque_4_N_m", Within(1e9, "N m"), kRecorded},
    {"contact_1", NonNegative(1, ""), kRecorded},
    {"contact_2", NonNegative(1, ""), kRecorded},
    {"contact_3", NonNegative(1, ""), kRecorded},
    {"contact_4", NonNegative(1, ""), kRecorded},
    {"leg_contact_x_1_m", Within(1e6, "m"), kSimulated},
    {"leg_contact_x_2_m", Within(1e6, "m"), kSimulated},
    {"leg_contact_x_3_m", Within(1e6, "m"), kSimulated},
    {"leg_contact_x_4_m", Within(1e6, "m"), kSimulated},
    {"leg_contact_y_1_m", Within(1e6, "m"), kSimulated},
    {"leg_contact_y_2_m", Within(1e6, "m"), kSimulated},
    {"leg_contact_y_3_m", Within(1e6, "m"), kSimulated},
    {"leg_contact_y_4_m", Within(1e6, "m"), kSimulated},
    {"leg_arc_1_rad", Within(1e3, "rad"), kSimulated},
    {"leg_arc_2_rad", Within(1e3, "rad"), kSimulated},
    {"leg_arc_3_rad", Within(1e3, "rad"), kSimulated},
    {"leg_arc_4_rad", Within(1e3, "rad"), kSimulated},
    {"leg_force_x_1_N", Within(1e9, "N"), kSimulated},
    {"leg_force_x_2_N", Within(1e9, "N"), kSimulated},
    {"leg_force_x_3_N", Within(1e9, "N"), kSimulated},
    {"leg_force_x_4_N", Within(1e9, "N"), kSimulated},
    {"leg_force_y_1_N", Within(1e9, "N"), kSimulated},
    {"leg_force_y_2_N", Within(1e9, "N"), kSimulated},
    {"leg_force_y_3_N", Within(1e9, "N"), kSimulated},
    {"leg_force_y_4_N", Within(1e9, "N"), kSimulated},
});

}  // namespace

const ChannelInfo& InfoOf(Channel channel) { return kRows[static_cast<std::size_t>(channel)]; }

std::vector<Channel> RecordedChannels() {
  std::vector<Channel> recorded;
  for (std::size_t i = 0; i < kRows.size(); ++i)
    if (kRows[i].known == kRecorded) recorded.push_back(static_cast<Channel>(i));
  return recorded;
}

std::optional<Channel> ChannelFromName(std::string_view name) {
  for (const Channel channel : RecordedChannels())
    if (name == ChannelName(channel)) return channel;
  return std::nullopt;
}

std::vector<std::string> ChannelNames() {
  std::vector<std::string> names;
  for (const Channel channel : RecordedChannels()) names.emplace_back(ChannelName(channel));
  return names;
}

}  // namespace hoplab
