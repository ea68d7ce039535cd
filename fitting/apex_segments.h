#pragma once

#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// A trace cut at its apexes: one piece from the start to the first apex after a stance, then one
/// a hop, each starting at the state a parabola through its flight shows. In such a piece an error
/// of stiffness shifts one flight, not ten: multiple shooting, with the nodes read off the data.
/// Empty if the trace has no `body_y_m` to see apexes in.
/// The pieces share no row.
std::vector<TrialProblem> CutAtApexes(const FitProblem& problem, const TrialProblem& trial);

/// Flights after a stance that a trial shows, each with its apex; of a ball its bounces. -1 where
/// there is no `body_y_m`, or nothing to cut.
int HopsInData(const FitProblem& problem, const TrialProblem& trial);

/// The pieces of all trials. Priors on shared values of a trial without apexes go over to the first
/// train piece.
std::vector<TrialProblem> CutAllAtApexes(const FitProblem& problem,
                                         const std::vector<TrialProblem>& trials);

/// The problem with every trial replaced by its hops, each a trial with a start of its own: what
/// can be fitted when no parameters let a whole trace be simulated. Trials that show no apexes stay
/// whole.
FitProblem SplitIntoHops(const FitProblem& problem);

}  // namespace hoplab
