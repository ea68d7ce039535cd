#include "datasets/mechanism_spec.h"

#include <gtest/gtest.h>

#include "base/units.h"

namespace hoplab {
namespace {

MechanismSpec CLeg(double radius_m) {
  MechanismSpec mechanism;
  mechanism.c_leg.rest_radius_m = radius_m;
  return mechanism;
}

TEST(TouchdownHeight, OfACLegOnItsArc) {
  EXPECT_DOUBLE_EQ(TouchdownHeight(CLeg(0.1), DegToRad(60)), 0.15);
}

TEST(TouchdownHeight, OfACLegOnItsToe) {
  EXPECT_DOUBLE_EQ(TouchdownHeight(CLeg(0.1), DegToRad(-60)), 0.1);
}

TEST(TouchdownHeight, OfAStraightLeg) {
  MechanismSpec mechanism;
  mechanism.type = MechanismKind::kStraightLeg;
  mechanism.straight_leg.rest_length_m = 0.2;
  EXPECT_DOUBLE_EQ(TouchdownHeight(mechanism, DegToRad(60)), 0.1);
}

TEST(TouchdownHeight, OfABallIsItsRadius) {
  MechanismSpec mechanism;
  mechanism.type = MechanismKind::kBall;
  mechanism.ball.radius_m = 0.02;
  EXPECT_EQ(TouchdownHeight(mechanism, 0), 0.02);
}

TEST(FreeFall, OfALightBallIsSlowerInAir) {
  MechanismSpec mechanism;
  mechanism.type = MechanismKind::kBall;
  mechanism.gravity_m_per_s2 = 9.81;
  mechanism.body_mass_kg = 0.0027;
  mechanism.ball.radius_m = 0.02;
  EXPECT_EQ(FreeFall(mechanism), 9.81);
  mechanism.ball.air_density_kg_per_m3 = 1.2;
  EXPECT_NEAR(FreeFall(mechanism), 9.596, 1e-3);
  mechanism.type = MechanismKind::kStraightLeg;
  EXPECT_EQ(FreeFall(mechanism), 9.81);
}

}  // namespace
}  // namespace hoplab
