#include <chrono>
#include <ostream>

#include "app/export/discovered_code.h"
#include "app/records/discovery_record.h"
#include "app/reports/discovery_report.h"
#include "app/reports/run_folder.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/help_text.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/terminal/report_text.h"
#include "base/text.h"
#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

struct DiscoverSettings : RunSettings {
  ProblemSettings problem;
  std::uint64_t seed = 1;
  std::string span = "whole_else_hops";
  std::string discrepancy = "matern";
  bool code = false;
};

DiagnosisOptions OptionsOf(const DiscoverSettings& settings) {
  DiagnosisOptions options;
  options.problem = ProblemOptionsOf(settings.problem);
  options.fit.seed = settings.seed;
  options.fit.jobs = JobsOf(settings.problem.jobs);
  options.fit.discrepancy = *FindDiscrepancy(settings.discrepancy);
  options.span = *FindSpan(settings.span);
  return options;
}

ExitCode RunDiscover(const DiscoverSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  DiagnosisOptions options = OptionsOf(settings);
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const RunFolder folder(RunFolderOptionsOf(settings), dataset.name, "discover");

  const InterruptGuard interrupt;
  Progress progress(console, settings.quiet);
  options.fit.stop = interrupt.flag();
  options.stage = [&](std::string_view stage) { progress.Stage(std::string(stage)); };
  options.step = [&](const std::string& text, int done, int of) { progress.Step(text, done, of); };
  const Discovery found = Discover(dataset, options);
  progress.Clear();

  Json record = DiscoveryRecord(dataset, settings.problem.dataset, options, found);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  std::map<std::string, std::string> files = DiscoveryFiles(found);
  if (settings.code) files.merge(DiscoveryCode(found));
  files["run.json"] = TextOf(record);
  const std::string kept = folder.Write(files).string();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << Styled(Printable(dataset.name, 100), Emphasis::kBold, console.out_colours)
                << "\n\n";
    for (const std::string& note : found.base.notes)
      console.out << Labelled("note", note, console.out_colours);
    console.out << DiscoveryReport(found, console.out_colours)
                << (settings.code ? CodeReport(found, console.out_colours) : "")
                << Styled("\n  run folder   ", Emphasis::kFaint, console.out_colours) << kept
                << '\n';
  }
  const std::string failure = FailureOf(found);
  if (!failure.empty()) console.err << "hoplab discover: " << failure << '\n';
  if (found.base.interrupted) return ExitCode::kInterrupted;
  return failure.empty() ? ExitCode::kDone : ExitCode::kNoResult;
}

void AddDiscover(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<DiscoverSettings>();
  AddProblemOptions(sub, settings->problem);
  AddDiscrepancyOption(sub, settings->discrepancy);
  AddSeedOption(sub, settings->seed, "Of noise draws, resamples and bootstraps");
  sub.add_option("--span", settings->span,
                 "whole traces, else single hops where a law falls (default), whole or hops")
      ->check(OneOf({"whole_else_hops", "whole", "hops"}))
      ->option_text("NAME");
  sub.add_flag("--code", settings->code, "Also write what is found as a C++ effect");
  AddRunFolderOptions(sub, *settings, "Run folder (default runs/<dataset>-discover-NNN)");
  OnParsed(sub, invocation, settings, RunDiscover);
}

}  // namespace

namespace commands {
extern constexpr Command discover = {
    .place = 50,
    .name = "discover",
    .what = "Look for a formula of what the simulation lacks and no listed cause explains",
    .footer =
        "Examples:\n"
        "  hoplab discover datasets/rig-drops --law large_deflection\n"
        "  hoplab discover my-hops --with air_drag --jobs 4\n"
        "  hoplab fit my-hops --with runs/my-hops-discover-001/discovered.yaml",
    .add = AddDiscover};
}  // namespace commands
}  // namespace hoplab
