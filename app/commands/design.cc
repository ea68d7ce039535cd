#include <chrono>
#include <cmath>
#include <ostream>

#include "app/records/design_record.h"
#include "app/reports/design_report.h"
#include "app/reports/run_folder.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/help_text.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/terminal/usage_error.h"
#include "base/input_error.h"
#include "base/text.h"
#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

struct DesignSettings : RunSettings {
  ProblemSettings problem;
  std::vector<std::string> cause, space;
  std::string sharpen;
  int budget = DesignRunOptions().budget;
  int map_size = DesignRunOptions().map_size;
  std::uint64_t seed = 1;
  std::string discrepancy = "matern";
};

// "angle=10:50", or "mass=0" for a setting that is held.
DesignRange RangeOf(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name(Trim(text.substr(0, equals)));
  if (equals != text.npos) {
    const std::string range = text.substr(equals + 1);
    const std::size_t colon = range.find(':');
    const auto low = ParseDouble(Trim(range.substr(0, colon)));
    const auto high = colon == range.npos ? low : ParseDouble(Trim(range.substr(colon + 1)));
    if (low && high && std::isfinite(*low) && std::isfinite(*high)) {
      const std::optional<DesignSetting> setting = FindDesignSetting(name);
      if (setting) {
        const double si = InfoOf(*setting).si;
        return {*setting, *low * si, *high * si};
      }
      std::vector<std::string> known;
      for (int i = 0; i < kDesignSettings; ++i)
        known.emplace_back(InfoOf(static_cast<DesignSetting>(i)).name);
      throw InputError({"--space", Printable(name), "is no setting of a trial to record",
                        DidYouMean(name, known)});
    }
  }
  throw UsageError("--space: " + Printable(text) +
                   "; must be setting=low:high, or setting=value to hold it, as angle=10:50");
}

DesignRunOptions OptionsOf(const DesignSettings& settings) {
  DesignRunOptions options;
  options.problem = ProblemOptionsOf(settings.problem);
  options.fit.seed = settings.seed;
  options.fit.jobs = JobsOf(settings.problem.jobs);
  options.fit.discrepancy = *FindDiscrepancy(settings.discrepancy);
  options.causes = settings.cause;
  options.sharpen = settings.sharpen;
  for (const std::string& text : settings.space) options.space.push_back(RangeOf(text));
  options.budget = settings.budget;
  options.map_size = settings.map_size;
  return options;
}

ExitCode RunDesignCommand(const DesignSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  DesignRunOptions options = OptionsOf(settings);
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
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  const bool keep = !run.interrupted || !run.search.best.empty();
  std::string kept = "nothing was written";
  if (keep) {
    std::map<std::string, std::string> files = {{"run.json", TextOf(record)}};
    if (!run.search.tried.empty()) files["designs.csv"] = DesignsTable(run);
    if (!run.search.map.empty()) files["map.csv"] = DesignMapTable(run);
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
  AddProblemOptions(sub, settings->problem);
  CLI::Option* cause =
      sub.add_option("--cause", settings->cause,
                     "Effects to tell apart, each added to the model; one: from none of it")
          ->delimiter(',')
          ->option_text("EFFECT,...")
          ->allow_extra_args(false);
  sub.add_option("--sharpen", settings->sharpen,
                 "Fitted value whose interval is to shrink (default of both: diagnose decides)")
      ->option_text("NAME")
      ->excludes(cause);
  sub.add_option(
         "--space", settings->space,
         "Ranges of angle [deg], height [m], speed [m/s], mass [kg] added, throw [m/s] "
         "up, gain [N s], of a robot pitch [deg] and the motors' angles leg_1, ... [deg]; as "
         "angle=10:50,mass=0")
      ->delimiter(',')
      ->option_text("SETTING=LOW:HIGH,...")
      ->allow_extra_args(false);
  sub.add_option("--budget", settings->budget, "Designs to try (default 300)")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N");
  sub.add_option("--map", settings->map_size, "Points along each axis of the maps (default 13)")
      ->check(CLI::Range(0, 200))
      ->option_text("N");
  AddDiscrepancyOption(sub, settings->discrepancy);
  AddSeedOption(sub, settings->seed, "Of the search");
  AddRunFolderOptions(sub, *settings, "Run folder (default runs/<dataset>-design-NNN)");
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
