#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fitting/discrepancy/matern_filter.h"
#include "fitting/problem.h"

namespace hoplab {

/// Loss on single whitened residuals. `pseudo_huber`: quadratic near zero, linear beyond `scale`
/// standard deviations, smooth in between.
enum class LossKind { kSquared, kPseudoHuber };
struct Loss {
  LossKind kind = LossKind::kSquared;
  double scale = 2.0;  // standard deviations
};

/// A trial compared with its simulation.
struct TrialEvaluation {
  Trajectory trajectory;
  /// Every datum has a simulated counterpart.
  bool complete = false;
  /// `residuals` and `jacobian` are filled: complete, or read on from a free flight past the end
  /// (EvaluationRequest::fly_on).
  bool evaluated = false;
  /// Whitened by the problem's noise: (simulated - measured)/sigma of the data that are there, row
  /// by row, then contact times, then priors; the loss is worked in.
  Eigen::VectorXd residuals;
  /// d residuals / d [shared parameters, own ones], in their own units. Empty unless asked for.
  RowMajorMatrix jacobian;
  int data_residuals = 0;  // how many of `residuals` come from data, the prior's left out
  /// Sum of squares of the data's residuals over the channels' sigma, before the discrepancy is
  /// whitened and without a loss.
  double white_square = 0.0;
  /// Half the logarithm of the determinant of the noise, in units of the channels' sigma.
  double half_log_determinant = 0.0;
};

/// Neighbouring columns of a Jacobian.
struct ColumnRange {
  int first = 0, count = 0;
};

/// What is asked of an evaluation.
struct EvaluationRequest {
  Eigen::Ref<const Eigen::VectorXd> shared;  // values in their own units
  Eigen::Ref<const OwnValues> own;           // the trial's own values
  bool want_jacobian = false;
  Loss loss = {};
  /// A simulation that ends before its data goes on as a free flight, so that a search can step
  /// back; contacts it does not make count as if they came at its horizon.
  bool fly_on = false;
  bool whiten = true;  // false: residuals and Jacobian in units of the channels' sigma
  std::optional<ColumnRange> only = std::nullopt;  // the Jacobian has these columns alone
};

/// Where a channel's samples stand among the residuals, and when they were taken [s].
struct ChannelRows {
  std::vector<int> rows;
  std::vector<double> times;
};

/// Compares one trial with the simulation; reuses its memory from call to call. The problem and the
/// trial must outlive it.
class TrialEvaluator {
 public:
  TrialEvaluator(const FitProblem& problem, const TrialProblem& trial);

  void Evaluate(const EvaluationRequest& request, TrialEvaluation& out) const;
  /// Rows of `residuals`, the same for every complete evaluation.
  int residual_count() const { return residual_count_; }
  const TrialProblem& trial() const { return *trial_; }
  const std::vector<ChannelRows>& channel_rows() const { return channel_rows_; }
  /// Columns of `jacobian`: the shared parameters and the trial's own.
  int column_count() const { return static_cast<int>(directions_.size()); }

  /// Whitens rows laid out as `residuals` (priors left out or not) by a noise; returns half the
  /// logarithm of its determinant in units of the channels' sigma.
  /// `log_roots`, if there (one a row), gets what each row adds to that.
  double WhitenRows(const NoiseModel& noise, Eigen::Ref<RowMajorMatrix> block,
                    Eigen::VectorXd* log_roots = nullptr) const;

  /// The simulation alone: the request of this trial at these values, every problem channel in
  /// every row, sensitivities with respect to [shared, own] if wanted.
  void Simulate(const EvaluationRequest& request, const IntegratorOptions& integrator,
                Trajectory& out) const;

 private:
  const FitProblem* problem_;
  const TrialProblem* trial_;
  std::vector<Channel> channels_;
  std::vector<double> sigma_;
  std::vector<SensitivityDirection> directions_;
  std::vector<ChannelRows> channel_rows_;

  ColumnRange ColumnsOf(const EvaluationRequest& request) const {
    return request.only.value_or(ColumnRange{0, column_count()});
  }
  void AddPriors(const EvaluationRequest& request, int next, TrialEvaluation& out) const;
  void ClearCut(const EvaluationRequest& request, int rows, TrialEvaluation& out) const;
  void Whiten(TrialEvaluation& out, bool jacobian) const;
  double horizon_ = 0.0;
  int residual_count_ = 0;
};

/// Whether a shared value acts in a trial.
bool ActsIn(const SharedParameter& parameter, const TrialProblem& trial);

/// A trial's effects and, over its own `parameters`, the shared values that act in it.
void ApplyShared(const FitProblem& problem, const TrialProblem& trial,
                 const Eigen::Ref<const Eigen::VectorXd>& shared, Parameters<double>& parameters,
                 std::vector<EffectSetting>& effects);

/// State a trial's simulation begins with, out of its own values.
std::vector<double> InitialOf(const TrialProblem& trial, const Eigen::Ref<const OwnValues>& own);

/// The trial cut to its rows [first, last), its time starting anew at `first`.
TrialProblem CutTrial(const FitProblem& problem, const TrialProblem& trial, int first, int last);

/// How long the longest of the trials lasts [s].
double LongestTrial(const std::vector<TrialProblem>& trials);

/// The trial cut at `until` [s].
TrialProblem FirstPart(const FitProblem& problem, const TrialProblem& trial, double until);

}  // namespace hoplab
