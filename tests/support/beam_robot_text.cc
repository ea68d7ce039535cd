#include "tests/support/beam_robot_text.h"

#include <fmt/format.h>

#include "tests/support/beam_text.h"

namespace hoplab::testing {

std::string BeamRobotText(const Parameters<double>& p) {
  const RobotParameters<double>& robot = *p.robot;
  BeamRig ground;
  ground.friction = robot.friction;
  ground.slope = p.slope;
  std::string legs, motors;
  for (int i = 0; i < robot.legs; ++i) {
    BeamRig leg = ground;
    leg.radius = p.r;
    leg.bending_stiffness = robot.E_scale[i] * p.E * p.I;
    leg.relaxation = robot.damping + robot.extra_damping[i];
    leg.leg_mass = robot.leg_mass;
    const std::string hip = fmt::format("hip{}", i);
    legs += fmt::format("<body pos='{} 0 {}'>{}</body>", robot.hip_x[i], robot.hip_y[i],
                        BeamLegText(leg, hip, robot.rotor_inertia));
    motors += fmt::format("<motor joint='{}'/>", hip);
  }
  const std::string body = fmt::format(
      "<joint name='x' type='slide' axis='1 0 0'/><joint name='y' type='slide' axis='0 0 1'/>"
      "<joint name='pitch' type='hinge' axis='0 -1 0'/>"
      "<inertial pos='{0} 0 {1}' mass='{2}' diaginertia='{3} {3} {3}'/>{4}",
      robot.com_x, robot.com_y, p.m, robot.pitch_inertia, legs);
  return BeamWorldText(ground, body, motors);
}

}  // namespace hoplab::testing
