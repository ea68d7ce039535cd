#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "datasets/dataset.h"
#include "model/simulate.h"

namespace hoplab {

/// A physical quantity all trials share and the fit may move: a parameter of the mechanism or one
/// of an effect. Values in its own unit; the optimiser works with value/scale.
struct SharedParameter {
  std::string name;  // "E", "air_drag.c_drag"
  std::string unit;
  SensitivityDirection direction;
  double lower, upper;  // physical bounds, closed
  double initial;       // nominal value
  double scale;         // one typical size of it, > 0
  /// The one recording (TrialProblem::recording) in which it acts; empty: in all. Elsewhere an
  /// effect's parameter stays at its null.
  std::string only_recording = {};
};

/// How a contact channel's switching times are compared with the events of a simulation.
struct ContactTimes {
  std::vector<double> touchdown_s, liftoff_s;  // middle between the rows they lie between
  std::vector<double> touchdown_sigma_s, liftoff_sigma_s;  // uniform over that gap: gap/sqrt(12)
};

/// One recorded trial, ready to be compared with a simulation. Row times count from the first row.
struct TrialProblem {
  std::string file;
  std::string recording;  // the file it was cut from; `file` itself for a whole trial
  TrialRole role = TrialRole::kTrain;
  Parameters<double> parameters;  // of this trial; shared values are put over them
  LiftoffRule liftoff = LiftoffRule::kZeroForce;
  double begin_s = 0.0;           // the first row's time in the dataset's own file
  std::vector<double> row_times;  // s since the first row
  std::vector<double> data;       // row-major [row][channel]; NaN = missing
  ContactTimes contact;
  std::array<double, 4> start{};  // x, y [m], vx, vy [m/s]: where the fit begins
  /// Gaussian prior on the start; an infinite sigma is no prior.
  std::array<double, 4> prior_mean{};
  std::array<double, 4> prior_sigma{};
  /// Components no channel can see (x without body_x) are held.
  std::array<bool, 4> start_free{true, true, true, true};
  std::array<double, 4> start_scale{};  // one typical size of a change, > 0
  long sample_count = 0;                // finite entries of `data`, contact times included
};

/// A channel that is compared, and its noise.
struct ChannelProblem {
  Channel channel;
  double sigma;          // 1 standard deviation in the channel's unit
  bool sigma_estimated;  // from the traces, not stated
};

/// A dataset as a least-squares problem: what is shared, what each trial has of its own.
struct FitProblem {
  Law law = Law::kLargeDeflection;
  std::vector<SharedParameter> shared;
  std::vector<EffectSetting> effects;    // with their nominal values
  std::vector<ChannelProblem> channels;  // without `contact`
  bool uses_contact = false;
  std::vector<TrialProblem> trials;
  IntegratorOptions integrator;
  std::vector<std::string> notes;  // what was decided on the way, for the reader

  /// Whether the leg has a mass at its toe in any trial.
  LegMass leg_mass() const;
  int shared_count() const { return static_cast<int>(shared.size()); }
  std::vector<std::string> shared_names() const;
};

/// What of a dataset is fitted, and how it is set up.
struct ProblemOptions {
  std::string law;                        // empty: the mechanism's default
  std::vector<std::string> free;          // empty: the mechanism's default
  std::map<std::string, double> fix;      // parameter (or effect.parameter) = value
  std::vector<std::string> with_effects;  // their parameters are freed
  IntegratorOptions integrator;
};

/// Sets the problem up. Throws InputError (place: the option) for unknown names, values out of
/// bounds, a parameter that differs between trials but is to be shared.
FitProblem MakeProblem(const Dataset& dataset, const ProblemOptions& options);

/// Values of the shared parameters at which a search starts: nominal, but off their bounds.
Eigen::VectorXd InitialShared(const FitProblem& problem);

}  // namespace hoplab
