#pragma once

#include <ceres/evaluation_callback.h>

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "fitting/reduced_trial.h"
#include "fitting/solve.h"

namespace hoplab {

/// Every trial of a search, simulated at one point of its unknowns: in parallel, before Ceres asks
/// its residual blocks one by one, so that sums are formed in one order whatever the number of
/// threads. The last point with derivatives is kept beside the last one without: neither is
/// simulated again when a search comes back to it. The request must outlive it.
class TrialEvaluations : public ceres::EvaluationCallback {
 public:
  explicit TrialEvaluations(const SolveRequest& request);

  /// Simulates the trials where the unknowns are, unless that is known.
  void PrepareForEvaluation(bool jacobians, bool new_point) override;

  /// The unknowns, which Ceres moves: shared values over their scale, and of each trial's own
  /// values (value - first value)/scale.
  double* shared() { return shared_.data(); }
  double* own(int trial) { return own_.data() + own_begin_[static_cast<std::size_t>(trial)]; }
  /// The same in their own units.
  Eigen::VectorXd SharedValues() const { return SharedValues(shared_); }
  OwnValues OwnValuesOf(int trial) const;
  void MoveTo(const Eigen::VectorXd& shared, const std::vector<OwnValues>& own);

  /// The shared values of the last point that was simulated without derivatives.
  Eigen::VectorXd TriedShared() const { return SharedValues(plain_.shared); }
  /// Moves shared values to where they were there.
  void TakeTried(const std::vector<int>& places);

  /// What follows is of the last point prepared.
  /// Whether a trial has residuals there: not even a free flight led on where it has none.
  bool IsEvaluated(int trial) const { return at_->evaluated[static_cast<std::size_t>(trial)] != 0; }
  /// Every simulation reached the end of its data.
  bool IsComplete() const { return at_->complete; }
  double Cost() const { return at_->cost; }
  /// Half the derivative of the sum of squares with respect to a shared unknown, at the last point
  /// with derivatives.
  double Gradient(int shared) const;
  int RowCount(int trial) const { return reduced_[static_cast<std::size_t>(trial)].rows(); }
  /// A trial's residuals, as few as ReducedTrial makes them, and at a point with derivatives those
  /// with respect to shared and own unknowns (row by row; null: not wanted).
  void Copy(int trial, double* residuals, double* by_shared, double* by_own) const;
  /// Why a trial has no residuals, or ended before its data.
  std::string ReasonOf(int trial) const;

  /// Points at which a simulation ended before its data: reason -> how often.
  const std::map<std::string, int>& rejected() const { return rejected_; }
  void ForgetRejected() { rejected_.clear(); }

 private:
  struct Point {
    Eigen::VectorXd shared, own;
    std::vector<char> evaluated;
    std::vector<double> norms;  // of each trial's residuals
    bool complete = false;
    double cost = 0.0;

    bool Is(const Eigen::VectorXd& other_shared, const Eigen::VectorXd& other_own) const {
      return shared.size() == other_shared.size() && own.size() == other_own.size() &&
             shared == other_shared && own == other_own;
    }
  };
  void Run(bool jacobians, Point& point);
  bool HoldsManyShared(int trial) const;
  void PutAfterShared(RowMajorMatrix& own) const;
  Eigen::VectorXd SharedValues(const Eigen::VectorXd& over_scale) const;
  Eigen::VectorXd ColumnScales(const TrialProblem& trial) const;

  const SolveRequest& request_;
  const FitProblem& problem_;
  const std::vector<TrialProblem>& trials_;
  std::vector<TrialEvaluator> evaluators_;
  std::vector<TrialEvaluation> evaluations_;  // of the last point simulated
  std::vector<ReducedTrial> reduced_;         // of the last one with derivatives
  Eigen::VectorXd shared_;
  /// Of all trials in one piece: Ceres takes the blocks of a group in the order of their addresses,
  /// and sums must be formed in one order.
  Eigen::VectorXd own_;
  std::vector<int> own_begin_ = {0};  // one a trial, and the end
  Point plain_, differentiated_;
  const Point* at_ = &plain_;
  std::map<std::string, int> rejected_;
};

}  // namespace hoplab
