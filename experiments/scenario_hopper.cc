#include "experiments/scenario_hopper.h"

#include "base/input_error.h"
#include "fitting/generate.h"
#include "fitting/model_of_spec.h"

namespace hoplab {

Hopper HopperOfScenario(const Scenario& scenario, const IntegratorOptions& integrator) {
  constexpr double kUsualHorizon = 60.0;  // s
  Scenario stopping = scenario;
  if (!stopping.stop.time_s && !stopping.stop.hops) stopping.stop.time_s = kUsualHorizon;
  Hopper hopper;
  hopper.effects = ResolveEffects(
      scenario.effects,
      ResolveLaw(scenario.law.value_or(""), scenario.mechanism.type, scenario.law_origin.place),
      LegMassOfSpec(scenario.mechanism), 0, RobotLegsOfSpec(scenario.mechanism));
  hopper.request = RequestOfScenario(stopping, hopper.effects);
  hopper.request.effects = {};  // the hopper's own are put in place where it runs
  hopper.request.integrator = integrator;
  return hopper;
}

Hopper LeggedHopperOfScenario(const Scenario& scenario, const IntegratorOptions& integrator) {
  if (scenario.mechanism.type == MechanismKind::kBall) {
    throw InputError({scenario.origin.place, "mechanism.type = ball",
                      "has no gait: what bounces has no steady hop to come back to",
                      "Use c_leg or straight_leg."});
  }
  if (scenario.mechanism.type == MechanismKind::kRobot &&
      scenario.controller->motors->kind != MotorControl::kClock) {
    throw InputError({scenario.origin.place, "controller.type",
                      "a robot whose motors stand still makes no strides: nothing drives it",
                      "Use type: clock, or look at its runs with simulate and sweep."});
  }
  for (const EffectSpec& effect : scenario.effects) {
    if (effect.name == "gait_period_scale")
      throw InputError({scenario.origin.place, "effects.gait_period_scale",
                        "a stride is one period of the clock as it is stated",
                        "Give controller.period_s the period that the clock has."});
  }
  if (LegMassOfSpec(scenario.mechanism) == LegMass::kAtToe) {
    throw InputError(
        {scenario.origin.place, "mechanism.toe_mass_kg",
         "speed and height at an apex do not tell the next ones of a leg that swings: its "
         "gait is no return map of these two",
         "Leave toe_mass_kg out, or look at runs with simulate and sweep."});
  }
  return HopperOfScenario(scenario, integrator);
}

ApexState StartApex(const Hopper& hopper) {
  const std::vector<double>& s = hopper.request.initial;
  return {s[2], s[1] + s[3] * s[3] / (2.0 * hopper.request.parameters.g)};
}

}  // namespace hoplab
