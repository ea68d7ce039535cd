#include "fitting/least_squares.h"

#include <ceres/ceres.h>

#include "base/check.h"

namespace hoplab {
namespace {

class Residuals : public ceres::CostFunction {
 public:
  explicit Residuals(const LeastSquaresRequest& request) : request_(request) {
    set_num_residuals(request.residual_count);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(request.start.size()));
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Eigen::Index n = request_.start.size();
    const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(blocks[0], n);
    Eigen::VectorXd r(request_.residual_count);
    Eigen::MatrixXd slopes(request_.residual_count, n);
    const bool with_slopes = jacobians != nullptr && jacobians[0] != nullptr;
    if (!request_.evaluate(x, r, with_slopes ? &slopes : nullptr)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, r.size()) = r;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (with_slopes) Eigen::Map<RowMajor>(jacobians[0], slopes.rows(), n) = slopes;
    return r.allFinite() && (!with_slopes || slopes.allFinite());
  }

 private:
  const LeastSquaresRequest& request_;
};

class StopOnRequest : public ceres::IterationCallback {
 public:
  explicit StopOnRequest(const std::atomic<bool>* stop) : stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return stop_ && *stop_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::atomic<bool>* stop_;
};

LeastSquaresResult::Status OutcomeOf(const ceres::Solver::Summary& summary) {
  using Status = LeastSquaresResult::Status;
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
      return Status::kConverged;
    case ceres::NO_CONVERGENCE:
      return Status::kIterationLimit;
    case ceres::USER_SUCCESS:
      return Status::kInterrupted;
    default:
      return Status::kFailed;
  }
}

}  // namespace

LeastSquaresResult SolveLeastSquares(const LeastSquaresRequest& request) {
  HOPLAB_CHECK(request.residual_count > 0 && request.start.size() > 0);
  LeastSquaresResult result;
  result.x = request.start;
  Eigen::VectorXd at_start(request.residual_count);
  if (!request.evaluate(request.start, at_start, nullptr) || !at_start.allFinite()) {
    result.status = LeastSquaresResult::Status::kNoStart;
    return result;
  }
  Residuals residuals(request);
  ceres::Problem::Options owning;
  owning.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(owning);
  problem.AddResidualBlock(&residuals, nullptr, result.x.data());
  for (int i = 0; i < result.x.size(); ++i) {
    problem.SetParameterLowerBound(result.x.data(), i, request.lower[i]);
    problem.SetParameterUpperBound(result.x.data(), i, request.upper[i]);
  }
  StopOnRequest stop(request.stop);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = request.max_iterations;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.line_search_interpolation_type = ceres::QUADRATIC;  // cubic asks for Jacobians
  options.logging_type = ceres::SILENT;
  options.callbacks = {&stop};
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  result.status = OutcomeOf(summary);
  result.cost = summary.final_cost;
  result.iterations = static_cast<int>(summary.iterations.size());
  return result;
}

}  // namespace hoplab
