#pragma once

#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// Standard deviation of a channel's noise in one trial, in the channel's unit.
double SigmaIn(const FitProblem& problem, const TrialProblem& trial, std::size_t channel);

/// How many times the channel's sigma that is; 1 where the trial has no noise of its own.
double NoiseFactorIn(const TrialProblem& trial, std::size_t channel);

/// Amplitude of a discrepancy in units of the noise of one trial (SigmaIn). What a model lacks is
/// as large where the data scatter more.
double AmplitudeIn(const NoiseModel& noise, const TrialProblem& trial, std::size_t channel);

/// Trials in which a channel's noise clearly differs from its `sigma` get a noise of their own
/// (TrialProblem::noise_factors): a camera that hung badly that day, a marker in the dark. A trial
/// differs by a factor of 1.3 at least and by four standard errors of its own estimate, and two
/// estimates must agree that it does: that of EstimateNoise, against `sigma`, and that of
/// HighFrequencyNoise, against the other trials'. Their mean is taken. Of coordinates and speeds
/// alone, which are parabolas in flight.
/// `only_louder`: of a sigma that is stated, only what is more than that counts.
/// What was found, one sentence a trial.
std::vector<std::string> FindTrialNoise(FitProblem& problem, std::size_t channel,
                                        bool only_louder = false);

}  // namespace hoplab
