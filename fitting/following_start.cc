#include "fitting/following_start.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "fitting/missed_motion.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

constexpr double kFollows = 0.2;  // rms, of the motion's own rms
constexpr double kBetter = 0.5;   // of the mean square that is missed at what is stated
constexpr int kRungsEachWay = 8;
constexpr double kRungRatio = 1.4;

bool IsStiffness(const SharedParameter& s) {
  if (s.direction.of != SensitivityDirection::Of::kParameter) return false;
  const ParameterId id = s.direction.parameter;
  return id == ParameterId::kE || id == ParameterId::kStiffness ||
         id == ParameterId::kLateralStiffness || (id >= ParameterId::kE1 && id <= ParameterId::kE4);
}

double MeanMissedOf(const FitProblem& problem, const std::vector<TrialProblem>& parts,
                    const Eigen::VectorXd& shared, int jobs) {
  std::vector<double> missed(parts.size());
  ParallelFor(static_cast<int>(parts.size()), jobs,
              [&](int i) { missed[i] = MissedMotion(problem, parts[i], shared); });
  return std::accumulate(missed.begin(), missed.end(), 0.0) / static_cast<double>(parts.size());
}

}  // namespace

Eigen::VectorXd FollowingStart(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                               const Eigen::VectorXd& shared, int jobs) {
  std::vector<TrialProblem> parts;
  for (const TrialProblem& trial : trials)
    parts.push_back(FirstPart(problem, trial, kFirstMotion_s));
  Eigen::VectorXd best = shared;
  const double stated = parts.empty() ? 0.0 : MeanMissedOf(problem, parts, shared, jobs);
  if (stated < kFollows * kFollows) return best;
  double least = kBetter * stated;
  for (int rung = -kRungsEachWay; rung <= kRungsEachWay; ++rung) {
    if (rung == 0) continue;
    Eigen::VectorXd scaled = shared;
    for (int k = 0; k < problem.shared_count(); ++k) {
      const SharedParameter& s = problem.shared[static_cast<std::size_t>(k)];
      if (IsStiffness(s))
        scaled[k] = std::clamp(shared[k] * std::pow(kRungRatio, rung), s.lower, s.upper);
    }
    const double missed = MeanMissedOf(problem, parts, scaled, jobs);
    if (missed >= least) continue;
    least = missed;
    best = scaled;
  }
  return best;
}

}  // namespace hoplab
