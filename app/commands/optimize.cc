#include <ostream>

#include "app/records/optimize_record.h"
#include "app/reports/optimize_report.h"
#include "app/reports/run_folder.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/stopwatch.h"

namespace hoplab {
namespace {

ExitCode RunOptimizeCommand(const OptimizeSettings& settings, Console& console) {
  const Stopwatch watch;
  const std::vector<OverOption> over = OverOptionsOf(settings);
  const ScenarioDocument document = ScenarioDocumentOf(settings.scenario);
  const Scenario scenario = document.Read();
  const RunFolder folder(RunFolderOptionsOf(settings), scenario.name, "optimize");
  OptimizeRun run = PrepareOptimize(settings, over, document, scenario);
  const InterruptGuard interrupt;
  Progress progress(console, settings.quiet);
  RunOptimize(settings, interrupt.flag(), progress, run);
  progress.Clear();

  Json record = OptimizeRecord(settings, scenario, run);
  record["seconds"] = watch.Seconds();
  std::map<std::string, std::string> files = OptimizeTables(run);
  files["run.json"] = TextOf(record);
  const std::string written = folder.Write(files).string();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << OptimizeReport(scenario.name, run, console.out_colours) << "  run folder     "
                << written << '\n';
  }
  const std::string failure = run.Failure();
  if (!failure.empty()) console.err << "hoplab optimize: " << failure << '\n';
  if (run.result.interrupted) {
    console.err << "kept: " << written << '\n';
    return ExitCode::kInterrupted;
  }
  return failure.empty() ? ExitCode::kDone : ExitCode::kNoResult;
}

void AddOptimize(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<OptimizeSettings>();
  AddOptimizeOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunOptimizeCommand);
}

}  // namespace

namespace commands {
extern constexpr Command optimize = {
    .place = 90,
    .name = "optimize",
    .what = "Search the gains of a scenario that settle soonest",
    .footer =
        "Examples:\n"
        "  hoplab optimize experiments/fastest-convergence.yaml --budget 20\n"
        "  hoplab optimize experiments/fastest-convergence.yaml --over kp,v_des=1:3\n"
        "  hoplab optimize hopping.yaml --algorithm crs2 --seeds 10 --json",
    .add = AddOptimize};
}  // namespace commands
}  // namespace hoplab
