// Units by the endings of keys and columns.
#include <gtest/gtest.h>

#include "app/records/sweep_record.h"
#include "app/terminal/quantity.h"

namespace hoplab {
namespace {

TEST(UnitOfKey, IsThatOfTheWholeEnding) {
  const std::pair<const char*, const char*> kKeys[] = {
      {"mechanism.pitch_inertia_kg_m2", "kg m^2"},
      {"mechanism.leg.second_moment_m4", "m^4"},
      {"mechanism.body_mass_kg", "kg"},
      {"mechanism.motor.kd_N_m_s_per_rad", "N m s/rad"},
      {"controller.kp_N_s", "N s"},
      {"controller.period_s", "s"},
      {"controller.sweep_rad", "rad"},
      {"initial.pitch_rate_rad_per_s", "rad/s"},
      {"initial.vx_m_per_s", "m/s"},
      {"controller.duty", ""}};
  for (const auto& [key, unit] : kKeys) EXPECT_EQ(UnitOfKey(key), unit) << key;
}

TEST(UnitOfChannel, IsKnownOfAccelerationsToo) {
  EXPECT_EQ(UnitOfChannel("body_ax_m_per_s2"), "m/s^2");
  EXPECT_EQ(WithoutUnit("body_ax_m_per_s2"), "body_ax");
  EXPECT_EQ(UnitOfChannel("hip_torque_1_N_m"), "N m");
  EXPECT_EQ(UnitOfChannel("contact"), "");
}

}  // namespace
}  // namespace hoplab
