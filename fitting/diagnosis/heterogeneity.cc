#include "fitting/diagnosis/heterogeneity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "fitting/deviation.h"
#include "fitting/eliminated_trial.h"

namespace hoplab {
namespace {

// Trials' rows with one value free in each: b_i ~ N(0, tau^2) beside the shared steps s,
// residuals r_i + C_i s + c_i b_i, held values having no steps. With b_i integrated out the rows
// have the covariance I + tau^2 c c', whose inverse is I - w c c', w = tau^2/(1 + tau^2 c'c).
class RandomEffect {
 public:
  RandomEffect(const std::vector<EliminatedTrial>& trials, int value, const std::vector<int>& held)
      : trials_(trials), value_(value) {
    for (EliminatedTrial& t : trials_) {
      effects_.push_back(t.empty() ? Eigen::VectorXd() : Eigen::VectorXd(t.columns.col(value)));
      for (const int k : t.empty() ? std::vector<int>() : held) t.columns.col(k).setZero();
    }
    mean_is_held_ = std::find(held.begin(), held.end(), value) != held.end();
  }

  // Restricted log-likelihood at tau, the shared steps marginalised; leaves their estimate.
  double LogLikelihood(double tau) {
    Eigen::MatrixXd H;
    Eigen::VectorXd g;
    double sum = 0.0;
    for (std::size_t i = 0; i < trials_.size(); ++i) {
      const EliminatedTrial& t = trials_[i];
      if (t.empty()) continue;
      if (H.size() == 0) {
        H = Eigen::MatrixXd::Zero(t.columns.cols(), t.columns.cols());
        g = Eigen::VectorXd::Zero(t.columns.cols());
      }
      const Eigen::VectorXd& c = effects_[i];
      const double V = c.squaredNorm(), w = tau * tau / (1.0 + tau * tau * V);
      const Eigen::RowVectorXd cC = c.transpose() * t.columns;
      const double cr = c.dot(t.residuals);
      H += t.columns.transpose() * t.columns - w * cC.transpose() * cC;
      g += t.columns.transpose() * t.residuals - w * cr * cC.transpose();
      sum -= 0.5 * (std::log1p(tau * tau * V) + t.residuals.squaredNorm() - w * cr * cr);
    }
    solver_.compute(H);
    step_ = -solver_.solve(g);
    const Eigen::VectorXd d = solver_.vectorD().cwiseMax(std::numeric_limits<double>::min());
    return sum - 0.5 * g.dot(step_) - 0.5 * d.array().log().sum();
  }

  double mean_step() const { return step_[value_]; }
  // Of the last LogLikelihood(tau).
  double SizeStep(std::size_t i, double tau) const {
    const EliminatedTrial& t = trials_[i];
    const Eigen::VectorXd& c = effects_[i];
    const double w = tau * tau / (1.0 + tau * tau * c.squaredNorm());
    return step_[value_] - w * c.dot(t.residuals + t.columns * step_);
  }
  // Of that, for the trial's true one: given the shared steps b_i is known to w, and SizeStep
  // follows them along e - w c'C.
  double SizeError(std::size_t i, double tau) const {
    const EliminatedTrial& t = trials_[i];
    const Eigen::VectorXd& c = effects_[i];
    const double w = tau * tau / (1.0 + tau * tau * c.squaredNorm());
    Eigen::VectorXd along = -w * t.columns.transpose() * c;
    if (!mean_is_held_) along[value_] += 1.0;
    return std::sqrt(w + std::max(along.dot(solver_.solve(along)), 0.0));
  }
  // Minus the second derivative of LogLikelihood by log tau.
  double Curvature(double tau) {
    constexpr double kDifference = 0.05;
    const double up = LogLikelihood(tau * std::exp(kDifference));
    const double down = LogLikelihood(tau * std::exp(-kDifference));
    return (2.0 * LogLikelihood(tau) - up - down) / (kDifference * kDifference);
  }

 private:
  std::vector<EliminatedTrial> trials_;
  std::vector<Eigen::VectorXd> effects_;  // c_i
  int value_;
  bool mean_is_held_ = false;
  Eigen::LDLT<Eigen::MatrixXd> solver_;
  Eigen::VectorXd step_;
};

// Takes off what one step of all values together explains: the values are those of least squares,
// not of the noise the rows are whitened by.
void Centre(std::vector<EliminatedTrial>& parts) {
  const EliminatedTrial all = Stacked(parts);
  if (all.residuals.size() == 0) return;
  const Eigen::VectorXd step = all.columns.completeOrthogonalDecomposition().solve(all.residuals);
  for (EliminatedTrial& part : parts) {
    if (!part.empty()) part.residuals -= part.columns * step;
  }
}

// The spread of the restricted likelihood's maximum and what it brings; steps in the value's scale.
void Spread(const std::vector<EliminatedTrial>& parts, int k, double value, double scale,
            double information, const std::vector<int>& held, Heterogeneity& h) {
  RandomEffect effect(parts, k, held);
  const double none = effect.LogLikelihood(0.0);
  // From a tenth of what one trial can tell to a thousand times it.
  const double told = 1.0 / std::sqrt(information / (h.degrees_of_freedom + 1));
  constexpr int kBits = 20;
  const auto [log_tau, worst] = boost::math::tools::brent_find_minima(
      [&](double x) { return -effect.LogLikelihood(std::exp(x)); }, std::log(0.1 * told),
      std::log(1e3 * told), kBits);
  h.gain = std::max(-worst - none, 0.0);
  const double tau = h.gain > 0.0 ? std::exp(log_tau) : 0.0;
  if (tau > 0.0) h.curvature = effect.Curvature(tau);
  effect.LogLikelihood(tau);
  h.mean = value + scale * effect.mean_step();
  h.spread = scale * tau;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const bool sees = !parts[i].empty() && parts[i].columns.col(k).squaredNorm() > 0.0;
    h.sizes.push_back(sees ? value + scale * effect.SizeStep(i, tau) : kNone);
    h.std_errors.push_back(sees ? scale * effect.SizeError(i, tau) : kNone);
  }
}

// Of the value in column k of the trials, in its scale.
Heterogeneity Describe(const std::vector<EliminatedTrial>& parts, int k, double value, double scale,
                       const std::vector<int>& held) {
  Heterogeneity h;
  double information = 0.0, pull = 0.0, squares = 0.0;
  int trials = 0;
  for (const EliminatedTrial& part : parts) {
    if (part.empty()) continue;
    const double V = part.columns.col(k).squaredNorm();
    const double g = part.columns.col(k).dot(part.residuals);
    if (!(V > 0.0)) continue;
    information += V;
    pull += g;
    squares += g * g / V;
    ++trials;
  }
  if (trials < 2) return h;
  h.chi2 = std::max(squares - pull * pull / information, 0.0);
  h.degrees_of_freedom = trials - 1;
  h.p_value = boost::math::cdf(
      boost::math::complement(boost::math::chi_squared(static_cast<double>(trials - 1)), h.chi2));
  Spread(parts, k, value, scale, information, held, h);
  return h;
}

std::vector<KeptColumn> SharedColumns(const FitProblem& problem) {
  std::vector<KeptColumn> columns;
  for (int k = 0; k < problem.shared_count(); ++k)
    columns.push_back({k, problem.shared[static_cast<std::size_t>(k)].scale});
  return columns;
}

std::vector<int> HeldOf(const FitProblem& problem) {
  std::vector<int> held;
  for (int k = 0; k < problem.shared_count(); ++k)
    if (problem.shared[static_cast<std::size_t>(k)].held) held.push_back(k);
  return held;
}

// A trial's rows with its deviation of one shared value taken back: as they would be without, to
// first order. The deviation's prior then has a row of zeros.
EliminatedTrial WithoutDeviation(TrialProblem trial, int place, TrialEvaluation& e,
                                 const OwnValues& own, const std::vector<KeptColumn>& columns) {
  const auto n = static_cast<int>(columns.size());
  if (const std::optional<int> k = DeviationOf(place, trial)) {
    e.residuals -= e.jacobian.col(n + *k) * own[*k];
    trial.own[static_cast<std::size_t>(*k)].free = false;
  }
  return EliminateOwn(trial, e, n, columns);
}

// Every trial that runs to its end at the model, its own values eliminated by `eliminate`.
template <class Eliminate>
std::vector<EliminatedTrial> EliminateTrials(const FittedModel& model,
                                             const std::vector<TrialProblem>& train, int jobs,
                                             const Eliminate& eliminate) {
  std::vector<EliminatedTrial> parts(train.size());
  ParallelFor(static_cast<int>(train.size()), jobs, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    TrialEvaluation e;
    TrialEvaluator(model.problem, train[at])
        .Evaluate({model.shared, model.initial_states[at], true}, e);
    if (e.complete) parts[at] = eliminate(at, e);
  });
  return parts;
}

}  // namespace

std::vector<Heterogeneity> HeterogeneityOf(const FittedModel& model,
                                           const std::vector<TrialProblem>& train, int jobs) {
  const int n = model.problem.shared_count();
  const std::vector<KeptColumn> columns = SharedColumns(model.problem);
  std::vector<EliminatedTrial> parts = EliminateTrials(
      model, train, jobs,
      [&](std::size_t at, TrialEvaluation& e) { return EliminateOwn(train[at], e, n, columns); });
  Centre(parts);
  std::vector<Heterogeneity> out;
  for (int k = 0; k < n; ++k)
    out.push_back(Describe(parts, k, model.shared[k], columns[static_cast<std::size_t>(k)].scale,
                           HeldOf(model.problem)));
  return out;
}

Heterogeneity HeterogeneityAt(const FittedModel& model, const std::vector<TrialProblem>& train,
                              int place, int jobs) {
  const std::vector<KeptColumn> columns = SharedColumns(model.problem);
  const std::vector<EliminatedTrial> parts =
      EliminateTrials(model, train, jobs, [&](std::size_t at, TrialEvaluation& e) {
        return WithoutDeviation(train[at], place, e, model.initial_states[at], columns);
      });
  return Describe(parts, place, model.shared[place], columns[static_cast<std::size_t>(place)].scale,
                  HeldOf(model.problem));
}

}  // namespace hoplab
