// A robot on straight legs: read, written back, blank, and refused with place and remedy.

#include <gtest/gtest.h>

#include "datasets/write_dataset.h"
#include "tests/datasets/small_dataset.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;
using testing::Replace;

const char* const kRodYaml =
    "format: hoplab-dataset/1\n"  // 1
    "name: drop\n"                // 2
    "mechanism:\n"                // 3
    "  type: robot\n"             // 4
    "  body_mass_kg: 3\n"         // 5
    "  gravity_m_per_s2: 9.81\n"  // 6
    "  pitch_inertia_kg_m2: 0.05\n"
    "  motor: {rotor_inertia_kg_m2: 0.001, kp_N_m_per_rad: 60, kd_N_m_s_per_rad: 0.8}\n"
    "  leg:\n"                                             // 9
    "    type: straight\n"                                 // 10
    "    rest_length_m: 0.18\n"                            // 11
    "    stiffness_N_per_m: 4000\n"                        // 12
    "    lateral_stiffness_N_per_m: 2e4\n"                 // 13
    "    material_damping_s: 0.0004\n"                     // 14
    "    mass_kg: 0.02\n"                                  // 15
    "  legs: [{hip_m: [-0.12, 0]}, {hip_m: [0.12, 0]}]\n"  // 16
    "controller: {type: held, angles_rad: [0.1, -0.1]}\n"  // 17
    "channels: {body_y_m: {sigma: 0.001}}\n"               // 18
    "trials:\n"                                            // 19
    "  - file: a.csv\n"                                    // 20
    "    role: train\n"                                    // 21
    "    initial: {x_m: 0, y_m: 0.3, vx_m_per_s: 0, vy_m_per_s: 0}\n";

Dataset ReadRods(const std::string& yaml) {
  return ReadDatasetText(yaml, {{"a.csv", "time_s,body_y_m\n0.0,0.3\n0.1,0.26\n"}}, "drop");
}
std::string RodError(const std::string& from, const std::string& to) {
  return InputErrorOf([&] { ReadRods(Replace(kRodYaml, from, to)); });
}

TEST(StraightLegsOfARobot, AreReadAndWrittenBack) {
  const Dataset dataset = ReadRods(kRodYaml);
  const RobotSpec& robot = dataset.trials[0].mechanism.robot;
  EXPECT_TRUE(robot.straight_legs);
  EXPECT_EQ(robot.rest_length_m, 0.18);
  EXPECT_EQ(robot.stiffness_N_per_m, 4000);
  EXPECT_EQ(robot.lateral_stiffness_N_per_m, 2e4);
  EXPECT_EQ(robot.material_damping_s, 0.0004);
  EXPECT_EQ(robot.leg_mass_kg, 0.02);
  std::map<std::string, std::string> files = FormatDataset(dataset);
  EXPECT_EQ(ReadDatasetText(files["dataset.yaml"], files), dataset) << files["dataset.yaml"];
}

TEST(StraightLegsOfARobot, BadValuesAreToldWithPlaceAndRemedy) {
  EXPECT_EQ(RodError("stiffness_N_per_m: 4000", "stiffness_N_per_m: -4000"),
            "drop/dataset.yaml:12: mechanism.leg.stiffness_N_per_m = -4000; must be in (0, 1e9] "
            "N/m. Check the sign.");
  EXPECT_EQ(RodError("rest_length_m: 0.18", "rest_length_m: 0"),
            "drop/dataset.yaml:11: mechanism.leg.rest_length_m = 0; must be in (0, 100] m. Check "
            "the unit: m is meant.");
  EXPECT_EQ(RodError("type: straight", "type: bent"),
            "drop/dataset.yaml:10: mechanism.leg.type = bent; must be one of arc, straight. "
            "Write one of these words.");
}

TEST(StraightLegsOfARobot, HaveNoKeyOfHalfCircles) {
  EXPECT_EQ(RodError("    mass_kg: 0.02\n", "    E_Pa: 22e9\n"),
            "drop/dataset.yaml:15: mechanism.leg.E_Pa; is of a half circle, and these legs are "
            "straight. Remove it, or write type: arc.");
  EXPECT_EQ(RodError("{hip_m: [0.12, 0]}", "{hip_m: [0.12, 0], E_Pa: 22e9}"),
            "drop/dataset.yaml:16: mechanism.legs[1].E_Pa; is of a half circle, and these legs are "
            "straight. Remove it: straight legs are alike but for the effect leg_stiffness_1.");
  EXPECT_EQ(RodError("    type: straight\n", ""),
            "drop/dataset.yaml:10: mechanism.leg.rest_length_m; is of a straight leg, and these "
            "are half circles. Write type: straight beside it.");
}

TEST(StraightLegsOfARobot, AreMissedWhereTheyAreBlank) {
  const std::string missed = RodError("    stiffness_N_per_m: 4000\n", "");
  EXPECT_NE(missed.find("stiffness_N_per_m"), std::string::npos) << missed;
  std::string yaml = Replace(kRodYaml, "stiffness_N_per_m: 4000", "stiffness_N_per_m:");
  yaml = Replace(yaml, "rest_length_m: 0.18", "rest_length_m:");
  EXPECT_EQ(InputErrorOf([&] { ReadRods(yaml); }),
            "drop/dataset.yaml: 2 values are still blank, and a fit needs them. Write each behind "
            "its key:\n"
            "  line 11  mechanism.leg.rest_length_m  (from hip to toe, unloaded: tape measure)\n"
            "  line 12  mechanism.leg.stiffness_N_per_m  (along each leg, the start of the fit: "
            "press it)");
}

// One set of parameters is fitted to all trials.
TEST(StraightLegsOfARobot, AreThoseOfAllTrials) {
  const std::string other =
      "    role: train\n    mechanism: {leg: {type: arc, rest_length_m: null, stiffness_N_per_m: "
      "null, lateral_stiffness_N_per_m: null, rest_radius_m: 0.09, E_Pa: 22e9, second_moment_m4: "
      "1e-10}}\n";
  EXPECT_EQ(RodError("    role: train\n", other),
            "drop/dataset.yaml:22: trials[0].mechanism.leg.type = arc; all trials must have the "
            "same type of legs. Make a dataset of its own for it.");
}

}  // namespace
}  // namespace hoplab
