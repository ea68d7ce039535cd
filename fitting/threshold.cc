#include "fitting/threshold.h"

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

constexpr double kLadder[] = {0.5, 0.8, 1.1, 1.5};  // of the typical size

}  // namespace

std::vector<Eigen::VectorXd> BeginningsBeyondThresholds(const FitProblem& problem,
                                                        const Eigen::VectorXd& shared, int first) {
  // A search begins a little off a null that is a bound.
  const auto at_null = [&](int i) {
    const SharedParameter& s = problem.shared[i];
    return std::abs(shared[i] - s.initial) <= 1e-2 * s.scale;
  };
  std::vector<int> sought, beside;
  for (int i = 0; i < problem.shared_count(); ++i) {
    const SharedParameter& s = problem.shared[i];
    if (s.has_threshold && (i >= first || at_null(i))) sought.push_back(i);
    if (!s.has_threshold && at_null(i) && s.initial == s.lower) beside.push_back(i);
  }
  std::vector<Eigen::VectorXd> beginnings;
  if (sought.empty()) return beginnings;
  for (const double rung : kLadder) {
    beginnings.push_back(shared);
    const auto put = [&](int i, double share) {
      const SharedParameter& s = problem.shared[i];
      beginnings.back()[i] = std::clamp(share * s.scale, s.lower, s.upper);
    };
    for (const int i : sought) put(i, rung);
    for (const int i : beside) put(i, 1.0);
  }
  return beginnings;
}

}  // namespace hoplab
