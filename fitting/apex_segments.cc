#include "fitting/apex_segments.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "fitting/carried_trials.h"
#include "fitting/trial_evaluator.h"
#include "fitting/turning_rows.h"
#include "model/leg_compliance.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

// A flight as the trace shows it: the apex row and the state there.
struct Apex {
  int row;
  Eigen::Vector4d state;
};

int ColumnOf(const FitProblem& problem, Channel channel) {
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    if (problem.channels[c].channel == channel) return static_cast<int>(c);
  }
  return -1;
}

// Least-squares value and slope at time `at` of values - curvature (t - at)^2 over rows [a, b).
bool FitLine(const TrialProblem& trial, int column, int width, int a, int b, double at,
             double curvature, double& value, double& slope) {
  double n = 0, st = 0, stt = 0, sv = 0, stv = 0;
  for (int row = a; row < b; ++row) {
    const double v = trial.data[static_cast<std::size_t>(row) * width + column];
    if (std::isnan(v)) continue;
    const double t = trial.row_times[row] - at, w = v - curvature * t * t;
    n += 1;
    st += t;
    stt += t * t;
    sv += w;
    stv += t * w;
  }
  const double det = n * stt - st * st;
  if (n < 4 || det <= 0) return false;
  slope = (n * stv - st * sv) / det;
  value = (sv - slope * st) / n;
  return true;
}

std::vector<TrialProblem> PiecesBetween(const FitProblem& problem, const TrialProblem& trial,
                                        const std::vector<Apex>& apexes) {
  std::vector<TrialProblem> pieces;
  int first = 0;
  for (std::size_t i = 0; i <= apexes.size(); ++i) {
    const int last = i < apexes.size() ? apexes[i].row : static_cast<int>(trial.row_times.size());
    if (last - first >= 8) {
      TrialProblem piece = CutTrial(problem, trial, first, last);
      if (i > 0) piece.start.head<4>() = apexes[i - 1].state;
      if (piece.sample_count > 0) pieces.push_back(std::move(piece));
    }
    if (i < apexes.size()) first = apexes[i].row;
  }
  // Those of a first piece that is left out, too.
  if (!pieces.empty()) pieces.front().shared_priors = trial.shared_priors;
  return pieces;
}

}  // namespace

std::vector<TrialProblem> CutAtApexes(const FitProblem& problem, const TrialProblem& trial) {
  const MechanismTraits& traits = TraitsOf(problem.law);
  if (traits.lands_leg_by_leg) return {};
  const int width = static_cast<int>(problem.channels.size());
  const int y_column = ColumnOf(problem, Channel::kBodyY);
  const int x_column = ColumnOf(problem, Channel::kBodyX);
  if (y_column < 0) return {};
  const double contact = traits.touchdown_height(trial.parameters);
  const int rows = static_cast<int>(trial.row_times.size());
  const auto y = [&](int row) {
    return trial.data[static_cast<std::size_t>(row) * width + y_column];
  };
  const double sigma = problem.channels[y_column].sigma;

  // Rows on the ground, or next to it where it lies between two rows.
  std::vector<char> low(static_cast<std::size_t>(rows), 0);
  for (const int row : TurningRows(y, rows, sigma)) low[static_cast<std::size_t>(row)] = 1;
  for (int row = 0; row < rows; ++row)
    if (y(row) < contact + 4.0 * sigma) low[static_cast<std::size_t>(row)] = 1;
  const auto flies = [&](int row) { return low[static_cast<std::size_t>(row)] == 0; };

  // A flight is a stretch of rows above contact height by a margin; lift-off happens somewhat
  // above that height, so only the upper two thirds of each arc are trusted to be parabolas.
  std::vector<Apex> apexes;
  bool begun = false;  // the first flight is the start's
  for (int row = 0; row < rows;) {
    if (std::isnan(y(row)) || !flies(row)) {
      begun = begun || !std::isnan(y(row));
      ++row;
      continue;
    }
    int end = row, top = row;
    for (int r = row; r < rows && flies(r); ++r) {
      end = r + 1;
      if (y(r) > y(top)) top = r;
    }
    const double floor = contact + (y(top) - contact) / 3.0;
    int a = top, b = top + 1;
    while (a > row && !(y(a - 1) < floor)) --a;
    while (b < end && !(y(b) < floor)) ++b;
    const bool falls_after = b < end || end < rows;  // the trace goes on after the apex
    Apex apex{top, Eigen::Vector4d::Zero()};
    const double at = trial.row_times[top];
    const bool seen =
        b - a >= 8 && FitLine(trial, y_column, width, a, b, at, -0.5 * trial.parameters.g,
                              apex.state[1], apex.state[3]);
    if (x_column >= 0 && seen)
      FitLine(trial, x_column, width, a, b, at, 0.0, apex.state[0], apex.state[2]);
    else
      apex.state[2] = trial.start[2];
    if (seen && falls_after && begun) apexes.push_back(apex);
    begun = true;
    row = end;
  }

  return PiecesBetween(problem, trial, apexes);
}

int HopsInData(const FitProblem& problem, const TrialProblem& trial) {
  const int column = ColumnOf(problem, Channel::kBodyY);
  if (problem.law != Law::kBall || column < 0)
    return static_cast<int>(CutAtApexes(problem, trial).size()) - 1;
  const auto y = [&](int row) {
    return trial.data[static_cast<std::size_t>(row) * problem.channels.size() +
                      static_cast<std::size_t>(column)];
  };
  return static_cast<int>(TurningRows(y, static_cast<int>(trial.row_times.size()),
                                      problem.channels[static_cast<std::size_t>(column)].sigma)
                              .size());
}

std::vector<TrialProblem> CutAllAtApexes(const FitProblem& problem,
                                         const std::vector<TrialProblem>& trials) {
  std::vector<TrialProblem> all;
  std::vector<SharedPrior> priors;
  for (const TrialProblem& trial : trials) {
    std::vector<TrialProblem> pieces = CutAtApexes(problem, trial);
    if (pieces.empty())
      priors.insert(priors.end(), trial.shared_priors.begin(), trial.shared_priors.end());
    std::move(pieces.begin(), pieces.end(), std::back_inserter(all));
  }
  KeepPriors(priors, all);
  return all;
}

FitProblem SplitIntoHops(const FitProblem& problem) {
  FitProblem split = problem;
  split.trials.clear();
  for (const TrialProblem& trial : problem.trials) {
    std::vector<TrialProblem> pieces = CutAtApexes(problem, trial);
    if (pieces.size() < 2) {
      split.trials.push_back(trial);
      continue;
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      pieces[i].file = trial.file + " hop " + std::to_string(i + 1);
      split.trials.push_back(std::move(pieces[i]));
    }
  }
  return split;
}

}  // namespace hoplab
