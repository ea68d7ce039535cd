#include <ostream>

#include "app/records/fit_record.h"
#include "app/records/fit_tables.h"
#include "app/reports/fit_report.h"
#include "app/reports/run_folder.h"
#include "app/reports/run_progress.h"
#include "app/runs/fit_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/stopwatch.h"
#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

ExitCode RunFitCommand(const FitSettings& settings, Console& console) {
  const Stopwatch watch;
  FitRunOptions options = FitRunOptionsOf(settings);
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const RunFolder folder(RunFolderOptionsOf(settings), dataset.name, "fit");

  const InterruptGuard interrupt;
  Progress progress(console, settings.quiet);
  options.fit.stop = interrupt.flag();
  ShowProgress(options, progress, console);
  const FitRun run = RunFit(dataset, options);
  progress.Clear();

  Json record = FitRecord(dataset, settings.problem.dataset, options, run);
  record["seconds"] = watch.Seconds();
  const bool keep = run.has_result || !run.interrupted;
  std::string kept = "nothing was written";
  if (keep) {
    std::map<std::string, std::string> files = FitTables(run);
    files["run.json"] = TextOf(record);
    kept = folder.Write(files).string();
  }
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << FitReport(dataset, run, console.out_colours)
                << Styled("  run folder   ", Emphasis::kFaint, console.out_colours) << kept << '\n';
  }
  if (!run.Failure().empty()) console.err << "hoplab fit: " << run.Failure() << '\n';
  if (run.interrupted) console.err << "kept: " << (keep ? kept : "nothing") << '\n';
  return ExitCodeOf(run.interrupted, run.Failure());
}

void AddFit(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<FitSettings>();
  AddFitOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunFitCommand);
}

}  // namespace

namespace commands {
extern constexpr Command fit = {
    .place = 30,
    .name = "fit",
    .what = "Fit parameters to recorded hops, with intervals",
    .footer =
        "Examples:\n"
        "  hoplab fit datasets/rig-drops\n"
        "  hoplab fit datasets/rig-drops --law consistent --free E,d,G --starts 8\n"
        "  hoplab fit my-hops --with air_drag --fix g=9.80665 --profile E",
    .add = AddFit};
}  // namespace commands
}  // namespace hoplab
