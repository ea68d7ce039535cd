#include <chrono>
#include <cmath>
#include <ostream>

#include "app/records/optimize_record.h"
#include "app/records/solver_record.h"
#include "app/reports/run_folder.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/help_text.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/terminal/quantity.h"
#include "app/terminal/usage_error.h"
#include "base/input_error.h"
#include "base/text.h"
#include "experiments/scenario_hopper.h"
#include "experiments/scenario_search.h"

namespace hoplab {
namespace {

struct OptimizeSettings : RunSettings {
  ScenarioSettings scenario;
  std::vector<std::string> over;
  std::string algorithm{NameOf(GainSearchOptions().algorithm)};
  std::optional<int> budget;
  std::uint64_t seed = GainSearchOptions().seed;
  int seeds = GainSearchOptions().seeds;
  double weight = SearchProblem().weight;
  int map_size = 25;
  int jobs = 0;
  SolverSettings solver;
};

OverOption ParseOver(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name(Trim(text.substr(0, equals)));
  if (equals == text.npos && !name.empty()) return {name, {}, {}};
  const std::size_t colon = text.find(':', equals == text.npos ? 0 : equals);
  if (!name.empty() && colon != text.npos) {
    const auto low = ParseDouble(Trim(text.substr(equals + 1, colon - equals - 1)));
    const auto high = ParseDouble(Trim(text.substr(colon + 1)));
    if (low && high && std::isfinite(*low) && std::isfinite(*high) && *low < *high)
      return {name, low, high};
  }
  throw UsageError("--over: " + Printable(text) +
                   "; must be a name, or name=low:high with low below high, as kp=0.5:12");
}

GainSearchOptions SearchOptionsOf(const OptimizeSettings& settings, const Scenario& scenario) {
  GainSearchOptions options;
  options.algorithm = *FindSearchAlgorithm(settings.algorithm);
  if (scenario.search && scenario.search->budget) options.budget = *scenario.search->budget;
  if (settings.budget) options.budget = *settings.budget;
  options.seed = settings.seed;
  options.seeds = settings.seeds;
  options.jobs = JobsOf(settings.jobs);
  return options;
}

// The scenario's own value of a variable that is a plain number of it.
double OwnValue(const Scenario& scenario, const ScenarioDocument& document,
                const SearchVariable& variable) {
  const std::optional<double> value = document.NumberAt(variable.name);
  if (value) return *value;
  throw InputError({scenario.origin.place, variable.name, "has no value in the scenario",
                    "State one: the search is compared with it."});
}

Json NewOptimizeRecord(const OptimizeSettings& settings, const Scenario& scenario, Law law,
                       const OptimizeRun& run) {
  RecordHeader header;
  header.command = "optimize";
  header.law = std::string(NameOf(law));
  header.variant = scenario.mechanism.variant;
  header.seed = settings.seed;
  Json over = Json::object();
  for (const SearchVariable& v : run.problem.variables) over[v.name] = {v.low, v.high};
  header.options = {{"scenario", settings.scenario.scenario},
                    {"set", settings.scenario.set},
                    {"with", settings.scenario.with},
                    {"over", over},
                    {"algorithm", settings.algorithm},
                    {"budget", run.options.budget},
                    {"seeds", settings.seeds},
                    {"weight", settings.weight},
                    {"map", settings.map_size}};
  RecordSolver(settings.solver, header.options);
  Json record = NewRecord(header);
  record["scenario"] = scenario.name;
  return record;
}

void Assess(OptimizeRun& run, const OptimizeSettings& settings, Progress& progress) {
  progress.Stage("trying out the best point");
  RobustnessOptions robustness;
  robustness.seed = settings.seed;
  robustness.jobs = run.options.jobs;
  run.before_robustness = AssessRobustness(run.problem.hopper_at(run.scenario_x), robustness);
  run.before_gait = SteadyHop(run.problem.hopper_at(run.scenario_x));
  if (!run.has_result()) return;
  run.best_gait = SteadyHop(run.problem.hopper_at(run.result.best.x));
  run.best_robustness = AssessRobustness(run.problem.hopper_at(run.result.best.x), robustness);
  if (settings.map_size == 0 || run.result.interrupted) return;
  progress.Stage("mapping the objective");
  run.map = MapObjective(run.problem, run.result.best.x, settings.map_size, run.options.jobs,
                         run.options.stop, [&](int done, int of) {
                           progress.Step("mapping the objective: " + std::to_string(done) + " of " +
                                             std::to_string(of) + " points",
                                         done, of);
                         });
}

ExitCode RunOptimizeCommand(const OptimizeSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<OverOption> over;
  for (const std::string& text : settings.over) over.push_back(ParseOver(text));
  const ScenarioDocument document = ScenarioDocumentOf(settings.scenario);
  const Scenario scenario = document.Read();
  const RunFolder folder(RunFolderOptionsOf(settings), scenario.name, "optimize");
  OptimizeRun run;
  run.problem =
      SearchProblemOfScenario(document, scenario, over, IntegratorOptionsOf(settings.solver));
  run.problem.weight = settings.weight;
  run.options = SearchOptionsOf(settings, scenario);
  for (const SearchVariable& variable : run.problem.variables)
    run.scenario_x.push_back(OwnValue(scenario, document, variable));

  const InterruptGuard interrupt;
  Progress progress(console, settings.quiet);
  run.options.stop = interrupt.flag();
  progress.Stage("searching");
  const long most = static_cast<long>(run.options.budget) * run.options.seeds;
  long evaluations = 0;
  run.options.progress = [&](int seed, int evaluation, const SearchPoint& best) {
    progress.Step("searching: seed " + std::to_string(seed + 1) + ", evaluation " +
                      std::to_string(evaluation) + ", best " +
                      (std::isnan(best.objective) ? std::string(NameOf(best.verdict))
                                                  : Significant(best.objective, 5)),
                  ++evaluations, most);
  };
  run.before = EvaluatePoint(run.problem, run.scenario_x);
  if (std::isnan(run.before.spectral_radius))
    run.before.spectral_radius = SteadyHop(run.problem.hopper_at(run.scenario_x)).spectral_radius;
  run.result = SearchGains(run.problem, run.options);
  Assess(run, settings, progress);
  progress.Clear();

  const Law law = run.problem.hopper_at(run.scenario_x).request.law;
  Json record = NewOptimizeRecord(settings, scenario, law, run);
  AddOptimize(run, record);
  const std::string failure = run.Failure();
  if (!failure.empty()) SetFailed(record, failure);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  std::map<std::string, std::string> files = {{"run.json", TextOf(record)},
                                              {"history.csv", HistoryTable(run)},
                                              {"cycles.csv", CyclesTable(run)}};
  if (!run.map.empty()) files["map.csv"] = MapTable(run);
  const std::string written = folder.Write(files).string();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << OptimizeReport(scenario.name, run, console.out_colours) << "  run folder     "
                << written << '\n';
  }
  if (!failure.empty()) console.err << "hoplab optimize: " << failure << '\n';
  if (run.result.interrupted) {
    console.err << "kept: " << written << '\n';
    return ExitCode::kInterrupted;
  }
  return failure.empty() ? ExitCode::kDone : ExitCode::kNoResult;
}

void AddOptimize(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<OptimizeSettings>();
  AddScenarioOptions(sub, settings->scenario);
  sub.add_option("--over", settings->over,
                 "What to search of search.over, or with a range, as theta_td,kp=0.5:12")
      ->delimiter(',')
      ->option_text("NAME[=LOW:HIGH],...")
      ->allow_extra_args(false);
  sub.add_option("--algorithm", settings->algorithm,
                 "Global search (default " + settings->algorithm + ")")
      ->check(OneOf(SearchAlgorithmNames()))
      ->option_text("NAME");
  sub.add_option("--budget", settings->budget,
                 "Evaluations of each seed (default: the scenario's, else 1000)")
      ->check(CLI::Range(10, 100000000))
      ->option_text("N");
  sub.add_option("--seeds", settings->seeds, "Independent searches (default 5)")
      ->check(CLI::Range(1, 10000))
      ->option_text("N");
  AddSeedOption(sub, settings->seed, "Of the first search");
  sub.add_option("--weight", settings->weight,
                 "Of the spectral radius where the objective is weighted (default 0.5)")
      ->check(CLI::Range(0.0, 1.0))
      ->option_text("NUMBER");
  sub.add_option("--map", settings->map_size,
                 "Points a side of the objective's map; 0: none (default 25)")
      ->check(CLI::Range(0, 1000))
      ->option_text("N");
  AddJobsOption(sub, settings->jobs);
  AddSolverOptions(sub, settings->solver);
  AddRunFolderOptions(sub, *settings, "Run folder (default runs/<scenario>-optimize-NNN)");
  OnParsed(sub, invocation, settings, RunOptimizeCommand);
}

}  // namespace

namespace commands {
extern constexpr Command optimize = {
    .place = 90,
    .name = "optimize",
    .what = "Search the gains of a scenario that settle soonest",
    .footer =
        "Examples:\n"
        "  hoplab optimize experiments/fastest-convergence.yaml --budget 20\n"
        "  hoplab optimize experiments/fastest-convergence.yaml --over kp,v_des=1:3\n"
        "  hoplab optimize hopping.yaml --algorithm crs2 --seeds 10 --json",
    .add = AddOptimize};
}  // namespace commands
}  // namespace hoplab
