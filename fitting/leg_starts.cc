#include "fitting/leg_starts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "fitting/fit.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

constexpr double kFirst_s = 0.02;
constexpr std::size_t kFewestRows = 4;
constexpr double kOff = 0.5;             // of the larger of two rates
constexpr double kLeastOff_rad_s = 5.0;  // a loaded leg may give way at some rad/s
constexpr double kSureOff = 8.0;         // standard errors of the logged rate

struct Rate {
  double value, std_error;  // rad/s
};

// The slope of a channel's line over the rows it has.
std::optional<Rate> RateOf(const TrialProblem& trial, const std::vector<double>& cells,
                           std::size_t width, std::size_t channel, double sigma) {
  double n = 0.0, t = 0.0, y = 0.0, tt = 0.0, ty = 0.0;
  for (std::size_t row = 0; row < trial.row_times.size(); ++row) {
    const double value = cells[row * width + channel];
    if (!std::isfinite(value)) continue;
    const double time = trial.row_times[row];
    n += 1.0;
    t += time;
    y += value;
    tt += time * time;
    ty += time * value;
  }
  const double spread = tt - t * t / n;
  if (n < static_cast<double>(kFewestRows) || !(spread > 0.0)) return std::nullopt;
  return Rate{(ty - t * y / n) / spread, sigma / std::sqrt(spread)};
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
    const auto logged = RateOf(trial, trial.data, width, c, channel.sigma);
    const auto own = RateOf(trial, simulated.samples, width, c, channel.sigma);
    if (!logged || !own) continue;
    const double off = std::abs(logged->value - own->value);
    const double larger = std::max(std::abs(logged->value), std::abs(own->value));
    if (off > std::max({kOff * larger, kLeastOff_rad_s, kSureOff * logged->std_error}))
      return Otherwise{ChannelName(channel.channel), logged->value, own->value};
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
          " rad/s, where the clock as it is stated turns it at " +
          FormatDouble(std::round(first->simulated)) +
          " rad/s, and a leg of every other train trial likewise. State the clock's phases, duty, "
          "period and sweep as they "
          "were: from the other piece of a turn no fit leads back"};
}

}  // namespace hoplab
