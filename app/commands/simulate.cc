#include <ostream>

#include "app/records/scenario_run_record.h"
#include "app/records/simulation_record.h"
#include "app/reports/run_folder.h"
#include "app/reports/simulation_report.h"
#include "app/terminal/command.h"
#include "app/terminal/stopwatch.h"
#include "fitting/generate.h"
#include "fitting/run_end.h"

namespace hoplab {
namespace {

ExitCode RunSimulate(const SimulateSettings& settings, Console& console) {
  const Stopwatch watch;
  const Scenario scenario = ReadScenarioOf(settings.scenario);
  const RunFolder folder(RunFolderOptionsOf(settings), scenario.name, "simulate");
  const ScenarioRequest simulated(settings, scenario);
  const SimulationRequest& request = simulated.request;
  const Trajectory run = Simulate(request);
  CheckAngleEach(scenario.touchdown_angles_rad, run, scenario.origin.place);

  Json record = ScenarioRunRecord(settings, scenario, request, run);
  std::map<std::string, std::string> files = ScenarioRunTables(request, run);
  record["seconds"] = watch.Seconds();
  files["run.json"] = TextOf(record);
  const std::filesystem::path written = folder.Write(files);
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << SimulationReport(scenario.name, request, run, console.out_colours);
    if (!settings.sensitivities.empty() && !FailedAtOnce(run))
      console.out << SensitivityReport(settings.sensitivities, run);
    console.out << "\n  run folder  " << written.string() << '\n';
  }
  const bool useless = IsUseless(run.outcome);
  if (useless)
    console.err << "hoplab simulate: the run " << WhyEnded(run, request.effects, request.initial)
                << '\n';
  return useless ? ExitCode::kNoResult : ExitCode::kDone;
}

void AddSimulate(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<SimulateSettings>();
  AddSimulateOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunSimulate);
}

}  // namespace

namespace commands {
extern constexpr Command simulate = {
    .place = 130,
    .name = "simulate",
    .what = "Run a scenario: events, energy, trajectory",
    .footer =
        "Examples:\n"
        "  hoplab simulate experiments/controlled-hopping.yaml\n"
        "  hoplab simulate hopping.yaml --set controller.kp_N_s=4 --law consistent\n"
        "  hoplab simulate hopping.yaml --sensitivities E,d --json",
    .add = AddSimulate};
}  // namespace commands
}  // namespace hoplab
