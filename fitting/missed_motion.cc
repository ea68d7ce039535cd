#include "fitting/missed_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fitting/fit.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

constexpr double kFarOff = 1.0;  // what a sample is counted as at most, or without a simulation
constexpr double kLeastMotion = 10.0;    // standard deviations of the noise
constexpr double kLeastTurn_rad = 0.02;  // of a leg that is held

bool ShowsMotion(Channel c) { return IsPose(c) || IsAngleOfLeg(c); }

}  // namespace

double MissedMotion(const FitProblem& problem, const TrialProblem& trial) {
  return MissedMotion(problem, trial, InitialShared(problem));
}

double MissedMotion(const FitProblem& problem, const TrialProblem& trial,
                    const Eigen::VectorXd& shared) {
  Trajectory simulated;
  TrialEvaluator(problem, trial)
      .Simulate({shared, trial.start, false}, problem.integrator, simulated);
  const std::size_t width = problem.channels.size();
  const std::size_t rows = trial.row_times.size();
  double missed = 0.0;
  int channels = 0;
  for (std::size_t c = 0; c < width; ++c) {
    if (!ShowsMotion(problem.channels[c].channel)) continue;
    double count = 0.0, sum = 0.0, squares = 0.0;
    for (std::size_t row = 0; row < rows; ++row) {
      const double value = trial.data[row * width + c];
      if (std::isnan(value)) continue;
      count += 1.0;
      sum += value;
      squares += value * value;
    }
    if (count < 2.0) continue;
    const bool of_leg = IsAngleOfLeg(problem.channels[c].channel);
    const double least =
        std::max(kLeastMotion * problem.channels[c].sigma, of_leg ? kLeastTurn_rad : 0.0);
    const double motion = std::max(squares / count - sum * sum / (count * count), least * least);
    double off = 0.0;
    for (std::size_t row = 0; row < rows; ++row) {
      const double value = trial.data[row * width + c];
      if (std::isnan(value)) continue;
      const double miss = simulated.samples[row * width + c] - value;
      off += std::isfinite(miss) ? std::min(miss * miss / motion, kFarOff) : kFarOff;
    }
    missed += off / count;
    ++channels;
  }
  return channels > 0 ? missed / channels : 0.0;
}

std::string MissedPercent(double missed) {
  char text[16];
  std::snprintf(text, sizeof text, "%.0f %%", 100.0 * std::sqrt(missed));
  return text;
}

}  // namespace hoplab
