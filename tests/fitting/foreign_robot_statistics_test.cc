// Robots with one thing wrong that a physics engine runs (tests/support/beam_robot.h): what
// diagnose calls a main cause, and whether it is there. HOPLAB_ROBOTS: how many, from
// HOPLAB_ROBOT_SEED on; one of each fault by default. HOPLAB_ROBOT_TORQUE=1: the torque told to the
// motors is compared, too. ctest -L statistics -R ForeignRobots

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <thread>

#include "datasets/read_dataset.h"
#include "fitting/diagnosis/diagnosis.h"
#include "tests/support/beam_robot.h"
#include "tests/support/robot_requests.h"
#include "tests/support/temp_folder.h"

namespace hoplab::testing {
namespace {

// A `%` in the name stands for the leg, each in turn.
struct Fault {
  const char* cause;  // of the catalogue; empty: none
  void (*plant)(Parameters<double>& p, std::size_t leg);
};
constexpr Fault kFaults[] = {
    {"", [](Parameters<double>&, std::size_t) {}},
    {"leg_stiffness_%",
     [](Parameters<double>& p, std::size_t leg) { p.robot->E_scale[leg] = 0.8; }},
    {"com_offset", [](Parameters<double>& p, std::size_t) { p.robot->com_x = 0.008; }},
    {"motor_gain_%", [](Parameters<double>& p, std::size_t leg) { p.robot->gain_of[leg] = 0.9; }},
    {"ground_slope",
     [](Parameters<double>& p, std::size_t) { p.slope = 1.5 * std::numbers::pi / 180.0; }},
    {"leg_damping_%",
     [](Parameters<double>& p, std::size_t leg) { p.robot->extra_damping[leg] = 4e-4; }},
    {"pitch_inertia_scale",
     [](Parameters<double>& p, std::size_t) { p.robot->pitch_inertia *= 1.15; }},
    {"foot_coulomb_friction", [](Parameters<double>& p, std::size_t) { p.robot->friction = 0.4; }},
    {"hip_viscous_friction_%",
     [](Parameters<double>& p, std::size_t leg) { p.robot->hip_viscous[leg] = 0.1; }},
    {"hip_coulomb_friction_%",
     [](Parameters<double>& p, std::size_t leg) { p.robot->hip_coulomb[leg] = 0.3; }},
    {"leg_zero_offset_%",
     [](Parameters<double>& p, std::size_t leg) { p.robot->leg_zero[leg] = 0.02; }},
    {"motor_lag", [](Parameters<double>& p, std::size_t) { p.robot->motor_lag = 0.005; }},
    {"backlash_%",
     [](Parameters<double>& p, std::size_t leg) {
       p.robot->play[leg] = 0.02;
       p.robot->hub_share[leg] = 0.1;
     }},
    {"torque_bias_%",
     [](Parameters<double>& p, std::size_t leg) { p.robot->torque_bias[leg] = 0.3; }},
    {"hip_spacing",
     [](Parameters<double>& p, std::size_t) {
       for (double& x : p.robot->hip_x) x *= 1.03;
     }},
    {"rotor_inertia_scale",
     [](Parameters<double>& p, std::size_t) { p.robot->rotor_inertia *= 1.5; }},
    {"motor_kp_scale", [](Parameters<double>& p, std::size_t) { p.robot->motor_kp *= 0.8; }},
    {"motor_kd_scale", [](Parameters<double>& p, std::size_t) { p.robot->motor_kd *= 0.7; }},
    {"torque_limit_loss", [](Parameters<double>& p, std::size_t) { p.robot->torque_limit *= 0.5; }},
    {"swinging_leg_mass", [](Parameters<double>& p, std::size_t) { p.robot->leg_mass *= 0.5; }},
    // Of a robot with a clock alone.
    {"gait_duty_shift", [](Parameters<double>& p, std::size_t) { p.robot->duty += 0.01; }},
    {"gait_sweep_scale", [](Parameters<double>& p, std::size_t) { p.robot->sweep *= 1.03; }},
    {"gait_offset_shift", [](Parameters<double>& p, std::size_t) { p.robot->offset += 0.02; }},
    {"gait_period_scale", [](Parameters<double>& p, std::size_t) { p.robot->period *= 1.005; }},
    {"gait_phase_shift_%",
     [](Parameters<double>& p, std::size_t leg) { p.robot->phase[leg] += 0.02; }},
};

int FaultsOf(const Parameters<double>& robot) {
  constexpr int kAll = static_cast<int>(std::size(kFaults)), kOfClocks = 5;
  return robot.robot->control == MotorControl::kClock ? kAll : kAll - kOfClocks;
}

// The robots of datasets/: legs of 10 g, half an arc of each fast to its motor.
Parameters<double> SoundRobot(int legs) {
  Parameters<double> p = RobotParametersFor(legs);
  p.E = 21.991e9;
  p.I = 1.8355e-10;
  RobotParameters<double>& robot = *p.robot;
  robot.friction = 1.0;
  robot.torque_limit = 15.0;
  robot.damping = 4e-4;
  robot.leg_mass = 0.010;
  robot.clamp = p.r * std::numbers::pi / 48.0;
  return p;
}

Parameters<double> Dropping() { return SoundRobot(2); }

Parameters<double> Pronking() {
  Parameters<double> p = SoundRobot(2);
  p.E = 23.63e9;
  RobotParameters<double>& robot = *p.robot;
  robot.control = MotorControl::kClock;
  robot.pitch_inertia = 0.03707;
  robot.motor_kp = 47.35;
  robot.motor_kd = 1.662;
  robot.period = 0.399;
  robot.duty = 0.5624;
  robot.sweep = 1.25;
  robot.offset = 0.4181;
  return p;
}

Parameters<double> Tripod() {
  Parameters<double> p = SoundRobot(3);
  p.E = 30.82e9;
  RobotParameters<double>& robot = *p.robot;
  for (int i = 0; i < 3; ++i) robot.hip_x[i] = 0.15 * (i - 1);
  robot.control = MotorControl::kClock;
  robot.pitch_inertia = 0.04468;
  robot.motor_kp = 56.52;
  robot.motor_kd = 0.7199;
  robot.period = 0.41;
  robot.duty = 0.6339;
  robot.sweep = 0.737;
  robot.offset = 0.2098;
  robot.phase = {0.0, 0.5, 0.0};
  return p;
}

struct Kind {
  const char* name;
  Parameters<double> (*robot)();
  double named;  // least share of the faults that are named with P >= kSure
};
class ForeignRobots : public ::testing::TestWithParam<Kind> {};

int EnvironmentOr(const char* name, int value) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : value;
}

// What diagnose made of the robots, added up.
struct Count {
  int faults = 0, named = 0, first = 0, wrong_leg = 0, wrong = 0, E_within = 0, E_covered = 0,
      robots = 0, followed = 0;
};

void Judge(const Diagnosis& d, const std::string& planted, double E, Count& count) {
  std::string said;
  const std::string other = planted.empty() ? "" : planted.substr(0, planted.size() - 1);
  const bool of_leg = !planted.empty() && planted.back() >= '1' && planted.back() <= '4';
  bool first = true;
  for (const CauseReport& c : d.extension ? d.extension->causes : std::vector<CauseReport>()) {
    const std::string name = c.cause.Name();
    said += fmt::format("; {}{} P {:.2f}, {:.0f} % of the misfit", c.main ? "" : "small ", name,
                        c.probability, 100.0 * d.extension->OfMisfit(c.share));
    if (!c.main) continue;
    if (name == planted) {
      count.first += first;
      count.named += c.probability >= kSure;
    } else if (c.probability >= kSure) {
      (of_leg && name.starts_with(other) ? count.wrong_leg : count.wrong) += 1;
    }
    first = false;
  }
  ++count.robots;
  count.faults += !planted.empty();
  if (!d.refusal.empty()) {
    std::printf("%-22s refused: %s\n", planted.empty() ? "nothing" : planted.c_str(),
                d.refusal.c_str());
    return;
  }
  const bool followed = d.carried_on && d.carried_on->stop.IsMinimum();
  count.followed += followed;
  const FittedModel& told = followed ? d.carried_on->model : d.extension ? d.naming.best : d.null;
  const Uncertainty& u = followed      ? d.carried_on->uncertainty
                         : d.extension ? d.extension->uncertainty
                                       : d.uncertainty;
  const double off = told.shared[0] / E - 1.0;
  count.E_within += std::abs(off) <= 0.03;
  const auto& interval = u.parameters[0].Wider();
  const bool covered = interval && interval->first <= E && interval->second >= E;
  count.E_covered += covered;
  const std::string span = followed  ? ", whole trials followed"
                           : d.until ? fmt::format(", of the first {:.2f} s", *d.until)
                                     : "";
  std::printf("%-22s %s%s%s; E %+.2f %%%s\n", planted.empty() ? "nothing" : planted.c_str(),
              std::string(NameOf(d.verdict)).c_str(), said.c_str(), span.c_str(), 100.0 * off,
              covered ? "" : " (not in its interval)");
  std::fflush(stdout);
}

TEST_P(ForeignRobots, WhatIsWrongIsNamed) {
  const int first = EnvironmentOr("HOPLAB_ROBOT_SEED", 0);
  const int faults = FaultsOf(GetParam().robot());
  const int robots = EnvironmentOr("HOPLAB_ROBOTS", faults);
  Count count;
  for (int seed = first; seed < first + robots; ++seed) {
    const Fault& fault = kFaults[static_cast<std::size_t>(seed % faults)];
    Parameters<double> told = GetParam().robot(), robot = told;
    const int leg = seed / faults % told.robot->legs;
    std::string cause = fault.cause;
    if (const auto at = cause.find('%'); at != cause.npos)
      cause.replace(at, 1, std::to_string(leg + 1));
    fault.plant(robot, static_cast<std::size_t>(leg));
    told.E = 24e9;
    told.robot->damping = 3e-4;
    const TempFolder folder;
    RecordRobot(robot, told, seed + 1, EnvironmentOr("HOPLAB_ROBOT_TORQUE", 0) != 0, folder.path());
    DiagnosisOptions options;
    options.fit.jobs = static_cast<int>(std::thread::hardware_concurrency());
    Judge(Diagnose(ReadDataset(folder.path()), options), cause, robot.E, count);
  }
  std::printf(
      "%d robots: of %d faults %d are named with P >= %.2f, %d are the first name; %d on the wrong "
      "leg, %d other names with P >= %.2f; E within 3 %% in %d, in its interval in %d\n",
      count.robots, count.faults, count.named, kSure, count.first, count.wrong_leg, count.wrong,
      kSure, count.E_within, count.E_covered);
  EXPECT_GE(count.named, GetParam().named * count.faults);
  EXPECT_EQ(count.wrong_leg, 0);
  EXPECT_GE(count.E_within, count.robots - 1);
}

INSTANTIATE_TEST_SUITE_P(, ForeignRobots,
                         ::testing::Values(Kind{"Drops", Dropping, 0.9},
                                           Kind{"Pronks", Pronking, 0.9},
                                           Kind{"Walks", Tripod, 0.9}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace hoplab::testing
