#pragma once

#include <string>
#include <vector>

#include "model/formula/formula_effect.h"

namespace hoplab::testing {

/// A parameter that is nothing at zero.
inline FormulaParameter Factor(const std::string& name, const std::string& unit, double lower,
                               double upper, double typical) {
  return {name, unit, 0.0, std::nullopt, lower, upper, typical};
}
/// A parameter that shapes a formula.
inline FormulaParameter Shape(const std::string& name, const std::string& unit, double value,
                              double lower, double upper) {
  return {name, unit, std::nullopt, value, lower, upper, std::nullopt};
}

inline FormulaSource Source(const std::string& acts_as, const std::string& formula,
                            std::vector<FormulaParameter> parameters,
                            const std::string& name = "written") {
  return {name, acts_as, formula, std::move(parameters), "written for a test"};
}

/// An effect of the catalogue, and the same written as a formula with its parameters in the same
/// order, further ones behind them.
struct WrittenEffect {
  std::string catalogue;
  FormulaSource formula;
};

/// Those of the catalogue that can be written so under any law they apply to; `weight` is m g [N].
inline std::vector<WrittenEffect> WrittenEffects(double weight) {
  const auto v0 = [](double value) { return Shape("v0", "m/s", value, 1e-3, 1.0); };
  return {
      {"air_drag",
       Source("body_force_along", "-c * speed^2", {Factor("c", "N s^2/m^2", 0.0, 10.0, 0.02)})},
      {"constant_force", Source("body_force_x", "f", {Factor("f", "N", -1000.0, 1000.0, 0.1)})},
      {"guide_viscous_friction",
       Source("body_force_y", "-b * vy", {Factor("b", "N s/m", 0.0, 1000.0, 0.1)})},
      {"guide_coulomb_friction",
       Source("body_force_y", "-f * tanh(vy/v0)", {Factor("f", "N", 0.0, 1000.0, 0.1), v0(0.02)})},
      {"magnus_lift",
       Source("body_force_across", "c * speed", {Factor("c", "N s/m", -10.0, 10.0, 0.02)})},
      {"gravity_scale",
       Source("body_force_y", "-gamma * weight",
              {Factor("gamma", "1", -0.9, 1.0, 0.005), Shape("weight", "N", weight, 0.0, 1e4)})},
      {"leg_hysteresis", Source("chord_force", "-eta * elastic * tanh(rate/v0)",
                                {Factor("eta", "1", 0.0, 1.0, 0.02), v0(0.05)})},
      {"leg_quadratic_damping",
       Source("chord_force", "-d2 * abs(rate) * rate", {Factor("d2", "N s^2/m^2", 0.0, 1e5, 2.0)})},
      {"leg_material_damping",
       Source("chord_force", "-tau * stiffness * rate", {Factor("tau", "s", 0.0, 1.0, 1e-4)})},
      {"leg_hardening",
       Source("chord_force", "beta * elastic * s", {Factor("beta", "1", -5.0, 50.0, 0.5)})},
      {"stiffness_drift",
       Source("chord_force", "gamma * elastic * t", {Factor("gamma", "1/s", -0.5, 0.5, 0.005)})},
      {"torque_bias", Source("hip_torque", "tau", {Factor("tau", "N m", -1e3, 1e3, 0.02)})},
      {"torque_gain", Source("hip_torque", "gain * motor", {Factor("gain", "1", -0.9, 5.0, 0.05)})},
      {"hip_viscous_friction",
       Source("hip_torque", "b * rate", {Factor("b", "N m s/rad", 0.0, 100.0, 0.001)})},
      {"hip_coulomb_friction",
       Source("hip_torque", "tau * tanh(rate/w0)",
              {Factor("tau", "N m", 0.0, 1e3, 0.03), Shape("w0", "rad/s", 0.5, 0.01, 10.0)})},
      {"touchdown_loss",
       Source("landing_velocity_along", "-zeta * along", {Factor("zeta", "1", 0.0, 1.0, 0.01)})},
      {"touchdown_angle_bias",
       Source("touchdown_angle", "a", {Factor("a", "rad", -0.5, 0.5, 0.02)})},
      {"touchdown_angle_speed",
       Source("touchdown_angle", "kappa * (vx - v1)",
              {Factor("kappa", "rad s/m", -1.0, 1.0, 0.02), Shape("v1", "m/s", 1.0, 0.0, 2.0)})},
      {"sensor_offset_x", Source("reading_x", "o", {Factor("o", "m", -1.0, 1.0, 0.005)})},
      {"sensor_offset_y", Source("reading_y", "o", {Factor("o", "m", -1.0, 1.0, 0.005)})},
      {"sensor_scale_x", Source("reading_x", "g * x", {Factor("g", "1", -0.5, 0.5, 0.01)})},
      {"sensor_scale_y", Source("reading_y", "g * y", {Factor("g", "1", -0.5, 0.5, 0.01)})},
      {"restitution_speed",
       Source("restitution", "slope * speed", {Factor("slope", "s/m", -0.5, 0.5, 0.01)})}};
}

/// Whether the formula is the catalogue's effect under a law: what changes a law inside is so where
/// the force along the chord is all there is of it.
inline bool IsWrittenUnder(const std::string& catalogue, Law law) {
  if (catalogue == "stiffness_drift") return law == Law::kStraightLeg;
  if (catalogue == "leg_hardening") return law == Law::kStraightLeg;
  if (catalogue == "leg_material_damping") return law != Law::kElastica;
  return true;
}

}  // namespace hoplab::testing
