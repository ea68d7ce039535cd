#include "app/runs/optimize_run.h"

#include <atomic>
#include <cmath>

#include "app/terminal/quantity.h"
#include "base/input_error.h"
#include "experiments/scenario_hopper.h"
#include "experiments/scenario_search.h"

namespace hoplab {
namespace {

// The scenario's own value of a variable that is a plain number of it.
double OwnValue(const Scenario& scenario, const ScenarioDocument& document,
                const SearchVariable& variable) {
  const std::optional<double> value = document.NumberAt(variable.name);
  if (value) return *value;
  throw InputError({scenario.origin.place, variable.name, "has no value in the scenario",
                    "State one: the search is compared with it."});
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

}  // namespace

bool OptimizeRun::has_result() const {
  return !result.best.x.empty() && result.best.verdict <= PointVerdict::kWideBand;
}

std::string OptimizeRun::Failure() const {
  if (result.interrupted)
    return has_result() ? "interrupted; the result is the best of what was tried"
                        : "interrupted; nothing that converges had been found";
  if (!has_result())
    return "no point that converges within the constraints was found in " +
           std::to_string(result.evaluations) + " evaluations; widen search.over or loosen " +
           "search.constraints";
  return "";
}

OptimizeRun PrepareOptimize(const OptimizeSettings& settings, const std::vector<OverOption>& over,
                            const ScenarioDocument& document, const Scenario& scenario) {
  OptimizeRun run;
  run.problem =
      SearchProblemOfScenario(document, scenario, over, IntegratorOptionsOf(settings.solver));
  run.problem.weight = settings.weight;
  run.options = SearchOptionsOf(settings, scenario);
  for (const SearchVariable& variable : run.problem.variables)
    run.scenario_x.push_back(OwnValue(scenario, document, variable));
  return run;
}

void RunOptimize(const OptimizeSettings& settings, const std::atomic<bool>* stop,
                 Progress& progress, OptimizeRun& run) {
  run.options.stop = stop;
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
  run.options.progress = nullptr;
  Assess(run, settings, progress);
}

}  // namespace hoplab
