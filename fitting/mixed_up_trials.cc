#include "fitting/mixed_up_trials.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "fitting/missed_motion.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

constexpr std::size_t kMostTrials = 40;   // pairs grow with the square
constexpr double kLeastMissed = 0.125;    // rms, of a trial's own motion
constexpr double kBetterExchanged = 0.4;  // rms of both, of what is missed as it stands
constexpr double kEach = 0.75;            // the same of one alone

// What two trials may have of each other.
enum class Mixed { kAngles, kAnglesAndStarts };

using Of = SensitivityDirection::Of;

// Own values that both have along the same direction.
void TakeOwn(Of of, const TrialProblem& other, TrialProblem& trial) {
  for (int k = 0; k < trial.own_count(); ++k) {
    const OwnParameter& mine = trial.own[static_cast<std::size_t>(k)];
    if (mine.direction.of != of || mine.deviation_of >= 0) continue;
    for (int j = 0; j < other.own_count(); ++j) {
      const OwnParameter& theirs = other.own[static_cast<std::size_t>(j)];
      if (theirs.deviation_of < 0 && theirs.name == mine.name) trial.start[k] = other.start[j];
    }
  }
}

// The first rows of `trial` with what is stated of `other`.
TrialProblem WithStatedOf(const FitProblem& problem, TrialProblem trial, const TrialProblem& other,
                          Mixed what) {
  trial.parameters.theta_td = other.parameters.theta_td;
  std::copy_n(other.touchdown_angles.begin(),
              std::min(trial.touchdown_angles.size(), other.touchdown_angles.size()),
              trial.touchdown_angles.begin());
  TakeOwn(Of::kTouchdownAngle, other, trial);
  if (what == Mixed::kAnglesAndStarts) TakeOwn(Of::kInitialState, other, trial);
  return FirstPart(problem, trial, kFirstMotion_s);
}

bool HaveOneAngle(const TrialProblem& a, const TrialProblem& b) {
  return a.parameters.theta_td == b.parameters.theta_td && a.touchdown_angles == b.touchdown_angles;
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
  std::string what = "touchdown_angle_deg";
  if (pair.what == Mixed::kAnglesAndStarts)
    what = (HaveOneAngle(trials[i], trials[j]) ? "" : what + " and ") + "initial, or file";
  return trials[i].file + " and " + trials[j].file + " seem to have each other's " + what +
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
    const double missed = MissedMotion(problem, FirstPart(problem, trial, kFirstMotion_s));
    if (missed < kLeastMissed * kLeastMissed) continue;
    trials.push_back(trial);
    as_stated.push_back(missed);
    if (trials.size() == kMostTrials) break;
  }
  std::vector<Pair> found;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    for (std::size_t j = i + 1; j < trials.size(); ++j) {
      if (trials[i].start_mode != trials[j].start_mode) continue;
      for (const Mixed what : {Mixed::kAngles, Mixed::kAnglesAndStarts}) {
        const auto exchanged = [&](std::size_t trial, std::size_t other) {
          return MissedMotion(problem, WithStatedOf(problem, trials[trial], trials[other], what));
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
