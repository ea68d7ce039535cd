#include "app/export/c_law.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "app/export/parts.h"
#include "app/export/template_text.h"
#include "app/terminal/quantity.h"
#include "base/input_error.h"
#include "base/text.h"
#include "model/laws/elastica/tables.h"

namespace hoplab {
namespace {

// Effects whose terms the file has.
constexpr std::array kWrittenInC = {
    "rest_radius_scale",     "leg_hardening",        "second_order_bending",
    "leg_material_damping",  "leg_hysteresis",       "leg_quadratic_damping",
    "foot_coulomb_friction", "hip_viscous_friction", "hip_coulomb_friction",
    "torque_gain",           "torque_bias",          "touchdown_angle_bias",
    "touchdown_angle_speed", "touchdown_loss"};
// Effects on the body, what drives it or the ground under it: not the leg's.
constexpr std::array kOfTheBody = {
    "air_drag",          "body_mass_scale",   "boom_inertia",           "constant_force",
    "gravity_scale",     "ground_slope",      "guide_coulomb_friction", "guide_viscous_friction",
    "leg_mass",          "magnus_lift",       "angle_input_delay",      "angle_input_scale",
    "force_input_delay", "force_input_scale", "torque_input_delay"};

// M94: friction that the statics of the leg have to know.
bool BendsTheLeg(const ExportedModel& model, std::string_view effect) {
  return model.law == Law::kElastica &&
         (effect == "hip_viscous_friction" || effect == "hip_coulomb_friction");
}

void CheckEffects(const ExportedModel& model, const std::string& place) {
  for (const EffectSetting& e : model.effects) {
    const EffectInfo& info = e.effect->info;
    if (!BendsTheLeg(model, info.name) &&
        (IsAmong(info.name, kWrittenInC) || IsAmong(info.name, kOfTheBody) ||
         info.kind == EffectKind::kObservation))
      continue;
    std::string remedy = "Fit without it (--with names what is fitted).";
    if (BendsTheLeg(model, info.name)) remedy = "Fit with --law large_deflection in its place.";
    if (info.name == "higher_order_bending") remedy = "Fit with --law elastica in its place.";
    throw InputError({place + ": effects", DescribeEffect(e),
                      "changes the law in a way an exported C file does not know", remedy});
  }
}

// What is not in the file, a line each.
std::vector<std::string> LeftOut(const ExportedModel& model) {
  std::vector<std::string> lines;
  for (const EffectSetting& e : model.effects) {
    const EffectInfo& info = e.effect->info;
    if (IsAmong(info.name, kWrittenInC)) continue;
    std::string what = "acts on the body";
    if (info.kind == EffectKind::kObservation) what = "is the sensors'";
    if (info.name == "leg_mass")
      what = "the leg's inertia and weight are yours to add; the force is that of its statics";
    if (info.name == "ground_slope") what = "x and y here are along the ground and across it";
    if (info.name.ends_with("_input_delay") || info.name.ends_with("_input_scale"))
      what = "is the log's";
    lines.push_back(DescribeEffect(e) + ": " + what);
  }
  if (model.law == Law::kElastica)
    lines.push_back(
        "what a torque of the hip does to the arc (M121): it is bent as if there were none");
  for (const std::string& kind : model.driven_by)
    lines.push_back("a column of a log drove " + kind + "; give it to leg_load_driven, leg_decide");
  return lines;
}

std::string HeadOf(const ExportedModel& model, const Parameters<double>& p) {
  std::string text = "/* The compliant leg of " + model.origin +
                     "\n   Law: " + std::string(NameOf(model.law)) +
                     ". Fitted and stated values:\n";
  for (const ParameterId id : ParametersOf(MechanismOf(model.law))) {
    if (id == ParameterId::kM || id == ParameterId::kGravity || id == ParameterId::kThetaTd)
      continue;
    text += fmt::format("     {} = {} {}\n", InfoOf(id).name, ExactNumber(Field(p, id)),
                        InfoOf(id).unit);
  }
  for (const EffectSetting& e : model.effects) {
    if (IsAmong(e.effect->info.name, kWrittenInC)) text += "     " + DescribeEffect(e) + "\n";
  }
  const std::vector<std::string> left_out = LeftOut(model);
  if (!left_out.empty()) text += "   Not in this file:\n";
  for (const std::string& line : left_out) text += "     " + line + "\n";
  return text +
         "\n   In your loop, the hip's place and speed known:\n"
         "     leg_load_at(&leg, &hip, &load);       forces load.fx, load.fy on the hip\n"
         "     ... one step of your own; leg.contact += load.contact_rate * step ...\n"
         "     leg_decide(&leg, &hip, angle);        flight, rolling or toe\n"
         "   Nothing is global; one leg_state a leg. SI units, radians. C99, -lm. */";
}

std::string TableText(const char* name, elastica::Table table) {
  std::string text = fmt::format("static const double {}[{}] = {{\n", name,
                                 elastica::kPhiCount * elastica::kLoadCount);
  for (int i = 0; i < elastica::kPhiCount * elastica::kLoadCount; ++i)
    text += ExactNumber(elastica::kCoefficients[table][i]) + (i % 4 == 3 ? ",\n" : ", ");
  return text + "};\n";
}

std::map<std::string, std::string> ElasticaValues(bool damps_along_arc) {
  using namespace elastica;
  std::string tables = TableText("leg_table_energy", kEnergy);
  if (damps_along_arc) {
    tables += "/* D_ff/phi^5, D_fphi/(f phi^4), D_phiphi/(f^2 phi^3) of the dissipation. */\n" +
              TableText("leg_table_ff", kDissipationFF) +
              TableText("leg_table_fphi", kDissipationFPhi) +
              TableText("leg_table_phiphi", kDissipationPhiPhi);
  }
  return {{"CELLS", fmt::format("{} times {}", kPhiCells, kLoadCells)},
          {"PHI_CELLS", std::to_string(kPhiCells)},
          {"LOAD_CELLS", std::to_string(kLoadCells)},
          {"PHI_BEGIN", ExactNumber(kPhiBegin)},
          {"PHI_END", ExactNumber(kPhiEnd)},
          {"LOAD_BEGIN", ExactNumber(kLoadBegin)},
          {"LOAD_END", ExactNumber(kLoadEnd)},
          {"TABLES", tables}};
}

class CWriter {
 public:
  explicit CWriter(const ExportedModel& model)
      : model_(model),
        p_(model.Effective()),
        straight_(model.law == Law::kStraightLeg),
        half_circle_(model.law == Law::kThesis || model.law == Law::kNoSlip),
        along_arc_(model.law == Law::kElastica && p_.law_terms.material_damping_active) {
    if (p_.law_terms.hardening != 0.0) flags_.insert("HARDENING");
    if (SecondOrderShare() != 0.0) flags_.insert("SECOND_ORDER");
    if (along_arc_) flags_.insert("ALONG_ARC");
    flags_.insert(straight_ ? "STRAIGHT" : "CURVED");
    if (model.Has("touchdown_loss")) flags_.insert("LANDING");
  }

  std::string Text() {
    values_ = {{"HEAD", HeadOf(model_, p_)},
               {"LAW", std::string(NameOf(model_.law))},
               {"COORDINATE", half_circle_ || straight_
                                  ? "place of the contact x_c"
                                  : "rolling X0 = x_c - r phi, on the toe its place x_c"},
               {"DEFINES", Defines()},
               {"CHORD", ChordLines()},
               {"TORQUE", TorqueLines()},
               {"ANGLE", AngleLines()},
               {"LIFTOFF", LiftoffTest()},
               {"ALPHA", straight_ ? "angle" : "angle > 0.0 ? 0.5 * angle : angle"},
               {"ROLLING_RADIUS", RollingRadius()},
               {"UNUSED_PHI", flags_.contains("SECOND_ORDER") ? "" : "  (void)phi;\n"}};
    if (model_.law == Law::kElastica) values_.merge(ElasticaValues(along_arc_));
    std::string text = Part("head.c");
    if (straight_) {
      text += Part("straight.c");
    } else {
      const bool exact = model_.law == Law::kElastica;
      if (!exact || flags_.contains("HARDENING")) text += Part("shapes.c");
      if (!exact && flags_.contains("SECOND_ORDER")) text += Part("second_order.c");
      if (exact) text += Part("elastica_energy.c");
      if (along_arc_) text += Part("elastica_damping.c");
      text += Part(exact ? "elastica_arc.c" : half_circle_ ? "half_circle.c" : "elastic_arc.c");
    }
    return text + Part("frame.c");
  }

 private:
  std::string Part(const char* name) const {
    return FilledTemplate(ExportPart(name), values_, flags_);
  }

  double SecondOrderShare() const {
    if (model_.law == Law::kLargeDeflection) return 1.0;
    return p_.law_terms.second_order;
  }

  std::string Defines() const {
    std::string text;
    const auto add = [&](const char* name, double value, const char* remark) {
      text += fmt::format("#define LEG_{} {} /* {} */\n", name, Literal(value), remark);
    };
    if (straight_) {
      add("K", p_.k, "stiffness, N/m");
      add("L0", p_.l0, "rest length, m");
    } else {
      add("R", p_.r, "rest radius, m");
      add("EI", p_.E * p_.I, "bending stiffness, N m^2");
      add("EA", p_.E * p_.A, "N");
      add("GA", p_.G * p_.A, "N");
      add("KAPPA", p_.kappa, "shear factor");
      add("UNROLLED", half_circle_ ? 0.0 : p_.r, "contact = x_c - this times the arc, rolling");
    }
    add("D", p_.d, "damping along the chord, N s/m");
    add("KP", p_.kp, "gain of the speed controller, N s");
    add("V_DES", p_.v_des, "speed it wants, m/s");
    add("MOST_TORQUE", p_.torque_limit, "N m");
    const ThesisReading& v = p_.reading;
    add("TORQUE_SIGN", v.torque_sign == ThesisReading::TorqueSign::kPrinted ? -1.0 : 1.0,
        "of the torque's vertical force");
    add("HARDENING", p_.law_terms.hardening, "beta");
    add("SECOND_ORDER", SecondOrderShare(), "share of the next term of the elastica");
    add("TAU", p_.law_terms.material_damping, "of the strip's material, s");
    add("LANDING_LOSS", model_.Of("touchdown_loss"), "share of the speed along the chord");
    if (half_circle_) text += ReadingDefines();
    return text;
  }

  std::string ReadingDefines() const {
    using V = ThesisReading;
    const V v = model_.law == Law::kThesis ? p_.reading : V();
    std::string text;
    const auto add = [&](const char* name, bool value) {
      text += fmt::format("#define LEG_{} {}\n", name, value ? 1 : 0);
    };
    add("ROLLS_EXPLICITLY", v.rolling == V::Rolling::kExplicit);
    add("DAMPS_HIP", v.damping_rate == V::DampingRate::kHip);
    add("DAMPS_DEFLECTION", v.damping_rate == V::DampingRate::kDeflection);
    add("STIFFNESS_AT_REST", v.stiffness_radius == V::StiffnessRadius::kRest);
    add("STIFFNESS_AT_VIRTUAL_ANGLE", v.stiffness_angle == V::StiffnessAngle::kVirtualLeg);
    return text + fmt::format("#define LEG_RATE_FACTOR {}\n",
                              v.angle_rate == V::AngleRate::kTheta ? "2.0" : "1.0");
  }

  std::string RollingRadius() const {
    if (model_.law == Law::kNoSlip) return "LEG_R";
    const bool at_rest = p_.reading.rolling_radius == ThesisReading::RollingRadius::kRest;
    return at_rest ? "2.0 * LEG_R * u * y / (l * l)" : "u";
  }

  static std::string Literal(double value) {
    if (std::isinf(value)) return "HUGE_VAL";
    return value < 0.0 ? "(" + ExactNumber(value) + ")" : ExactNumber(value);
  }

  std::string ChordLines() const {
    std::string text;
    if (p_.law_terms.material_damping_active && !along_arc_)
      text += "  force -= LEG_TAU * s->stiffness * s->rate;\n";
    if (const double eta = model_.Of("leg_hysteresis"); eta != 0.0)
      text += "  force -= " + Literal(eta) + " * s->elastic * tanh(s->rate / 0.05);\n";
    if (const double d2 = model_.Of("leg_quadratic_damping"); d2 != 0.0)
      text += "  force -= " + Literal(d2) + " * fabs(s->rate) * s->rate;\n";
    return text;
  }

  std::string TorqueLines() const {
    std::string text;
    if (const double gain = model_.Of("torque_gain"); gain != 0.0)
      text += "  load->torque += " + Literal(gain) + " * motor;\n";
    if (const double bias = model_.Of("torque_bias"); bias != 0.0)
      text += "  load->torque += " + Literal(bias) + ";\n";
    if (const double b = model_.Of("hip_viscous_friction"); b != 0.0)
      text += "  load->torque += " + Literal(b) + " * s.angle_rate;\n";
    if (const double tau = model_.Of("hip_coulomb_friction"); tau != 0.0)
      text += "  load->torque += " + Literal(tau) + " * tanh(s.angle_rate / 0.5);\n";
    return text;
  }

  std::string AngleLines() const {
    const double bias = model_.Of("touchdown_angle_bias");
    const double speed = model_.Of("touchdown_angle_speed");
    std::string text = speed == 0.0 ? "  (void)vx;\n" : "";
    text += "  return commanded";
    if (bias != 0.0) text += " + " + Literal(bias);
    if (speed != 0.0) text += " + " + Literal(speed) + " * (vx - 1.0)";
    return text + ";\n";
  }

  // M64 and the liftoff rule.
  std::string LiftoffTest() const {
    std::string text = model_.liftoff == LiftoffRule::kZeroForce
                           ? "leg_chord_force(hip->y, &s) < 0.0"
                           : "s.rest - s.l < 0.0";
    if (const double slip = model_.Of("foot_coulomb_friction"); slip != 0.0)
      text += " || " + Literal(slip) + " * fabs(s.u) > hip->y";
    return text;
  }

  const ExportedModel& model_;
  Parameters<double> p_;
  bool straight_, half_circle_, along_arc_;
  std::set<std::string> flags_;
  std::map<std::string, std::string> values_;
};

}  // namespace

std::string CSourceOf(const ExportedModel& model, const std::string& place) {
  CheckEffects(model, place);
  return CWriter(model).Text();
}

}  // namespace hoplab
