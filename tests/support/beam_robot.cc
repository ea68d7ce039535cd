#include "tests/support/beam_robot.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "base/random.h"
#include "tests/support/arc_contact.h"
#include "tests/support/beam_robot_text.h"
#include "tests/support/beam_text.h"
#include "tests/support/mujoco_model.h"

namespace hoplab::testing {
namespace {

constexpr double kRow = 2e-3, kLongest = 0.8;  // s
constexpr int kTrials = 9, kTrain = 6;
constexpr double kPosition = 5e-4, kAngle = 1e-3, kTorque = 5e-3;  // noise [m], [rad], [N m]
// The first degrees of freedom.
enum Dof { kX, kY, kPitch };

struct Drop {
  std::array<double, kMaxLegs> angle;  // of the motors [rad]
  std::array<double, 6> start;         // x, y, vx, vy, pitch, its rate
};

Drop RandomDrop(const Parameters<double>& p, RandomStream& random) {
  Drop drop = {};
  for (int i = 0; i < p.robot->legs; ++i) drop.angle[i] = random.Uniform(0.15, 0.7);
  drop.start = {0.0,
                random.Uniform(0.225, 0.29),
                random.Uniform(-0.1, 0.4),
                random.Uniform(-0.05, 0.05),
                random.Uniform(-0.08, 0.04),
                random.Uniform(-0.4, 0.3)};
  return drop;
}

// Whether the robot is about to fall: then what is recorded ends.
bool Tips(const Parameters<double>& p, const mjData& data) {
  constexpr double kTipped = 0.6;  // rad
  return std::abs(data.qpos[kPitch]) > kTipped || data.qpos[kY] < p.r;
}

void RecordDrop(const Parameters<double>& p, mjModel& model, const Drop& drop, RandomStream& noise,
                const std::filesystem::path& file) {
  const RobotParameters<double>& robot = *p.robot;
  const MujocoData data = NewData(model);
  std::array<int, kMaxLegs> hip = {};
  for (int i = 0; i < robot.legs; ++i)
    hip[i] = model.jnt_dofadr[mj_name2id(&model, mjOBJ_JOINT, fmt::format("hip{}", i).c_str())];
  data->qpos[kY] = drop.start[1];
  data->qvel[kX] = drop.start[2];
  data->qvel[kY] = drop.start[3];
  data->qpos[kPitch] = drop.start[4];
  data->qvel[kPitch] = drop.start[5];
  for (int i = 0; i < robot.legs; ++i) data->qpos[hip[i]] = drop.angle[i];
  std::ofstream csv(file);
  csv << "time_s,body_x_m,body_y_m,body_pitch_rad";
  for (int i = 1; i <= robot.legs; ++i) csv << fmt::format(",leg_angle_{}_rad", i);
  for (int i = 1; i <= robot.legs; ++i) csv << fmt::format(",hip_torque_{}_N_m", i);
  csv << '\n';
  for (int row = 0; data->time <= kLongest && !Tips(p, *data);) {
    mj_step1(&model, data.get());
    std::array<double, kMaxLegs> told = {};
    for (int i = 0; i < robot.legs; ++i) {
      told[i] = std::clamp(robot.motor_kp * (drop.angle[i] - data->qpos[hip[i]]) -
                               robot.motor_kd * data->qvel[hip[i]],
                           -robot.torque_limit, robot.torque_limit);
      data->ctrl[i] = robot.motor_gain * robot.gain_of[i] * told[i];
    }
    if (data->time >= row * kRow - 1e-9) {
      csv << fmt::format("{:.4f},{:.6f},{:.6f},{:.6f}", row * kRow,
                         data->qpos[kX] + kPosition * noise.Normal(),
                         data->qpos[kY] + kPosition * noise.Normal(),
                         data->qpos[kPitch] + kAngle * noise.Normal());
      for (int i = 0; i < robot.legs; ++i)
        csv << fmt::format(",{:.6f}", data->qpos[hip[i]] + kAngle * noise.Normal());
      for (int i = 0; i < robot.legs; ++i)
        csv << fmt::format(",{:.5f}", told[i] + kTorque * noise.Normal());
      csv << '\n';
      ++row;
    }
    mj_step2(&model, data.get());
    ASSERT_EQ(data->warning[mjWARN_BADQACC].number, 0) << "the robot fell apart";
  }
}

void DescribeRobot(const Parameters<double>& p, std::ostream& yaml) {
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
  for (int i = 1; i <= robot.legs; ++i)
    yaml << fmt::format(
        "  leg_angle_{0}_rad: {{sigma: {1}}}\n  hip_torque_{0}_N_m: {{sigma: {2}}}\n", i, kAngle,
        kTorque);
  yaml << "trials:\n";
}

}  // namespace

void RecordRobotDrops(const Parameters<double>& p, const Parameters<double>& told, int seed,
                      const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  MeetEllipsoidsAsArcs();
  const MujocoModel model = CompileMujoco(BeamRobotText(p));
  std::ofstream yaml(folder / "dataset.yaml");
  DescribeRobot(told, yaml);
  RandomStream random(static_cast<std::uint64_t>(seed), 1);
  for (int i = 0; i < kTrials; ++i) {
    const Drop drop = RandomDrop(p, random);
    const char* role = i < kTrain ? "train" : "test";
    const std::string name = fmt::format("{}-{}.csv", role, i + 1);
    RecordDrop(p, *model, drop, random, folder / name);
    std::string angles;
    for (int k = 0; k < p.robot->legs; ++k)
      angles += fmt::format("{}{:.6f}", k > 0 ? ", " : "", drop.angle[k]);
    // What is stated of a start is off by its sigma.
    constexpr std::array<double, 6> kSigma = {0.002, 0.002, 0.02, 0.02, 0.005, 0.05};
    std::array<double, 6> start;
    for (std::size_t k = 0; k < start.size(); ++k)
      start[k] = drop.start[k] + kSigma[k] * random.Normal();
    yaml << fmt::format(
        "  - file: {}\n    role: {}\n    controller: {{type: held, angles_rad: [{}]}}\n"
        "    initial: {{x_m: {:.5f}, y_m: {:.5f}, vx_m_per_s: {:.4f}, vy_m_per_s: {:.4f}, "
        "pitch_rad: {:.5f}, pitch_rate_rad_per_s: {:.4f}}}\n"
        "    initial_sigma: {{x_m: 0.002, y_m: 0.002, vx_m_per_s: 0.02, vy_m_per_s: 0.02, "
        "pitch_rad: 0.005, pitch_rate_rad_per_s: 0.05}}\n",
        name, role, angles, start[0], start[1], start[2], start[3], start[4], start[5]);
  }
}

}  // namespace hoplab::testing
