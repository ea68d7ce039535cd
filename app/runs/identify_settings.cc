#include "app/runs/identify_settings.h"

#include <algorithm>
#include <ctime>

#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

using C = StudyConstant;

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

}  // namespace

void AddIdentifyOptions(CLI::App& sub, IdentifySettings& settings) {
  sub.add_option("--tables", settings.tables, "6.1 to 6.5 with commas between, or all (default)")
      ->option_text("LIST");
  sub.add_option("--times", settings.times, "Reading of the times, as flight,stays,last_five")
      ->option_text("READING");
  sub.add_option("--budget", settings.budget, "Evaluations of a search (default 3000)")
      ->check(CLI::Range(20, 10000000))
      ->option_text("N");
  sub.add_option("--readings", settings.readings,
                 "Readings that go on from table 6.5 (default 192, all)")
      ->check(CLI::Range(1, 192))
      ->option_text("N");
  sub.add_option("--keep", settings.keep, "Fits that go on to all tables (default 24)")
      ->check(CLI::Range(1, 10000))
      ->option_text("N");
  sub.add_flag("--free-toe-mass", settings.free_toe_mass,
               "Search a mass at the toe and its placement, too");
  sub.add_option("--keep-toe", settings.keep_toe,
                 "Fits that go on to a mass at the toe (default 3)")
      ->check(CLI::Range(1, 10000))
      ->option_text("N");
  sub.add_option("--toe-budget", settings.toe_budget,
                 "Evaluations of a search with it from scratch (default: none such)")
      ->check(CLI::Range(20, 10000000))
      ->option_text("N");
  sub.add_flag("--placed-as-printed", settings.placed_as_printed,
               "All landings at the printed angle, no share searched");
  sub.add_flag("--free-desired-speed", settings.free_desired_speed,
               "Search the desired speed, too (printed: 1.8 m/s)");
  sub.add_flag("--free-damping-scale", settings.free_damping_scale,
               "Search a factor on the printed damping, too");
  sub.add_flag("--free-rolling-blend", settings.free_rolling_blend,
               "Search the share of the arc laid down, too (M27)");
  AddSeedOption(sub, settings.seed, "Of the searches");
  AddJobsOption(sub, settings.jobs, "; one a rank under mpirun");
  AddSolverOptions(sub, settings.solver);
  AddRunFolderOptions(
      sub, settings, "Run folder (default runs/published-identify-NNN)",
      "Replace the run that stands in the run folder, begin an interrupted one anew");
}

IdentificationRequest IdentificationRequestOf(const IdentifySettings& settings) {
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
  request.toe_budget = settings.toe_budget;
  request.seed = settings.seed;
  return request;
}

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
  if (settings.free_toe_mass && settings.toe_budget > 0)
    text += " --toe-budget " + std::to_string(settings.toe_budget);
  add(settings.free_desired_speed, " --free-desired-speed");
  add(settings.placed_as_printed, " --placed-as-printed");
  const SolverSettings usual = IdentifySettings().solver;
  if (settings.solver.integrator != usual.integrator)
    text += " --integrator " + settings.solver.integrator;
  if (settings.solver.tolerance != usual.tolerance)
    text += " --tolerance " + FormatDouble(settings.solver.tolerance);
  return text + "`, " + date;
}

}  // namespace hoplab
