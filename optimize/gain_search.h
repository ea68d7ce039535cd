#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "optimize/search_point.h"

namespace hoplab {

/// Global derivative-free searches of NLopt; the default was chosen by measurement
/// (docs/decisions/0004-gain-search.md).
enum class SearchAlgorithm { kDirectL, kDirectLRandom, kCrs2, kIsres, kEsch, kRandom };
std::string_view NameOf(SearchAlgorithm algorithm);
std::optional<SearchAlgorithm> FindSearchAlgorithm(std::string_view name);
std::vector<std::string> SearchAlgorithmNames();

struct GainSearchOptions {
  SearchAlgorithm algorithm = SearchAlgorithm::kDirectL;
  int budget = 1000;  // evaluations of each seed, polishing included
  std::uint64_t seed = 1;
  int seeds = 5;  // independent searches: seed, seed + 1, ...
  int jobs = 1;   // never changes a result
  /// Share of the budget that goes to the polishing of the global search's best point.
  double polish_share = 0.3;
  const std::atomic<bool>* stop = nullptr;  // keeps what was found
  /// Called after each evaluation, from several threads but one at a time.
  std::function<void(int seed_index, int evaluation, const SearchPoint& best)> progress = nullptr;
};

/// A best point so far: after how many evaluations it was found.
struct SearchStep {
  int evaluation = 0;
  double score = 0.0;
  double objective = 0.0;  // NaN where the point has none
};

/// One search from one seed.
struct SeedResult {
  std::uint64_t seed = 0;
  SearchPoint best;
  int evaluations = 0;
  int global_evaluations = 0;       // of them before polishing
  std::vector<SearchStep> history;  // improvements, in their order
};

struct GainSearchResult {
  SearchPoint best;           // of all seeds; its spectral radius is filled in
  std::size_t best_seed = 0;  // index into `seeds`
  std::vector<SeedResult> seeds;
  int evaluations = 0;  // of all seeds
  /// Seeds whose best objective is within 1 % of the best: how sure this is the optimum.
  int agreeing = 0;
  bool interrupted = false;
};

/// Searches the box of `problem.variables`: globally for `1 - polish_share` of the budget, then
/// from the best point by Sbplx on the objective, and by BOBYQA on the spectral radius, each point
/// of which is scored as well. Ties go to the point found first.
GainSearchResult SearchGains(const SearchProblem& problem, const GainSearchOptions& options);

/// One cell of a map of the objective.
struct MapCell {
  double first = 0.0, second = 0.0;  // the two variables, in their units
  SearchPoint point;
};
/// The objective on a grid of `size` x `size` over the first two variables, the others held at
/// `at`. Row-major, the first variable slowest. With one variable: `size` points. Cells that were
/// not reached before a stop are missing at the end. `progress` is called after each, one at a
/// time.
std::vector<MapCell> MapObjective(const SearchProblem& problem, std::span<const double> at,
                                  int size, int jobs, const std::atomic<bool>* stop = nullptr,
                                  const std::function<void(int done, int of)>& progress = nullptr);

}  // namespace hoplab
