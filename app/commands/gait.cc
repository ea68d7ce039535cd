#include <ostream>

#include "app/records/gait_record.h"
#include "app/reports/gait_report.h"
#include "app/reports/run_folder.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/terminal/stopwatch.h"
#include "experiments/scenario_hopper.h"

namespace hoplab {
namespace {

ExitCode RunGaitCommand(const GaitSettings& settings, Console& console) {
  const Stopwatch watch;
  GaitOptions options;
  if (!settings.along.empty()) options.along = ParseAlong(settings.along);
  const Scenario scenario = ReadScenarioOf(settings.scenario);
  const RunFolder folder(RunFolderOptionsOf(settings), scenario.name, "gait");
  const Hopper hopper = LeggedHopperOfScenario(scenario, IntegratorOptionsOf(settings.solver));

  const InterruptGuard interrupt;
  Progress progress(console, settings.quiet);
  options.stop = interrupt.flag();
  options.jobs = JobsOf(settings.jobs);
  options.stage = [&](const std::string& stage) { progress.Stage(stage); };
  const GaitRun run = RunGait(hopper, options);
  progress.Clear();

  Json record = GaitRecord(settings, scenario, run);
  record["seconds"] = watch.Seconds();
  std::map<std::string, std::string> files = GaitTables(run);
  files["run.json"] = TextOf(record);
  const std::string written = folder.Write(files).string();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << GaitReport(scenario.name, run, console.out_colours) << "\n  run folder  "
                << written << '\n';
  }
  const std::string failure = run.Failure();
  if (!failure.empty()) console.err << "hoplab gait: " << failure << '\n';
  return ExitCodeOf(run.interrupted, failure);
}

void AddGait(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<GaitSettings>();
  AddGaitOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunGaitCommand);
}

}  // namespace

namespace commands {
extern constexpr Command gait = {
    .place = 80,
    .name = "gait",
    .what = "Steady hop or stride of a scenario, its stability and what changes it",
    .footer =
        "Examples:\n"
        "  hoplab gait experiments/controlled-hopping.yaml\n"
        "  hoplab gait experiments/controlled-hopping.yaml --along theta_td=0.5:0.9\n"
        "  hoplab gait experiments/robot-walk.yaml --along clock.period_s=0.5:0.6\n"
        "  hoplab gait hopping.yaml --set controller.kp_N_s=2 --json",
    .add = AddGait};
}  // namespace commands
}  // namespace hoplab
