#include <ostream>

#include "app/records/diagnosis_record.h"
#include "app/records/diagnosis_tables.h"
#include "app/records/discovery_record.h"
#include "app/reports/diagnosis_report.h"
#include "app/reports/run_folder.h"
#include "app/reports/run_progress.h"
#include "app/runs/diagnose_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/stopwatch.h"
#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

ExitCode RunDiagnose(const DiagnoseSettings& settings, Console& console) {
  const Stopwatch watch;
  DiagnosisOptions options = DiagnosisOptionsOf(settings);
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const RunFolder folder(RunFolderOptionsOf(settings), dataset.name, "diagnose");

  const InterruptGuard guard;
  Progress progress(console, settings.quiet);
  options.fit.stop = guard.flag();
  ShowProgress(options, progress, console);
  const DiagnosisRun run = RunDiagnosis(dataset, options);
  std::optional<Discovery> discovery;
  if (settings.discover && run.WantsFormula()) discovery = DiscoverBeside(run.diagnosis, options);
  progress.Clear();

  Json record = DiagnosisRecord(dataset, settings.problem.dataset, options, run);
  if (settings.discover)
    record["discovery"] = discovery ? DiscoveryPart(*discovery) : Json(nullptr);
  record["seconds"] = watch.Seconds();
  // Before the null fit is over there is nothing worth keeping of an interrupted run.
  const bool keep = run.diagnosis.fit.ok || !run.diagnosis.interrupted;
  std::string kept = "nothing was written";
  if (keep) {
    std::map<std::string, std::string> files = DiagnosisTables(run);
    if (discovery) files.merge(DiscoveryFiles(*discovery));  // the diagnosis' tables stay
    files["run.json"] = TextOf(record);
    kept = folder.Write(files).string();
  }
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << DiagnosisReport(dataset, run, settings.discover, console.out_colours);
    if (settings.discover) console.out << FormulaReport(run, discovery, console.out_colours);
    console.out << Styled("  run folder   ", Emphasis::kFaint, console.out_colours) << kept << '\n';
  }
  if (!run.Failure().empty()) console.err << "hoplab diagnose: " << run.Failure() << '\n';
  const bool interrupted = run.diagnosis.interrupted || run.diagnosis.cut_short;
  if (interrupted) console.err << "kept: " << (keep ? kept : "nothing") << '\n';
  return ExitCodeOf(interrupted, run.Failure());
}

void AddDiagnose(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<DiagnoseSettings>();
  AddDiagnoseOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunDiagnose);
}

}  // namespace

namespace commands {
extern constexpr Command diagnose = {
    .place = 40,
    .name = "diagnose",
    .what = "Name what the simulation lacks, extend it and measure what that brings",
    .footer =
        "Examples:\n"
        "  hoplab diagnose datasets/rig-drops --effects touchdown_loss,air_drag\n"
        "  hoplab diagnose my-hops --without sensor_delay,clock_scale --jobs 4\n"
        "  hoplab diagnose my-hops --with air_drag --effects ground_slope,foot_slip",
    .add = AddDiagnose};
}  // namespace commands
}  // namespace hoplab
