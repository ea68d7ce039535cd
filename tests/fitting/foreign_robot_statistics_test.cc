// Robots with one thing wrong that a physics engine drops (tests/support/beam_robot.h): what
// diagnose calls a main cause, and whether it is there. HOPLAB_ROBOTS: how many, from
// HOPLAB_ROBOT_SEED on; one of each fault by default. ctest -L statistics -R ForeignRobots

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

// A `%` in the name stands for the leg, 1 and 2 in turn.
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
};

// The robot of datasets/robot-drops: legs of 10 g, half an arc of each fast to its motor.
Parameters<double> SoundRobot() {
  Parameters<double> p = RobotParametersFor(2);
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

int EnvironmentOr(const char* name, int value) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : value;
}

// What diagnose made of the robots, added up.
struct Count {
  int faults = 0, named = 0, first = 0, wrong_leg = 0, wrong = 0, E_within = 0, E_covered = 0,
      robots = 0;
};

void Judge(const Diagnosis& d, const std::string& planted, double E, Count& count) {
  std::string said;
  const std::string other = planted.empty() ? "" : planted.substr(0, planted.size() - 1);
  const bool of_leg = !planted.empty() && (planted.back() == '1' || planted.back() == '2');
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
  const FittedModel& told = d.extension ? d.naming.best : d.null;
  const Uncertainty& u = d.extension ? d.extension->uncertainty : d.uncertainty;
  const double off = told.shared[0] / E - 1.0;
  count.E_within += std::abs(off) <= 0.03;
  const bool covered =
      u.parameters[0].ci95 && u.parameters[0].ci95->first <= E && u.parameters[0].ci95->second >= E;
  count.E_covered += covered;
  ++count.robots;
  count.faults += !planted.empty();
  std::printf("%-22s %s%s; E %+.2f %%%s\n", planted.empty() ? "nothing" : planted.c_str(),
              d.refusal.empty() ? std::string(NameOf(d.verdict)).c_str() : d.refusal.c_str(),
              said.c_str(), 100.0 * off, covered ? "" : " (not in its interval)");
  std::fflush(stdout);
}

TEST(ForeignRobots, WhatIsWrongIsNamed) {
  const int first = EnvironmentOr("HOPLAB_ROBOT_SEED", 0);
  const int robots = EnvironmentOr("HOPLAB_ROBOTS", static_cast<int>(std::size(kFaults)));
  Count count;
  for (int seed = first; seed < first + robots; ++seed) {
    const Fault& fault = kFaults[static_cast<std::size_t>(seed) % std::size(kFaults)];
    const auto leg = static_cast<std::size_t>(seed / static_cast<int>(std::size(kFaults))) % 2;
    std::string cause = fault.cause;
    if (const auto at = cause.find('%'); at != cause.npos)
      cause.replace(at, 1, std::to_string(leg + 1));
    Parameters<double> told = SoundRobot(), robot = told;
    fault.plant(robot, leg);
    told.E = 24e9;
    told.robot->damping = 3e-4;
    const TempFolder folder;
    RecordRobotDrops(robot, told, seed + 1, folder.path());
    DiagnosisOptions options;
    options.fit.jobs = static_cast<int>(std::thread::hardware_concurrency());
    Judge(Diagnose(ReadDataset(folder.path()), options), cause, robot.E, count);
  }
  std::printf(
      "%d robots: of %d faults %d are named with P >= %.2f, %d are the first name; %d on the wrong "
      "leg, %d other names with P >= %.2f; E within 3 %% in %d, in its interval in %d\n",
      count.robots, count.faults, count.named, kSure, count.first, count.wrong_leg, count.wrong,
      kSure, count.E_within, count.E_covered);
  EXPECT_EQ(count.wrong_leg, 0);
  EXPECT_GE(count.E_within, count.robots - 1);
}

}  // namespace
}  // namespace hoplab::testing
