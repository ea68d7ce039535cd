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

// An arc of the leg at rest, x forward and z up from the hip.
struct Arc {
  std::array<double, 2> middle;  // of its circle
  double radius, from, turn;     // the angle of its end towards the hip, how far it turns

  // At a share of its length, `inside` of its outer side.
  std::array<double, 2> At(double share, double inside = 0.0) const {
    const double angle = from + share * turn, out = radius - inside;
    return {middle[0] - out * std::sin(angle), middle[1] + out * std::cos(angle)};
  }
};
// From the hip on; all of the same length, each beginning where and as the one before it ends.
std::array<Arc, kArcs> ArcsOf(const BeamRig& rig) {
  std::array<Arc, kArcs> arcs;
  std::array<double, 2> begin = {0.0, 0.0};
  double from = 0.0;
  for (int i = 0; i < kArcs; ++i) {
    const double curved = 1.0 + rig.uneven * (1.0 - (2.0 * i + 1.0) / kArcs);
    const double radius = rig.radius / curved;
    arcs[i] = {{begin[0] + radius * std::sin(from), begin[1] - radius * std::cos(from)},
               radius,
               from,
               curved * kTurn};
    begin = arcs[i].At(1.0);
    from += arcs[i].turn;
  }
  return arcs;
}

// What an arc stands on.
std::string FeetText(const BeamRig& rig, const Arc& arc) {
  const std::array<double, 2> begin = arc.At(0.0);
  if (rig.studs == 0)
    return fmt::format(
        "<geom class='foot' type='ellipsoid' pos='{} 0 {}' euler='0 {} 0' size='{} {} 0.01'/>",
        arc.middle[0] - begin[0], arc.middle[1] - begin[1], -(arc.from + 0.5 * arc.turn),
        arc.radius, 0.5 * arc.turn);
  std::string text;
  for (int k = 0; k < rig.studs; ++k) {
    const auto stud = arc.At((k + 0.5) / rig.studs, kStudRadius);
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
  bool is_first = true;
  for (const Arc& arc : ArcsOf(rig)) {
    const auto begin = arc.At(0.0), middle = arc.At(0.5);
    text += fmt::format("<body pos='{} 0 {}'>", begin[0] - before[0], begin[1] - before[1]);
    text += is_first ? fmt::format("<joint name='{}' type='hinge' axis='0 -1 0' armature='{}'/>",
                                   hip, rotor_inertia)
                     : bend;
    text +=
        fmt::format("<inertial pos='{} 0 {}' mass='{}' diaginertia='{} {} {}'/>",
                    middle[0] - begin[0], middle[1] - begin[1], mass, inertia, inertia, inertia);
    text += FeetText(rig, arc);
    before = begin;
    is_first = false;
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
