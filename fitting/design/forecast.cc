#include "fitting/design/forecast.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/nan.h"
#include "base/parallel.h"
#include "fitting/eliminated_trial.h"

namespace hoplab {
namespace {

constexpr int kRefitIterations = 40;
constexpr double kNormal975 = 1.959963984540054;
// Singular values below this share of the largest are rounding, as in AssessUncertainty.
constexpr double kSeenRankTolerance = 1e-8;
// More nats than that are as good as certain, and beyond what a linear model can know.
constexpr double kMostNatsApart = 1000.0;

std::vector<int> FreePlaces(const FittedModel& model) {
  std::vector<int> free;
  for (int k = 0; k < model.problem.shared_count(); ++k) {
    const SharedParameter& s = model.problem.shared[static_cast<std::size_t>(k)];
    const double near = 1e-6 * s.scale;
    if (model.shared[k] > s.lower + near && model.shared[k] < s.upper - near) free.push_back(k);
  }
  return free;
}

std::vector<KeptColumn> ColumnsOf(const FittedModel& model, const std::vector<int>& places) {
  std::vector<KeptColumn> columns;
  for (const int k : places)
    columns.push_back({k, model.problem.shared[static_cast<std::size_t>(k)].scale});
  return columns;
}

ForecastFailure FailureOf(Outcome outcome, const FittedModel& model) {
  return {outcome, RivalName(model)};
}

std::string Under(const std::string& rival) { return rival.empty() ? "" : " under " + rival; }

// A throw from below the height at which the leg meets the ground flies in the simulation, but
// nobody can begin there.
bool BeginsInGround(const FittedModel& model, const TrialProblem& trial) {
  if (!(trial.start[3] > 0.0)) return false;
  TrialProblem still = trial;
  still.row_times = {0.0};
  still.data.assign(model.problem.channels.size(), kNaN);
  still.sample_count = 0;
  still.start[3] = 0.0;
  Trajectory run;
  TrialEvaluator(model.problem, still)
      .Simulate({model.shared, still.start, false}, model.problem.integrator, run);
  return run.outcome == Outcome::kStartsInGround;
}

// The trial filled with what `truth` predicts, without noise, where it gets through it.
Outcome Record(const FittedModel& truth, TrialProblem& trial) {
  if (BeginsInGround(truth, trial)) return Outcome::kStartsInGround;
  Trajectory predicted;
  TrialEvaluator(truth.problem, trial)
      .Simulate({truth.shared, trial.start, false}, truth.problem.integrator, predicted);
  if (!IsComplete(predicted.outcome)) return predicted.outcome;
  trial.data = predicted.samples;
  trial.sample_count =
      std::count_if(trial.data.begin(), trial.data.end(), [](double v) { return !std::isnan(v); });
  return predicted.outcome;
}

struct Nats {
  double value = kNaN;
  std::optional<ForecastFailure> failure;
};

// By the linear model at `shared` and `start`.
Nats LinearNats(const FittedModel& rival, const RecordedInformation& information,
                const TrialProblem& trial, const Eigen::VectorXd& shared, const OwnValues& start) {
  const TrialEvaluator evaluator(rival.problem, trial);
  TrialEvaluation e;
  evaluator.Evaluate({shared, start, true}, e);
  if (!e.complete) return {kNaN, FailureOf(e.trajectory.outcome, rival)};
  const EliminatedTrial reduced =
      EliminateOwn(trial, e, rival.problem.shared_count(), ColumnsOf(rival, information.free));
  const Eigen::Index old = information.rows.rows(), fresh = reduced.columns.rows();
  const Eigen::Index n = static_cast<Eigen::Index>(information.free.size());
  if (n == 0) return {0.5 * reduced.residuals.squaredNorm(), {}};
  Eigen::MatrixXd A(old + fresh, n);
  A << information.rows, reduced.columns;
  Eigen::VectorXd moved(n);  // from where the recorded trials have the values, per scale
  for (Eigen::Index i = 0; i < n; ++i) {
    const int k = information.free[static_cast<std::size_t>(i)];
    moved[i] =
        (shared[k] - rival.shared[k]) / rival.problem.shared[static_cast<std::size_t>(k)].scale;
  }
  Eigen::VectorXd b(old + fresh);
  b << information.rows * moved, reduced.residuals;
  const Eigen::VectorXd step = A.completeOrthogonalDecomposition().solve(b);
  return {0.5 * (b - A * step).squaredNorm(), {}};
}

// A search minimises white errors. Where a rival's noise is another, what is left under it is told
// by the linear model at the values that were found.
Nats RefittedNats(const FittedModel& rival, const RecordedInformation& information,
                  const std::vector<TrialProblem>& train, const TrialProblem& trial) {
  std::vector<TrialProblem> trials = train;
  trials.push_back(trial);
  SolveRequest request;
  request.problem = &rival.problem;
  request.trials = &trials;
  request.shared = rival.shared;
  request.initial_states = rival.initial_states;
  request.initial_states.push_back(trial.start);
  request.max_iterations = kRefitIterations;
  request.function_tolerance = 1e-6;
  const SolveResult result = Solve(request);
  if (!IsUsable(result.status)) return {kNaN, ForecastFailure{std::nullopt, RivalName(rival)}};
  if (rival.problem.noise.IsWhite()) return {std::max(result.cost - rival.cost, 0.0), {}};
  return LinearNats(rival, information, trial, result.shared, result.initial_states.back());
}

// All pairs of rivals by `nats_of(j, trial as i predicts it)`.
template <class NatsOf>
SeparationForecast Forecast(std::span<const FittedModel> rivals, const TrialProblem& trial,
                            int jobs, const NatsOf& nats_of) {
  const int k = static_cast<int>(rivals.size());
  SeparationForecast out;
  std::vector<TrialProblem> recorded(rivals.size(), trial);
  for (int i = 0; i < k; ++i) {
    const Outcome outcome = Record(rivals[i], recorded[i]);
    if (IsComplete(outcome)) continue;
    out.failure = FailureOf(outcome, rivals[i]);
    return out;
  }
  std::vector<Nats> all(static_cast<std::size_t>(k * k), Nats{0.0, {}});
  ParallelFor(k * k, jobs, [&](int pair) {
    if (pair / k != pair % k) all[pair] = nats_of(pair % k, recorded[pair / k]);
  });
  out.nats.resize(k, k);
  for (int pair = 0; pair < k * k; ++pair) {
    if (!out.failure) out.failure = all[pair].failure;
    out.nats(pair / k, pair % k) = all[pair].value;
  }
  return out;
}

// log(-sum w log w) of weights given by their logarithms, also where all but one vanish.
double LogEntropy(std::span<const double> log_weights) {
  const double most = *std::max_element(log_weights.begin(), log_weights.end());
  double sum = 0.0;
  for (const double w : log_weights) sum += std::exp(w - most);
  const double log_sum = most + std::log(sum);
  // The largest weight's own term by what the others leave of it: log(1 - rest).
  double rest = 0.0;
  bool skipped = false;
  double highest = -std::numeric_limits<double>::infinity();
  std::vector<double> terms;
  for (const double w : log_weights) {
    const double log_share = w - log_sum;
    if (!skipped && w == most) {
      skipped = true;
      continue;
    }
    rest += std::exp(log_share);
    if (log_share < -1e-300) terms.push_back(log_share + std::log(-log_share));
  }
  // -(1 - rest) log(1 - rest) is rest to first order, so it never decides beside the others' terms.
  if (rest > 1e-12) terms.push_back(std::log(-(1.0 - rest) * std::log1p(-rest)));
  for (const double t : terms) highest = std::max(highest, t);
  if (!std::isfinite(highest)) return -std::numeric_limits<double>::infinity();
  double total = 0.0;
  for (const double t : terms) total += std::exp(t - highest);
  return highest + std::log(total);
}

}  // namespace

std::string RivalName(const FittedModel& rival) {
  std::string names;
  for (const Candidate& c : rival.members) names += (names.empty() ? "" : " + ") + c.Name();
  return names.empty() ? "no effect at all" : names;
}

bool AllGetThrough(std::span<const FittedModel> rivals, TrialProblem trial) {
  return std::all_of(rivals.begin(), rivals.end(),
                     [&](const FittedModel& r) { return IsComplete(Record(r, trial)); });
}

RecordedInformation InformationOf(const FittedModel& model,
                                  const std::vector<TrialProblem>& train) {
  RecordedInformation out;
  out.free = FreePlaces(model);
  const Eigen::Index n = static_cast<Eigen::Index>(out.free.size());
  out.rows = Eigen::MatrixXd::Zero(0, n);
  std::vector<EliminatedTrial> parts;
  for (std::size_t i = 0; i < train.size(); ++i) {
    const TrialEvaluator evaluator(model.problem, train[i]);
    TrialEvaluation e;
    evaluator.Evaluate({model.shared, model.initial_states[i], true}, e);
    if (!e.complete) continue;
    parts.push_back(
        EliminateOwn(train[i], e, model.problem.shared_count(), ColumnsOf(model, out.free)));
  }
  if (parts.empty() || n == 0) return out;
  const Eigen::MatrixXd S = Stacked(parts).columns;
  if (S.rows() <= n) {
    out.rows = S;
  } else {
    out.rows = Eigen::HouseholderQR<Eigen::MatrixXd>(S)
                   .matrixQR()
                   .topRows(n)
                   .triangularView<Eigen::Upper>();
  }
  return out;
}

SeparationForecast ForecastLinearly(std::span<const FittedModel> rivals,
                                    std::span<const RecordedInformation> information,
                                    const TrialProblem& trial, int jobs) {
  return Forecast(rivals, trial, jobs, [&](int j, const TrialProblem& recorded) {
    return LinearNats(rivals[j], information[j], recorded, rivals[j].shared, recorded.start);
  });
}

SeparationForecast ForecastByRefits(std::span<const FittedModel> rivals,
                                    const std::vector<TrialProblem>& train,
                                    const TrialProblem& trial, int jobs) {
  std::vector<RecordedInformation> information(rivals.size());
  ParallelFor(static_cast<int>(rivals.size()), jobs, [&](int j) {
    if (!rivals[j].problem.noise.IsWhite()) information[j] = InformationOf(rivals[j], train);
  });
  return Forecast(rivals, trial, jobs, [&](int j, const TrialProblem& recorded) {
    return RefittedNats(rivals[j], information[j], train, recorded);
  });
}

double EntropyOf(std::span<const double> weights) {
  double entropy = 0.0;
  for (const double w : weights) entropy -= w > 0.0 ? w * std::log(w) : 0.0;
  return entropy;
}

double LogExpectedEntropy(std::span<const double> weights, const Eigen::MatrixXd& nats) {
  // The trapezoidal rule converges geometrically for what falls off like a Gaussian. The entropy is
  // largest where noise makes up for the expected ratio, at z = -sqrt(d/2), so the tail counts.
  constexpr double kEnd = 26.0, kStep = 0.1;
  const std::size_t k = weights.size();
  std::vector<double> terms, log_weights(k);
  for (std::size_t i = 0; i < k; ++i) {
    if (!(weights[i] > 0.0)) continue;
    for (double z = -kEnd; z <= kEnd; z += kStep) {
      for (std::size_t j = 0; j < k; ++j) {
        const double d = std::min(nats(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                                  kMostNatsApart);
        log_weights[j] = std::log(std::max(weights[j], 1e-300)) -
                         (i == j ? 0.0 : d + std::sqrt(2.0 * std::max(d, 0.0)) * z);
      }
      terms.push_back(std::log(weights[i] * kStep / std::sqrt(2.0 * std::numbers::pi)) -
                      0.5 * z * z + LogEntropy(log_weights));
    }
  }
  const double highest = *std::max_element(terms.begin(), terms.end());
  if (!std::isfinite(highest)) return highest;
  double sum = 0.0;
  for (const double t : terms) sum += std::exp(t - highest);
  return highest + std::log(sum);
}

std::string ForecastFailure::Name() const {
  return outcome ? std::string(NameOf(*outcome)) + Under(under) : "no refit of " + under;
}

std::string ForecastFailure::Sentence() const {
  return outcome ? std::string(SentenceOf(*outcome)) + Under(under) : "no refit of " + under;
}

SharpeningForecast ForecastInterval(const FittedModel& model,
                                    const RecordedInformation& information, int parameter,
                                    const TrialProblem* trial) {
  SharpeningForecast out;
  const Eigen::Index n = static_cast<Eigen::Index>(information.free.size());
  Eigen::MatrixXd S = information.rows;
  if (trial) {
    TrialProblem recorded = *trial;
    const Outcome outcome = Record(model, recorded);
    if (!IsComplete(outcome)) return {0.0, ForecastFailure{outcome, ""}};
    TrialEvaluation e;
    TrialEvaluator(model.problem, recorded).Evaluate({model.shared, recorded.start, true}, e);
    if (!e.complete) return {0.0, ForecastFailure{e.trajectory.outcome, ""}};
    const EliminatedTrial fresh =
        EliminateOwn(recorded, e, model.problem.shared_count(), ColumnsOf(model, information.free));
    S.resize(information.rows.rows() + fresh.columns.rows(), n);
    S << information.rows, fresh.columns;
  }
  out.half_width = std::numeric_limits<double>::infinity();
  const auto at = std::find(information.free.begin(), information.free.end(), parameter);
  if (at == information.free.end() || S.rows() == 0) return out;
  const Eigen::Index place = at - information.free.begin();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(S, Eigen::ComputeFullV);
  const Eigen::VectorXd& sv = svd.singularValues();
  double variance = 0.0;
  for (Eigen::Index j = 0; j < n; ++j) {
    const double along = svd.matrixV()(place, j);
    const bool seen = j < sv.size() && sv[j] > kSeenRankTolerance * sv[0] && sv[j] > 0.0;
    if (!seen && along * along > 1e-10) return out;
    if (seen) variance += along * along / (sv[j] * sv[j]);
  }
  out.half_width = kNormal975 * std::sqrt(variance) *
                   model.problem.shared[static_cast<std::size_t>(parameter)].scale;
  return out;
}

}  // namespace hoplab
