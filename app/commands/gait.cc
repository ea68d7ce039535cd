#include <chrono>
#include <ostream>

#include "app/records/gait_record.h"
#include "app/records/solver_record.h"
#include "app/reports/gait_report.h"
#include "app/reports/run_folder.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "experiments/scenario_hopper.h"

namespace hoplab {
namespace {

struct GaitSettings : RunSettings {
  ScenarioSettings scenario;
  std::string along;
  int jobs = 0;
  SolverSettings solver{.tolerance = 1e-12};
};

Json NewGaitRecord(const GaitSettings& settings, const Scenario& scenario, Law law) {
  RecordHeader header;
  header.command = "gait";
  header.law = std::string(NameOf(law));
  header.variant = scenario.mechanism.variant;
  header.options = {{"scenario", settings.scenario.scenario},
                    {"set", settings.scenario.set},
                    {"with", settings.scenario.with},
                    {"along", settings.along.empty() ? Json(nullptr) : Json(settings.along)}};
  RecordSolver(settings.solver, header.options);
  Json record = NewRecord(header);
  record["scenario"] = scenario.name;
  return record;
}

ExitCode RunGaitCommand(const GaitSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
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

  Json record = NewGaitRecord(settings, scenario, hopper.request.law);
  AddGait(run, record);
  const std::string failure =
      run.interrupted ? "interrupted; the branch ends where it was stopped" : run.Failure();
  if (!failure.empty()) SetFailed(record, failure);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  std::map<std::string, std::string> files = GaitTables(run);
  files["run.json"] = TextOf(record);
  const std::string written = folder.Write(files).string();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << GaitReport(scenario.name, run, console.out_colours) << "\n  run folder  "
                << written << '\n';
  }
  if (!failure.empty()) console.err << "hoplab gait: " << failure << '\n';
  if (run.interrupted) return ExitCode::kInterrupted;
  return failure.empty() ? ExitCode::kDone : ExitCode::kNoResult;
}

void AddGait(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<GaitSettings>();
  AddScenarioOptions(sub, settings->scenario);
  sub.add_option("--along", settings->along,
                 "Follow it along a parameter, SI units, as kp=0.5:12 or clock.period_s=0.25:0.6")
      ->option_text("NAME=LOW:HIGH");
  AddJobsOption(sub, settings->jobs);
  AddSolverOptions(sub, settings->solver);
  AddRunFolderOptions(sub, *settings, "Run folder (default runs/<scenario>-gait-NNN)");
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
