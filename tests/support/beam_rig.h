#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>

#include "tests/support/beam_extras.h"

namespace hoplab::testing {

/// A hopper in MuJoCo that shares nothing with the program but the laws of nature: its leg is a
/// chain of rigid arcs on linear hinges, its foot meets the floor through MuJoCo's contacts: along
/// the whole arc, or on a row of studs. Its hip is held by a PD in the air and is free in stance
/// but for a torque. SI units; angles in radians.
struct BeamRig {
  double radius = 0.09;
  double uneven = 0.0;  // curvature at the hip over the mean, less one; it falls evenly (M124)
  double bending_stiffness = 2.691;  // E I of the strip [N m^2]
  double relaxation = 400e-6;        // of the hinges: damping over stiffness [s]
  double leg_mass = 0.010;
  double body_mass = 1.0;
  double friction = 1.0;
  int studs = 0;             // on each of the 24 arcs; 0: it stands on the arc itself
  double slope = 0.0;        // of the floor, rising ahead
  double drag = 0.0;         // force on the body over speed squared [N s^2/m^2]
  double hip_damping = 0.0;  // in stance [N m s/rad]
  double hip_gain = 0.0;     // torque = gain (desired speed - speed), in stance [N s]
  double desired_speed = 1.8;
  double motor_share = 1.0;  // of the torque that is asked for
  // The motor that holds the hip in the air, and how long after the last contact it does.
  double hold_stiffness = 60.0, hold_damping = 0.45;  // [N m/rad], [N m s/rad]
  double release = 0.005;
  int hops = 3;
  // Of the camera.
  double roll = 0.0;
  double clock = 1.0;  // its seconds in one second
  double scale_x = 1.0, scale_y = 1.0;
  double noise = 5e-4;
  double told_modulus = 20e9;  // the dataset's start
  int seed = 1;
  BeamExtras extras = {};
};

/// The section that the dataset states: E I = E times this [m^4].
double StatedSecondMoment();

/// Nine trials of a model whose first joints are body_x, body_y and hip, six of them to train,
/// written as a dataset into `folder`: rows of 2 ms. Of `rig` its hip, its camera and what acts on
/// it count.
void RecordHops(const BeamRig& rig, mjModel& model, const std::filesystem::path& folder);
/// The same of the rig as it is described.
void RecordRig(const BeamRig& rig, const std::filesystem::path& folder);

}  // namespace hoplab::testing
