#include "datasets/key_advice.h"

#include <gtest/gtest.h>

namespace hoplab {
namespace {

TEST(KeyAdvice, ReadsTheUnitOffAName) {
  EXPECT_EQ(UnitOfKey("E_Pa"), "Pa");
  EXPECT_EQ(UnitOfKey("kp_N_s"), "N s");
  EXPECT_EQ(UnitOfKey("damping_N_s_per_m"), "N s/m");
  EXPECT_EQ(UnitOfKey("second_moment_m4"), "m4");
  EXPECT_EQ(UnitOfKey("restitution"), "");
  EXPECT_EQ(UnitOfKey("initial_sigma"), "");
}

TEST(KeyAdvice, SaysNothingOfANameWithTheRightUnit) {
  EXPECT_FALSE(WrongUnitAdvice("E_Pa", {"E_Pa"}));
}

TEST(KeyAdvice, SaysNothingOfAnotherQuantity) {
  EXPECT_FALSE(WrongUnitAdvice("F_GPa", {"E_Pa", "rest_radius_m"}));
}

TEST(KeyAdvice, SeesAWrongUnitOfSeveralWords) {
  EXPECT_TRUE(WrongUnitAdvice("gravity_mm_per_s2", {"gravity_m_per_s2"}));
  EXPECT_TRUE(WrongUnitAdvice("v_des_km_per_h", {"v_des_m_per_s"}));
}

TEST(KeyAdvice, AMissingUnitIsAllowedWhereNamesMayBeAnything) {
  EXPECT_TRUE(WrongUnitAdvice("body_y", {"body_y_m"}));
  EXPECT_FALSE(WrongUnitAdvice("body_y", {"body_y_m"}, true));
}

}  // namespace
}  // namespace hoplab
