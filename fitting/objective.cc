#include "fitting/objective.h"

#include "base/parallel.h"

namespace hoplab {

Objective EvaluateObjective(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                            const Eigen::VectorXd& shared,
                            const std::vector<std::array<double, 4>>& starts, const Loss& loss,
                            int jobs) {
  std::vector<TrialEvaluation> evaluations(trials.size());
  ParallelFor(static_cast<int>(trials.size()), jobs, [&](int i) {
    const TrialEvaluator evaluator(problem, trials[i]);
    evaluator.Evaluate({shared, starts[i], true, loss}, evaluations[i]);
  });

  Objective out;
  long rows = 0;
  out.complete = true;
  for (const TrialEvaluation& e : evaluations) {
    out.outcomes.push_back(e.trajectory.outcome);
    out.complete = out.complete && e.complete;
    rows += e.residuals.size();
  }
  if (!out.complete) return out;

  const int n = problem.shared_count();
  out.residuals.resize(rows);
  out.jacobian.setZero(rows, n + 4 * static_cast<long>(trials.size()));
  long row = 0, column = n;
  for (const TrialEvaluation& e : evaluations) {
    const long count = e.residuals.size();
    out.residuals.segment(row, count) = e.residuals;
    out.jacobian.block(row, 0, count, n) = e.jacobian.leftCols(n);
    out.jacobian.block(row, column, count, 4) = e.jacobian.rightCols(4);
    row += count;
    column += 4;
  }
  out.cost = 0.5 * out.residuals.squaredNorm();
  out.gradient = out.jacobian.transpose() * out.residuals;
  return out;
}

}  // namespace hoplab
