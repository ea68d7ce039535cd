#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "fitting/problem.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {

/// Where one whitened residual comes from.
struct RowLabel {
  enum class Of { kSample, kContactTime, kPrior };
  Of of = Of::kSample;
  int trial = 0;      // place among the linearised trials
  int channel = -1;   // place in FitProblem::channels; -1 for contact times and priors
  double time = 0.0;  // s since the trial's first row
  Mode mode = Mode::kFlight;
  double phase = 0.0;  // share of its spell in that mode gone by, 0..1
  int hop = 0;         // hop number in the trial, from 0
};

/// The train trials linearised at a fit: whitened residuals r, and columns of tested values, with
/// what the fitted values and the initial states can explain projected out (M of the method).
struct Linearisation {
  Eigen::VectorXd r;        // M r
  Eigen::VectorXd raw;      // r itself
  Eigen::MatrixXd columns;  // M s_j, per own unit of value j, one a tested value
  Eigen::VectorXd length;   // |s_j| before the projection
  std::vector<RowLabel> labels;
  /// Orthonormal basis of what the fitted shared values explain beyond the initial states.
  Eigen::MatrixXd fitted_basis;
  /// What of each column lies along that basis: columns + fitted_basis * along_fitted is s_j with
  /// the initial states alone projected out, which may be cut to one trial.
  Eigen::MatrixXd along_fitted;
  /// What one unit of a tested value moves each fitted one by, per scale; one column a tested
  /// value.
  Eigen::MatrixXd fitted_shift;
  Eigen::VectorXd leverage;  // share of each row the fitted values can explain, 0..1
  int fitted_rank = 0;       // dimensions projected out
  int row_count = 0;         // rows before they were compressed, if they were
  int samples = 0;           // of them from data
  int trials_left_out = 0;   // their simulation ends before their data
  double alike_rows = 0.0;   // AlikeRows: where they are told, what noise leaves is so much less
  /// Tested candidates whose columns are zeros because no run could be differentiated by them. By
  /// others that may be so in some trials: there their columns are zeros.
  std::vector<std::string> failed;

  int rows() const { return static_cast<int>(r.size()); }
  double chi2() const { return r.squaredNorm(); }
  /// What noise alone leaves of chi2, at least 1.
  double degrees_of_freedom() const { return std::max(row_count - alike_rows - fitted_rank, 1.0); }
};

/// One trial's rows, own values projected out; what a linearisation is assembled from.
struct LinearisedTrial {
  Eigen::VectorXd raw, r;         // residuals; orthogonal to the own values' columns
  Eigen::MatrixXd fitted;         // columns of the fitted shared values, per scale
  Eigen::MatrixXd tested;         // of the tested ones, per own unit
  Eigen::VectorXd tested_square;  // squared length of the tested columns before the projection
  Eigen::VectorXd leverage;       // of the own values
  std::vector<RowLabel> labels;
  int own_rank = 0;
  Eigen::Index row_count = 0;  // 0: it could not be simulated
  int samples = 0;
};

/// Lays trials one below the other and projects the fitted columns out.
Linearisation Assemble(const std::vector<LinearisedTrial>& trials, int fitted, int tested);

/// Places of shared values that do not lie on a bound.
std::vector<int> FreeShared(const FitProblem& problem, const Eigen::VectorXd& shared);

/// Linearises `trials` of `problem` at `shared` and `initial_states`. Shared values from place
/// `first_tested` on are tested, those before it are fitted; a fitted value on a bound is taken as
/// given. Trials whose simulation ends before their data are left out. Every row is kept.
Linearisation Linearise(const FitProblem& problem, int first_tested,
                        const std::vector<TrialProblem>& trials, const Eigen::VectorXd& shared,
                        const std::vector<OwnValues>& initial_states, int jobs);

/// A tested column cut to each of `groups` groups of trials, what the fitted values take of it
/// projected out again: what they stand for in all trials (a modulus, for how stiff the leg is) is
/// seen in some. `group_of`: the group of each trial, -1: none. `squares`, where it is asked for:
/// the squared lengths before that projection.
Eigen::MatrixXd CutToTrials(const Linearisation& at, int column, const std::vector<int>& group_of,
                            int groups, Eigen::VectorXd* squares = nullptr);

/// Part of a column's length (squared) that the projection must leave for it to be told from the
/// fitted values: sensitivities are good to about 1e-7 of their column.
inline constexpr double kInseparable = 1e-10;

}  // namespace hoplab
