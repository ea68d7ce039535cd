#include "tests/support/beam_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/units.h"

namespace hoplab::testing {
namespace {

constexpr int kArcs = 24;
constexpr double kStep = 2e-5;
// The floor gives by about (1 - 0.99) a kSoftness^2, a the acceleration that the leg's tip would
// have without it: 0.04 mm for a tip of a tenth of a gram under 40 N.
constexpr double kSoftness = 1e-4;  // s
constexpr double kStudRadius = 0.002;
constexpr double kTurn = kPi / kArcs;

// A place on the leg at rest, `angle` from the hip, `radius` from the middle of its circle.
std::array<double, 2> PlaceOn(const BeamRig& rig, double angle, double radius) {
  return {-radius * std::sin(angle), -rig.radius + radius * std::cos(angle)};
}

// What arc `i`, whose frame is at `begin`, stands on.
std::string FeetText(const BeamRig& rig, int i, const std::array<double, 2>& begin) {
  if (rig.studs == 0)
    return fmt::format(
        "<geom class='foot' type='ellipsoid' pos='{} 0 {}' euler='0 {} 0' size='{} {} 0.01'/>",
        -begin[0], -rig.radius - begin[1], -(i + 0.5) * kTurn, rig.radius, 0.5 * kTurn);
  std::string text;
  for (int k = 0; k < rig.studs; ++k) {
    const auto stud = PlaceOn(rig, (i + (k + 0.5) / rig.studs) * kTurn, rig.radius - kStudRadius);
    text += fmt::format("<geom class='foot' type='sphere' pos='{} 0 {}' size='{}'/>",
                        stud[0] - begin[0], stud[1] - begin[1], kStudRadius);
  }
  return text;
}

}  // namespace

void StickToFloor(double force, const mjModel& model, mjData& data) {
  for (int i = 0; i < data.ncon; ++i) {
    const int body = model.geom_bodyid[data.contact[i].geom2];
    data.xfrc_applied[6 * body + 2] -= force / data.ncon;
  }
}

// The chain from the hip, hinge by hinge; the tip is half a turn from the hip.
std::string BeamLegText(const BeamRig& rig, std::string_view hip, double rotor_inertia) {
  const double length = rig.radius * kTurn;
  const double mass = rig.leg_mass / kArcs, inertia = mass * length * length / 12.0;
  const double stiffness = rig.bending_stiffness / length;
  // Dry hinges stick: they creep by a thousandth of a radian a second at most.
  const std::string bend = fmt::format(
      "<joint class='bend' stiffness='{}' damping='{}' frictionloss='{}' "
      "solreffriction='2e-4 1' solimpfriction='0.99 0.99 0.001'/>",
      stiffness, rig.relaxation * stiffness, rig.extras.joint_friction);
  std::string text;
  std::array<double, 2> before = {0.0, 0.0};
  for (int i = 0; i < kArcs; ++i) {
    const auto begin = PlaceOn(rig, i * kTurn, rig.radius),
               middle = PlaceOn(rig, (i + 0.5) * kTurn, rig.radius);
    text += fmt::format("<body pos='{} 0 {}'>", begin[0] - before[0], begin[1] - before[1]);
    text += i == 0 ? fmt::format("<joint name='{}' type='hinge' axis='0 -1 0' armature='{}'/>", hip,
                                 rotor_inertia)
                   : bend;
    text +=
        fmt::format("<inertial pos='{} 0 {}' mass='{}' diaginertia='{} {} {}'/>",
                    middle[0] - begin[0], middle[1] - begin[1], mass, inertia, inertia, inertia);
    text += FeetText(rig, i, begin);
    before = begin;
  }
  for (int i = 0; i < kArcs; ++i) text += "</body>";
  return text;
}

std::string BeamLoadText(const BeamExtras& extras) {
  if (extras.load == 0.0) return "";
  return fmt::format(
      "<body><joint name='load' type='slide' axis='0 0 1' stiffness='{}' damping='{}' "
      "springref='{}'/><inertial pos='0 0 0' mass='{}' diaginertia='1e-6 1e-6 1e-6'/></body>",
      extras.load_stiffness, extras.load_damping,
      extras.load * kBeamGravity / extras.load_stiffness, extras.load);
}

std::string BeamWorldText(const BeamRig& rig, std::string_view body, std::string_view actuators,
                          std::string_view tendons) {
  return fmt::format(
      "<mujoco><compiler angle='radian'/>"
      "<option timestep='{}' gravity='0 0 {}' integrator='implicit' cone='elliptic' "
      "impratio='20'/>"
      "<size nconmax='500' njmax='2000'/><default>"
      "<default class='bend'><joint type='hinge' axis='0 -1 0' armature='{}'/></default>"
      "<default class='foot'><geom contype='0' conaffinity='1' "
      "condim='3' friction='{} 0 0' priority='1' solref='{} 1' solimp='0.99 0.99 0.001'/>"
      "</default></default><worldbody>"
      "<geom type='plane' size='9 1 0.1' euler='0 {} 0' contype='1' conaffinity='0'/>"
      "<body>{}</body></worldbody><tendon>{}</tendon><actuator>{}</actuator></mujoco>",
      kStep, -kBeamGravity, kBeamHingeInertia, rig.friction, kSoftness, -rig.slope, body, tendons,
      actuators);
}

}  // namespace hoplab::testing
