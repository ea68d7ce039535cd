#pragma once

#include <optional>
#include <utility>

#include "fitting/problem.h"

namespace hoplab {

// One trial's deviation of a shared value: an own value with a Gaussian prior of mean 0. In the
// trial acts the shared value plus the deviation, cut to the shared value's bounds.

/// Appends to `trial` a deviation of the shared value at `place`, 0 at its start, with the prior
/// sigma `spread` [the value's unit, > 0], which is its scale, too. False, and nothing is done, if
/// the value does not act in the trial or the trial has the deviation already.
bool AddDeviation(const FitProblem& problem, int place, double spread, TrialProblem& trial);

/// Gives the trial's deviation of that shared value another prior sigma and scale; nothing if it
/// has none.
void SetSpread(int place, double spread, TrialProblem& trial);

/// Place among the trial's own values of its deviation of a shared value; nothing if it has none.
std::optional<int> DeviationOf(int place, const TrialProblem& trial);

/// The shared values as they act in one trial: deviations added, cut to the bounds.
Eigen::VectorXd ActingShared(const FitProblem& problem, const TrialProblem& trial,
                             const Eigen::Ref<const Eigen::VectorXd>& shared,
                             const Eigen::Ref<const OwnValues>& own);

/// Whether a deviation leads beyond the bounds: the trial answers to neither it nor its value.
bool IsCut(const SharedParameter& of, double shared, double deviation);

/// Least and greatest value of an own value that keep what acts within its bounds, the shared
/// values as given; infinite for what is no deviation.
std::pair<double, double> OwnBounds(const FitProblem& problem, const OwnParameter& own,
                                    const Eigen::Ref<const Eigen::VectorXd>& shared);

}  // namespace hoplab
