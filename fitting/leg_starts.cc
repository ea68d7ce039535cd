#include "fitting/leg_starts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "datasets/suspect_things.h"
#include "fitting/fit.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

constexpr double kFirst_s = 0.02;
constexpr std::size_t kFewestRows = 4;
constexpr double kOff = 0.5;             // of the larger of two rates
constexpr double kLeastOff_rad_s = 5.0;  // a loaded leg may give way at some rad/s
constexpr double kSureOff = 8.0;         // sigmas, over that time

// Of the line through the rows that a channel has [rad/s].
std::optional<double> RateOf(const TrialProblem& trial, const std::vector<double>& cells,
                             std::size_t width, std::size_t channel) {
  std::vector<double> times, values;
  for (std::size_t row = 0; row < trial.row_times.size(); ++row) {
    const double value = cells[row * width + channel];
    if (!std::isfinite(value)) continue;
    times.push_back(trial.row_times[row]);
    values.push_back(value);
  }
  if (times.size() < kFewestRows) return std::nullopt;
  return MedianSlope(times, values);
}

// What is seen of one leg that begins otherwise.
struct Otherwise {
  std::string leg;
  double logged, simulated;  // rad/s
};

std::optional<Otherwise> BeginsOtherwise(const FitProblem& problem, const TrialProblem& whole,
                                         const Eigen::VectorXd& shared) {
  const TrialProblem trial = FirstPart(problem, whole, kFirst_s);
  Trajectory simulated;
  TrialEvaluator(problem, trial)
      .Simulate({shared, trial.start, false}, problem.integrator, simulated);
  const std::size_t width = problem.channels.size();
  for (std::size_t c = 0; c < width; ++c) {
    const ChannelProblem& channel = problem.channels[c];
    if (!IsAngleOfLeg(channel.channel)) continue;
    const auto logged = RateOf(trial, trial.data, width, c);
    const auto own = RateOf(trial, simulated.samples, width, c);
    if (!logged || !own) continue;
    const double off = std::abs(*logged - *own);
    const double larger = std::max(std::abs(*logged), std::abs(*own));
    if (off > std::max({kOff * larger, kLeastOff_rad_s, kSureOff * channel.sigma / kFirst_s}))
      return Otherwise{ChannelName(channel.channel), *logged, *own};
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> LegStarts(const FitProblem& problem) {
  const std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  const Eigen::VectorXd shared = InitialShared(problem);
  std::optional<Otherwise> first;
  for (const TrialProblem& trial : trials) {
    if (!trial.parameters.robot || trial.parameters.robot->control != MotorControl::kClock)
      return {};
    const std::optional<Otherwise> seen = BeginsOtherwise(problem, trial, shared);
    if (!seen) return {};
    if (!first) first = seen;
  }
  if (!first) return {};
  return {first->leg + " of " + trials.front().file + " begins to turn at " +
          FormatDouble(std::round(first->logged)) +
          " rad/s, where the clock as stated turns it at " +
          FormatDouble(std::round(first->simulated)) + " rad/s" +
          (trials.size() > 1 ? ", and so in every train trial" : "") +
          "; check the clock's phases, duty, period and sweep: a fit hardly finds back from the "
          "other piece of a turn"};
}

}  // namespace hoplab
