#pragma once

#include <string>
#include <vector>

#include "datasets/dataset.h"
#include "fitting/problem.h"

namespace hoplab {

// What a fit of a robot has that one of a hopper has not.

/// Its legs have the modulus of all, or each its own: where the dataset says so, or one of them is
/// asked for.
void ChooseModuli(const ProblemOptions& options, FitProblem& problem);

/// Whether a parameter means something of a robot with this many legs, and this way of telling
/// their moduli; true of any other mechanism.
bool IsOfRobot(ParameterId id, const FitProblem& problem);

/// What is free unless asked otherwise, of any mechanism.
std::vector<std::string> FreeNames(const FitProblem& problem);

/// Appends pitch and pitch rate at the first row to a trial's own values.
void AddPitch(const Trial& trial, TrialProblem& t);

/// Where a trial begins with feet on the ground at the nominal values, appends how far each of them
/// is ahead (M119) to its own values: no start tells how far a leg leans. The trials, by file.
std::vector<std::string> AddStandingFeet(FitProblem& problem);

}  // namespace hoplab
