#include "bench/beam_robot.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>

#include "bench/robot_second.h"
#include "model/mechanisms/motor_clock.h"
#include "tests/support/arc_contact.h"
#include "tests/support/beam_robot_text.h"
#include "tests/support/mujoco_model.h"

namespace hoplab::bench {
namespace {

// The first degrees of freedom; of a leg the first is its hip.
enum Dof { kX, kY, kPitch };

}  // namespace

BeamSecond RunBeamSecond() {
  const SimulationRequest request = RobotSecond();
  const RobotParameters<double>& robot = *request.parameters.robot;
  testing::MeetEllipsoidsAsArcs();
  const testing::MujocoModel model =
      testing::CompileMujoco(testing::BeamRobotText(request.parameters));
  const testing::MujocoData data = testing::NewData(*model);
  const auto hip = [&](int leg) {
    return model
        ->jnt_dofadr[mj_name2id(model.get(), mjOBJ_JOINT, fmt::format("hip{}", leg).c_str())];
  };
  std::array<int, kMaxLegs> at = {};
  std::array<MotorClock<double>, kMaxLegs> clock;
  data->qpos[kX] = request.initial[0];
  data->qpos[kY] = request.initial[1];
  data->qvel[kX] = request.initial[2];
  data->qvel[kY] = request.initial[3];
  for (int i = 0; i < robot.legs; ++i) {
    at[i] = hip(i);
    clock[i] = MotorClock<double>(robot, i, 0.0);
    const int piece = clock[i].PieceAt(0.0);
    data->qpos[at[i]] = clock[i].Angle(piece, 0.0);
    data->qvel[at[i]] = clock[i].Rate(piece);
  }
  BeamSecond second;
  second.step = model->opt.timestep;
  const auto begin = std::chrono::steady_clock::now();
  while (data->time < request.horizon) {
    mj_step1(model.get(), data.get());
    for (int i = 0; i < robot.legs; ++i) {
      const int piece = clock[i].PieceAt(data->time);
      const double told = robot.motor_kp * (clock[i].Angle(piece, data->time) - data->qpos[at[i]]) +
                          robot.motor_kd * (clock[i].Rate(piece) - data->qvel[at[i]]);
      data->ctrl[i] = std::clamp(told, -robot.torque_limit, robot.torque_limit);
    }
    mj_step2(model.get(), data.get());
    if (data->time <= kEarly + 1e-9)
      second.early = {data->qpos[kX], data->qpos[kY], data->qpos[kPitch]};
  }
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  second.seconds = passed.count();
  if (data->warning[mjWARN_BADQACC].number > 0)
    throw std::runtime_error("The robot fell apart in MuJoCo.");
  return second;
}

}  // namespace hoplab::bench
