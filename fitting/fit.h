#pragma once

#include <cstdint>
#include <optional>

#include "fitting/discrepancy/estimate_discrepancy.h"
#include "fitting/solve.h"
#include "fitting/stop_check.h"

namespace hoplab {

/// How a fit gets from its nominal start to the basin of the raw-time optimum. Measured in
/// docs/decisions/0003-convergence.md.
enum class FitStrategy {
  kRaw,             // all rows at once, from the nominal values
  kGrowingHorizon,  // the first rows, then more and more of them
  kApexShooting     // hops one by one from the apexes the data show, then all rows (default)
};
std::string_view NameOf(FitStrategy strategy);
std::optional<FitStrategy> FindStrategy(std::string_view name);

/// What a fit takes the noise for.
enum class Discrepancy {
  kNone,   // white, of the channels' sigma
  kMatern  // white, and a model discrepancy where one pays (NoiseModel; default)
};
std::string_view NameOf(Discrepancy discrepancy);
std::optional<Discrepancy> FindDiscrepancy(std::string_view name);

struct FitOptions {
  FitStrategy strategy = FitStrategy::kApexShooting;
  int restarts = 1;  // the nominal one, then scattered ones; thresholds add theirs
  std::uint64_t seed = 1;
  Loss loss;
  int jobs = 1;
  int max_iterations = 100;
  /// Of FitTraces and what is built on it; Fit itself takes the problem's noise as it is.
  Discrepancy discrepancy = Discrepancy::kMatern;
  const std::atomic<bool>* stop = nullptr;
  bool IsStopped() const { return stop && *stop; }
  /// Called as the search goes on: which start, what it does, its cost (NaN if not known).
  std::function<void(int start, std::string_view stage, int iteration, double cost)> progress =
      nullptr;
};

/// One start of the search and where it led.
struct StartRecord {
  Eigen::VectorXd from;    // shared values it began with
  Eigen::VectorXd hops;    // what single hops made of them (kApexShooting); else empty
  Eigen::VectorXd shared;  // where it ended
  double cost = 0.0;       // NaN if it led nowhere
  bool complete = false;   // every simulation reaches the end of its data there
  SolveStatus status = SolveStatus::kFailed;
  std::string message;
  int iterations = 0;
  std::map<std::string, int> rejected;
};

struct FitResult {
  /// Values were found that let something be simulated; false: see `message`.
  bool ok = false;
  bool interrupted = false;
  std::string message;
  Eigen::VectorXd shared;                 // own units
  std::vector<OwnValues> initial_states;  // of the train trials, in their order
  double cost = 0.0;                      // half the sum of squared residuals, prior included
  std::vector<StartRecord> records;
  int best_start = -1;
  /// Discrepancy found beside the values; absent: not looked for.
  std::optional<DiscrepancyEstimate> discrepancy;
  /// Whether they lie at a minimum: else they are no result.
  StopCheck stop;
};

/// The train trials of a problem.
std::vector<TrialProblem> TrialsOf(const FitProblem& problem, TrialRole role);

/// Fits the train trials.
FitResult Fit(const FitProblem& problem, const FitOptions& options);

/// Fits from given shared values instead of the nominal ones.
StartRecord FitFrom(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                    const Eigen::VectorXd& shared, const FitOptions& options, int start_number,
                    std::vector<OwnValues>* initial_states);

}  // namespace hoplab
