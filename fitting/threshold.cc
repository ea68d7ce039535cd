#include "fitting/threshold.h"

#include <algorithm>

namespace hoplab {
namespace {

constexpr double kLadder[] = {0.5, 0.8, 1.1, 1.5};  // of the typical size

}  // namespace

std::vector<Eigen::VectorXd> BeginningsBeyondThresholds(const FitProblem& problem,
                                                        const Eigen::VectorXd& shared, int first) {
  std::vector<Eigen::VectorXd> beginnings;
  if (std::none_of(problem.shared.begin() + first, problem.shared.end(),
                   [](const SharedParameter& s) { return s.has_threshold; }))
    return beginnings;
  for (const double rung : kLadder) {
    beginnings.push_back(shared);
    for (int i = first; i < problem.shared_count(); ++i) {
      const SharedParameter& s = problem.shared[static_cast<std::size_t>(i)];
      if (s.has_threshold) beginnings.back()[i] = std::clamp(rung * s.scale, s.lower, s.upper);
    }
  }
  return beginnings;
}

}  // namespace hoplab
