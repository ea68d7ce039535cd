#include "fitting/trial_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/nan.h"
#include "base/parallel.h"
#include "base/random.h"
#include "fitting/growing_horizon.h"
#include "fitting/trial_noise.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

// Half a squared residual a sample beyond which a refitted start is tried from elsewhere, too, and
// how often; where the trials that were fitted have more, so many times theirs: a model that fits
// nothing well fits no start well.
constexpr double kPoorCost = 1.0, kPoorer = 2.0;
constexpr int kMoreRestarts = 8;

double PoorCost(const FitProblem& problem, const FitResult& fit) {
  long samples = 0;
  for (const TrialProblem& trial : problem.trials)
    if (trial.role == TrialRole::kTrain) samples += trial.sample_count;
  return samples > 0 ? std::max(kPoorCost, kPoorer * fit.cost / static_cast<double>(samples))
                     : kPoorCost;
}

// A start drawn from what is known of it; what is held stays as it is stated.
OwnValues DrawnStart(const TrialProblem& trial, RandomStream& random) {
  OwnValues start = trial.start;
  for (int k = 0; k < trial.own_count(); ++k) {
    const OwnParameter& own = trial.own[static_cast<std::size_t>(k)];
    if (own.free) start[k] += std::min(own.scale, own.prior_sigma) * random.Normal();
  }
  return start;
}

// The start of a held-out trial, the shared values held. Which of a robot's legs lands first turns
// with its pitch, and a search does not pass from one order to the other: it begins where another
// model has its start, if one is known, and one that ends badly begins again elsewhere. `poor`: the
// cost a sample of such an end.
OwnValues RefitStart(const FitProblem& problem, const TrialProblem& trial,
                     const Eigen::VectorXd& shared, double poor, const FitOptions& options,
                     const TrialErrors* like) {
  const std::vector<TrialProblem> one = {trial};
  SolveRequest request;
  request.problem = &problem;
  request.trials = &one;
  request.shared = shared;
  request.hold_shared = true;
  request.function_tolerance = 1e-10;  // of thousands: far below one standard error
  request.loss = options.loss;
  request.stop = options.stop;
  const bool grows = TraitsOf(problem.law).lands_leg_by_leg;
  const auto is_poor = [&](const SolveResult& r) {
    return !r.complete || r.cost > poor * static_cast<double>(trial.sample_count);
  };
  if (grows && like && like->complete && like->start.size() <= trial.start.size()) {
    OwnValues begun = trial.start;
    begun.head(like->start.size()) = like->start;
    request.initial_states = {begun};
    const SolveResult found = Solve(request);
    if (found.status == SolveStatus::kConverged && !is_poor(found))
      return found.initial_states.front();
  }
  request.initial_states = {trial.start};
  Rounds rounds;
  SolveResult best = grows ? GrowHorizonBeside(request, {}, rounds) : Solve(request);
  RandomStream random(options.seed, 0);
  for (int k = 0; k < kMoreRestarts && grows && is_poor(best); ++k) {
    request.initial_states = {DrawnStart(trial, random)};
    SolveResult other = GrowHorizonElsewhere(request, rounds);
    if (other.initial_states.empty()) continue;
    if ((other.complete && !best.complete) ||
        (other.complete == best.complete && other.cost < best.cost))
      best = std::move(other);
  }
  return best.initial_states.front();
}

// Per-channel root mean square over the rows [first, last).
std::vector<double> Rmse(const TrialProblem& trial, const Trajectory& trajectory,
                         std::size_t channels, std::size_t first, std::size_t last) {
  std::vector<double> sum(channels, 0.0), count(channels, 0.0);
  for (std::size_t row = first; row < last; ++row) {
    for (std::size_t c = 0; c < channels; ++c) {
      const std::size_t cell = row * channels + c;
      if (std::isnan(trial.data[cell])) continue;
      sum[c] += std::pow(trajectory.samples[cell] - trial.data[cell], 2);
      count[c] += 1.0;
    }
  }
  for (std::size_t c = 0; c < channels; ++c)
    sum[c] = count[c] > 0 ? std::sqrt(sum[c] / count[c]) : kNaN;
  return sum;
}

std::vector<HopErrors> PerHop(const TrialProblem& trial, const Trajectory& trajectory,
                              std::size_t channels) {
  std::vector<double> cuts = {0.0};
  bool stance = false;
  for (const Event& e : trajectory.events) {
    stance = stance || e.kind != EventKind::kApex;
    if (e.kind == EventKind::kApex && stance) cuts.push_back(e.time);
    if (e.kind == EventKind::kApex) stance = false;
  }
  cuts.push_back(std::numeric_limits<double>::infinity());
  std::vector<HopErrors> hops;
  std::size_t row = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const std::size_t first = row;
    while (row < trial.row_times.size() && trial.row_times[row] < cuts[i + 1]) ++row;
    if (row == first) continue;
    hops.push_back({cuts[i], std::min(cuts[i + 1], trial.row_times.back()),
                    Rmse(trial, trajectory, channels, first, row)});
  }
  return hops;
}

void AddSampleLikelihoods(const FitProblem& problem, const TrialEvaluator& evaluator,
                          const Eigen::VectorXd& shared, const OwnValues& own, TrialErrors& out) {
  TrialEvaluation raw;
  EvaluationRequest request{shared, own};
  request.whiten = false;
  evaluator.Evaluate(request, raw);
  const TrialProblem& trial = evaluator.trial();
  RowMajorMatrix rows = raw.residuals.head(raw.data_residuals);
  Eigen::VectorXd log_roots = Eigen::VectorXd::Zero(rows.rows());
  evaluator.WhitenRows(problem.noise, rows, &log_roots);
  Eigen::Index row = 0;
  for (std::size_t cell = 0; cell < trial.data.size(); ++cell) {
    if (std::isnan(trial.data[cell])) continue;
    out.sample_times.push_back(trial.row_times[cell / problem.channels.size()]);
    out.sample_nll.push_back(0.5 * rows(row, 0) * rows(row, 0) + log_roots[row]);
    ++row;
  }
  for (const auto* times : {&trial.contact.touchdown_s, &trial.contact.liftoff_s}) {
    for (const double time : *times) {
      out.sample_times.push_back(time);
      out.sample_nll.push_back(0.5 * rows(row, 0) * rows(row, 0));
      ++row;
    }
  }
}

}  // namespace

std::vector<TrialErrors> AssessTrials(const FitProblem& problem, const FitResult& fit,
                                      const FitOptions& options, bool test_only,
                                      const std::vector<TrialErrors>* like) {
  std::vector<OwnValues> initial_states(problem.trials.size());
  std::size_t train = 0;
  for (std::size_t i = 0; i < problem.trials.size(); ++i) {
    if (problem.trials[i].role == TrialRole::kTrain)
      initial_states[i] = fit.initial_states[train++];
  }
  std::vector<TrialErrors> errors(problem.trials.size());
  const double poor = PoorCost(problem, fit);
  ParallelFor(static_cast<int>(errors.size()), options.jobs, [&](int i) {
    const TrialProblem& trial = problem.trials[i];
    TrialErrors& out = errors[i];
    out.file = trial.file;
    out.role = trial.role;
    if (test_only && trial.role == TrialRole::kTrain) return;
    if (trial.role == TrialRole::kTest)
      initial_states[i] = RefitStart(problem, trial, fit.shared, poor, options,
                                     like ? &(*like)[static_cast<std::size_t>(i)] : nullptr);
    const TrialEvaluator evaluator(problem, trial);
    TrialEvaluation e;
    evaluator.Evaluate({fit.shared, initial_states[i], false}, e);
    out.outcome = e.trajectory.outcome;
    out.end_time = e.trajectory.end_time;
    out.complete = e.complete;
    out.samples = trial.sample_count;
    out.start = initial_states[i];
    out.max_deflection_ratio = e.trajectory.max_deflection_ratio;
    out.nll_per_sample = kNaN;
    const std::size_t channels = problem.channels.size();
    out.rmse.assign(channels, kNaN);
    if (e.complete) {
      out.rmse = Rmse(trial, e.trajectory, channels, 0, trial.row_times.size());
      out.hops = PerHop(trial, e.trajectory, channels);
      out.chi2 = e.white_square;
      AddSampleLikelihoods(problem, evaluator, fit.shared, initial_states[i], out);
      out.prior_nll = 0.5 * e.residuals.tail(e.residuals.size() - e.data_residuals).squaredNorm();
      double nll = 0.5 * out.chi2;
      for (std::size_t cell = 0; cell < trial.data.size(); ++cell) {
        if (std::isnan(trial.data[cell])) continue;
        nll += std::log(SigmaIn(problem, trial, cell % channels)) +
               0.5 * std::log(2.0 * std::numbers::pi);
      }
      for (const auto* sigmas :
           {&trial.contact.touchdown_sigma_s, &trial.contact.liftoff_sigma_s}) {
        for (double sigma : *sigmas)
          nll += std::log(sigma) + 0.5 * std::log(2.0 * std::numbers::pi);
      }
      out.nll_per_sample = nll / static_cast<double>(trial.sample_count);
    }
    out.trajectory = std::move(e.trajectory);
  });
  return errors;
}

RoleErrors Summarise(const FitProblem& problem, const std::vector<TrialErrors>& trials,
                     TrialRole role) {
  const std::size_t channels = problem.channels.size();
  RoleErrors out{std::vector<double>(channels, 0.0), 0.0, 0, 0, 0};
  std::vector<double> counts(channels, 0.0);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (trials[i].role != role) continue;
    ++out.trials;
    out.samples += trials[i].samples;
    if (!trials[i].complete) ++out.incomplete;
    out.nll_per_sample += trials[i].nll_per_sample * static_cast<double>(trials[i].samples);
    for (std::size_t c = 0; c < channels; ++c) {
      double count = 0.0;
      for (std::size_t cell = c; cell < problem.trials[i].data.size(); cell += channels)
        count += !std::isnan(problem.trials[i].data[cell]);
      if (count == 0.0) continue;
      out.rmse[c] += trials[i].rmse[c] * trials[i].rmse[c] * count;
      counts[c] += count;
    }
  }
  for (std::size_t c = 0; c < channels; ++c)
    out.rmse[c] = counts[c] > 0.0 ? std::sqrt(out.rmse[c] / counts[c]) : kNaN;
  out.nll_per_sample =
      out.samples > 0 ? out.nll_per_sample / static_cast<double>(out.samples) : kNaN;
  return out;
}

}  // namespace hoplab
