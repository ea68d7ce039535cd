#include "tests/support/evidence_integrand.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "fitting/trial_evaluator.h"

namespace hoplab::testing {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

double LogNormal(double x, double sigma) {
  return -0.5 * (x / sigma) * (x / sigma) - std::log(sigma * std::sqrt(2.0 * std::numbers::pi));
}

// Seven widths alike, from 0.03 to 30 typical sizes; on one side all of it.
double LogPriorOf(const SharedParameter& s, double value) {
  if (value < s.lower || value > s.upper) return kNever;
  // A parameter of the mechanism counts from zero, an effect from what changes nothing.
  const bool effect = s.direction.of == SensitivityDirection::Of::kEffect;
  const double null = effect ? s.initial : 0.0;
  double density = 0.0;
  for (const double width : {0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0})
    density += std::exp(LogNormal((value - null) / s.scale, width)) / 7.0;
  return std::log(density) + (s.lower < null && s.upper > null ? 0.0 : std::log(2.0));
}

}  // namespace

EvidenceIntegrand::EvidenceIntegrand(const FitProblem& problem,
                                     const std::vector<TrialProblem>& trials, bool discrepancy)
    : problem_(problem), trials_(trials), discrepancy_(discrepancy) {
  // From three rows to half the longest trial.
  double seconds = 0.0, rows = 0.0;
  for (const TrialProblem& t : trials) {
    seconds += t.row_times.back();
    rows += static_cast<double>(t.row_times.size());
    longest_ = std::max(longest_, 0.5 * t.row_times.back());
  }
  shortest_ = 3.0 * seconds / rows;
}

double EvidenceIntegrand::LogNoisePrior(const Noise& noise) const {
  if (noise.time_scale < shortest_ || noise.time_scale > longest_) return kNever;
  // Uniform in the logarithm of the time scale; half-normal of ten sigma in each amplitude, whose
  // coordinate is its logarithm.
  double sum = -std::log(std::log(longest_ / shortest_));
  for (const double a : noise.amplitude) sum += std::log(2.0) + LogNormal(a, 10.0) + std::log(a);
  return sum;
}

// Log-likelihood of one trial's rows by the dense covariance of each channel.
double EvidenceIntegrand::LogRows(const TrialProblem& trial, const Eigen::VectorXd& residuals,
                                  const Noise& noise) const {
  if (noise.amplitude.empty()) return -0.5 * residuals.squaredNorm();
  const std::size_t width = problem_.channels.size();
  const auto n = static_cast<Eigen::Index>(trial.row_times.size());
  Eigen::MatrixXd correlation(n, n);
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b <= a; ++b) {
      const double x = std::sqrt(3.0) / noise.time_scale *
                       (trial.row_times[static_cast<std::size_t>(a)] -
                        trial.row_times[static_cast<std::size_t>(b)]);
      correlation(a, b) = (1.0 + x) * std::exp(-x);
    }
  }
  double sum = 0.0;
  for (std::size_t c = 0; c < width; ++c) {
    Eigen::VectorXd r(n);  // rows are complete: their residuals stand channel by channel
    for (Eigen::Index a = 0; a < n; ++a)
      r[a] = residuals[a * static_cast<Eigen::Index>(width) + static_cast<Eigen::Index>(c)];
    Eigen::MatrixXd C = noise.amplitude[c] * noise.amplitude[c] * correlation;
    C.diagonal().array() += 1.0;
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(C);
    sum -= 0.5 * llt.matrixL().solve(r).squaredNorm();
    sum -= llt.matrixLLT().diagonal().array().log().sum();
  }
  return sum;
}

double EvidenceIntegrand::operator()(const Eigen::VectorXd& x) const {
  const int n = problem_.shared_count();
  Eigen::VectorXd shared(n);
  double sum = 0.0;
  for (int k = 0; k < n; ++k) {
    const SharedParameter& s = problem_.shared[static_cast<std::size_t>(k)];
    shared[k] = x[k] * s.scale;
    sum += LogPriorOf(s, shared[k]);
  }
  Noise noise;
  if (discrepancy_) {
    for (std::size_t c = 0; c < problem_.channels.size(); ++c)
      noise.amplitude.push_back(
          std::exp(x[x.size() - 1 - static_cast<Eigen::Index>(problem_.channels.size() - c)]));
    noise.time_scale = std::exp(x[x.size() - 1]);
    sum += LogNoisePrior(noise);
  }
  if (sum == kNever) return kNever;
  Eigen::Index at = n;
  for (const TrialProblem& trial : trials_) {
    OwnValues own(trial.own_count());
    for (int k = 0; k < trial.own_count(); ++k) {
      const OwnParameter& o = trial.own[static_cast<std::size_t>(k)];
      own[k] = x[at++] * o.scale;
      const double off = (own[k] - o.prior_mean) / o.prior_sigma;
      sum -= 0.5 * off * off + 0.5 * std::log(2.0 * std::numbers::pi);
    }
    TrialEvaluation e;
    EvaluationRequest request{shared, own};
    request.whiten = false;
    TrialEvaluator(problem_, trial).Evaluate(request, e);
    if (!e.complete) return kNever;
    sum += LogRows(trial, e.residuals.head(e.data_residuals), noise);
  }
  return sum;
}

Eigen::VectorXd EvidenceIntegrand::CoordinatesOf(const Eigen::VectorXd& shared,
                                                 const std::vector<OwnValues>& initial_states,
                                                 const hoplab::NoiseModel& noise) const {
  std::vector<double> x;
  for (int k = 0; k < problem_.shared_count(); ++k)
    x.push_back(shared[k] / problem_.shared[static_cast<std::size_t>(k)].scale);
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    for (int k = 0; k < trials_[i].own_count(); ++k)
      x.push_back(initial_states[i][k] / trials_[i].own[static_cast<std::size_t>(k)].scale);
  }
  if (discrepancy_) {
    for (std::size_t c = 0; c < problem_.channels.size(); ++c)
      x.push_back(std::log(std::max(noise.AmplitudeOf(c), 0.1)));
    const double middle = std::sqrt(shortest_ * longest_);
    x.push_back(std::log(noise.IsWhite()
                             ? middle
                             : std::clamp(noise.time_scale, 1.01 * shortest_, 0.99 * longest_)));
  }
  return Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

Eigen::MatrixXd EvidenceIntegrand::Spread(const Eigen::VectorXd& shared,
                                          const std::vector<OwnValues>& initial_states) const {
  const Eigen::VectorXd at = CoordinatesOf(shared, initial_states, {});
  Eigen::MatrixXd information = Eigen::MatrixXd::Identity(at.size(), at.size());
  const int n = problem_.shared_count();
  Eigen::Index first = n;
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    TrialEvaluation e;
    EvaluationRequest request{shared, initial_states[i], true};
    request.whiten = false;
    TrialEvaluator(problem_, trials_[i]).Evaluate(request, e);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(e.jacobian.rows(), at.size());
    for (int k = 0; k < n; ++k)
      J.col(k) = e.jacobian.col(k) * problem_.shared[static_cast<std::size_t>(k)].scale;
    for (int k = 0; k < trials_[i].own_count(); ++k, ++first)
      J.col(first) = e.jacobian.col(n + k) * trials_[i].own[static_cast<std::size_t>(k)].scale;
    information += J.transpose() * J;
  }
  return information.inverse();
}

}  // namespace hoplab::testing
