#include "fitting/leg_starts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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

// How many turns more than the simulation's the first samples of a leg's column say; absent where
// they say another angle.
std::optional<int> TurnsMore(const FitProblem& problem, const TrialProblem& whole,
                             const Eigen::VectorXd& shared, std::size_t channel) {
  constexpr double kTurn = 2.0 * std::numbers::pi, kNear = 1.0;  // rad
  const TrialProblem trial = FirstPart(problem, whole, kFirst_s);
  Trajectory simulated;
  TrialEvaluator(problem, trial)
      .Simulate({shared, trial.start, false}, problem.integrator, simulated);
  std::vector<double> more;
  for (std::size_t cell = channel; cell < trial.data.size(); cell += problem.channels.size())
    if (const double off = trial.data[cell] - simulated.samples[cell]; std::isfinite(off))
      more.push_back(off);
  if (more.size() < kFewestRows) return std::nullopt;
  const auto middle = more.begin() + static_cast<std::ptrdiff_t>(more.size() / 2);
  std::nth_element(more.begin(), middle, more.end());
  const double turns = std::round(*middle / kTurn);
  if (std::abs(*middle - turns * kTurn) > kNear) return std::nullopt;
  return static_cast<int>(turns);
}

}  // namespace

std::vector<std::string> LegTurns(const FitProblem& problem) {
  const std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  std::vector<std::string> sentences;
  if (trials.empty() || !trials.front().parameters.robot) return sentences;
  const Eigen::VectorXd shared = InitialShared(problem);
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    if (!IsAngleOfLeg(problem.channels[c].channel)) continue;
    std::optional<int> turns;
    bool alike = true;
    for (const TrialProblem& trial : trials) {
      const std::optional<int> more = TurnsMore(problem, trial, shared, c);
      alike = alike && more && *more != 0 && (!turns || *turns == *more);
      turns = more;
    }
    if (!alike || !turns) continue;
    sentences.push_back(
        std::string(ChannelName(problem.channels[c].channel)) + " begins " +
        std::to_string(std::abs(*turns)) + (std::abs(*turns) == 1 ? " turn " : " turns ") +
        (*turns > 0 ? "above" : "below") +
        " its motor's angle in every train trial, as an encoder does that counts "
        "since it was switched on; take " +
        FormatDouble(std::round(*turns * 2e6 * std::numbers::pi) / 1e6) + " rad from that column");
  }
  return sentences;
}

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
