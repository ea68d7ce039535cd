#include "app/commands/identify.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <ostream>

#include "app/identify_record.h"
#include "app/interrupt.h"
#include "app/problem_settings.h"
#include "app/progress.h"
#include "app/run_folder.h"
#include "app/run_settings.h"

namespace hoplab {
namespace {

struct IdentifySettings : RunSettings {
  int budget = IdentificationRequest().budget;
  int keep = IdentificationRequest().keep;
  std::uint64_t seed = IdentificationRequest().seed;
  bool free_damping_scale = false, free_rolling_blend = false, free_toe_mass = false;
  int jobs = 0;
  SolverSettings solver;
};

IdentificationRequest RequestOf(const IdentifySettings& settings) {
  IdentificationRequest request;
  request.data = PublishedStudyData();
  request.readings = AllReadings();
  if (settings.free_toe_mass) {
    std::erase_if(request.readings, [](const StudyReading& reading) {
      return reading.liftoff != LiftoffRule::kZeroForce;
    });
  }
  for (int i = 0; i < kStudyConstantCount; ++i) {
    const auto c = static_cast<StudyConstant>(i);
    if (c == StudyConstant::kDampingScale && !settings.free_damping_scale) continue;
    if (c == StudyConstant::kRollingBlend && !settings.free_rolling_blend) continue;
    if (c == StudyConstant::kToeMass && !settings.free_toe_mass) continue;
    request.free.push_back(c);
  }
  At(request.fixed, StudyConstant::kGain) = 1.0;
  At(request.fixed, StudyConstant::kDampingScale) = 1.0;
  request.budget = settings.budget;
  request.keep = settings.keep;
  request.seed = settings.seed;
  request.jobs = JobsOf(settings.jobs);
  request.integrator = IntegratorOptionsOf(settings.solver);
  return request;
}

Json NewIdentifyRecord(const IdentifySettings& settings) {
  RecordHeader header;
  header.command = "identify";
  header.law = std::string(NameOf(Law::kThesis));
  header.seed = settings.seed;
  header.options = {{"budget", settings.budget},
                    {"keep", settings.keep},
                    {"free_damping_scale", settings.free_damping_scale},
                    {"free_rolling_blend", settings.free_rolling_blend},
                    {"free_toe_mass", settings.free_toe_mass}};
  RecordSolver(settings.solver, header.options);
  return NewRecord(header);
}

// "`hoplab identify --budget 600 --seed 1`, 2026-01-31": what a scenario says of its origin.
std::string OriginText(const IdentifySettings& settings) {
  char date[16] = "";
  const std::time_t now = std::time(nullptr);
  std::tm day{};
  if (gmtime_r(&now, &day) != nullptr) std::strftime(date, sizeof date, "%Y-%m-%d", &day);
  return "`hoplab identify --budget " + std::to_string(settings.budget) + " --keep " +
         std::to_string(settings.keep) + " --seed " + std::to_string(settings.seed) +
         (settings.free_damping_scale ? " --free-damping-scale" : "") +
         (settings.free_rolling_blend ? " --free-rolling-blend" : "") +
         (settings.free_toe_mass ? " --free-toe-mass" : "") + "`, " + date;
}

ExitCode RunIdentify(const IdentifySettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  const RunFolder folder(RunFolderOptionsOf(settings), "published", "identify");
  IdentificationRequest request = RequestOf(settings);
  const InterruptGuard interrupt;
  Progress progress(console, settings.quiet);
  request.stop = interrupt.flag();
  std::string stage_shown;
  request.progress = [&](const std::string& stage, int done, int of) {
    if (stage != stage_shown) progress.Stage(stage_shown = stage);
    progress.Step(stage + ": " + std::to_string(done) + " of " + std::to_string(of) + " readings",
                  done, of);
  };
  const IdentificationResult result = Identify(request);
  progress.Clear();

  const StudyFit& fit = result.by_all.front().fit;
  const StudyHopper best{fit.reading, fit.constants, request.integrator};
  Json record = NewIdentifyRecord(settings);
  AddIdentification(request, result, record);
  if (result.interrupted)
    SetFailed(record, "interrupted; the result is the best of what was tried");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  std::map<std::string, std::string> files = {{"run.json", TextOf(record)},
                                              {"readings.csv", ReadingsTable(result)}};
  if (!std::isnan(fit.misfit)) {
    files["numbers.csv"] = NumbersTable(best, request.data);
    files["published.yaml"] = ScenarioText(best, OriginText(settings));
  }
  const std::string written = folder.Write(files).string();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << IdentifyReport(request, result, console.out_colours) << "  run folder  "
                << written << '\n';
  }
  if (!result.interrupted) return ExitCode::kDone;
  console.err << "kept: " << written << '\n';
  return ExitCode::kInterrupted;
}

}  // namespace

void AddIdentifyCommand(CLI::App& app, Invocation& invocation) {
  auto settings = std::make_shared<IdentifySettings>();
  CLI::App& sub = *app.add_subcommand(
      "identify", "Find what the published study does not print, from its tables");
  sub.add_option("--budget", settings->budget,
                 "Evaluations of each reading in each stage (default 600)")
      ->check(CLI::Range(20, 10000000))
      ->option_text("N");
  sub.add_option("--keep", settings->keep,
                 "Families of readings that go on from table 6.5 to the others (default 32, all)")
      ->check(CLI::Range(1, 32))
      ->option_text("N");
  sub.add_flag("--free-damping-scale", settings->free_damping_scale,
               "Search a factor on the printed damping coefficients, too (default: 1)");
  sub.add_flag("--free-rolling-blend", settings->free_rolling_blend,
               "Search the share of the arc laid down in the rolling (effect rolling_law), too");
  sub.add_flag("--free-toe-mass", settings->free_toe_mass,
               "Search a mass at the toe, too; lift-off by force only then");
  AddSeedOption(sub, settings->seed, "Of the searches");
  AddJobsOption(sub, settings->jobs);
  AddSolverOptions(sub, settings->solver);
  AddRunFolderOptions(sub, *settings, "Run folder (default runs/published-identify-NNN)");
  sub.footer(
      "Examples:\n"
      "  hoplab identify --budget 20 --keep 1\n"
      "  hoplab identify --budget 2000 --free-damping-scale --out constants");
  OnParsed(sub, invocation, settings, RunIdentify);
}

}  // namespace hoplab
