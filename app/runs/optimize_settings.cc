#include "app/runs/optimize_settings.h"

#include <cmath>

#include "app/terminal/help_text.h"
#include "app/terminal/usage_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

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

}  // namespace

void AddOptimizeOptions(CLI::App& sub, OptimizeSettings& settings) {
  AddScenarioOptions(sub, settings.scenario);
  sub.add_option("--over", settings.over,
                 "What to search of search.over, or with a range, as theta_td,kp=0.5:12")
      ->delimiter(',')
      ->option_text("NAME[=LOW:HIGH],...")
      ->allow_extra_args(false);
  sub.add_option("--algorithm", settings.algorithm,
                 "Global search (default " + settings.algorithm + ")")
      ->check(OneOf(SearchAlgorithmNames()))
      ->option_text("NAME");
  sub.add_option("--budget", settings.budget,
                 "Evaluations of each seed (default: the scenario's, else 1000)")
      ->check(CLI::Range(10, 100000000))
      ->option_text("N");
  sub.add_option("--seeds", settings.seeds, "Independent searches (default 5)")
      ->check(CLI::Range(1, 10000))
      ->option_text("N");
  AddSeedOption(sub, settings.seed, "Of the first search");
  sub.add_option("--weight", settings.weight,
                 "Of the spectral radius where the objective is weighted (default 0.5)")
      ->check(NumberIn(0.0, 1.0))
      ->option_text("NUMBER");
  sub.add_option("--map", settings.map_size,
                 "Points a side of the objective's map; 0: none (default 25)")
      ->check(CLI::Range(0, 1000))
      ->option_text("N");
  AddJobsOption(sub, settings.jobs);
  AddSolverOptions(sub, settings.solver);
  AddRunFolderOptions(sub, settings, "Run folder (default runs/<scenario>-optimize-NNN)");
}

std::vector<OverOption> OverOptionsOf(const OptimizeSettings& settings) {
  std::vector<OverOption> over;
  for (const std::string& text : settings.over) over.push_back(ParseOver(text));
  return over;
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

}  // namespace hoplab
