#include "fitting/mixed_up_trials.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "fitting/missed_motion.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

constexpr double kLookedAt_s = 0.5;       // a hop or so
constexpr std::size_t kMostTrials = 40;   // pairs grow with the square
constexpr double kLeastMissed = 0.125;    // rms, of a trial's own motion
constexpr double kBetterExchanged = 0.5;  // rms of both, of what is missed as it stands
constexpr double kEach = 0.75;            // the same of one alone

// What two trials may have of each other.
enum class Mixed { kAngles, kAnglesAndStarts };

// What is stated of `other`, with the samples of `trial`.
TrialProblem WithStatedOf(TrialProblem trial, const TrialProblem& other, Mixed what) {
  trial.parameters.theta_td = other.parameters.theta_td;
  trial.touchdown_angles = other.touchdown_angles;
  if (what == Mixed::kAnglesAndStarts) trial.start = other.start;
  return trial;
}

bool CanHaveStatedOf(const TrialProblem& a, const TrialProblem& b) {
  return a.own_count() == b.own_count() && a.start_mode == b.start_mode;
}

struct Pair {
  std::array<std::size_t, 2> trials;
  std::array<double, 2> missed;  // mean squares, exchanged
  Mixed what;
  double sum() const { return missed[0] + missed[1]; }
};

std::string SentenceOf(const Pair& pair, const std::vector<TrialProblem>& trials,
                       const std::vector<double>& as_stated) {
  const auto [i, j] = pair.trials;
  const bool angles = pair.what == Mixed::kAngles;
  return trials[i].file + " and " + trials[j].file + " seem to have each other's " +
         (angles ? "touchdown_angle_deg" : "touchdown_angle_deg and initial, or file") +
         ": at the nominal values the simulation misses " + MissedPercent(as_stated[i]) + " and " +
         MissedPercent(as_stated[j]) + " of their motion, and " + MissedPercent(pair.missed[0]) +
         " and " + MissedPercent(pair.missed[1]) + " with these exchanged";
}

}  // namespace

std::vector<std::string> MixedUpTrials(const FitProblem& problem) {
  if (problem.trials.empty() || problem.trials.front().parameters.robot) return {};
  std::vector<TrialProblem> trials;
  std::vector<double> as_stated;
  for (const TrialProblem& trial : problem.trials) {
    TrialProblem part = FirstPart(problem, trial, kLookedAt_s);
    const double missed = MissedMotion(problem, part);
    if (missed < kLeastMissed * kLeastMissed || trials.size() == kMostTrials) continue;
    trials.push_back(std::move(part));
    as_stated.push_back(missed);
  }
  std::vector<Pair> found;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    for (std::size_t j = i + 1; j < trials.size(); ++j) {
      if (!CanHaveStatedOf(trials[i], trials[j])) continue;
      for (const Mixed what : {Mixed::kAngles, Mixed::kAnglesAndStarts}) {
        const auto exchanged = [&](std::size_t trial, std::size_t other) {
          return MissedMotion(problem, WithStatedOf(trials[trial], trials[other], what));
        };
        const Pair pair{{i, j}, {exchanged(i, j), exchanged(j, i)}, what};
        const double sum = as_stated[i] + as_stated[j];
        if (pair.missed[0] <= kEach * kEach * as_stated[i] &&
            pair.missed[1] <= kEach * kEach * as_stated[j] &&
            pair.sum() <= kBetterExchanged * kBetterExchanged * sum)
          found.push_back(pair);
      }
    }
  }
  // A trial belongs to one pair, the one that is followed best.
  std::stable_sort(found.begin(), found.end(),
                   [](const Pair& a, const Pair& b) { return a.sum() < b.sum(); });
  std::vector<std::string> sentences;
  std::vector<char> told(trials.size(), 0);
  for (const Pair& pair : found) {
    const auto [i, j] = pair.trials;
    if (told[i] || told[j]) continue;
    told[i] = told[j] = 1;
    sentences.push_back(SentenceOf(pair, trials, as_stated));
  }
  return sentences;
}

}  // namespace hoplab
