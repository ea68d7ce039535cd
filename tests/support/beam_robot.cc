#include "tests/support/beam_robot.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include "base/random.h"
#include "tests/support/arc_contact.h"
#include "tests/support/beam_robot_text.h"
#include "tests/support/beam_text.h"
#include "tests/support/mujoco_model.h"

namespace hoplab::testing {
namespace {

constexpr double kPosition = 5e-4, kAngle = 1e-3, kTorque = 5e-3;  // noise [m], [rad], [N m]
constexpr int kPitch = kThird;

// How many runs, and how long.
struct Plan {
  int trials, train;
  double longest;  // s
};
Plan PlanFor(const RobotParameters<double>& robot) {
  return robot.control == MotorControl::kClock ? Plan{6, 4, 1.0} : Plan{9, 6, 0.8};
}

struct Run {
  std::array<double, kMaxLegs> angle;  // of motors that are held [rad]
  double period, sweep;                // of a clock [s], [rad]
  std::array<double, 6> start;         // x, y, vx, vy, pitch, its rate
};

Run RandomDrop(const Parameters<double>& p, RandomStream& random) {
  Run run = {};
  for (int i = 0; i < p.robot->legs; ++i) run.angle[i] = random.Uniform(0.15, 0.7);
  run.start = {0.0,
               random.Uniform(0.225, 0.29),
               random.Uniform(-0.1, 0.4),
               random.Uniform(-0.05, 0.05),
               random.Uniform(-0.08, 0.04),
               random.Uniform(-0.4, 0.3)};
  return run;
}

// Legs in phase leap, others walk: from near a steady gait of the robots in datasets/.
Run RandomGait(const Parameters<double>& p, RandomStream& random) {
  const RobotParameters<double>& robot = *p.robot;
  const bool leaps = std::abs(robot.phase[0] - robot.phase[1]) < 0.25;
  Run run = {};
  run.period = robot.period * random.Uniform(0.97, 1.03);
  run.sweep = robot.sweep * random.Uniform(0.98, 1.02);
  if (leaps)
    run.start = {0.0,
                 random.Uniform(0.215, 0.223),
                 random.Uniform(0.72, 0.775),
                 random.Uniform(-0.01, 0.03),
                 random.Uniform(0.015, 0.049),
                 random.Uniform(-0.077, 0.025)};
  else
    run.start = {0.0,
                 random.Uniform(0.2045, 0.2065),
                 random.Uniform(0.44, 0.48),
                 random.Uniform(-0.015, 0.015),
                 random.Uniform(-0.04, -0.02),
                 random.Uniform(-0.04, 0.04)};
  return run;
}

// Angle and rate that motor i follows at t: held, or by the clock (M76).
struct Followed {
  double angle, rate;
};
Followed FollowedAt(const RobotParameters<double>& robot, const Run& run, int i, double t) {
  if (robot.control != MotorControl::kClock) return {run.angle[i], 0.0};
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double c = t / run.period + robot.phase[i], turns = std::floor(c), s = c - turns;
  const double slow = run.sweep / (robot.duty * run.period);
  const double fast = (kTurn - run.sweep) / ((1.0 - robot.duty) * run.period);
  if (s < robot.duty)
    return {robot.offset + 0.5 * run.sweep - kTurn * turns - slow * s * run.period, -slow};
  return {robot.offset - 0.5 * run.sweep - kTurn * turns - fast * (s - robot.duty) * run.period,
          -fast};
}

// Whether the robot is about to fall: then what is recorded ends.
bool Tips(const Parameters<double>& p, const mjData& data) {
  // A leap by the clock pitches more than a drop.
  const double tipped = p.robot->control == MotorControl::kClock ? 0.9 : 0.6;  // rad
  return std::abs(data.qpos[kPitch]) > tipped || data.qpos[kY] < p.r;
}

// Degree of freedom of a joint of a leg.
int DofOf(const mjModel& model, const char* joint, int leg) {
  const std::string name = fmt::format("{}{}", joint, leg);
  return model.jnt_dofadr[mj_name2id(&model, mjOBJ_JOINT, name.c_str())];
}
// Of what its motor turns: the hip, or where its gear has play the rotor.
int MotorOf(const mjModel& model, const RobotParameters<double>& robot, int leg) {
  return DofOf(model, robot.play[leg] == 0.0 ? "hip" : "rotor", leg);
}

// What the motors give of what they are told, some time later.
class LaggingMotors {
 public:
  explicit LaggingMotors(const RobotParameters<double>& robot) : robot_(robot) {}
  double Give(int i, double told, double step) {
    double& given = given_[i];
    if (robot_.motor_lag == 0.0 || !begun_[i])
      given = told;
    else
      given += (told - given) * -std::expm1(-step / robot_.motor_lag);
    begun_[i] = true;
    return robot_.motor_gain * robot_.gain_of[i] * given + robot_.torque_bias[i];
  }

 private:
  const RobotParameters<double>& robot_;
  std::array<double, kMaxLegs> given_ = {};
  std::array<bool, kMaxLegs> begun_ = {};
};

// A joint with dry friction sticks: it creeps at a thousandth of a radian a second at most.
void MakeDry(mjModel& model, int dof, double torque) {
  model.dof_frictionloss[dof] = torque;
  model.dof_solref[mjNREF * dof] = 2e-4;
  model.dof_solref[mjNREF * dof + 1] = 1.0;
  model.dof_solimp[mjNIMP * dof] = model.dof_solimp[mjNIMP * dof + 1] = 0.99;
}

void RecordRun(const Parameters<double>& p, const BeamExtras& extras, mjModel& model,
               const Run& run, RandomStream& noise, const std::filesystem::path& file) {
  const RobotParameters<double>& robot = *p.robot;
  const MujocoData data = NewData(model);
  std::array<int, kMaxLegs> motor = {};
  for (int i = 0; i < robot.legs; ++i) motor[i] = MotorOf(model, robot, i);
  LaggingMotors motors(robot);
  data->qpos[kY] = run.start[1];
  data->qvel[kX] = run.start[2];
  data->qvel[kY] = run.start[3];
  data->qpos[kPitch] = run.start[4];
  data->qvel[kPitch] = run.start[5];
  for (int i = 0; i < robot.legs; ++i) {
    const Followed begin = FollowedAt(robot, run, i, 0.0);
    for (int dof : {motor[i], DofOf(model, "hip", i)}) {
      data->qpos[dof] = begin.angle + robot.leg_zero[i];
      data->qvel[dof] = begin.rate;
    }
  }
  std::ofstream csv(file);
  csv << "time_s,body_x_m,body_y_m,body_pitch_rad";
  for (int i = 1; i <= robot.legs; ++i) csv << fmt::format(",leg_angle_{}_rad", i);
  for (int i = 1; i <= robot.legs; ++i) csv << fmt::format(",hip_torque_{}_N_m", i);
  csv << '\n';
  for (int row = 0; data->time <= PlanFor(robot).longest && !Tips(p, *data);) {
    mj_step1(&model, data.get());
    std::array<double, kMaxLegs> read = {}, told = {};  // encoders, torques
    for (int i = 0; i < robot.legs; ++i) {
      const Followed at = FollowedAt(robot, run, i, data->time);
      read[i] = data->qpos[motor[i]] - robot.leg_zero[i];
      told[i] = std::clamp(
          robot.motor_kp * (at.angle - read[i]) + robot.motor_kd * (at.rate - data->qvel[motor[i]]),
          -robot.torque_limit, robot.torque_limit);
      data->ctrl[i] = motors.Give(i, told[i], model.opt.timestep);
    }
    if (extras.push) {
      mju_zero(data->qfrc_applied, model.nv);
      mju_zero(data->xfrc_applied, 6 * model.nbody);
      extras.push(data->ncon > 0, model, *data);
    }
    if (data->time >= row * kBeamRow - 1e-9) {
      double x = data->qpos[kX], y = data->qpos[kY], pitch = data->qpos[kPitch];
      if (extras.seen) extras.seen(data->time, x, y, pitch);
      csv << fmt::format("{:.4f},{:.6f},{:.6f},{:.6f}", row * kBeamRow,
                         x + kPosition * noise.Normal(), y + kPosition * noise.Normal(),
                         pitch + kAngle * noise.Normal());
      for (int i = 0; i < robot.legs; ++i)
        csv << fmt::format(",{:.6f}", read[i] + kAngle * noise.Normal());
      for (int i = 0; i < robot.legs; ++i)
        csv << fmt::format(",{:.5f}", told[i] + kTorque * noise.Normal());
      csv << '\n';
      ++row;
    }
    mj_step2(&model, data.get());
    ASSERT_EQ(data->warning[mjWARN_BADQACC].number, 0) << "the robot fell apart";
  }
}

void DescribeRobot(const Parameters<double>& p, bool compares_torque, std::ostream& yaml) {
  const RobotParameters<double>& robot = *p.robot;
  yaml << fmt::format(
      "format: hoplab-dataset/1\nname: robot\ntitle: A robot on chains of arcs in MuJoCo\n"
      "source: {{kind: simulated, by: chains of arcs in MuJoCo, licence: CC0-1.0}}\n"
      "mechanism:\n  type: robot\n  body_mass_kg: {}\n  pitch_inertia_kg_m2: {}\n"
      "  centre_of_mass_m: [{}, {}]\n  gravity_m_per_s2: {}\n  friction: {}\n"
      "  motor: {{rotor_inertia_kg_m2: {}, kp_N_m_per_rad: {}, kd_N_m_s_per_rad: {}, "
      "torque_limit_N_m: {}}}\n"
      "  leg: {{rest_radius_m: {}, E_Pa: {}, second_moment_m4: {}, material_damping_s: {}, "
      "clamp_m: {}, mass_kg: {}}}\n  legs:\n",
      p.m, robot.pitch_inertia, robot.com_x, robot.com_y, kBeamGravity, robot.friction,
      robot.rotor_inertia, robot.motor_kp, robot.motor_kd, robot.torque_limit, p.r, p.E, p.I,
      robot.damping, robot.clamp, robot.leg_mass);
  for (int i = 0; i < robot.legs; ++i)
    yaml << fmt::format("    - {{hip_m: [{}, {}]}}\n", robot.hip_x[i], robot.hip_y[i]);
  yaml << fmt::format(
      "channels:\n  body_x_m: {{sigma: {0}}}\n  body_y_m: {{sigma: {0}}}\n"
      "  body_pitch_rad: {{sigma: {1}}}\n",
      kPosition, kAngle);
  for (int i = 1; i <= robot.legs; ++i) {
    yaml << fmt::format("  leg_angle_{}_rad: {{sigma: {}}}\n", i, kAngle);
    if (compares_torque) yaml << fmt::format("  hip_torque_{}_N_m: {{sigma: {}}}\n", i, kTorque);
  }
  yaml << "trials:\n";
}

// What is told of the controller of a run of robot `p`.
std::string ControllerText(const RobotParameters<double>& p, const RobotParameters<double>& robot,
                           const Run& run) {
  const auto list = [&](const std::array<double, kMaxLegs>& values) {
    std::string text;
    for (int k = 0; k < robot.legs; ++k)
      text += fmt::format("{}{:.6f}", k > 0 ? ", " : "", values[k]);
    return text;
  };
  if (robot.control != MotorControl::kClock)
    return fmt::format("{{type: held, angles_rad: [{}]}}", list(run.angle));
  return fmt::format(
      "{{type: clock, period_s: {}, duty: {}, sweep_rad: {}, offset_rad: {}, phases: [{}]}}",
      run.period * (robot.period / p.period), robot.duty, run.sweep * (robot.sweep / p.sweep),
      robot.offset, list(robot.phase));
}

}  // namespace

void RecordRobot(const Parameters<double>& p, const Parameters<double>& told, int seed,
                 bool compares_torque, const std::filesystem::path& folder,
                 const BeamExtras& extras) {
  std::filesystem::create_directories(folder);
  MeetEllipsoidsAsArcs();
  const MujocoModel model = CompileMujoco(BeamRobotText(p, extras));
  for (int i = 0; i < p.robot->legs; ++i) {
    const int hip = DofOf(*model, "hip", i);
    model->dof_damping[hip] = p.robot->hip_viscous[i];
    if (p.robot->hip_coulomb[i] > 0.0) MakeDry(*model, hip, p.robot->hip_coulomb[i]);
  }
  std::ofstream yaml(folder / "dataset.yaml");
  DescribeRobot(told, compares_torque, yaml);
  RandomStream random(static_cast<std::uint64_t>(seed), 1);
  const Plan plan = PlanFor(*p.robot);
  const bool by_clock = p.robot->control == MotorControl::kClock;
  for (int i = 0; i < plan.trials; ++i) {
    const Run run = by_clock ? RandomGait(p, random) : RandomDrop(p, random);
    const char* role = i < plan.train ? "train" : "test";
    const std::string name = fmt::format("{}-{}.csv", role, i + 1);
    RecordRun(p, extras, *model, run, random, folder / name);
    // What is stated of a start is off by its sigma.
    constexpr std::array<double, 6> kSigma = {0.002, 0.002, 0.02, 0.02, 0.005, 0.05};
    std::array<double, 6> start;
    for (std::size_t k = 0; k < start.size(); ++k)
      start[k] = run.start[k] + kSigma[k] * random.Normal();
    yaml << fmt::format(
        "  - file: {}\n    role: {}\n    controller: {}\n"
        "    initial: {{x_m: {:.5f}, y_m: {:.5f}, vx_m_per_s: {:.4f}, vy_m_per_s: {:.4f}, "
        "pitch_rad: {:.5f}, pitch_rate_rad_per_s: {:.4f}}}\n"
        "    initial_sigma: {{x_m: 0.002, y_m: 0.002, vx_m_per_s: 0.02, vy_m_per_s: 0.02, "
        "pitch_rad: 0.005, pitch_rate_rad_per_s: 0.05}}\n",
        name, role, ControllerText(*p.robot, *told.robot, run), start[0], start[1], start[2],
        start[3], start[4], start[5]);
  }
}

}  // namespace hoplab::testing
