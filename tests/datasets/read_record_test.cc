// What a log of a real machine brings along: angles hop by hop, initial states in stance. Read,
// written back, and refused with place and remedy.

#include "datasets/read_record.h"

#include <gtest/gtest.h>

#include "base/units.h"
#include "tests/datasets/recorded_hops.h"

namespace hoplab {
namespace {

using namespace testing;

// ---- angles

TEST(TouchdownAngles, AreAListOnePerTouchdown) {
  const Dataset dataset = RecordWith("deg: 25", "deg: [25, 22.5]");
  const Trial& trial = dataset.trials[0];
  EXPECT_EQ(trial.touchdown_angles_rad, (std::vector<double>{DegToRad(25), DegToRad(22.5)}));
  EXPECT_EQ(trial.touchdown_angle_rad, DegToRad(25));
  ExpectRoundTrip(dataset);
}

TEST(TouchdownAngles, AreReadFromTheMeasuredColumnAtContact) {
  const Dataset dataset = RecordWith("deg: 25", "deg: {from: leg_angle}");
  const std::vector<double>& angles = dataset.trials[0].touchdown_angles_rad;
  ASSERT_EQ(angles.size(), 2u);
  // Between 0.1 s, 0.19 m and 0.2 s, 0.15 m, where y - H(angle) changes sign: the angle of a trace
  // whose leg angle jumps lies between the two samples.
  EXPECT_LT(angles[0], 0.44);
  EXPECT_GT(angles[0], 0.10);
  EXPECT_LT(angles[1], 0.40);
  EXPECT_GT(angles[1], 0.20);
  ExpectRoundTrip(dataset);
}

TEST(TouchdownAngles, AreReadWhereTheContactColumnSaysWhenItHasOne) {
  const std::string csv =
      "time_s,contact,leg_angle_rad\n0,0,0.5\n0.1,0,0.4\n0.2,1,0.3\n0.3,0,0.6\n0.4,1,0.5\n";
  const Dataset dataset =
      ReadRecord(Replace(Replace(kRecordYaml, "deg: 25", "deg: {from: leg_angle}"),
                         "{body_y_m: {sigma: 0.001}}", "{contact: {}}"),
                 csv);
  ASSERT_EQ(dataset.trials[0].touchdown_angles_rad.size(), 2u);
  EXPECT_NEAR(dataset.trials[0].touchdown_angles_rad[0], 0.35, 1e-12);
  EXPECT_NEAR(dataset.trials[0].touchdown_angles_rad[1], 0.55, 1e-12);
}

TEST(TouchdownAngles, WithASigmaEachHopHasItsOwnAboutTheOneGiven) {
  const Dataset dataset = RecordWith("deg: 25\n", "deg: 25\n    touchdown_angle_sigma_deg: 0.5\n");
  const Trial& trial = dataset.trials[0];
  EXPECT_EQ(trial.touchdown_angles_rad, (std::vector<double>{DegToRad(25), DegToRad(25)}));
  EXPECT_EQ(trial.touchdown_angle_sigma_rad, DegToRad(0.5));
  ExpectRoundTrip(dataset);
}

TEST(BadTouchdownAngles, AreToldWithPlaceValueRuleAndRemedy) {
  ExpectSays({
      {ErrorOfAngle("[25]"),
       "hops/dataset.yaml:10: touchdown_angle_deg has 1 angle; hops/a.csv shows 2 touch-downs, and "
       "each needs its own. Add what is missing, or end the record before."},
      {ErrorOfAngle("[]"),
       "hops/dataset.yaml:12: trials[0].touchdown_angle_deg = (a list); must have at least 1 item. "
       "Add what is missing."},
      {ErrorOfAngle("[25, 200]"),
       "hops/dataset.yaml:12: trials[0].touchdown_angle_deg[1] = 200; must be in (-90, 180) deg. "
       "Check the unit: deg is meant."},
      {ErrorOfAngle("[25, ahead]"),
       "hops/dataset.yaml:12: trials[0].touchdown_angle_deg[1] = ahead; is not a number; must be "
       "in (-90, 180) deg. Write a number such as 0.09 or 22e9, without unit."},
      {ErrorOfAngle("{from: leg_angel}"),
       "hops/dataset.yaml:12: trials[0].touchdown_angle_deg.from = leg_angel; must be one of "
       "leg_angle. Did you mean leg_angle?"},
      {ErrorOfAngle("{at: leg_angle}"),
       "hops/dataset.yaml:12: trials[0].touchdown_angle_deg.at; unknown key. Known: from."},
      {ErrorOfAngle("{from: leg_angle}", "time_s,body_y_m\n0,0.3\n0.1,0.1\n"),
       "hops/dataset.yaml:10: touchdown_angle_deg = {from: leg_angle}; hops/a.csv has no column "
       "leg_angle_rad to read it from. Add the column, or give the angles."},
      {ErrorOfAngle("{from: leg_angle}", "time_s,body_y_m,leg_angle_rad\n0,0.3,1\n0.1,0.29,1\n"),
       "hops/dataset.yaml:10: touchdown_angle_deg = {from: leg_angle}; hops/a.csv shows no "
       "touch-down. Give the angle itself."},
      {ErrorOfAngle("{from: leg_angle}", "time_s,body_y_m,leg_angle_rad\n0,0.3,25\n0.1,0.1,25\n"),
       "hops/a.csv: leg_angle_rad = 25 at 0.0604 s; the leg touches down there; must be in (-90, "
       "180) deg. Check its unit and where it counts from: 0 is upright, ahead positive."},
  });
}

// ---- initial states

TEST(InitialStates, MayLieInStance) {
  const std::string start =
      "deg: 25\n    initial: {x_m: 0, y_m: 0.15, vx_m_per_s: 1, vy_m_per_s: -1, contact_x_m: 0.03";
  const std::string sigma = "\n    initial_sigma: {y_m: 0.002, contact_x_m: 0.004}\n";
  for (const auto& [mode, expected] : {std::pair(", mode: rolling}", StartMode::kRolling),
                                       {", mode: toe}", StartMode::kToe},
                                       {", mode: stance}", StartMode::kStance},
                                       {"}", StartMode::kStance}}) {
    const Dataset dataset = RecordWith("deg: 25\n", start + mode + sigma);
    ASSERT_TRUE(dataset.trials[0].initial);
    EXPECT_EQ(dataset.trials[0].initial->mode, expected);
    EXPECT_EQ(dataset.trials[0].initial->contact_x_m, 0.03);
    EXPECT_EQ(dataset.trials[0].initial_sigma->contact_x_m, 0.004);
    ExpectRoundTrip(dataset);
  }
}

TEST(BadInitialStates, AreToldWithPlaceValueRuleAndRemedy) {
  const auto of = [](const std::string& more, const std::string& yaml = kRecordYaml) {
    return InputErrorOf([&] {
      ReadRecord(Replace(yaml, "deg: 25\n",
                         "deg: 25\n    initial: {x_m: 0, y_m: 0.15, vx_m_per_s: 1, vy_m_per_s: -1" +
                             more + "}\n"));
    });
  };
  const std::string straight =
      Replace(Replace(kRecordYaml, "c_leg", "straight_leg"),
              "{rest_radius_m: 0.09, E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: 0.0038, "
              "damping_N_s_per_m: 3}",
              "{rest_length_m: 0.2, stiffness_N_per_m: 1000, damping_N_s_per_m: 0}");
  const std::string ball = Replace(
      Replace(Replace(kRecordYaml, "c_leg", "ball"), "    touchdown_angle_deg: 25\n",
              "    touchdown_angle_deg: 25\n"),
      "leg: {rest_radius_m: 0.09, E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: 0.0038, "
      "damping_N_s_per_m: 3}",
      "ball: {radius_m: 0.03, restitution: 0.8, tangential_loss: 0}");
  ExpectSays({
      {of(", mode: rolling"),
       "hops/dataset.yaml:13: trials[0].initial.mode = rolling; is a start in stance, which needs "
       "contact_x_m. Add contact_x_m, the place of the ground that carries the leg."},
      {of(", contact_x_m: 0.1, mode: flight"),
       "hops/dataset.yaml:13: trials[0].initial.mode = flight; is a start in flight, which has no "
       "contact. Remove contact_x_m, or say mode: stance."},
      {of(", contact_x_m: 0.1, mode: standing"),
       "hops/dataset.yaml:13: trials[0].initial.mode = standing; must be one of flight, rolling, "
       "toe, stance. Write one of these words."},
      {of(", contact_mm: 3"),
       "hops/dataset.yaml:13: trials[0].initial.contact_mm; unknown key. Did you mean "
       "contact_x_m?"},
      {of(", contact_x_m: 0.1, mode: toe", straight),
       "hops/dataset.yaml:10: trials[0] = (a block of keys); a straight leg neither rolls nor has "
       "another toe: its one mode is stance. Write mode: stance."},
      {of(", contact_x_m: 0.1", ball),
       "hops/dataset.yaml:10: trials[0] = (a block of keys); a ball has no stance to begin in. "
       "Begin the record in flight."},
  });
}

}  // namespace
}  // namespace hoplab
