#include "fitting/deviation.h"

#include <algorithm>
#include <limits>

#include "base/check.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {

bool AddDeviation(const FitProblem& problem, int place, double spread, TrialProblem& trial) {
  HOPLAB_CHECK(spread > 0.0);
  const SharedParameter& s = problem.shared[static_cast<std::size_t>(place)];
  if (!ActsIn(s, trial) || DeviationOf(place, trial)) return false;
  trial.own.push_back({.name = s.name,
                       .direction = s.direction,
                       .scale = spread,
                       .prior_mean = 0.0,
                       .prior_sigma = spread,
                       .deviation_of = place});
  trial.start.conservativeResize(trial.own_count());
  trial.start[trial.own_count() - 1] = 0.0;
  return true;
}

void SetSpread(int place, double spread, TrialProblem& trial) {
  HOPLAB_CHECK(spread > 0.0);
  const std::optional<int> k = DeviationOf(place, trial);
  if (!k) return;
  OwnParameter& own = trial.own[static_cast<std::size_t>(*k)];
  own.scale = own.prior_sigma = spread;
}

std::optional<int> DeviationOf(int place, const TrialProblem& trial) {
  for (int k = 0; k < trial.own_count(); ++k) {
    if (trial.own[static_cast<std::size_t>(k)].deviation_of == place) return k;
  }
  return std::nullopt;
}

Eigen::VectorXd ActingShared(const FitProblem& problem, const TrialProblem& trial,
                             const Eigen::Ref<const Eigen::VectorXd>& shared,
                             const Eigen::Ref<const OwnValues>& own) {
  Eigen::VectorXd acting = shared;
  for (int k = 0; k < trial.own_count(); ++k) {
    const int place = trial.own[static_cast<std::size_t>(k)].deviation_of;
    if (place < 0) continue;
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(place)];
    acting[place] = std::clamp(shared[place] + own[k], s.lower, s.upper);
  }
  return acting;
}

bool IsCut(const SharedParameter& of, double shared, double deviation) {
  // On the bound itself it answers to a step inside.
  const double value = shared + deviation, near = 1e-6 * of.scale;
  return value < of.lower - near || value > of.upper + near;
}

std::pair<double, double> OwnBounds(const FitProblem& problem, const OwnParameter& own,
                                    const Eigen::Ref<const Eigen::VectorXd>& shared) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (own.deviation_of < 0) return {-kInfinity, kInfinity};
  const SharedParameter& s = problem.shared[static_cast<std::size_t>(own.deviation_of)];
  return {s.lower - shared[own.deviation_of], s.upper - shared[own.deviation_of]};
}

}  // namespace hoplab
