#include "tests/support/beam_rig.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numeric>

#include "base/random.h"
#include "base/units.h"
#include "tests/support/arc_contact.h"
#include "tests/support/beam_text.h"
#include "tests/support/mujoco_model.h"

namespace hoplab::testing {
namespace {

constexpr double kWidth = 0.03, kThickness = 0.003658;

struct Drop {
  double angle_deg, height, speed;
};
constexpr std::array<Drop, 9> kDrops = {{{22, 0.30, 1.0},
                                         {26, 0.33, 1.3},
                                         {30, 0.28, 0.9},
                                         {33, 0.31, 1.5},
                                         {36, 0.34, 1.2},
                                         {40, 0.29, 1.6},
                                         {24, 0.32, 1.4},
                                         {29, 0.26, 1.1},
                                         {38, 0.31, 1.4}}};
constexpr std::size_t kTrain = 6;

// Of the body the first two joints, then the hip: the order of BeamDof.
std::string ModelText(const BeamRig& rig) {
  return BeamWorldText(
      rig,
      fmt::format("<joint name='x' type='slide' axis='1 0 0'/>"
                  "<joint name='y' type='slide' axis='0 0 1'/>"
                  "<inertial pos='0 0 0' mass='{}' diaginertia='0.001 0.001 "
                  "0.001'/>{}{}",
                  rig.body_mass - rig.extras.load, BeamLegText(rig, "hip", kBeamHingeInertia),
                  BeamLoadText(rig.extras)),
      "<motor joint='hip' gear='-1'/>");
}

constexpr int kHip = kThird;

// Whether the hip is free. A foot that lands or slides leaves the ground for a step and another;
// a rig's switch does not see it.
class Stance {
 public:
  bool At(const BeamRig& rig, const mjData& data) {
    if (data.ncon > 0) last_touch_ = data.time;
    return data.time - last_touch_ <= rig.release;
  }

 private:
  double last_touch_ = -1.0;  // s
};

// What acts from outside, at the state of now. Damping is the joint's own, which MuJoCo takes
// implicitly.
void Push(const BeamRig& rig, double angle, bool stands, mjModel& model, mjData& data) {
  const double vx = data.qvel[kX], vy = data.qvel[kY];
  const double drag = rig.drag * std::hypot(vx, vy);
  mju_zero(data.qfrc_applied, model.nv);
  mju_zero(data.xfrc_applied, 6 * model.nbody);
  data.qfrc_applied[kX] = -drag * vx;
  data.qfrc_applied[kY] = -drag * vy;
  model.dof_damping[kHip] = stands ? rig.hip_damping : rig.hold_damping;
  data.ctrl[0] = stands ? rig.motor_share * rig.hip_gain * (rig.desired_speed - vx)
                        : -rig.hold_stiffness * (angle - data.qpos[kHip]);
  if (rig.extras.push) rig.extras.push(stands, model, data);
}

void RecordDrop(const BeamRig& rig, mjModel& model, const Drop& drop, RandomStream& noise,
                const std::filesystem::path& file) {
  const MujocoData data = NewData(model);
  const double angle = drop.angle_deg * kPi / 180.0;
  data->qpos[kY] = drop.height;
  data->qpos[kHip] = angle;
  data->qvel[kX] = drop.speed;
  std::ofstream csv(file);
  csv << "time_s,body_x_m,body_y_m\n";
  const double cosine = std::cos(rig.roll), sine = std::sin(rig.roll);
  int hops = 0;
  double rising = 0.0;
  Stance stance;
  for (int row = 0; hops < rig.hops && row < 2000;) {
    if (data->time * rig.clock >= row * kBeamRow - 1e-9) {
      double x = data->qpos[kX], y = data->qpos[kY], pitch = 0.0;
      if (rig.extras.seen) rig.extras.seen(data->time, x, y, pitch);
      csv << fmt::format("{:.4f},{:.6f},{:.6f}\n", row * kBeamRow,
                         rig.scale_x * (x * cosine + y * sine) + rig.noise * noise.Normal(),
                         rig.scale_y * (y * cosine - x * sine) + rig.noise * noise.Normal());
      ++row;
    }
    mj_step1(&model, data.get());
    Push(rig, angle, stance.At(rig, *data), model, *data);
    mj_step2(&model, data.get());
    ASSERT_EQ(data->warning[mjWARN_BADQACC].number, 0) << "the rig fell apart";
    const double up = data->qvel[kY];
    if (data->ncon == 0 && rising > 0.0 && up <= 0.0) ++hops;
    rising = up;
  }
}

}  // namespace

double StatedSecondMoment() { return kWidth * kThickness * kThickness * kThickness / 12.0; }

void RecordHops(const BeamRig& rig, mjModel& model, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream yaml(folder / "dataset.yaml");
  yaml << fmt::format(
      "format: hoplab-dataset/1\nname: rig\ntitle: A chain of arcs in MuJoCo\n"
      "source: {{kind: recorded, by: a chain of arcs in MuJoCo, licence: CC0-1.0}}\n"
      "mechanism:\n  type: c_leg\n  body_mass_kg: {}\n  gravity_m_per_s2: {}\n"
      "  leg: {{rest_radius_m: {}, E_Pa: {}, G_Pa: 4e9, width_m: {}, thickness_m: {}, "
      "damping_N_s_per_m: 1.0}}\n"
      "channels: {{body_x_m: {{sigma: {}}}, body_y_m: {{sigma: {}}}}}\ntrials:\n",
      std::accumulate(model.body_mass, model.body_mass + model.nbody, 0.0), kBeamGravity,
      rig.radius, rig.told_modulus, kWidth, kThickness, rig.noise, rig.noise);
  RandomStream noise(static_cast<std::uint64_t>(rig.seed), 1);
  for (std::size_t i = 0; i < kDrops.size(); ++i) {
    const char* role = i < kTrain ? "train" : "test";
    const std::string file = fmt::format("{}-{}.csv", role, i + 1);
    RecordDrop(rig, model, kDrops[i], noise, folder / file);
    yaml << fmt::format("  - file: {}\n    role: {}\n    touchdown_angle_deg: {}\n", file, role,
                        kDrops[i].angle_deg);
    if (rig.hip_gain > 0.0)
      yaml << fmt::format("    controller: {{kp_N_s: {}, v_des_m_per_s: {}}}\n", rig.hip_gain,
                          rig.desired_speed);
    yaml << fmt::format(
        "    initial: {{x_m: {:.4f}, y_m: {:.4f}, vx_m_per_s: {:.3f}, vy_m_per_s: {:.3f}}}\n"
        "    initial_sigma: {{x_m: 0.002, y_m: 0.002, vx_m_per_s: 0.02, vy_m_per_s: 0.02}}\n",
        0.002 * noise.Normal(), kDrops[i].height + 0.002 * noise.Normal(),
        kDrops[i].speed + 0.02 * noise.Normal(), 0.02 * noise.Normal());
  }
}

void RecordRig(const BeamRig& rig, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  MeetEllipsoidsAsArcs();
  RecordHops(rig, *CompileMujoco(ModelText(rig)), folder);
}

}  // namespace hoplab::testing
