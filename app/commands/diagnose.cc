#include <chrono>
#include <cmath>
#include <ostream>

#include "app/records/diagnosis_record.h"
#include "app/records/diagnosis_tables.h"
#include "app/records/discovery_record.h"
#include "app/reports/diagnosis_report.h"
#include "app/reports/discovery_report.h"
#include "app/reports/run_folder.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/help_text.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/terminal/quantity.h"
#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

struct DiagnoseSettings : RunSettings {
  ProblemSettings problem;
  std::vector<std::string> effects, without;
  int max_effects = DiagnosisOptions().max_effects;
  double material = 100.0 * kMaterial;  // [%]
  int starts = 1;
  std::uint64_t seed = 1;
  std::string span = "whole_else_hops";
  std::string discrepancy = "matern";
  bool discover = false;
};

DiagnosisOptions OptionsOf(const DiagnoseSettings& settings) {
  DiagnosisOptions options;
  options.problem = ProblemOptionsOf(settings.problem);
  options.fit.starts = settings.starts;
  options.fit.seed = settings.seed;
  options.fit.jobs = JobsOf(settings.problem.jobs);
  options.fit.discrepancy = *FindDiscrepancy(settings.discrepancy);
  options.span = *FindSpan(settings.span);
  options.candidates = {settings.effects, settings.without};
  options.max_effects = settings.max_effects;
  options.material = settings.material / 100.0;
  return options;
}

void ShowProgress(DiagnosisOptions& options, Progress& progress) {
  options.stage = [&](std::string_view stage) { progress.Stage(std::string(stage)); };
  options.step = [&](const std::string& text, int done, int of) { progress.Step(text, done, of); };
  const int starts = options.fit.starts;
  options.fit.progress = [&progress, starts](int start, std::string_view stage, int iteration,
                                             double cost) {
    std::string text = "fitting the model as it is";
    if (starts > 1)
      text += ", start " + std::to_string(start + 1) + " of " + std::to_string(starts);
    text += ": " + std::string(stage) + ", iteration " + std::to_string(iteration);
    if (std::isfinite(cost)) text += ", cost " + Significant(cost, 5);
    progress.Step(text);
  };
}

// Something is left that no listed cause explains, or that is likely.
bool WantsFormula(const DiagnosisRun& run) {
  const Diagnosis& d = run.diagnosis;
  return run.Failure().empty() && (d.CausesMayStandIn() || d.left.material);
}

ExitCode CodeOf(const DiagnosisRun& run) {
  if (run.diagnosis.interrupted) return ExitCode::kInterrupted;
  return run.Failure().empty() ? ExitCode::kDone : ExitCode::kNoResult;
}

ExitCode RunDiagnose(const DiagnoseSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  DiagnosisOptions options = OptionsOf(settings);
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const RunFolder folder(RunFolderOptionsOf(settings), dataset.name, "diagnose");

  const InterruptGuard interrupt;
  Progress progress(console, settings.quiet);
  options.fit.stop = interrupt.flag();
  ShowProgress(options, progress);
  const DiagnosisRun run = RunDiagnosis(dataset, options);
  std::optional<Discovery> discovery;
  if (settings.discover && WantsFormula(run)) discovery = DiscoverBeside(run.diagnosis, options);
  progress.Clear();

  Json record = DiagnosisRecord(dataset, settings.problem.dataset, options, run);
  if (settings.discover)
    record["discovery"] = discovery ? DiscoveryPart(*discovery) : Json(nullptr);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
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
    if (discovery) console.out << '\n' << DiscoveryReport(*discovery, console.out_colours) << '\n';
    if (settings.discover && !discovery && run.Failure().empty())
      console.out << "\n  no formula is needed beside what was named\n";
    console.out << Styled("  run folder   ", Emphasis::kFaint, console.out_colours) << kept << '\n';
  }
  if (!run.Failure().empty()) console.err << "hoplab diagnose: " << run.Failure() << '\n';
  if (run.diagnosis.interrupted) console.err << "kept: " << (keep ? kept : "nothing") << '\n';
  return CodeOf(run);
}

void AddDiagnose(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<DiagnoseSettings>();
  AddProblemOptions(sub, settings->problem);
  CLI::Option* only = sub.add_option("--effects", settings->effects,
                                     "Effects to try (default: all that apply); see hoplab effects")
                          ->delimiter(',')
                          ->option_text("EFFECT,...")
                          ->allow_extra_args(false);
  sub.add_option("--without", settings->without, "Effects not to try")
      ->delimiter(',')
      ->option_text("EFFECT,...")
      ->allow_extra_args(false)
      ->excludes(only);
  sub.add_option("--max-effects", settings->max_effects,
                 "Most effects to add to the model (default 5)")
      ->check(CLI::Range(1, 10))
      ->option_text("N");
  sub.add_option("--material", settings->material,
                 "Misfit share below which a cause is small (default 2)")
      ->check(CLI::Range(0.0, 100.0))
      ->option_text("PERCENT");
  AddDiscrepancyOption(sub, settings->discrepancy);
  sub.add_option("--starts", settings->starts,
                 "Searches for the model as it is: from the nominal values, then scattered")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N");
  AddSeedOption(sub, settings->seed, "Of scattered starts, noise draws and bootstraps");
  sub.add_option("--span", settings->span,
                 "whole traces, else single hops where a law falls (default), whole or hops")
      ->check(OneOf({"whole_else_hops", "whole", "hops"}))
      ->option_text("NAME");
  sub.add_flag("--discover", settings->discover,
               "Look for a formula where the catalogue falls short");
  AddRunFolderOptions(sub, *settings, "Run folder (default runs/<dataset>-diagnose-NNN)");
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
