#include "tests/support/beam_robot_text.h"

#include <fmt/format.h>

#include "tests/support/beam_text.h"

namespace hoplab::testing {
namespace {

constexpr double kStopSoftness = 2e-4;  // of a gear's teeth [s]

}  // namespace

std::string BeamRobotText(const Parameters<double>& p, const BeamExtras& extras) {
  const RobotParameters<double>& robot = *p.robot;
  BeamRig ground;
  ground.friction = robot.friction;
  ground.slope = p.slope;
  ground.extras = extras;
  std::string legs, motors, gears;
  for (int i = 0; i < robot.legs; ++i) {
    BeamRig leg = ground;
    leg.radius = p.r;
    leg.bending_stiffness = robot.E_scale[i] * p.E * p.I;
    leg.relaxation = robot.damping + robot.extra_damping[i];
    leg.leg_mass = robot.leg_mass;
    const std::string hip = fmt::format("hip{}", i),
                      at = fmt::format("<body pos='{} 0 {}'>", robot.hip_x[i], robot.hip_y[i]);
    if (robot.play[i] == 0.0) {
      legs += at + BeamLegText(leg, hip, robot.rotor_inertia) + "</body>";
      motors += fmt::format("<motor joint='{}'/>", hip);
      continue;
    }
    // The rotor is a body of its own; what its angle is ahead of the hip's has stops.
    const double on_hip = robot.hub_share[i] * robot.rotor_inertia;
    const std::string rotor = fmt::format("rotor{}", i);
    legs += at + BeamLegText(leg, hip, on_hip) + "</body>";
    legs += at + fmt::format(
                     "<joint name='{}' type='hinge' axis='0 -1 0' armature='{}'/>"
                     "<inertial pos='0 0 0' mass='1e-6' diaginertia='1e-9 1e-9 1e-9'/>"
                     "</body>",
                     rotor, robot.rotor_inertia - on_hip);
    motors += fmt::format("<motor joint='{}'/>", rotor);
    gears += fmt::format(
        "<fixed limited='true' range='{0} {1}' solreflimit='{2} 1' "
        "solimplimit='0.99 0.99 0.001'><joint joint='{3}' coef='1'/>"
        "<joint joint='{4}' coef='-1'/></fixed>",
        -0.5 * robot.play[i], 0.5 * robot.play[i], kStopSoftness, rotor, hip);
  }
  const std::string body = fmt::format(
      "<joint name='x' type='slide' axis='1 0 0'/><joint name='y' type='slide' axis='0 0 1'/>"
      "<joint name='pitch' type='hinge' axis='0 -1 0'/>"
      "<inertial pos='{0} 0 {1}' mass='{2}' diaginertia='{3} {3} {3}'/>{4}{5}",
      robot.com_x, robot.com_y, p.m - extras.load, robot.pitch_inertia, legs, BeamLoadText(extras));
  return BeamWorldText(ground, body, motors, gears);
}

}  // namespace hoplab::testing
