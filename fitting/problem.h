#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "datasets/dataset.h"
#include "fitting/discrepancy/noise_model.h"
#include "fitting/known.h"
#include "fitting/trace_faults.h"
#include "model/simulate.h"

namespace hoplab {

/// Recordings, by their files; none stands for all.
using Recordings = std::vector<std::string>;
/// Whether what acts in `of` acts in this one.
bool Holds(const Recordings& of, const std::string& recording);

/// A physical quantity all trials share and the fit may move: a parameter of the mechanism or one
/// of an effect. Values in its own unit; the optimiser works with value/scale.
struct SharedParameter {
  std::string name;  // "E", "air_drag.c_drag"
  std::string unit;
  SensitivityDirection direction;
  double lower, upper;  // physical bounds, closed
  double initial;       // nominal value
  double scale;         // one typical size of it, > 0
  /// The recordings (TrialProblem::recording) in which it acts; empty: all. Elsewhere an effect's
  /// parameter stays at its null.
  Recordings only_recordings = {};
  /// Small sizes change nothing (EffectInfo::has_threshold).
  bool has_threshold = false;
  /// It stays where it is; only deviations of it are fitted (fitting/deviation.h).
  bool held = false;
};

/// A value one trial has of its own, to be fitted beside the shared ones: a component of its start,
/// or how far a shared value is off in this trial (fitting/deviation.h).
struct OwnParameter {
  std::string name;  // "vx0"
  SensitivityDirection direction;
  double scale = 1.0;  // one typical size of a change, > 0
  /// Gaussian prior; an infinite sigma is no prior.
  double prior_mean = 0.0;
  double prior_sigma = std::numeric_limits<double>::infinity();
  bool free = true;  // what no channel can see (x without body_x) is held
  /// Place of the shared value it is added to; -1: it is none's deviation.
  int deviation_of = -1;
};
/// Values of one trial's own parameters, in their own units.
using OwnValues = Eigen::VectorXd;

/// How a contact channel's switching times are compared with the events of a simulation.
struct ContactTimes {
  std::vector<double> touchdown_s, liftoff_s;  // middle between the rows they lie between
  std::vector<double> touchdown_sigma_s, liftoff_sigma_s;  // uniform over that gap: gap/sqrt(12)
};

/// A logged column that drives a trial's simulation; times count from the trial's first row.
struct DrivenColumn {
  InputKind kind = InputKind::kHipTorque;
  std::vector<double> times = {}, values = {};
  bool held = false, of_stance = false;
  double delay = 0.0, scale = 1.0;
  int clock = -1;  // of FitProblem::clocks
};

/// A Gaussian prior on a shared value, counted once: by the trial that carries it.
struct SharedPrior {
  int shared = 0;  // place among the problem's shared values
  double mean = 0.0, sigma = 1.0;
};

/// Sensors that share a clock: what it stamps t was read at t + offset.
struct ClockProblem {
  std::string name;
  double offset = 0.0;     // s, nominal
  double sigma = 0.0;      // how well it is known; 0: exactly
  bool per_trial = false;  // each trial's own
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
  /// Of each channel: how many times its sigma the noise is in this trial; empty: 1 (SigmaIn).
  std::vector<double> noise_factors;
  ContactTimes contact;
  /// The components of the start first: x, y [m], vx, vy [m/s], in stance the contact's place [m].
  std::vector<OwnParameter> own;
  OwnValues start;  // values of `own` where the fit begins
  Mode start_mode = Mode::kFlight;
  std::vector<double> touchdown_angles;  // one a touch-down [rad]; empty: parameters.theta_td
  std::vector<double> touchdown_times;   // of those, as the trace shows them [s]
  std::vector<DrivenColumn> inputs;
  std::vector<SharedPrior> shared_priors;
  long sample_count = 0;  // finite entries of `data`, contact times included

  int own_count() const { return static_cast<int>(own.size()); }
};

/// A channel that is compared, and its noise.
struct ChannelProblem {
  Channel channel;
  double sigma;          // 1 standard deviation in the channel's unit
  bool sigma_estimated;  // from the traces, not stated
  int clock = -1;        // of FitProblem::clocks; -1: the trial's own time
};

/// A dataset as a least-squares problem: what is shared, what each trial has of its own.
struct FitProblem {
  Law law = Law::kElastica;
  std::vector<SharedParameter> shared;
  std::vector<EffectSetting> effects;  // with their nominal values
  /// Effects beside the catalogue: the dataset's own formulas and those asked for by their files.
  std::vector<const Effect*> formulas;
  std::vector<ClockProblem> clocks;
  KnownCauses known;                     // what the set-up rules out or bounds
  std::vector<ChannelProblem> channels;  // without `contact`
  bool uses_contact = false;
  int contact_clock = -1;  // of `clocks`; -1: the trial's own time
  std::vector<TrialProblem> trials;
  NoiseModel noise;  // white until it is estimated
  IntegratorOptions integrator;
  std::vector<std::string> notes;        // what was decided on the way, for the reader
  std::vector<TraceFault> trace_faults;  // of the dataset, whose trials and rows they count
  bool keeps_stray = false;              // stray and held samples of these are compared

  /// Whether the leg has a mass at its toe in any trial.
  LegMass leg_mass() const;
  /// What drives any trial.
  InputSet inputs() const;
  /// Legs of a robot; 0 of any other mechanism.
  RobotLegs robot_legs() const;
  int shared_count() const { return static_cast<int>(shared.size()); }
  std::vector<std::string> shared_names() const;
};

/// What of a dataset is fitted, and how it is set up.
struct ProblemOptions {
  std::string law;                        // empty: the mechanism's default
  std::vector<std::string> free;          // empty: the mechanism's default
  std::map<std::string, double> fix;      // parameter (or effect.parameter) = value
  std::vector<std::string> with_effects;  // their parameters are freed
  /// A robot's legs share one modulus unless a leg is told apart by name. Else each has its own.
  bool legs_alike = false;
  /// Samples that no body can have made (TraceFault) are compared like the others.
  bool keep_stray = false;
  IntegratorOptions integrator;
};

/// The same for a search of causes: that one leg differs from the others is one of them.
ProblemOptions WithLegsAlike(ProblemOptions options);

/// Sets the problem up. Throws InputError (place: the option) for unknown names, values out of
/// bounds, a parameter that differs between trials but is to be shared, an effect that is known not
/// to be there.
FitProblem MakeProblem(const Dataset& dataset, const ProblemOptions& options);

/// The samples of a channel, by its place, trial by trial; NaN = missing.
std::vector<std::vector<double>> SamplesOf(const FitProblem& problem, std::size_t channel);

/// Values of the shared parameters at which a search starts: nominal, but off their bounds.
Eigen::VectorXd InitialShared(const FitProblem& problem);

}  // namespace hoplab
