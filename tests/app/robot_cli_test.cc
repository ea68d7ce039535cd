// A robot on clamped legs through the program: shipped scenarios and data.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/hoplab_process.h"
#include "tests/support/csv_rows.h"

namespace hoplab::testing {
namespace {

class RobotCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  TempFolder temp_;
};

TEST_F(RobotCli, TheShippedScenariosRun) {
  for (const char* name : {"experiments/robot-drop.yaml", "experiments/robot-straight-drop.yaml",
                           "experiments/robot-walk.yaml", "experiments/robot-straight-walk.yaml"}) {
    const ProcessResult run = Hoplab({"simulate", Shipped(name), "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto record = nlohmann::json::parse(run.out);
    EXPECT_EQ(record.at("outcome"), "completed") << name;
  }
}

TEST_F(RobotCli, WhatItGeneratesItFits) {
  ASSERT_EQ(Hoplab({"generate", Shipped("experiments/robot-drop.yaml"), "--out", "made", "--set",
                    "mechanism.legs=[{hip_m: [-0.12, 0]}, {hip_m: [0.12, 0], E_Pa: 18e9}]"})
                .exit_code,
            0);
  const ProcessResult check = Hoplab({"check", "made"});
  EXPECT_EQ(check.exit_code, 0) << check.err << check.out;
  const ProcessResult fit =
      Hoplab({"fit", "made", "--json", "--quiet", "--free", "E_1,E_2,leg_damping"});
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  for (const auto& p : nlohmann::json::parse(fit.out).at("parameters")) {
    const std::string name = p.at("name");
    if (name == "E_1") {
      EXPECT_NEAR(p.at("value").get<double>(), 22e9, 0.15e9);
    }
    if (name == "E_2") {
      EXPECT_NEAR(p.at("value").get<double>(), 18e9, 0.15e9);
    }
  }
}

// Straight legs: k comes out of a fit within its interval, and what is of half circles is refused.
TEST_F(RobotCli, FitsStraightLegs) {
  ASSERT_EQ(Hoplab({"generate", Shipped("experiments/robot-straight-drop.yaml"), "--out", "made"})
                .exit_code,
            0);
  const ProcessResult check = Hoplab({"check", "made"});
  EXPECT_EQ(check.exit_code, 0) << check.err << check.out;
  const ProcessResult fit = Hoplab({"fit", "made", "--json", "--quiet"});
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  const auto record = nlohmann::json::parse(fit.out);
  const auto& found = record.at("parameters");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1].at("name"), "leg_damping");
  const auto& k = found[0];
  EXPECT_EQ(k.at("name"), "k");
  EXPECT_LT(k.at("ci95")[0].get<double>(), 4000.0);
  EXPECT_GT(k.at("ci95")[1].get<double>(), 4000.0);
  EXPECT_LT(k.at("ci95")[1].get<double>() - k.at("ci95")[0].get<double>(), 40.0);
  const auto refused = [&](const char* dataset, const char* name, const char* why) {
    const ProcessResult run = Hoplab({"fit", dataset, "--free", name});
    EXPECT_EQ(run.exit_code, 65) << name;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
  };
  for (const char* name : {"E", "E_1", "r", "clamp", "I"})
    refused("made", name, "is of a half circle, and this robot's legs are straight");
  refused("made", "rest_radius_scale.rho_r", "is of half circles");
  const std::string arcs = Shipped("datasets/robot-drops");
  for (const char* name : {"k", "l0", "k_lateral"})
    refused(arcs.c_str(), name, "is of a straight leg, and this robot's are half circles");
}

TEST_F(RobotCli, TheTrajectoryOfStraightLegsHasNoArc) {
  ASSERT_EQ(Hoplab({"simulate", Shipped("experiments/robot-straight-drop.yaml"), "--out", "run"})
                .exit_code,
            0);
  int down = 0;
  for (const auto& row :
       CsvRows(temp_.path() / "run" / "trajectory.csv",
               {"contact_1", "leg_contact_x_1_m", "leg_force_y_1_N", "leg_arc_1_rad"})) {
    const bool stands = row[0] == "1";
    EXPECT_EQ(row[1].empty(), !stands);
    EXPECT_EQ(row[2].empty(), !stands);
    EXPECT_TRUE(row[3].empty()) << row[3];
    down += stands;
  }
  EXPECT_GT(down, 20);
}

// Robots of a physics engine, E I of their legs known: E with the datasets' section.
struct EnginesRobot {
  const char* dataset;
  std::size_t legs;
  double E, within;  // [Pa], of it
  double noises;     // of the channels, the held-out error at most
  double gradients;  // how far the derivatives are off at most
};
class RobotOfAnEngine : public RobotCli, public ::testing::WithParamInterface<EnginesRobot> {};

TEST_P(RobotOfAnEngine, HasTheModulusOfEachLegFound) {
  const EnginesRobot& is = GetParam();
  const ProcessResult fit =
      Hoplab({"fit", Shipped(std::string("datasets/") + is.dataset), "--json", "--quiet"});
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  const auto record = nlohmann::json::parse(fit.out);
  ASSERT_EQ(record.at("parameters").size(), is.legs + 1);  // each E, and what damps them
  for (const auto& p : record.at("parameters")) {
    if (p.at("name") == "leg_damping") continue;
    EXPECT_NEAR(p.at("value").get<double>(), is.E, is.within * is.E) << p.at("name");
  }
  const auto& rmse = record.at("test").at("rmse");
  for (const auto& [channel, error] : rmse.items()) {
    const bool is_length = channel == "body_x_m" || channel == "body_y_m";
    EXPECT_LT(error.get<double>(), is.noises * (is_length ? 0.0005 : 0.001)) << channel;
  }
  EXPECT_EQ(rmse.size(), 3 + is.legs);
  EXPECT_LT(record.at("gradient_check").at("max_relative_error"), is.gradients);
}

INSTANTIATE_TEST_SUITE_P(
    All, RobotOfAnEngine,
    ::testing::Values(EnginesRobot{"robot-drops", 2, 21.991e9, 0.005, 1.2, 1e-6},
                      EnginesRobot{"robot-walk", 3, 30.817e9, 0.02, 1.6, 1e-4},
                      EnginesRobot{"robot-pronk", 2, 23.633e9, 0.02, 2.0, 1e-4}),
    [](const auto& is) { return std::string(is.param.dataset).substr(sizeof("robot")); });

// The leg that is soft is named, not its like, and the other trial says so, too.
TEST_F(RobotCli, DiagnosisNamesTheSoftLeg) {
  ASSERT_EQ(Hoplab({"generate", Shipped("experiments/robot-drop.yaml"), "--out", "made", "--with",
                    "leg_stiffness_2:loss=0.2", "--set",
                    "dataset.channels.hip_torque_2_N_m={sigma: 0.005}"})
                .exit_code,
            0);
  const ProcessResult run =
      Hoplab({"diagnose", "made", "--effects",
              "leg_stiffness_1,leg_stiffness_2,motor_gain_2,backlash_2", "--json", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("verdict"), "named");
  ASSERT_EQ(record.at("causes").size(), 1u);
  const auto& cause = record.at("causes")[0];
  EXPECT_EQ(cause.at("name"), "leg_stiffness_2");
  EXPECT_NEAR(cause.at("parameters")[0].at("value").get<double>(), 0.2, 0.002);
  EXPECT_GT(cause.at("held_out_gain").at("nats_per_sample").get<double>(), 0.2);
  // By the first stances, then carried on to the whole trials.
  EXPECT_EQ(record.at("fitted"), "first parts");
  EXPECT_GT(record.at("fitted_until_s").get<double>(), 0.0);
  const auto& whole = record.at("whole_trials");
  EXPECT_TRUE(whole.at("followed").get<bool>()) << whole.at("sentence");
  EXPECT_NEAR(whole.at("chi2_per_sample").get<double>(), 1.0, 0.1);
  EXPECT_EQ(whole.at("parameters")[0].at("name"), "E");
  EXPECT_NEAR(whole.at("parameters")[0].at("value").get<double>(), 22e9, 0.01 * 22e9);
  EXPECT_NE(whole.at("sentence").get<std::string>().find("follows them to their end: E 2"),
            std::string::npos);
  // Runs with play are slow: nothing is left for it, so it is not tried.
  for (const auto& candidate : record.at("candidates"))
    EXPECT_EQ(candidate.at("refit").is_null(), candidate.at("effect") == "backlash_2") << candidate;
  // A leg this robot does not have is no cause of it.
  const ProcessResult third = Hoplab({"diagnose", "made", "--effects", "leg_stiffness_3"});
  EXPECT_EQ(third.exit_code, 65);
  EXPECT_NE(third.err.find("is of a leg this robot does not have"), std::string::npos) << third.err;
}

// Small sizes of it change nothing: it is sought from several.
TEST_F(RobotCli, DiagnosisNamesTheGearWithPlay) {
  ASSERT_EQ(Hoplab({"generate", Shipped("experiments/robot-drop.yaml"), "--out", "made", "--with",
                    "backlash_2:play=0.02"})
                .exit_code,
            0);
  const ProcessResult run =
      Hoplab({"diagnose", "made", "--effects", "backlash_1,backlash_2,motor_gain_2,leg_stiffness_2",
              "--json", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("verdict"), "named");
  ASSERT_EQ(record.at("causes").size(), 1u);
  const auto& cause = record.at("causes")[0];
  EXPECT_EQ(cause.at("name"), "backlash_2");
  EXPECT_NEAR(cause.at("parameters")[0].at("value").get<double>(), 0.02, 0.0005);
  // What the size is told for, and how to fit that, too.
  EXPECT_NE(record.at("notes").dump().find(
                "sizes are told for backlash_2.tooth_torque 20 N m, backlash_2.tooth_damping 0.2 "
                "s/rad, backlash_2.hub_share 0.1, which are taken as given"),
            std::string::npos)
      << record.at("notes");
  const std::string free =
      "--free E,leg_damping,backlash_2.play,backlash_2.tooth_torque,backlash_2.tooth_damping,"
      "backlash_2.hub_share`";
  EXPECT_NE(record.at("notes").dump().find(free), std::string::npos) << record.at("notes");
}

TEST_F(RobotCli, RefusesWhatDoesNotGoTogether) {
  const auto refused = [&](const std::string& set, const std::string& why) {
    const ProcessResult run =
        Hoplab({"simulate", Shipped("experiments/robot-drop.yaml"), "--set", set});
    EXPECT_EQ(run.exit_code, 65) << set;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
  };
  refused("controller.angles_rad=[0.5]", "has 1 angles or phases, and the robot 2 legs");
  refused("controller=null", "a robot needs a controller");
  refused("touchdown_angle_deg=20", "said by its controller");
  refused("mechanism.motor.kp_N_m_per_rad=-1", "kp_N_m_per_rad");
  refused("initial.mode=stance", "contact_x_m");
  refused("mechanism.leg.mass_kg=-0.01", "mass_kg");
  refused("mechanism.leg.type=bent", "type");
  refused("mechanism.leg.type=straight", "is of a half circle, and these legs are straight");
  refused("mechanism.leg.rest_length_m=0.18", "is of a straight leg, and these are half circles");
  const ProcessResult gait = Hoplab({"gait", Shipped("experiments/robot-drop.yaml")});
  EXPECT_EQ(gait.exit_code, 65);
  EXPECT_NE(gait.err.find("makes no strides"), std::string::npos) << gait.err;
  const auto search = [&](const std::string& objective) {
    return Hoplab({"optimize", Shipped("experiments/robot-walk.yaml"), "--set",
                   "search={over: {controller.duty: [0.75, 0.8]}, objective: " + objective + "}"});
  };
  EXPECT_EQ(search("convergence_time").exit_code, 65);
  EXPECT_NE(search("convergence_time").err.find("does not make"), std::string::npos);
  const ProcessResult hopper = Hoplab({"optimize", Shipped("experiments/fastest-convergence.yaml"),
                                       "--set", "search.objective=speed"});
  EXPECT_EQ(hopper.exit_code, 65);
  EXPECT_NE(hopper.err.find("robot's stride"), std::string::npos) << hopper.err;
}

// The next drop of a robot: its legs' angles and pitch are set, not a touch-down angle.
TEST_F(RobotCli, ProposesADropOverTheAnglesOfItsLegs) {
  const auto design = [&](const std::string& space) {
    return Hoplab({"design", Shipped("datasets/robot-drops"), "--sharpen", "E", "--budget", "12",
                   "--map", "2", "--space", space, "--json", "--quiet"});
  };
  const ProcessResult run = design("leg_1=0:20,mass=0,throw=0");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto record = nlohmann::json::parse(run.out);
  const auto& best = record.at("designs").at(0);
  EXPECT_GT(best.at("worth").get<double>(), 0.0);
  EXPECT_LT(best.at("half_width"), record.at("sharpened").at("half_width"));
  const auto& settings = best.at("settings");
  EXPECT_TRUE(settings.at("touchdown_angle_rad").is_null());
  EXPECT_TRUE(settings.contains("pitch_rad"));
  EXPECT_TRUE(settings.contains("leg_angle_2_rad"));
  EXPECT_FALSE(settings.contains("leg_angle_3_rad"));
  const double angle = settings.at("leg_angle_1_rad").get<double>();
  EXPECT_GE(angle, 0.0);
  EXPECT_LE(angle, 0.35);
  EXPECT_EQ(settings.at("added_mass_kg"), 0.0);
  const ProcessResult refused = design("angle=10:50");
  EXPECT_EQ(refused.exit_code, 65);
  EXPECT_NE(refused.err.find("angle; cannot be set in these trials"), std::string::npos)
      << refused.err;
}

// Three legs, the middle one half a turn behind: a stable stride, whatever the number of jobs.
TEST_F(RobotCli, FindsTheSteadyStrideOfAWalkingRobot) {
  const auto gait = [&](const char* jobs) {
    return Hoplab({"gait", Shipped("experiments/robot-walk.yaml"), "--tolerance", "1e-9", "--jobs",
                   jobs, "--json", "--quiet", "--out", std::string("gait-") + jobs});
  };
  const ProcessResult run = gait("2");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  auto record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("stable"), true);
  EXPECT_NEAR(record.at("spectral_radius").get<double>(), 0.8203, 0.001);
  EXPECT_NEAR(record.at("stride").at("speed_m_per_s").get<double>(), 0.2472, 0.0005);
  EXPECT_EQ(record.at("stride").at("legs").size(), 3u);
  EXPECT_EQ(record.at("multipliers").size(), 14u);
  EXPECT_EQ(record.at("own_run").at("outcome"), "completed");
  EXPECT_TRUE(std::filesystem::exists(temp_.path() / "gait-2" / "cycles.csv"));
  auto alone = nlohmann::json::parse(gait("1").out);
  for (auto* r : {&record, &alone}) {
    for (const char* key : {"seconds", "command_line", "started"}) r->erase(key);
  }
  EXPECT_EQ(record.at("d_spectral_radius"), alone.at("d_spectral_radius"));
}

// What a search finds is at least as good as what it began with, and stands as the limit says.
TEST_F(RobotCli, SearchesTheClockOfARobot) {
  const ProcessResult run = Hoplab(
      {"optimize", Shipped("experiments/robot-walk.yaml"), "--set",
       "search={over: {controller.period_s: [0.52, 0.56], controller.phases.1: [0.48, 0.52]}, "
       "objective: cost_of_transport, constraints: {min_speed_m_per_s: 0.24}}",
       "--budget", "14", "--seeds", "1", "--map", "0", "--json", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto record = nlohmann::json::parse(run.out);
  const auto& best = record.at("best");
  EXPECT_GE(best.at("steady_speed_m_per_s").get<double>(), 0.24);
  EXPECT_LT(best.at("spectral_radius").get<double>(), 1.0);
  EXPECT_LE(best.at("cost_of_transport").get<double>(),
            record.at("before").at("cost_of_transport").get<double>());
  EXPECT_TRUE(best.at("parameters").contains("controller.phases.1"));
}

// A log of what held motors were told, with next to no noise, moves the robot as they did; what is
// generated of it is checked and fitted, its inputs with it.
TEST_F(RobotCli, MotorsFollowALog) {
  std::filesystem::copy_file(Shipped("experiments/robot-drop.yaml"), temp_.path() / "drop.yaml");
  ASSERT_EQ(Hoplab({"generate", "drop.yaml", "--set", "dataset.sample_rate_hz=2000", "--set",
                    "dataset.channels.hip_torque_2_N_m={sigma: 1}", "--set",
                    "dataset.trials=[{role: train}]", "--noise", "1e-9", "--out", "log"})
                .exit_code,
            0);
  const auto told = [&](std::vector<std::string> arguments) {
    for (const char* set :
         {"controller.type=recorded", "inputs.hip_torque_1_N_m={file: log/train-1.csv}",
          "inputs.hip_torque_2_N_m={file: log/train-1.csv}",
          "dataset.channels={body_x_m: {sigma: 0.0005}, body_y_m: {sigma: "
          "0.0005}, body_pitch_rad: {sigma: 0.001}}",
          "dataset.sample_rate_hz=2000", "dataset.trials=[{role: train}]"})
      arguments.insert(arguments.end(), {"--set", set});
    return Hoplab(arguments);
  };
  const ProcessResult held = Hoplab({"simulate", "drop.yaml", "--json"});
  const ProcessResult again = told({"simulate", "drop.yaml", "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto first = nlohmann::json::parse(held.out), second = nlohmann::json::parse(again.out);
  EXPECT_EQ(second.at("mechanism").at("driven_by"),
            nlohmann::json::parse(R"(["hip_torque_1", "hip_torque_2"])"));
  EXPECT_EQ(second.at("events").size(), first.at("events").size());
  const auto &then = first.at("final_state"), &now = second.at("final_state");
  for (const char* key : {"x_m", "y_m"})
    EXPECT_NEAR(now.at(key).get<double>(), then.at(key).get<double>(), 1e-4) << key;

  ASSERT_EQ(told({"generate", "drop.yaml", "--out", "made"}).exit_code, 0);
  EXPECT_EQ(Hoplab({"check", "made"}).exit_code, 0);
  const ProcessResult fit =
      Hoplab({"fit", "made", "--json", "--quiet", "--free", "E,input.hip_torque_2.scale"});
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  for (const auto& p : nlohmann::json::parse(fit.out).at("parameters")) {
    const bool modulus = p.at("name") == "E";
    EXPECT_NEAR(p.at("value").get<double>(), modulus ? 22e9 : 1.0, modulus ? 0.3e9 : 0.02);
  }
  const ProcessResult both =
      Hoplab({"simulate", "drop.yaml", "--set", "inputs.hip_torque_1_N_m={file: log/train-1.csv}"});
  EXPECT_EQ(both.exit_code, 65);
  EXPECT_NE(both.err.find("controller of type held"), std::string::npos) << both.err;
}

}  // namespace
}  // namespace hoplab::testing
