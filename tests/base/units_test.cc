#include "base/units.h"

#include <gtest/gtest.h>

#include <numbers>

namespace hoplab {
namespace {

TEST(Units, HalfATurnIsPi) { EXPECT_EQ(DegToRad(180), std::numbers::pi); }

TEST(Units, RadiansGoBackToDegrees) { EXPECT_DOUBLE_EQ(RadToDeg(DegToRad(25)), 25); }

}  // namespace
}  // namespace hoplab
