#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iterator>
#include <ostream>

#include "app/records/identify_record.h"
#include "app/records/solver_record.h"
#include "app/reports/identify_report.h"
#include "app/reports/run_folder.h"
#include "app/runs/identify_work.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/version.h"
#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

using C = StudyConstant;

struct IdentifySettings : RunSettings {
  std::string tables = "all", times = "all";
  int budget = IdentificationRequest().budget;
  int readings = IdentificationRequest().keep_readings;
  int keep = IdentificationRequest().keep;
  int keep_toe = IdentificationRequest().keep_toe;
  std::uint64_t seed = IdentificationRequest().seed;
  bool free_damping_scale = false, free_rolling_blend = false, free_toe_mass = false;
  bool free_desired_speed = false, placed_as_printed = false;
  int jobs = 0;
  SolverSettings solver{.tolerance = 1e-7};
};

// "6.1" to "6.5" with commas, or "all".
std::vector<StudyTableId> TablesOf(const std::string& text) {
  std::vector<StudyTableId> tables;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string_view word = std::string_view(text).substr(at, end - at);
    bool known = false;
    for (int i = 0; i < kStudyTableCount; ++i) {
      const auto table = static_cast<StudyTableId>(i);
      if (word != "all" && word != NameOf(table)) continue;
      tables.push_back(table);
      known = true;
    }
    if (!known)
      throw InputError({"--tables", Printable(word), "is no table of the study",
                        "Give 6.1, 6.2, 6.3, 6.4, 6.5, some of them with commas between, or all."});
    at = end + 1;
  }
  return tables;
}

// "flight,stays,last_five", or "all" but those of every instant: in stance the speed dips by more
// than the band, so that they never converge; the best fit is scored by them, too.
std::vector<ConvergenceReading> ReadingsOfTimes(const std::string& text) {
  std::vector<ConvergenceReading> readings;
  std::vector<std::string> names = {"all"};
  for (const ConvergenceReading& reading : AllConvergenceReadings()) {
    names.push_back(NameOf(reading));
    const bool in_all = reading.speed != ConvergenceReading::Speed::kInstant;
    if ((text == "all" && in_all) || text == names.back()) readings.push_back(reading);
  }
  if (!readings.empty()) return readings;
  const auto nearest = NearestWord(text, names);
  throw InputError({"--times", Printable(text), "is no reading of the times",
                    (nearest ? "Did you mean " + *nearest + "? " : std::string()) +
                        "Give one of flight, apex, hop_mean, instant; of stays, first; and of "
                        "last_five, last_hop, fixed_point; with commas between."});
}

IdentificationRequest RequestOf(const IdentifySettings& settings) {
  IdentificationRequest request;
  request.context.data = OnlyTables(PublishedStudyData(), TablesOf(settings.tables));
  request.context.convergence = ReadingsOfTimes(settings.times);
  request.context.integrator = IntegratorOptionsOf(settings.solver);
  request.readings = AllReadings();
  request.free = {C::kMass, C::kRadius, C::kBendingStiffness, C::kGain, C::kStartSpeed};
  if (!settings.placed_as_printed) request.free.push_back(C::kPlacedShare);
  if (settings.free_desired_speed) request.free.push_back(C::kDesiredSpeed);
  if (settings.free_damping_scale) request.free.push_back(C::kDampingScale);
  if (settings.free_rolling_blend) {
    request.free.push_back(C::kRollingBlend);
    At(request.fixed, C::kRollingBlend) = 0.5;
  }
  if (settings.free_toe_mass)
    request.toe_free = {C::kToeMass, C::kPlacementRate, C::kPlacementDamping};
  request.budget = settings.budget;
  request.keep_readings = settings.readings;
  request.keep = settings.keep;
  request.keep_toe = settings.keep_toe;
  request.seed = settings.seed;
  return request;
}

Json NewIdentifyRecord(const IdentifySettings& settings) {
  RecordHeader header;
  header.command = "identify";
  header.law = std::string(NameOf(Law::kThesis));
  header.seed = settings.seed;
  header.options = {{"tables", settings.tables},
                    {"times", settings.times},
                    {"budget", settings.budget},
                    {"readings", settings.readings},
                    {"keep", settings.keep},
                    {"keep_toe", settings.keep_toe},
                    {"free_damping_scale", settings.free_damping_scale},
                    {"free_rolling_blend", settings.free_rolling_blend},
                    {"free_toe_mass", settings.free_toe_mass},
                    {"free_desired_speed", settings.free_desired_speed},
                    {"placed_as_printed", settings.placed_as_printed}};
  RecordSolver(settings.solver, header.options);
  return NewRecord(header);
}

// "`hoplab identify --budget 600 --seed 1`, 2026-01-31": what a scenario says of its origin.
std::string OriginText(const IdentifySettings& settings) {
  char date[16] = "";
  const std::time_t now = std::time(nullptr);
  std::tm day{};
  if (gmtime_r(&now, &day) != nullptr) std::strftime(date, sizeof date, "%Y-%m-%d", &day);
  std::string text = "`hoplab identify --tables " + settings.tables + " --times " + settings.times +
                     " --budget " + std::to_string(settings.budget) + " --readings " +
                     std::to_string(settings.readings) + " --keep " +
                     std::to_string(settings.keep) + " --seed " + std::to_string(settings.seed);
  const auto add = [&](bool given, const char* flag) { text += given ? flag : ""; };
  add(settings.free_damping_scale, " --free-damping-scale");
  add(settings.free_rolling_blend, " --free-rolling-blend");
  if (settings.free_toe_mass)
    text += " --free-toe-mass --keep-toe " + std::to_string(settings.keep_toe);
  add(settings.free_desired_speed, " --free-desired-speed");
  add(settings.placed_as_printed, " --placed-as-printed");
  return text + "`, " + date;
}

std::string TextOfFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::map<std::string, std::string> FilesOf(const IdentifySettings& settings,
                                           const IdentificationResult& result, const Json& record,
                                           const FitJournal& journal) {
  std::map<std::string, std::string> files = IdentificationTables(result);
  files["run.json"] = TextOf(record);
  files["fits.txt"] = TextOfFile(journal.lines().file());
  if (!result.by_all.empty() && !std::isnan(result.by_all.front().fit.misfit))
    files["published.yaml"] =
        ScenarioText(result.by_all.front().fit, "published", OriginText(settings));
  if (!result.by_energy.empty() && !std::isnan(result.by_energy.front().misfit))
    files["published-energy.yaml"] =
        ScenarioText(result.by_energy.front(), "published-energy", OriginText(settings));
  return files;
}

ExitCode Lead(const IdentifySettings& settings, Console& console, MpiJob* job) {
  const auto begin = std::chrono::steady_clock::now();
  const InterruptGuard interrupt;
  IdentificationRequest request = RequestOf(settings);
  const RunFolder folder(RunFolderOptionsOf(settings), "published", "identify");
  FitJournal journal(folder.Partial(), request.context, ProjectVersion(), settings.force);
  request.context.stop = interrupt.flag();
  Progress progress(console, settings.quiet);
  IdentificationResult result;
  {
    IdentifyWork work(request.context, journal,
                      {.jobs = JobsOf(settings.jobs), .job = job, .stop = interrupt.flag()},
                      progress, console);
    result = Identify(request, work.Fits());
  }
  progress.Clear();

  Json record = NewIdentifyRecord(settings);
  AddIdentification(request, result, record);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  if (result.interrupted) {
    const std::string message = "interrupted; " + std::to_string(journal.size()) +
                                " fits are kept in " + journal.lines().file().string() +
                                ", the same command computes the others";
    SetFailed(record, message);
    if (settings.json) console.out << TextOf(record);
    console.err << "hoplab identify: " << message << '\n';
    return ExitCode::kInterrupted;
  }
  const std::string written = folder.Write(FilesOf(settings, result, record, journal)).string();
  journal.Remove();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << IdentifyReport(request, result, console.out_colours) << "  run folder  "
                << written << '\n';
  }
  return ExitCode::kDone;
}

// A rank other than 0: says nothing, rank 0 tells what is wrong with the settings.
ExitCode Follow(const IdentifySettings& settings, MpiJob& job) {
  try {
    const IdentificationRequest request = RequestOf(settings);
    FollowIdentification(request.context, job);
    return ExitCode::kDone;
  } catch (const InputError&) {
    return ExitCode::kDone;
  }
}

ExitCode RunIdentify(const IdentifySettings& settings, Console& console) {
  if (!MpiJob::Launched()) return Lead(settings, console, nullptr);
  MpiJob job;
  return job.rank() == 0 ? Lead(settings, console, &job) : Follow(settings, job);
}

void AddIdentify(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<IdentifySettings>();
  sub.add_option("--tables", settings->tables, "6.1 to 6.5 with commas between, or all (default)")
      ->option_text("LIST");
  sub.add_option("--times", settings->times, "Reading of the times, as flight,stays,last_five")
      ->option_text("READING");
  sub.add_option("--budget", settings->budget, "Evaluations of a search (default 3000)")
      ->check(CLI::Range(20, 10000000))
      ->option_text("N");
  sub.add_option("--readings", settings->readings,
                 "Readings that go on from table 6.5 (default 192, all)")
      ->check(CLI::Range(1, 192))
      ->option_text("N");
  sub.add_option("--keep", settings->keep, "Fits that go on to all tables (default 24)")
      ->check(CLI::Range(1, 10000))
      ->option_text("N");
  sub.add_flag("--free-toe-mass", settings->free_toe_mass,
               "Search a mass at the toe and its placement, too");
  sub.add_option("--keep-toe", settings->keep_toe,
                 "Fits that go on to a mass at the toe (default 3)")
      ->check(CLI::Range(1, 10000))
      ->option_text("N");
  sub.add_flag("--placed-as-printed", settings->placed_as_printed,
               "All landings at the printed angle, no share searched");
  sub.add_flag("--free-desired-speed", settings->free_desired_speed,
               "Search the desired speed, too (printed: 1.8 m/s)");
  sub.add_flag("--free-damping-scale", settings->free_damping_scale,
               "Search a factor on the printed damping, too");
  sub.add_flag("--free-rolling-blend", settings->free_rolling_blend,
               "Search the share of the arc laid down, too (M27)");
  AddSeedOption(sub, settings->seed, "Of the searches");
  AddJobsOption(sub, settings->jobs, "; one a rank under mpirun");
  AddSolverOptions(sub, settings->solver);
  AddRunFolderOptions(
      sub, *settings, "Run folder (default runs/published-identify-NNN)",
      "Replace the run that stands in the run folder, begin an interrupted one anew");
  OnParsed(sub, invocation, settings, RunIdentify);
}

}  // namespace

namespace commands {
extern constexpr Command identify = {
    .place = 120,
    .name = "identify",
    .what = "Find what the published study does not print, from its tables",
    .footer =
        "An interrupted run goes on where it was: start the same command again.\n"
        "Examples:\n"
        "  hoplab identify --tables 6.5 --budget 40\n"
        "  hoplab identify --budget 2000 --free-damping-scale --out constants\n"
        "  mpirun -n 4 hoplab identify --tables all --free-toe-mass",
    .add = AddIdentify};
}  // namespace commands
}  // namespace hoplab
