// The log of a robot, as another program wrote it, becomes a dataset that is checked and fitted.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

struct Foreign {
  std::string own, title;
  double factor;  // foreign over own
};
const std::vector<Foreign> kNames = {{"time_s", "Time [ms]", 1e3},
                                     {"body_x_m", "trunk X [mm]", 1e3},
                                     {"body_y_m", "trunk Z [mm]", 1e3},
                                     {"body_pitch_rad", "pitch_deg", 180 / std::numbers::pi},
                                     {"leg_angle_1_rad", "motor_0_angle", 180 / std::numbers::pi},
                                     {"leg_angle_2_rad", "motor_1_angle", 180 / std::numbers::pi},
                                     {"hip_torque_1_N_m", "tau_0 [N cm]", 1e2},
                                     {"contact_1", "contact0", 1}};

class RobotImportCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }

  // The columns of a trial under other names and in other units.
  void Rename(const std::string& from, const std::string& to) {
    std::istringstream lines(ReadText(temp_.path() / from));
    std::string line, text;
    std::vector<double> factors;
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      std::string cell;
      for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
        text += i == 0 ? "" : ",";
        if (text.empty() || factors.size() <= i) {
          const auto is = std::find_if(kNames.begin(), kNames.end(),
                                       [&](const Foreign& f) { return f.own == cell; });
          ASSERT_NE(is, kNames.end()) << cell;
          factors.push_back(is->factor);
          text += is->title;
        } else {
          std::ostringstream number;
          number.precision(15);
          number << std::stod(cell) * factors[i];
          text += number.str();
        }
      }
      text += "\n";
    }
    WriteText(temp_.path() / to, text);
  }

  // What only the user can know of experiments/robot-drop.yaml, but for E, which begins 10 % off.
  static std::vector<std::string> Constants() {
    std::vector<std::string> arguments;
    for (const char* value :
         {"mechanism.body_mass_kg=3", "mechanism.pitch_inertia_kg_m2=0.05", "mechanism.friction=1",
          "mechanism.motor.rotor_inertia_kg_m2=0.001", "mechanism.motor.kp_N_m_per_rad=60",
          "mechanism.motor.kd_N_m_s_per_rad=0.8", "mechanism.motor.torque_limit_N_m=15",
          "mechanism.leg.rest_radius_m=0.09", "mechanism.leg.E_Pa=24.2e9",
          "mechanism.leg.width_m=0.03", "mechanism.leg.thickness_m=0.00418734",
          "mechanism.leg.material_damping_s=0.0004", "mechanism.legs.0.hip_m=[-0.12, 0]",
          "mechanism.legs.1.hip_m=[0.12, 0]", "controller={type: held, angles_rad: [0.6, 0.4]}",
          "trials.1.controller={type: held, angles_rad: [0.4, 0.5]}"}) {
      arguments.emplace_back("--set");
      arguments.emplace_back(value);
    }
    return arguments;
  }

  static double ModulusOf(const nlohmann::json& record, const std::string& name) {
    for (const auto& p : record.at("parameters"))
      if (p.at("name") == name) return p.at("value").get<double>();
    return std::nan("");
  }

  TempFolder temp_;
};

TEST_F(RobotImportCli, WhatIsRenamedAndImportedIsFittedAsTheOriginal) {
  const std::string scenario =
      (std::filesystem::path(HOPLAB_SOURCE_DIR) / "experiments/robot-drop.yaml").string();
  ASSERT_EQ(Hoplab({"generate", scenario, "--out", "original"}).exit_code, 0);
  Rename("original/train-1.csv", "a.csv");
  Rename("original/train-2.csv", "b.csv");
  Rename("original/test-3.csv", "c.csv");
  const std::vector<std::string> call = {"import", "a.csv",      "b.csv", "c.csv",
                                         "--role", "c.csv=test", "--out", "mine"};
  const ProcessResult asked = Hoplab(call);
  EXPECT_EQ(asked.exit_code, 64);
  EXPECT_NE(asked.err.find("leg_angle_2_rad   motor_1_angle  deg   guessed"), std::string::npos)
      << asked.err;
  EXPECT_NE(asked.err.find("mechanism: robot, 2 legs"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(temp_.path() / "mine"));

  std::vector<std::string> filled = call;
  filled.emplace_back("--accept-guesses");
  const std::vector<std::string> constants = Constants();
  filled.insert(filled.end(), constants.begin(), constants.end());
  const ProcessResult made = Hoplab(filled);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out.find("to fill in"), std::string::npos) << made.out;
  const ProcessResult check = Hoplab({"check", "mine"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("nothing weakly"), std::string::npos) << check.out;

  const auto fit = [&](const char* dataset) {
    const ProcessResult run = Hoplab({"fit", dataset, "--json", "--quiet"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return nlohmann::json::parse(run.out);
  };
  const auto original = fit("original"), imported = fit("mine");
  for (const char* name : {"E_1", "E_2"}) {
    EXPECT_NEAR(ModulusOf(imported, name), ModulusOf(original, name), 0.003 * 22e9) << name;
    EXPECT_NEAR(ModulusOf(imported, name), 22e9, 0.007 * 22e9) << name;
  }
}

TEST_F(RobotImportCli, WhatIsWrongIsToldAndNothingIsWritten) {
  std::string text = "t [s],x [m],y [m],pitch [rad],q1 [rad],q2 [rad],c1\n";
  for (int i = 0; i < 60; ++i) {
    const double t = 0.002 * i;
    text += std::to_string(t) + ",0," + std::to_string(0.3 - 4.905 * t * t) + ",0.1,0.5,0.5,0.5\n";
  }
  WriteText(temp_.path() / "log.csv", text);
  const std::vector<std::pair<std::vector<std::string>, std::string>> calls = {
      {{"--legs", "1"}, "--legs: 1; there are columns of leg 2. Leave --legs out"},
      {{"--type", "ball", "--legs", "2"}, "--legs: ball; only a robot has a pitch"},
      {{"--type", "c_leg", "--map", "leg_angle_1=q1"}, "--type: c_leg; only a robot has a pitch"},
      {{"--unit", "furlong"}, "--unit: furlong; is no unit that is known"},
      {{"--unit", "deg", "--unit", "rad"}, "--unit: rad; is an angle, and so is deg"},
      {{"--map", "leg_angle_5=q1"}, "--map: leg_angle_5; is no channel"},
      {{"--map", "contact_1=c1"}, "log.csv:2: c1 = 0.5; must be 0 or 1"},
      {{"--set", "mechanism.legs.2.hip_m=[0, 0]"}, "is no value that a new dataset waits for"},
      {{"--set", "mechanism.legs.0.hip_m=0.1"}, "is not a list. Write it on one line, as [1, 1]"},
      {{"--set", "controller=held"}, "is not a block. Write it on one line, as {type: locked"},
      {{"--set", "controller={type: held, angles_rad: [0.5]}"},
       "1 angles or phases, and the robot 2"},
      {{"--set", "mechanism.leg.material_damping_s=3"}, "must be in [0, 0.1] s"}};
  for (const auto& [call, says] : calls) {
    std::vector<std::string> arguments = {"import", "log.csv", "--accept-guesses", "--out", "d"};
    arguments.insert(arguments.end(), call.begin(), call.end());
    const ProcessResult run = Hoplab(arguments);
    EXPECT_EQ(run.exit_code, 65) << call[1] << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
  }
  EXPECT_EQ(CountEntries(temp_.path()), 1);
}

}  // namespace
}  // namespace hoplab::testing
