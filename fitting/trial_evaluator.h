#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

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
  /// Every datum has a simulated counterpart. If not, `residuals` and `jacobian` are not filled.
  bool complete = false;
  /// Whitened: (simulated - measured)/sigma of the data that are there, row by row, then contact
  /// times, then the prior on the start; the loss is worked in.
  Eigen::VectorXd residuals;
  /// d residuals / d [shared parameters, start], in their own units. Empty unless asked for.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian;
  int data_residuals = 0;  // how many of `residuals` come from data, the prior's left out
};

/// What is asked of an evaluation.
struct EvaluationRequest {
  Eigen::Ref<const Eigen::VectorXd> shared;  // values in their own units
  std::array<double, 4> start;
  bool want_jacobian = false;
  Loss loss = {};
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

  /// The simulation alone: the request of this trial at these values, every problem channel in
  /// every row, sensitivities with respect to [shared, start] if wanted.
  void Simulate(const EvaluationRequest& request, const IntegratorOptions& integrator,
                Trajectory& out) const;

 private:
  const FitProblem* problem_;
  const TrialProblem* trial_;
  std::vector<Channel> channels_;
  std::vector<double> sigma_;
  std::vector<SensitivityDirection> directions_;
  double horizon_ = 0.0;
  int residual_count_ = 0;
};

/// Whether a shared value acts in a trial.
bool ActsIn(const SharedParameter& parameter, const TrialProblem& trial);

/// A trial's effects and, over its own `parameters`, the shared values that act in it.
void ApplyShared(const FitProblem& problem, const TrialProblem& trial,
                 const Eigen::Ref<const Eigen::VectorXd>& shared, Parameters<double>& parameters,
                 std::vector<EffectSetting>& effects);

/// The trial cut to its rows [first, last), its time starting anew at `first`.
TrialProblem CutTrial(const FitProblem& problem, const TrialProblem& trial, int first, int last);

}  // namespace hoplab
