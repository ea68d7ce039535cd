// A logged torque that is none in flight, held on through the flights (M123).
#include "datasets/stance_torque.h"

#include <gtest/gtest.h>

namespace hoplab {
namespace {

using Rows = std::vector<double>;

TEST(StanceTorque, IsHeldOnAndBackToTheMiddleOfAFlight) {
  const Rows log = {0, 0, 0, 0, 0, 2, 3, 1, 0, 0, 0, 0, 0, 0, 1.5, 1, 0.75, 0, 0, 0, 0, 0};
  const Rows held = {2,   2,   2,   2,   2, 2,    3,    1,    1,    1,    1,
                     1.5, 1.5, 1.5, 1.5, 1, 0.75, 0.75, 0.75, 0.75, 0.75, 0.75};
  EXPECT_EQ(HeldThroughFlights(log, {}), held);
  EXPECT_EQ(HeldThroughFlights(held, {}), held);
}

TEST(StanceTorque, OfALogWithNoiseIsThatOfTheStancesToo) {
  const Rows log = {0.01, -0.02, 0.03, 0, -0.01, -2, -3, -1, 0.02, 0.01, -0.03, 0.01, 0.02};
  const Rows held = {-2, -2, -2, -2, -2, -2, -3, -1, -1, -1, -1, -1, -1};
  EXPECT_EQ(HeldThroughFlights(log, {}), held);
}

// It grows from none and falls to none within the stance, which has more rows than it is there.
TEST(StanceTorque, ThatDoesNotStepStays) {
  const Rows log = {0, 0, 0, 0, 0, 0.4, 2, 3, 2, 0.4, 0, 0, 0, 0, 0, 0, 0.4, 1, 2, 1, 0.3};
  EXPECT_EQ(HeldThroughFlights(log, {}), log);
  EXPECT_EQ(HeldThroughFlights(Rows(9, 0.0), {}), Rows(9, 0.0));
  EXPECT_EQ(HeldThroughFlights({}, {}), Rows());
  // Four rows without torque are no flight.
  const Rows zero_crossing = {2, 2, 2, 0, 0, 0, 0, -2, -2, -2};
  EXPECT_EQ(HeldThroughFlights(zero_crossing, {}), zero_crossing);
}

// It has fallen to a sixth of its largest when the foot leaves the ground.
TEST(StanceTorque, ThatFallsSlowlyAndThenAtOnceIsHeldOn) {
  const Rows log = {6, 5, 4, 3, 2, 1.6, 1.3, 1.1, 1, 0, 0, 0, 0, 0};
  const Rows held = {6, 5, 4, 3, 2, 1.6, 1.3, 1.1, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(HeldThroughFlights(log, {}), held);
  // Here it goes on falling as before.
  const Rows smooth = {6, 5, 4, 3, 2, 1, 0.5, 0.2, 0, 0, 0, 0, 0};
  EXPECT_EQ(HeldThroughFlights(smooth, {}), smooth);
}

// A step is one of its own stance, however weak that is beside another.
TEST(StanceTorque, OfAWeakStanceIsHeldToo) {
  const Rows log = {9, 9, 9, 0, 0, 0, 0, 0, 0, 1, 1, 1};
  const Rows held = {9, 9, 9, 9, 9, 9, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(HeldThroughFlights(log, {}), held);
}

// The motor is off in the second half of the stance, and comes on late in the next one.
TEST(StanceTorque, ThatEndsWhileTheFootIsOnTheGroundStays) {
  const Rows log = {2, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 2};
  const Rows contact_before = {1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1};
  Rows held = log;
  for (std::size_t row = 8; row < 14; ++row) held[row] = 2;
  EXPECT_EQ(HeldThroughFlights(log, contact_before), held);
  const Rows contact_behind = {1, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1};
  held = log;
  for (std::size_t row = 2; row < 8; ++row) held[row] = 2;
  EXPECT_EQ(HeldThroughFlights(log, contact_behind), held);
  // A switch that opens four rows late says nothing against it.
  const Rows late = {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(HeldThroughFlights(log, late), Rows(16, 2.0));
}

TEST(StanceTorque, RestsAreTold) {
  const std::vector<TorqueRest> rests =
      TorqueRests({0, 0, 0, 0, 0, 2, 3, 0.5, 0, 0, 0, 0, 0, 0, 0.5, 2});
  ASSERT_EQ(rests.size(), 2u);
  EXPECT_EQ(rests[0].end, 5u);
  EXPECT_FALSE(rests[0].steps_out);
  EXPECT_TRUE(rests[0].steps_in);
  EXPECT_EQ(rests[1].begin, 8u);
  EXPECT_FALSE(rests[1].steps_out);
  EXPECT_TRUE(rests[1].steps_in);
}

}  // namespace
}  // namespace hoplab
