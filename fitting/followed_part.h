#pragma once

#include <optional>

#include "fitting/fit.h"

namespace hoplab {

/// All trials cut at `until` [s].
FitProblem FirstPart(const FitProblem& problem, double until);

/// When, in the simulations at the nominal values, every leg of a robot has stood once in every
/// trial [s], and a little more: a tenth, or half of the time until the next leg lands. Trials that
/// fall before are left out; absent where all do.
std::optional<double> FirstStancesOver(const FitProblem& problem);

/// The least part of the trials that tells something of the legs: in the simulations at the nominal
/// values the first leg of every trial has landed, and a tenth more [s].
double LeastPart(const FitProblem& problem);

/// Each part of the trials that is tried is longer than the last by this.
inline constexpr double kLonger = 1.5;
/// Where the first one cannot be fitted, so many shorter ones are.
inline constexpr int kShorterParts = 2;

/// Which first parts of the trials are tried, one after the other: the first stances, and longer
/// and longer ones; where the first stances cannot be fitted, shorter ones, and from there none as
/// long as what failed.
class Parts {
 public:
  explicit Parts(const FitProblem& problem);
  bool IsLeft() const { return until_ < end_; }
  double until() const { return until_; }
  bool IsShorterThanStances() const { return shorter_ < kShorterParts; }
  /// This one can be fitted, or cannot.
  void Follows();
  void Fails();

 private:
  double until_, least_, end_;
  int shorter_ = kShorterParts;
  bool followed_ = false;
};

/// As much of every trial as a model can be fitted to.
struct FollowedPart {
  double until = 0.0;  // s
  FitProblem problem;  // the one whose trials are cut there
  FitResult result;    // a minimum
};

/// Fits longer and longer first parts of all trials, up to the longest whose fit is a minimum. A
/// gait magnifies what is wrong with a model from stride to stride, until its simulation goes
/// another way than the robot and the least cost lies in no valley; the first stances can still be
/// fitted. Absent where not even these can.
std::optional<FollowedPart> FitFollowedPart(const FitProblem& problem, const FitOptions& options);

}  // namespace hoplab
