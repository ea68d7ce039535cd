#include <chrono>
#include <cmath>
#include <ostream>

#include "app/records/fit_record.h"
#include "app/records/fit_tables.h"
#include "app/reports/fit_report.h"
#include "app/reports/run_folder.h"
#include "app/runs/fit_run.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/help_text.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/terminal/quantity.h"
#include "app/terminal/warnings.h"
#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

struct FitSettings : RunSettings {
  ProblemSettings problem;
  int starts = 1;
  std::uint64_t seed = 1;
  std::string strategy = "apex_shooting";
  std::string span = "whole_else_hops";
  std::string loss = "squared";
  std::string discrepancy = "matern";
  double loss_scale = Loss().scale;
  std::vector<std::string> profile;
};

FitRunOptions OptionsOf(const FitSettings& settings) {
  FitRunOptions options;
  options.problem = ProblemOptionsOf(settings.problem);
  options.fit.strategy = *FindStrategy(settings.strategy);
  options.span = *FindSpan(settings.span);
  options.fit.starts = settings.starts;
  options.fit.seed = settings.seed;
  options.fit.loss = {settings.loss == "squared" ? LossKind::kSquared : LossKind::kPseudoHuber,
                      settings.loss_scale};
  options.fit.discrepancy = *FindDiscrepancy(settings.discrepancy);
  options.fit.jobs = JobsOf(settings.problem.jobs);
  options.profile = settings.profile;
  return options;
}

std::string StepText(int start, int starts, std::string_view stage, int iteration, double cost) {
  std::string text = "fitting";
  if (start >= starts) {
    text += ", beyond a threshold";
  } else if (starts > 1) {
    text += ", start " + std::to_string(start + 1) + " of " + std::to_string(starts);
  }
  text += ": " + std::string(stage) + ", iteration " + std::to_string(iteration);
  if (std::isfinite(cost)) text += ", cost " + Significant(cost, 5);
  return text;
}

ExitCode CodeOf(const FitRun& run) {
  if (run.interrupted) return ExitCode::kInterrupted;
  return run.Failure().empty() ? ExitCode::kDone : ExitCode::kNoResult;
}

ExitCode RunFitCommand(const FitSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  FitRunOptions options = OptionsOf(settings);
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const RunFolder folder(RunFolderOptionsOf(settings), dataset.name, "fit");

  const InterruptGuard interrupt;
  Progress progress(console, settings.quiet);
  options.fit.stop = interrupt.flag();
  options.stage = [&](std::string_view stage) { progress.Stage(std::string(stage)); };
  options.checked = [&](const CheckReport& check) {
    progress.Clear();
    for (const std::string& warning : CollapseWarnings(check.warnings)) Warn(console, warning);
  };
  options.fit.progress = [&](int start, std::string_view stage, int iteration, double cost) {
    progress.Step(StepText(start, settings.starts, stage, iteration, cost), start, settings.starts);
  };
  const FitRun run = RunFit(dataset, options);
  progress.Clear();

  Json record = FitRecord(dataset, settings.problem.dataset, options, run);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
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
  return CodeOf(run);
}

void AddFit(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<FitSettings>();
  AddProblemOptions(sub, settings->problem);
  sub.add_option("--starts", settings->starts,
                 "Searches: one from the nominal values, then scattered")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N");
  AddSeedOption(sub, settings->seed, "Of the scattered starts");
  sub.add_option("--strategy", settings->strategy,
                 "apex_shooting (default), growing_horizon or raw")
      ->check(OneOf({"raw", "growing_horizon", "apex_shooting"}))
      ->option_text("NAME");
  sub.add_option("--span", settings->span,
                 "whole traces, else single hops where a law falls (default), whole or hops")
      ->check(OneOf({"whole_else_hops", "whole", "hops"}))
      ->option_text("NAME");
  sub.add_option("--loss", settings->loss, "squared (default) or pseudo_huber")
      ->check(OneOf({"squared", "pseudo_huber"}))
      ->option_text("NAME");
  sub.add_option("--loss-scale", settings->loss_scale,
                 "Standard deviations from which pseudo_huber is linear (default 2)")
      ->check(CLI::PositiveNumber)
      ->option_text("NUMBER");
  AddDiscrepancyOption(sub, settings->discrepancy);
  sub.add_option("--profile", settings->profile, "Profile likelihood of these parameters, or all")
      ->delimiter(',')
      ->option_text("NAME,...")
      ->allow_extra_args(false);
  AddRunFolderOptions(sub, *settings, "Run folder (default runs/<dataset>-fit-NNN)");
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
