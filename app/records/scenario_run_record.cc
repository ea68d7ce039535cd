#include "app/records/scenario_run_record.h"

#include "app/records/simulation_record.h"
#include "app/records/solver_record.h"
#include "app/records/trajectory_tables.h"
#include "fitting/run_end.h"

namespace hoplab {
namespace {

constexpr double kTrajectoryRate = 1000.0;  // Hz

Json NewSimulationRecord(const SimulateSettings& settings, const Scenario& scenario, Law law) {
  RecordHeader header;
  header.command = "simulate";
  header.law = std::string(NameOf(law));
  header.reading = scenario.mechanism.reading;
  header.options = {{"scenario", settings.scenario.scenario},
                    {"set", settings.scenario.set},
                    {"with", settings.scenario.with},
                    {"sensitivities", settings.sensitivities}};
  RecordSolver(settings.solver, header.options);
  Json record = NewRecord(header);
  record["scenario"] = scenario.name;
  return record;
}

}  // namespace

bool IsUseless(Outcome outcome) {
  return outcome == Outcome::kStartsInGround || outcome == Outcome::kIntegrationFailed ||
         outcome == Outcome::kStepLimit;
}

Json ScenarioRunRecord(const SimulateSettings& settings, const Scenario& scenario,
                       const SimulationRequest& request, const Trajectory& run) {
  Json record = NewSimulationRecord(settings, scenario, request.law);
  AddSimulation(request, run, settings.sensitivities, record);
  record["mechanism"] = MechanismRecord(request);
  if (IsUseless(run.outcome))
    SetFailed(record, "the run " + WhyEnded(run, request.effects, request.initial));
  return record;
}

std::map<std::string, std::string> ScenarioRunTables(const SimulationRequest& request,
                                                     const Trajectory& run) {
  const int legs = RobotLegsOf(request.parameters);
  CsvText trajectory(TrajectoryHeader({}, legs)), events(EventHeader({}, legs));
  AddTrajectoryRows(request, kTrajectoryRate, {}, 0.0, trajectory);
  AddEventRows(run, {}, 0.0, events, legs);
  return {{"trajectory.csv", trajectory.text()}, {"events.csv", events.text()}};
}

}  // namespace hoplab
