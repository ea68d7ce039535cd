#include "model/observation.h"

namespace hoplab {
namespace {
constexpr std::array<std::string_view, kAllChannelCount> kNames = {
    "body_x_m",          "body_y_m",          "body_vx_m_per_s",   "body_vy_m_per_s",
    "leg_angle_rad",     "leg_length_m",      "ground_force_x_N",  "ground_force_y_N",
    "hip_torque_N_m",    "contact",           "body_ax_m_per_s2",  "body_ay_m_per_s2",
    "imu_ax_m_per_s2",   "imu_ay_m_per_s2",   "contact_x_m",       "contact_y_m",
    "contact_arc_rad",   "body_pitch_rad",    "leg_angle_1_rad",   "leg_angle_2_rad",
    "leg_angle_3_rad",   "leg_angle_4_rad",   "hip_torque_1_N_m",  "hip_torque_2_N_m",
    "hip_torque_3_N_m",  "hip_torque_4_N_m",  "contact_1",         "contact_2",
    "contact_3",         "contact_4",         "leg_contact_x_1_m", "leg_contact_x_2_m",
    "leg_contact_x_3_m", "leg_contact_x_4_m", "leg_contact_y_1_m", "leg_contact_y_2_m",
    "leg_contact_y_3_m", "leg_contact_y_4_m", "leg_arc_1_rad",     "leg_arc_2_rad",
    "leg_arc_3_rad",     "leg_arc_4_rad",     "leg_force_x_1_N",   "leg_force_x_2_N",
    "leg_force_x_3_N",   "leg_force_x_4_N",   "leg_force_y_1_N",   "leg_force_y_2_N",
    "leg_force_y_3_N",   "leg_force_y_4_N"};
}  // namespace

std::string_view NameOf(Channel channel) { return kNames[static_cast<std::size_t>(channel)]; }

std::optional<Channel> FindChannel(std::string_view name) {
  for (int i = 0; i < kChannelCount; ++i) {
    if (kNames[i] == name) return static_cast<Channel>(i);
  }
  for (int i = kSeenCount; i < kSeenCount + kRobotChannelCount; ++i) {
    if (kNames[i] == name) return static_cast<Channel>(i);
  }
  return std::nullopt;
}

}  // namespace hoplab
