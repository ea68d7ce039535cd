#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "fitting/problem.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {

/// What the data say of the shared values, the trials' own ones marginalised under flat priors
/// (beyond the stated ones), for steps u off where they were linearised, in their scales:
/// log-likelihood log_constant - |root u + rest|^2/2.
struct ValueLikelihood {
  double log_constant = 0.0;
  Eigen::MatrixXd root;  // a column a shared value
  Eigen::VectorXd rest;
};

/// How much of the data a likelihood is of. What noise is like is common to all trials and slower
/// than a row, so a search for it can do with less.
struct LikelihoodDetail {
  /// Rows of a trial's channel are averaged until there are no more than these; 0: every row.
  std::size_t rows_a_channel = 0;
  /// Of more samples every second trial is taken, or every third, ...
  std::size_t most_samples = std::numeric_limits<std::size_t>::max();
  /// Widths of the shared values' priors in their scales: what they bound is not counted as a gain
  /// that no data made. Empty: flat.
  Eigen::VectorXd prior_widths;

  /// For a search.
  static LikelihoodDetail Coarse();
};

/// Trials linearised at one point, in units of the channels' sigma: the restricted likelihood of
/// any noise there.
class RestrictedLikelihood {
 public:
  /// Simulates `trials` (of `problem`) once. Trials that cannot be simulated to the end of their
  /// data are left out. Shared values on a bound are taken as given.
  RestrictedLikelihood(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                       const Eigen::VectorXd& shared, const std::vector<OwnValues>& initial_states,
                       int jobs, const LikelihoodDetail& detail = {});

  /// The same in another detail, without simulating anew: that of a likelihood of every row and
  /// trial.
  RestrictedLikelihood With(const LikelihoodDetail& detail) const;

  /// Restricted log-likelihood [nats]: of the residuals with the linearised values marginalised
  /// under flat priors (beyond the own ones' stated priors), but for a constant that no noise
  /// changes:
  ///   - 1/2 |r~|^2 (r~ whitened, its values' best fit taken off) - 1/2 log |C| - 1/2 log |J~' J~|
  /// The columns of J are per scale of the values.
  double At(const NoiseModel& noise) const;
  /// The same before the shared values are marginalised, those on bounds among them.
  ValueLikelihood ValuesAt(const NoiseModel& noise) const;

  /// Whether every trial asked for is in it.
  bool complete() const { return complete_; }
  /// Root mean square of a channel's residuals over sigma.
  double RootMeanSquare(std::size_t channel) const { return root_mean_square_[channel]; }
  std::size_t channels() const { return root_mean_square_.size(); }
  /// Greatest and least time scale the data can tell [s]: half the longest trial, three rows.
  double longest() const { return longest_; }
  double shortest() const { return shortest_; }

 private:
  struct Part {
    std::vector<ChannelRows> channels;
    std::vector<double> averaged;  // rows of one channel that were averaged into one
    std::vector<double> factors;   // of the trial's noise, by channel
    RowMajorMatrix block;          // own columns, free shared ones, those on bounds, residuals
    Eigen::Index own = 0;
    std::size_t place = 0;           // of its trial
    Eigen::ArrayXd squares, counts;  // of its residuals per channel
    double rows = 0.0, seconds = 0.0;
  };
  // None: the trial cannot be simulated to the end of its data.
  std::optional<Part> Make(const FitProblem& problem, const TrialProblem& trial,
                           const Eigen::VectorXd& shared, const OwnValues& own) const;
  void SetPriorWidths(const Eigen::VectorXd& widths);
  void Summarise();
  std::vector<int> Columns() const;
  static void Average(Part& part, std::size_t most);
  // Columns of the shared values and the residuals, whitened, own values projected out; `log_sum`:
  // of the determinants that this takes.
  RowMajorMatrix Whitened(const NoiseModel& noise, double& log_sum) const;

  std::vector<Part> parts_;
  bool complete_ = true;
  std::vector<int> free_, bound_;  // shared values
  Eigen::VectorXd prior_widths_;   // of these, in this order; empty: flat
  std::vector<double> root_mean_square_;
  double longest_ = 0.0, shortest_ = 0.0;
  Eigen::Index channels_;
  std::size_t samples_ = 0;  // of all trials
  int jobs_;
};

}  // namespace hoplab
