#include <ostream>

#include "app/records/design_record.h"
#include "app/reports/design_report.h"
#include "app/reports/run_folder.h"
#include "app/runs/design_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/terminal/stopwatch.h"
#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

ExitCode RunDesignCommand(const DesignSettings& settings, Console& console) {
  const Stopwatch watch;
  DesignRunOptions options = DesignRunOptionsOf(settings);
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const RunFolder folder(RunFolderOptionsOf(settings), dataset.name, "design");

  const InterruptGuard interrupt;
  Progress progress(console, settings.quiet);
  options.fit.stop = interrupt.flag();
  options.stage = [&](std::string_view stage) { progress.Stage(std::string(stage)); };
  options.step = [&](const std::string& text, int done, int of) { progress.Step(text, done, of); };
  const DesignRun run = RunDesign(dataset, options);
  progress.Clear();

  Json record = DesignRecord(dataset, settings.problem.dataset, options, run);
  record["seconds"] = watch.Seconds();
  const bool keep = !run.interrupted || !run.search.best.empty();
  std::string kept = "nothing was written";
  if (keep) {
    std::map<std::string, std::string> files = DesignTables(run);
    files["run.json"] = TextOf(record);
    kept = folder.Write(files).string();
  }
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << DesignReport(dataset, run, console.out_colours)
                << Styled("  run folder   ", Emphasis::kFaint, console.out_colours) << kept << '\n';
  }
  if (run.interrupted) {
    console.err << "kept: " << (keep ? kept : "nothing") << '\n';
    return ExitCode::kInterrupted;
  }
  if (run.failure.empty()) return ExitCode::kDone;
  console.err << "hoplab design: " << run.failure << '\n';
  return ExitCode::kNoResult;
}

void AddDesign(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<DesignSettings>();
  AddDesignOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunDesignCommand);
}

}  // namespace

namespace commands {
extern constexpr Command design = {
    .place = 60,
    .name = "design",
    .what = "Propose the trial to record next",
    .footer =
        "Examples:\n"
        "  hoplab design datasets/rig-drops --sharpen E\n"
        "  hoplab design my-hops --cause air_drag,guide_viscous_friction\n"
        "  hoplab design my-hops --space angle=15:40,height=0.2:0.5,mass=0,throw=0",
    .add = AddDesign};
}  // namespace commands
}  // namespace hoplab
