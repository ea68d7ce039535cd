#include "app/export/mjcf.h"

#include <fmt/format.h>

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "app/terminal/quantity.h"
#include "base/input_error.h"
#include "base/units.h"
#include "model/laws/uneven_arc.h"
#include "model/leg_compliance.h"

namespace hoplab {
namespace {

// Spheres the leg meets the ground with: on few it rolls like a cogwheel.
constexpr int kFeet = 288;
constexpr double kFootRadius = 0.02;  // of the leg's radius
constexpr double kLeastShare = 1e-3;  // of the weighed mass, where the leg's own is not known
constexpr double kHeldFriction = 1.0;
// Steps a hinge's own oscillation is spread over: its armature, else the chain asks for steps of a
// microsecond.
constexpr double kStepsPerRadian = 2.0;
// Steps in which a contact settles; MuJoCo asks for two.
constexpr double kContactSteps = 2.5;

// What the model has of the effects, beside those that change a parameter of it.
constexpr std::array kWrittenInMjcf = {"leg_material_damping",   "leg_mass",
                                       "foot_coulomb_friction",  "hip_viscous_friction",
                                       "hip_coulomb_friction",   "guide_viscous_friction",
                                       "guide_coulomb_friction", "boom_inertia",
                                       "rest_radius_scale",      "body_mass_scale",
                                       "gravity_scale",          "higher_order_bending",
                                       "second_order_bending",   "torque_bending",
                                       "tip_rotation",           "rolling_law",
                                       "sole_thickness",         "uneven_curvature"};
// They change the leg itself, and a chain of arcs on linear hinges cannot show them.
constexpr std::array kOfTheLeg = {"leg_hardening",   "leg_hysteresis", "leg_quadratic_damping",
                                  "stiffness_drift", "foot_slip",      "ground_compliance",
                                  "touchdown_loss"};

void Check(const ExportedModel& model, const std::string& place) {
  if (MechanismOf(model.law) != MechanismKind::kCLeg) {
    throw InputError({place, "law = " + std::string(NameOf(model.law)),
                      "must be a law of the half-circular leg: only a beam is cut into arcs",
                      "Export the law with --c."});
  }
  for (const EffectSetting& e : model.effects) {
    if (!IsAmong(e.effect->info.name, kOfTheLeg)) continue;
    throw InputError({place + ": effects", DescribeEffect(e),
                      "is nothing that arcs on linear hinges can show",
                      "Fit without it (--with names what is fitted)."});
  }
}

std::string N(double value) { return ExactNumber(value); }

// The leg as a beam: everything the model needs, in SI units.
struct Beam {
  Parameters<double> p;
  int arcs;
  double length, stiffness, damping, armature;  // of one arc, of the hinge between two
  double leg_mass, body_mass, friction, tau;
  bool mass_known, friction_known, from_chord;

  Beam(const ExportedModel& model, const MjcfOptions& options)
      : p(model.Effective()), arcs(options.arcs) {
    length = kPi * p.r / arcs;
    stiffness = p.E * p.I / length;
    tau = p.law_terms.material_damping;
    from_chord = tau == 0.0 && p.d > 0.0;
    // M12 against tau k w: the same loss at the arc of touch-down.
    if (from_chord) {
      const double theta =
          model.initial_states.empty() ? p.theta_td : model.initial_states[0].touchdown_angle;
      tau = p.d * LegCompliance<double>(p).Chord(kPi - std::fmax(theta, 0.0));
    }
    damping = tau * stiffness;
    const double lag = kStepsPerRadian * options.step;
    armature = stiffness * lag * lag;
    mass_known = p.law_terms.leg_mass > 0.0;
    leg_mass = mass_known             ? p.law_terms.leg_mass
               : options.leg_mass > 0 ? options.leg_mass
                                      : kLeastShare * p.m;
    body_mass = p.m - leg_mass;
    friction_known = p.law_terms.foot_friction > 0.0;
    friction = friction_known ? 1.0 / p.law_terms.foot_friction : kHeldFriction;
  }

  // Place in the unloaded leg at leg angle 0, from the hip: x forward, z up; r gamma along the line
  // that bends, `outside` beyond it.
  std::array<double, 2> At(double gamma, double outside) const {
    if (!p.law_terms.uneven_active) {
      const double radius = p.r + outside;
      return {-radius * std::sin(gamma), -p.r + radius * std::cos(gamma)};
    }
    const auto turned = [&](double at) { return UnevenArc<double>(at, p.law_terms.uneven).turned; };
    const auto to_here = [&](const auto& slope) {
      return p.r * boost::math::quadrature::gauss<double, 15>::integrate(slope, 0.0, gamma);
    };
    return {to_here([&](double at) { return -std::cos(turned(at)); }) -
                outside * std::sin(turned(gamma)),
            to_here([&](double at) { return -std::sin(turned(at)); }) +
                outside * std::cos(turned(gamma))};
  }
};

std::string HeadOf(const ExportedModel& model, const Beam& beam) {
  std::string text = fmt::format(
      "<!-- The compliant leg of {}\n"
      "     E I = {} N m^2, r = {} m: {} rigid arcs on hinges of stiffness E I/s, s the length of\n"
      "     an arc. Joint damping tau E I/s, tau = {} s{}.\n"
      "     Leg mass {} kg{}. Friction of the foot {}{}.\n"
      "     Joint hip: the leg angle theta, 0 with the tip below the hip, positive with the leg\n"
      "     reaching forward; actuator hip_torque pushes the hip forward where it is positive.\n"
      "     Hold the angle in flight, leave the hip free in stance but for the torque you want.\n"
      "     Shear and length of the beam are rigid here.\n",
      model.origin, Significant(beam.p.E * beam.p.I, 5), Significant(beam.p.r, 5), beam.arcs,
      Significant(beam.tau, 4),
      beam.from_chord ? fmt::format(",\n     which loses at touch-down what the damper along the "
                                    "chord, d = {} N s/m, does: fit\n     leg_material_damping "
                                    "with d = 0 for a leg that damps along its arc",
                                    Significant(beam.p.d, 4))
                      : "",
      Significant(beam.leg_mass, 4), beam.mass_known ? "" : ", not fitted",
      Significant(beam.friction, 4),
      beam.friction_known ? "" : ", not fitted: it holds in the law");
  if (model.law != Law::kElastica && !model.Has("higher_order_bending"))
    text += fmt::format("     E was fitted under the law {}; arcs bend as under elastica.\n",
                        NameOf(model.law));
  for (const EffectSetting& e : model.effects) {
    if (!IsAmong(e.effect->info.name, kWrittenInMjcf))
      text += "     Not in this model: " + DescribeEffect(e) + "\n";
  }
  for (const std::string& kind : model.driven_by)
    text += "     A column of a log drove " + kind + "; drive the model by it.\n";
  return text + "-->\n";
}

// Dashes may not stand together in a comment.
std::string WithoutDashes(std::string text) {
  for (std::size_t at = text.find("--", 4); at != text.npos; at = text.find("--", at + 1)) {
    if (text.compare(at, 3, "-->") != 0) text[at + 1] = ' ';
  }
  return text;
}

std::string ArcBodies(const Beam& beam) {
  const double turn = kPi / beam.arcs, r = beam.p.r;
  const double feet_at = beam.p.law_terms.sole - kFootRadius * r;  // M113
  const double mass = beam.leg_mass / beam.arcs;
  // A thin rod's.
  const double inertia = mass * beam.length * beam.length / 12.0;
  const int feet = std::max(kFeet / beam.arcs, 1);
  std::string text, close;
  std::array<double, 2> before = {0.0, 0.0};
  for (int i = 0; i < beam.arcs; ++i) {
    const std::string indent(6 + 2 * static_cast<std::size_t>(std::min(i, 20)), ' ');
    const std::array<double, 2> begin = beam.At(i * turn, 0.0),
                                middle = beam.At((i + 0.5) * turn, 0.0);
    text += fmt::format("{}<body name=\"arc_{}\" pos=\"{} 0 {}\">\n", indent, i,
                        N(begin[0] - before[0]), N(begin[1] - before[1]));
    text += fmt::format("{}  <joint name=\"{}\" class=\"{}\"/>\n", indent,
                        i == 0 ? "hip" : fmt::format("bend_{}", i), i == 0 ? "hip" : "bend");
    text += fmt::format("{}  <inertial pos=\"{} 0 {}\" mass=\"{}\" diaginertia=\"{} {} {}\"/>\n",
                        indent, N(middle[0] - begin[0]), N(middle[1] - begin[1]), N(mass),
                        N(inertia), N(inertia), N(inertia));
    for (int k = 0; k < feet; ++k) {
      const std::array<double, 2> at = beam.At((i + (k + 0.5) / feet) * turn, feet_at);
      text += fmt::format("{}  <geom class=\"foot\" pos=\"{} 0 {}\"/>\n", indent,
                          N(at[0] - begin[0]), N(at[1] - begin[1]));
    }
    close.insert(0, indent + "</body>\n");
    before = begin;
  }
  return text + close;
}

std::string SlideJoint(const char* name, const char* axis, double damping, double friction,
                       double armature) {
  return fmt::format(
      "      <joint name=\"{}\" type=\"slide\" axis=\"{}\" damping=\"{}\" frictionloss=\"{}\" "
      "armature=\"{}\"/>\n",
      name, axis, N(damping), N(friction), N(armature));
}

std::string KeysOf(const ExportedModel& model, const Beam& beam) {
  if (model.initial_states.empty()) return "";
  std::string text = "  <keyframe>\n", zeros;
  for (int i = 1; i < beam.arcs; ++i) zeros += " 0";
  for (const ExportedStart& start : model.initial_states) {
    const auto& s = start.state;
    const std::string along = beam.p.on_guide ? "" : N(s[0]) + " ";
    const std::string speed = beam.p.on_guide ? "" : N(s[2]) + " ";
    text +=
        fmt::format("    <key name=\"{}\" qpos=\"{}{} {}{}\" qvel=\"{}{} 0{}\"/>\n", start.trial,
                    along, N(s[1]), N(start.touchdown_angle), zeros, speed, N(s[3]), zeros);
  }
  return text + "  </keyframe>\n";
}

// What stands in a file's name is not for XML.
std::string XmlText(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' || c == '>' || c == '&' || c == '"' ? '_' : c;
  return out;
}

}  // namespace

std::string MjcfOf(const ExportedModel& given, const MjcfOptions& options,
                   const std::string& place) {
  Check(given, place);
  ExportedModel model = given;
  model.origin = XmlText(model.origin);
  for (ExportedStart& start : model.initial_states) start.trial = XmlText(start.trial);
  const Beam beam(model, options);
  if (!(beam.body_mass > 0.0)) {
    throw InputError({place, "leg mass = " + N(beam.leg_mass) + " kg",
                      "must be less than the mass weighed, " + N(beam.p.m) + " kg", ""});
  }
  const double settle = kContactSteps * options.step;
  std::string text = WithoutDashes(HeadOf(model, beam));
  text += "<mujoco model=\"hoplab leg\">\n  <compiler angle=\"radian\"/>\n";
  text += fmt::format(
      "  <option timestep=\"{}\" gravity=\"0 0 {}\" integrator=\"implicit\" cone=\"elliptic\" "
      "tolerance=\"1e-12\"/>\n",
      N(options.step), N(-beam.p.g));
  text += "  <size nconmax=\"500\" njmax=\"2000\"/>\n";
  text += fmt::format(
      "  <default>\n"
      "    <default class=\"bend\">\n"
      "      <joint type=\"hinge\" axis=\"0 -1 0\" stiffness=\"{}\" damping=\"{}\" "
      "armature=\"{}\"/>\n"
      "    </default>\n"
      "    <default class=\"hip\">\n"
      "      <joint type=\"hinge\" axis=\"0 -1 0\" damping=\"{}\" frictionloss=\"{}\"/>\n"
      "    </default>\n"
      "    <default class=\"foot\">\n"
      "      <geom type=\"sphere\" size=\"{}\" contype=\"0\" conaffinity=\"1\" condim=\"3\" "
      "friction=\"{} 0 0\" solref=\"{} 1\" priority=\"1\" solimp=\"0.99 0.99 0.001\"/>\n"
      "    </default>\n"
      "  </default>\n",
      N(beam.stiffness), N(beam.damping), N(beam.armature), N(model.Of("hip_viscous_friction")),
      N(model.Of("hip_coulomb_friction")), N(kFootRadius * beam.p.r), N(beam.friction), N(settle));
  text +=
      "  <worldbody>\n"
      "    <geom name=\"floor\" type=\"plane\" size=\"5 1 0.1\" contype=\"1\" conaffinity=\"0\" "
      "friction=\"0 0 0\"/>\n"
      "    <body name=\"body\">\n";
  if (!beam.p.on_guide)
    text += SlideJoint("body_x", "1 0 0", 0.0, 0.0, beam.p.inertia_x * beam.p.m);
  text += SlideJoint("body_y", "0 0 1", model.Of("guide_viscous_friction"),
                     model.Of("guide_coulomb_friction"), beam.p.inertia_y * beam.p.m);
  const double ball = 0.15 * beam.p.r, inertia = 0.4 * beam.body_mass * ball * ball;
  text += fmt::format(
      "      <inertial pos=\"0 0 0\" mass=\"{}\" diaginertia=\"{} {} {}\"/>\n"
      "      <geom type=\"sphere\" size=\"{}\" contype=\"0\" conaffinity=\"0\"/>\n",
      N(beam.body_mass), N(inertia), N(inertia), N(inertia), N(ball));
  text += ArcBodies(beam) + "    </body>\n  </worldbody>\n";
  text +=
      "  <actuator>\n    <motor name=\"hip_torque\" joint=\"hip\" gear=\"-1\"/>\n  </actuator>\n";
  return text + KeysOf(model, beam) + "</mujoco>\n";
}

}  // namespace hoplab
