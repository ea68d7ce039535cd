#include "app/runs/simulate_settings.h"

#include "app/runs/sensitivity_direction.h"
#include "fitting/generate.h"
#include "fitting/model_of_spec.h"

namespace hoplab {

void AddSimulateOptions(CLI::App& sub, SimulateSettings& settings) {
  AddScenarioOptions(sub, settings.scenario);
  AddSolverOptions(sub, settings.solver);
  sub.add_option("--sensitivities", settings.sensitivities,
                 "Derivatives of the end and of event times, as E,d,x0,air_drag.c_drag")
      ->delimiter(',')
      ->option_text("NAME,...")
      ->allow_extra_args(false);
  AddRunFolderOptions(sub, settings, "Run folder (default runs/<scenario>-simulate-NNN)");
}

ScenarioRequest::ScenarioRequest(const SimulateSettings& settings, const Scenario& scenario) {
  const MechanismKind mechanism = scenario.mechanism.type;
  const LegMass mass = LegMassOfSpec(scenario.mechanism);
  const Law law = ResolveLaw(scenario.law.value_or(""), mechanism, scenario.law_origin.place);
  inputs = DrivenInputsOf(scenario);
  effects = ResolveEffects(scenario.effects, law, mass, KindsOf(inputs),
                           RobotLegsOfSpec(scenario.mechanism));
  request = RequestOfScenario(scenario, effects, inputs);
  request.integrator = IntegratorOptionsOf(settings.solver);
  for (const std::string& name : settings.sensitivities)
    directions.push_back(ResolveDirection(name, request, mass, effects));
  request.directions = directions;
}

}  // namespace hoplab
