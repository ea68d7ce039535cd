#include "fitting/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hoplab {
namespace {

constexpr double kChi2Level = 3.841458820694124;  // 95 % of chi-square with one degree of freedom

struct Walker {
  const FitProblem& problem;
  const std::vector<TrialProblem>& trials;
  const FitOptions& options;
  int parameter;
  double best_cost;

  // Refits everything but `parameter`, held at `value`, starting from `from`.
  SolveResult At(double value, const Eigen::VectorXd& shared,
                 const std::vector<OwnValues>& initial_states) const {
    SolveRequest request;
    request.problem = &problem;
    request.trials = &trials;
    request.shared = shared;
    request.shared[parameter] = value;
    request.initial_states = initial_states;
    request.held = {parameter};
    request.loss = options.loss;
    request.max_iterations = 50;
    request.jobs = options.jobs;
    request.stop = options.stop;
    return Solve(request);
  }
};

double Crossing(const ProfilePoint& a, const ProfilePoint& b) {
  // The square root of a profile is close to linear.
  const double u = std::sqrt(std::max(a.delta_chi2, 0.0)), v = std::sqrt(b.delta_chi2);
  const double share = (std::sqrt(kChi2Level) - u) / (v - u);
  return a.value + share * (b.value - a.value);
}

}  // namespace

Profile ComputeProfile(const FitProblem& problem, const FitResult& fit, const FitOptions& options,
                       int parameter, double first_step, double inflation, int max_points) {
  const std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  const Walker walker{problem, trials, options, parameter, fit.cost};
  const SharedParameter& s = problem.shared[parameter];
  Profile profile{parameter, {}, {}, {}};
  const ProfilePoint middle{fit.shared[parameter], 0.0, fit.shared};
  for (const double side : {-1.0, 1.0}) {
    std::vector<ProfilePoint> points;
    Eigen::VectorXd shared = fit.shared;
    std::vector<OwnValues> initial_states = fit.initial_states;
    double step = first_step;
    ProfilePoint last = middle;
    for (int i = 0; i < max_points; ++i) {
      const double value = std::clamp(last.value + side * step, s.lower, s.upper);
      if (value == last.value) break;
      SolveResult result = walker.At(value, shared, initial_states);
      if (!IsUsable(result.status)) break;
      const ProfilePoint point{value, 2.0 * (result.cost - fit.cost) / inflation, result.shared};
      if (last.delta_chi2 < kChi2Level && point.delta_chi2 >= kChi2Level)
        (side < 0.0 ? profile.lower95 : profile.upper95) = Crossing(last, point);
      points.push_back(point);
      const double rise = point.delta_chi2 - last.delta_chi2;
      if (rise < 0.5) step *= 2.0;  // flat: stride out
      if (rise > 3.0) step *= 0.5;
      last = point;
      shared = result.shared;
      initial_states = result.initial_states;
      if (point.delta_chi2 > 2.0 * kChi2Level) break;
    }
    if (side < 0.0) {
      std::reverse(points.begin(), points.end());
      profile.points = points;
      profile.points.push_back(middle);
    } else {
      profile.points.insert(profile.points.end(), points.begin(), points.end());
    }
  }
  return profile;
}

}  // namespace hoplab
