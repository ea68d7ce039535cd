#pragma once

#include <mujoco/mujoco.h>

#include <functional>

namespace hoplab::testing {

/// First degrees of freedom of every model: the body's place; the third is a rig's hip, a robot's
/// pitch.
enum BeamDof { kX, kY, kThird };

/// What a foreign rig or robot has that no list of causes holds. SI units; angles in radians.
struct BeamExtras {
  double joint_friction = 0.0;  // dry friction of every hinge of a leg [N m]
  // A load that hangs on the body by a vertical spring; its mass is part of the body's.
  double load = 0.0;                                // [kg]
  double load_stiffness = 0.0, load_damping = 0.0;  // [N/m], [N s/m]
  // Adds to the forces that act on the model, at the state of now. `stands`: a foot touched the
  // floor just now.
  std::function<void(bool stands, const mjModel& model, mjData& data)> push;
  // What is recorded of the body's place, and of its pitch where it has one.
  std::function<void(double t, double& x, double& y, double& pitch)> seen;
};

/// A force on every part that touches the floor, downwards: soles that stick [N].
void StickToFloor(double force, const mjModel& model, mjData& data);

}  // namespace hoplab::testing
