#pragma once

#include <span>
#include <vector>

#include "fitting/diagnosis/fitted_model.h"
#include "fitting/diagnosis/linearisation.h"

namespace hoplab {

/// The model linearised, under its noise, with the columns of candidates it does not have, at their
/// null; any number of them. Rows are compressed: each trial has as many as there are columns and
/// one, whose sums of products are those of all its rows, so that memory does not grow with the
/// length of the trials. Their labels name the trial alone, and `raw` and `leverage` are empty.
/// (Linearise gives every row.)
Linearisation LineariseAt(const FittedModel& model, std::span<const Candidate> tested,
                          const std::vector<TrialProblem>& train, int jobs);

/// Shared values that move nothing in any trial, such as what a ball loses at a bounce where none
/// bounces, go back to their nominal values, where that leaves the fit as it is: a search of a
/// smaller model may have left them anywhere. The members' values stay.
void RestateUnseen(const std::vector<TrialProblem>& train, int jobs, FittedModel& model);

}  // namespace hoplab
