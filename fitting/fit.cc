#include "fitting/fit.h"

#include <algorithm>
#include <cmath>

#include "base/nan.h"
#include "base/parallel.h"
#include "base/random.h"
#include "fitting/apex_segments.h"
#include "fitting/carried_trials.h"
#include "fitting/following_start.h"
#include "fitting/growing_horizon.h"
#include "fitting/threshold.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

// Relative change of the cost that ends a search for where another begins.
constexpr double kBeginning = 1e-6;

std::vector<OwnValues> InitialStatesOf(const std::vector<TrialProblem>& trials) {
  std::vector<OwnValues> initial_states;
  for (const TrialProblem& t : trials) initial_states.push_back(t.start);
  return initial_states;
}

SolveRequest RequestFor(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                        const FitOptions& options, int start_number, std::string_view stage) {
  SolveRequest request;
  request.problem = &problem;
  request.trials = &trials;
  request.initial_states = InitialStatesOf(trials);
  request.loss = options.loss;
  request.max_iterations = options.max_iterations;
  request.jobs = options.jobs;
  request.stop = options.stop;
  if (options.progress) {
    request.progress = [&options, start_number, stage](int iteration, double cost) {
      options.progress(start_number, stage, iteration, cost);
    };
  }
  return request;
}

// Costs of all trials at given shared values, initial states as they are; NaN where a simulation
// ends before its data.
std::vector<double> CostsAt(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                            const Eigen::VectorXd& shared, int jobs) {
  std::vector<double> costs(trials.size());
  ParallelFor(static_cast<int>(trials.size()), jobs, [&](int i) {
    const TrialEvaluator evaluator(problem, trials[i]);
    TrialEvaluation e;
    evaluator.Evaluate({shared, trials[i].start, false}, e);
    costs[i] = e.complete ? 0.5 * e.residuals.squaredNorm() : kNaN;
  });
  return costs;
}

// ---- apex shooting ------------------------------------------------------------------------

// Where to begin on the pieces: the given values, and the first shared value (the stiffness of the
// leg, by the order of ParametersOf) scaled over a coarse ladder; the rung with the most complete
// pieces, then the least cost. A hop is one bend of one valley: a rung every 25 % finds it.
Eigen::VectorXd BestRung(const FitProblem& problem, const std::vector<TrialProblem>& pieces,
                         const Eigen::VectorXd& shared, int jobs) {
  constexpr int kRungs = 8;
  constexpr double kRatio = 1.25;
  Eigen::VectorXd best = shared;
  long best_complete = -1;
  double best_cost = 0.0;
  for (int i = 0; i <= 2 * kRungs; ++i) {
    // 0, +1, -1, +2, -2, ...: the given value wins ties.
    const int rung = i % 2 == 1 ? (i + 1) / 2 : -i / 2;
    Eigen::VectorXd trial = shared;
    trial[0] = std::clamp(shared[0] * std::pow(kRatio, rung), problem.shared[0].lower,
                          problem.shared[0].upper);
    const std::vector<double> costs = CostsAt(problem, pieces, trial, jobs);
    long complete = 0;
    double cost = 0.0;
    for (double c : costs) {
      if (std::isnan(c)) continue;
      ++complete;
      cost += c;
    }
    if (complete > best_complete || (complete == best_complete && cost < best_cost)) {
      best = trial;
      best_complete = complete;
      best_cost = cost;
    }
  }
  return best;
}

// At most so many of the pieces, evenly spread: a valley is seen in some of them as well.
std::vector<TrialProblem> Spread(const std::vector<TrialProblem>& pieces) {
  constexpr std::size_t kMost = 48;
  const std::size_t n = std::min(kMost, pieces.size());
  std::vector<TrialProblem> some;
  for (std::size_t i = 0; i < n; ++i) some.push_back(pieces[i * pieces.size() / n]);
  return some;
}

// Shared values from single hops, each started at the apex its data show; `shared` if there are
// none to be had.
Eigen::VectorXd ShootApexes(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                            const Eigen::VectorXd& shared, const FitOptions& options,
                            int start_number) {
  std::vector<TrialProblem> pieces = CutAllAtApexes(problem, trials);
  if (pieces.empty()) return shared;
  Eigen::VectorXd values = BestRung(problem, Spread(pieces), shared, options.jobs);
  // Pieces that fail there tell nothing yet; two rounds let them come back.
  for (int round = 0; round < 2 && !options.IsStopped(); ++round) {
    const std::vector<double> costs = CostsAt(problem, pieces, values, options.jobs);
    std::vector<TrialProblem> usable;
    std::vector<SharedPrior> priors;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const std::vector<SharedPrior>& own = pieces[i].shared_priors;
      if (std::isnan(costs[i]))
        priors.insert(priors.end(), own.begin(), own.end());
      else
        usable.push_back(pieces[i]);
    }
    if (usable.empty()) return shared;
    KeepPriors(priors, usable);
    SolveRequest request = RequestFor(problem, usable, options, start_number, "single hops");
    request.shared = values;
    request.hold_initial_states = true;
    request.max_iterations = 40;
    request.function_tolerance = kBeginning;
    const SolveResult result = Solve(request);
    if (result.status == SolveStatus::kNoStart || result.status == SolveStatus::kFailed) break;
    values = result.shared;
    if (usable.size() == pieces.size()) break;
  }
  return values;
}

Eigen::VectorXd ScatteredStart(const FitProblem& problem, const Eigen::VectorXd& nominal,
                               std::uint64_t seed, int number) {
  RandomStream random(seed, static_cast<std::uint64_t>(number));
  Eigen::VectorXd start = nominal;
  for (int i = 0; i < problem.shared_count(); ++i) {
    const SharedParameter& s = problem.shared[i];
    const double u = random.Uniform(-1.0, 1.0);
    // Positive sizes by a factor of two either way; what may be zero by its typical size.
    const double value = s.lower > 0.0 ? nominal[i] * std::pow(2.0, u) : nominal[i] + u * s.scale;
    const double room = std::min(0.05 * s.scale, 0.25 * (s.upper - s.lower));
    start[i] = std::clamp(value, s.lower + room, s.upper - room);
  }
  return start;
}

}  // namespace

std::string_view NameOf(FitStrategy strategy) {
  switch (strategy) {
    case FitStrategy::kRaw:
      return "raw";
    case FitStrategy::kGrowingHorizon:
      return "growing_horizon";
    case FitStrategy::kApexShooting:
      return "apex_shooting";
  }
  return "";
}

std::optional<FitStrategy> FindStrategy(std::string_view name) {
  for (FitStrategy s :
       {FitStrategy::kRaw, FitStrategy::kGrowingHorizon, FitStrategy::kApexShooting}) {
    if (NameOf(s) == name) return s;
  }
  return std::nullopt;
}

std::string_view NameOf(Discrepancy discrepancy) {
  return discrepancy == Discrepancy::kNone ? "none" : "matern";
}

std::optional<Discrepancy> FindDiscrepancy(std::string_view name) {
  for (const Discrepancy d : {Discrepancy::kNone, Discrepancy::kMatern}) {
    if (NameOf(d) == name) return d;
  }
  return std::nullopt;
}

std::vector<TrialProblem> TrialsOf(const FitProblem& problem, TrialRole role) {
  std::vector<TrialProblem> trials;
  for (const TrialProblem& t : problem.trials) {
    if (t.role == role) trials.push_back(t);
  }
  return trials;
}

StartRecord FitFrom(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                    const Eigen::VectorXd& shared, const FitOptions& options, int start_number,
                    std::vector<OwnValues>* initial_states) {
  StartRecord record;
  record.from = shared;
  SolveResult result;
  const bool grows =
      options.strategy == FitStrategy::kGrowingHorizon ||
      (options.strategy == FitStrategy::kApexShooting && TraitsOf(problem.law).lands_leg_by_leg);
  const auto grow = [&](const Eigen::VectorXd& from) {
    SolveRequest request = RequestFor(problem, trials, options, start_number, "growing horizon");
    request.shared = from;
    return GrowHorizon(request);
  };
  if (grows) {
    const Eigen::VectorXd from = TraitsOf(problem.law).lands_leg_by_leg
                                     ? FollowingStart(problem, trials, shared, options.jobs)
                                     : shared;
    result = grow(from);
    const bool led_on = IsUsable(result.status) && result.complete;
    if (from != shared && !led_on && !options.IsStopped()) {
      SolveResult stated = grow(shared);
      if (IsUsable(stated.status) && (stated.complete || !IsUsable(result.status)))
        result = std::move(stated);
    }
  } else {
    SolveRequest request = RequestFor(problem, trials, options, start_number, "all rows");
    request.follow_edges = true;
    request.shared = options.strategy == FitStrategy::kRaw
                         ? shared
                         : ShootApexes(problem, trials, shared, options, start_number);
    result = Solve(request);
    // The long run falls where single hops do not: let it grow to its full length.
    if (options.strategy == FitStrategy::kApexShooting) record.hops = request.shared;
    const bool led_on = IsUsable(result.status) && result.complete;
    if (options.strategy == FitStrategy::kApexShooting && !led_on && !options.IsStopped()) {
      SolveResult grown = grow(request.shared);
      if (IsUsable(grown.status) && (grown.complete || !IsUsable(result.status)))
        result = std::move(grown);
    }
  }
  const bool usable =
      IsUsable(result.status) || (result.status == SolveStatus::kInterrupted && result.cost > 0.0);
  record.shared = result.shared;
  record.cost = usable ? result.cost : kNaN;
  record.complete = usable && result.complete;
  record.status = result.status;
  record.message = result.message;
  record.iterations = result.iterations;
  record.rejected = result.rejected;
  if (initial_states) *initial_states = result.initial_states;
  return record;
}

namespace {

// An unfinished start does not displace a finished one, nor one that falls one that does not.
bool IsBetter(const StartRecord& record, const FitResult& than) {
  if (record.status == SolveStatus::kInterrupted) return false;
  const StartRecord& best = than.records[static_cast<std::size_t>(than.best_start)];
  if (record.complete != best.complete) return record.complete;
  return record.cost < best.cost;
}

}  // namespace

FitResult Fit(const FitProblem& problem, const FitOptions& options) {
  const std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  const Eigen::VectorXd nominal = InitialShared(problem);
  FitResult fit;
  const auto search = [&](const Eigen::VectorXd& from, int i) {
    std::vector<OwnValues> initial_states;
    StartRecord record = FitFrom(problem, trials, from, options, i, &initial_states);
    const bool interrupted = record.status == SolveStatus::kInterrupted;
    const bool better = !std::isnan(record.cost) && (fit.best_start < 0 || IsBetter(record, fit));
    if (better) {
      fit.best_start = i;
      fit.cost = record.cost;
      fit.shared = record.shared;
      fit.initial_states = initial_states;
    }
    fit.interrupted = fit.interrupted || interrupted;
    fit.records.push_back(std::move(record));
  };
  const int searches = std::max(options.restarts, 1);
  for (int i = 0; i < searches; ++i) {
    if (i > 0 && options.IsStopped()) break;
    search(i == 0 ? nominal : ScatteredStart(problem, nominal, options.seed, i), i);
  }
  if (fit.best_start >= 0 && !options.IsStopped()) {
    int number = searches;
    for (const Eigen::VectorXd& beyond : BeginningsBeyondThresholds(problem, fit.shared)) {
      if (options.IsStopped()) break;
      search(beyond, number++);
    }
  }
  fit.interrupted = fit.interrupted || options.IsStopped();
  fit.ok = fit.best_start >= 0;
  if (!fit.ok) {
    fit.message = fit.records.front().message;
  } else {
    fit.stop =
        CheckStop(problem, trials, fit.shared, fit.initial_states, options.loss, options.jobs);
    if (!fit.stop.complete) fit.message = fit.stop.faults.front();
  }
  return fit;
}

}  // namespace hoplab
