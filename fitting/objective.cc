#include "fitting/objective.h"

#include "base/parallel.h"

namespace hoplab {

Objective EvaluateObjective(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                            const Eigen::VectorXd& shared,
                            const std::vector<OwnValues>& initial_states, const Loss& loss,
                            int jobs, bool matrices) {
  std::vector<TrialEvaluation> evaluations(trials.size());
  ParallelFor(static_cast<int>(trials.size()), jobs, [&](int i) {
    const TrialEvaluator evaluator(problem, trials[i]);
    evaluator.Evaluate({shared, initial_states[i], true, loss, /*fly_on=*/false, /*whiten=*/false},
                       evaluations[i]);
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
  long columns = n;
  for (const TrialProblem& t : trials) columns += t.own_count();
  out.gradient = Eigen::VectorXd::Zero(columns);
  if (matrices) {
    out.residuals.resize(rows);
    out.jacobian.setZero(rows, columns);
  }
  out.cost = 0.0;
  long row = 0, column = n;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialEvaluation& e = evaluations[i];
    const long count = e.residuals.size(), own = trials[i].own_count();
    out.cost += 0.5 * e.residuals.squaredNorm();
    const Eigen::VectorXd gradient = e.jacobian.transpose() * e.residuals;
    out.gradient.head(n) += gradient.head(n);
    out.gradient.segment(column, own) = gradient.tail(own);
    if (matrices) {
      out.residuals.segment(row, count) = e.residuals;
      out.jacobian.block(row, 0, count, n) = e.jacobian.leftCols(n);
      out.jacobian.block(row, column, count, own) = e.jacobian.rightCols(own);
    }
    row += count;
    column += own;
  }
  return out;
}

}  // namespace hoplab
