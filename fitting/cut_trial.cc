#include <algorithm>
#include <cmath>
#include <limits>

#include "fitting/driven_trial.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {

TrialProblem CutTrial(const FitProblem& problem, const TrialProblem& trial, int first, int last) {
  TrialProblem cut = trial;
  const std::size_t width = problem.channels.size();
  const double origin = trial.row_times[first], end = trial.row_times[last - 1] - origin;
  cut.row_times.assign(trial.row_times.begin() + first, trial.row_times.begin() + last);
  for (double& t : cut.row_times) t -= origin;
  cut.begin_s += origin;
  cut.parameters.time_origin += origin;
  cut.data.assign(trial.data.begin() + static_cast<std::ptrdiff_t>(first * width),
                  trial.data.begin() + static_cast<std::ptrdiff_t>(last * width));
  cut.sample_count =
      std::count_if(cut.data.begin(), cut.data.end(), [](double v) { return !std::isnan(v); });
  const auto cut_times = [&](const std::vector<double>& times, const std::vector<double>& sigmas,
                             std::vector<double>& out, std::vector<double>& out_sigmas) {
    out.clear();
    out_sigmas.clear();
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double t = times[i] - origin;
      if (t <= 0.0 || t >= end) continue;
      out.push_back(t);
      out_sigmas.push_back(sigmas[i]);
      ++cut.sample_count;
    }
  };
  cut_times(trial.contact.touchdown_s, trial.contact.touchdown_sigma_s, cut.contact.touchdown_s,
            cut.contact.touchdown_sigma_s);
  cut_times(trial.contact.liftoff_s, trial.contact.liftoff_sigma_s, cut.contact.liftoff_s,
            cut.contact.liftoff_sigma_s);
  if (first > 0) {
    for (OwnParameter& o : cut.own) {
      if (o.direction.of == SensitivityDirection::Of::kInitialState)
        o.prior_sigma = std::numeric_limits<double>::infinity();
    }
  }
  CutDriven(cut, origin, end, first == 0);
  return cut;
}

double LongestTrial(const std::vector<TrialProblem>& trials) {
  double longest = 0.0;
  for (const TrialProblem& t : trials) longest = std::max(longest, t.row_times.back());
  return longest;
}

TrialProblem FirstPart(const FitProblem& problem, const TrialProblem& trial, double until) {
  int last = 1;
  while (last < static_cast<int>(trial.row_times.size()) && trial.row_times[last] <= until) ++last;
  return CutTrial(problem, trial, 0, last);
}

}  // namespace hoplab
