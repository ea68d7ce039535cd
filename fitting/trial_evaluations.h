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
/// threads. A point is always simulated with its derivatives: these may steer the steps of the
/// integrator, so that a run without them ends elsewhere by some of its tolerance, and near a
/// minimum that is more than what a step gains. Of two points the results are kept: the last one
/// whose derivatives were asked for, and the last one beside it. Neither is simulated again when a
/// search comes back to it. The request must outlive it.
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

  /// The shared values of the last point beside the one whose derivatives were asked for.
  Eigen::VectorXd TriedShared() const { return SharedValues(Tried().shared); }
  /// Moves shared values to where they were there.
  void TakeTried(const std::vector<int>& places);

  /// What follows is of the last point prepared.
  /// Whether a trial has residuals there: not even a free flight led on where it has none.
  bool IsEvaluated(int trial) const { return at_->evaluated[static_cast<std::size_t>(trial)] != 0; }
  /// Every simulation reached the end of its data.
  bool IsComplete() const { return at_->complete; }
  double Cost() const { return at_->cost; }
  /// Half the derivative of the sum of squares with respect to a shared unknown, at the last point
  /// whose derivatives were asked for.
  double Gradient(int shared) const;
  /// What a Gauss-Newton step from there gains of half the sum of squares, as the model linear in
  /// the unknowns has it: r' J (J' J)^-1 J' r / 2, over those that are free. Where bounds of
  /// own values or columns that say nothing stand in its way, it is more than a step can gain.
  double PredictedGain(const std::vector<int>& held) const;
  int RowCount(int trial) const { return at_->reduced[static_cast<std::size_t>(trial)].rows(); }
  /// A trial's residuals, as few as ReducedTrial makes them, and their derivatives with respect to
  /// shared and own unknowns (row by row; null: not wanted).
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
    std::vector<ReducedTrial> reduced;
    bool complete = false;
    double cost = 0.0;

    bool Is(const Eigen::VectorXd& other_shared, const Eigen::VectorXd& other_own) const {
      return shared.size() == other_shared.size() && own.size() == other_own.size() &&
             shared == other_shared && own == other_own;
    }
  };
  const Point& Tried() const { return points_[1 - kept_]; }
  void Run(Point& point);
  bool HoldsManyShared(int trial) const;
  void PutAfterShared(RowMajorMatrix& own) const;
  std::vector<int> FreeOwnColumns(const TrialProblem& trial) const;
  Eigen::VectorXd SharedValues(const Eigen::VectorXd& over_scale) const;
  Eigen::VectorXd ColumnScales(const TrialProblem& trial) const;

  const SolveRequest& request_;
  const FitProblem& problem_;
  const std::vector<TrialProblem>& trials_;
  std::vector<TrialEvaluator> evaluators_;
  std::vector<TrialEvaluation> evaluations_;  // of the last point simulated
  std::vector<ReducedTrial::Workspace> workspaces_;
  Eigen::VectorXd shared_;
  /// Of all trials in one piece: Ceres takes the blocks of a group in the order of their addresses,
  /// and sums must be formed in one order.
  Eigen::VectorXd own_;
  std::vector<int> own_begin_ = {0};  // one a trial, and the end
  Point points_[2];
  int kept_ = 0;  // of the two: where derivatives were last asked for
  const Point* at_ = points_;
  std::map<std::string, int> rejected_;
};

}  // namespace hoplab
