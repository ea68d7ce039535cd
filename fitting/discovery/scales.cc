#include "fitting/discovery/scales.h"

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

// What a channel says over all trials.
Extent ExtentOf(const FitProblem& problem, Channel which) {
  Extent range;
  const auto channel = std::find_if(problem.channels.begin(), problem.channels.end(),
                                    [&](const ChannelProblem& c) { return c.channel == which; });
  if (channel == problem.channels.end()) return range;
  bool any = false;
  for (const TrialProblem& t : problem.trials) {
    for (auto i = static_cast<std::size_t>(channel - problem.channels.begin()); i < t.data.size();
         i += problem.channels.size()) {
      if (std::isnan(t.data[i])) continue;
      range.least = any ? std::min(range.least, t.data[i]) : t.data[i];
      range.most = any ? std::max(range.most, t.data[i]) : t.data[i];
      any = true;
    }
  }
  return range;
}

}  // namespace

double RoundedToOneDigit(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)));
  return std::max(1.0, std::round(value / digit)) * digit;
}

NaturalScales ScalesOf(const FitProblem& problem) {
  NaturalScales s;
  s.x = ExtentOf(problem, Channel::kBodyX);
  s.y = ExtentOf(problem, Channel::kBodyY);
  double longest = 0.0;
  for (const TrialProblem& t : problem.trials)
    if (!t.row_times.empty()) longest = std::max(longest, t.row_times.back());
  const Parameters<double>& p = problem.trials.front().parameters;
  if (!s.y.empty()) s.length = RoundedToOneDigit(s.y.most - s.y.least);
  s.speed = RoundedToOneDigit(std::sqrt(2.0 * p.g * s.length));
  if (longest > 0.0) s.time = RoundedToOneDigit(longest);
  s.force = p.m * p.g;
  return s;
}

}  // namespace hoplab
