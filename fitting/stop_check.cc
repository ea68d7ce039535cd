#include "fitting/stop_check.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/parallel.h"
#include "fitting/edges.h"
#include "fitting/eliminated_trial.h"

namespace hoplab {
namespace {

enum class Side { kInside, kLower, kUpper };

Side SideOf(const SharedParameter& s, double value) {
  const double near = 1e-6 * s.scale;
  if (value <= s.lower + near) return Side::kLower;
  return value >= s.upper - near ? Side::kUpper : Side::kInside;
}

// A bound at zero, at one or at the value that changes nothing is where physics ends.
bool IsWall(const SharedParameter& s, Side side) {
  if (side == Side::kInside) return false;
  const double bound = side == Side::kLower ? s.lower : s.upper;
  return bound != 0.0 && bound != 1.0 && bound != s.initial;
}

std::vector<int> IndicesAtWall(const FitProblem& problem, const Eigen::VectorXd& shared) {
  std::vector<int> at_wall;
  for (int k = 0; k < problem.shared_count(); ++k) {
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(k)];
    if (IsWall(s, SideOf(s, shared[k]))) at_wall.push_back(k);
  }
  return at_wall;
}

// Gain of a Gauss-Newton step that does not cross the bounds values lie on already, and that step;
// `held` gets the values that it leaves where they are.
double PromisedNats(const FitProblem& problem, const Eigen::VectorXd& shared,
                    const EliminatedTrial& all, Eigen::VectorXd& of_shared,
                    std::vector<int>& held) {
  const Eigen::VectorXd gradient = all.columns.transpose() * all.residuals;
  Eigen::MatrixXd S(all.columns.rows(), all.columns.cols());
  std::vector<int> free_values;
  Eigen::Index free = 0;
  of_shared = Eigen::VectorXd::Zero(problem.shared_count());
  for (int k = 0; k < problem.shared_count(); ++k) {
    const Side side = SideOf(problem.shared[static_cast<std::size_t>(k)], shared[k]);
    const bool outward =
        (side == Side::kLower && gradient[k] > 0.0) || (side == Side::kUpper && gradient[k] < 0.0);
    const bool seen = all.columns.col(k).squaredNorm() > 0.0;
    if (!seen || outward) {
      held.push_back(k);
      continue;
    }
    S.col(free++) = all.columns.col(k);
    free_values.push_back(k);
  }
  if (free == 0) return all.own_nats;
  S.conservativeResize(Eigen::NoChange, free);
  const Eigen::VectorXd step = S.completeOrthogonalDecomposition().solve(all.residuals);
  for (Eigen::Index i = 0; i < free; ++i) {
    const int k = free_values[static_cast<std::size_t>(i)];
    of_shared[k] = -step[i] * problem.shared[static_cast<std::size_t>(k)].scale;
  }
  return all.own_nats +
         0.5 * (all.residuals.squaredNorm() - (all.residuals - S * step).squaredNorm());
}

std::string Text(const char* format, double value) {
  char text[120];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

bool StopCheck::OnlyPromises() const {
  return complete && at_wall.empty() && faults.size() == 1 && !(promised_nats < kMinimumNats);
}

std::optional<double> StopCheck::PromisedErrors(const Eigen::VectorXd& std_errors,
                                                double cost) const {
  std::optional<double> most;
  if (!(promised_nats < kShareOfCost * cost)) return most;
  for (Eigen::Index k = 0; k < std_errors.size(); ++k) {
    if (!(std_errors[k] > 0.0)) continue;
    most = std::max(most.value_or(0.0), std::abs(promised_step[k]) / std_errors[k]);
  }
  return most;
}

std::vector<std::string> AtWall(const FitProblem& problem, const Eigen::VectorXd& shared) {
  std::vector<std::string> names;
  for (const int k : IndicesAtWall(problem, shared))
    names.push_back(problem.shared[static_cast<std::size_t>(k)].name);
  return names;
}

StopCheck CheckStop(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                    const Eigen::VectorXd& shared, const std::vector<OwnValues>& initial_states,
                    const Loss& loss, int jobs) {
  std::vector<KeptColumn> columns;
  for (int k = 0; k < problem.shared_count(); ++k)
    columns.push_back({k, problem.shared[static_cast<std::size_t>(k)].scale});
  std::vector<EliminatedTrial> eliminated(trials.size());
  std::vector<std::string> broken(trials.size());
  ParallelFor(static_cast<int>(trials.size()), jobs, [&](int i) {
    const TrialEvaluator evaluator(problem, trials[i]);
    TrialEvaluation e;
    evaluator.Evaluate({shared, initial_states[i], true, loss, /*fly_on=*/true, /*whiten=*/false},
                       e);
    if (!e.complete) {
      broken[i] = trials[i].file +
                  (IsComplete(e.trajectory.outcome)
                       ? ": other contacts than the trace shows"
                       : ": the simulation " + std::string(SentenceOf(e.trajectory.outcome)) +
                             Text(", at %.3f s", e.trajectory.end_time));
    }
    if (e.evaluated) eliminated[i] = EliminateOwn(trials[i], e, problem.shared_count(), columns);
  });

  StopCheck out;
  out.complete = true;
  bool evaluated = true;
  std::size_t count = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    evaluated = evaluated && !eliminated[i].empty();
    if (broken[i].empty()) continue;
    out.complete = false;
    if (count++ == 0) out.faults.push_back(broken[i]);
  }
  if (count > 1)
    out.faults.back() +=
        " (and " + std::to_string(count - 1) + " more of " + std::to_string(trials.size()) + ")";
  for (const int k : IndicesAtWall(problem, shared)) {
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(k)];
    out.at_wall.push_back(s.name);
    out.faults.push_back(s.name + Text(" ended at the end of its range, %.3g ", shared[k]) +
                         s.unit);
  }
  if (!evaluated) return out;
  std::vector<int> held;
  out.promised_nats = PromisedNats(problem, shared, Stacked(eliminated), out.promised_step, held);
  if (out.complete && !(out.promised_nats < kMinimumNats)) {
    const EdgeCheck check =
        CheckEdges({problem, trials, shared, initial_states, held, false, loss, jobs});
    for (const Edge& edge : check.edges) {
      const std::string& file = trials[static_cast<std::size_t>(edge.trial)].file;
      const auto& known = out.on_edges_of;
      if (std::find(known.begin(), known.end(), file) == known.end())
        out.on_edges_of.push_back(file);
    }
    if (!check.edges.empty()) {
      out.promised_nats = check.promised_nats;
      out.promised_step = check.promised_step;
    }
  }
  if (!(out.promised_nats < kMinimumNats)) {
    out.faults.push_back(
        Text("the search ended where the fit still gets better, by %.2g nats to first order",
             out.promised_nats));
  }
  return out;
}

}  // namespace hoplab
