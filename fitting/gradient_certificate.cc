#include "fitting/gradient_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace hoplab {
namespace {

// Differences need simulations whose own error is far below the step's effect.
IntegratorOptions Tight(const IntegratorOptions& options) {
  IntegratorOptions tight = options;
  tight.relative_tolerance = std::min(options.relative_tolerance, 1e-12);
  tight.absolute_tolerance = std::min(options.absolute_tolerance, 1e-13);
  return tight;
}

// Step of the widest difference as a share of the size of the value: its h^4 remainder after
// extrapolation and the simulations' 1e-12 over it balance near 1e-3 for hop traces.
constexpr double kStep = 1e-3;
// Below this guard rate [1/s] an event is close to grazing: a start half a hop earlier would meet
// it at more than 1 in every hop trace seen.
constexpr double kNearGrazing = 1e-2;
constexpr double kNearMiss = 1e-3;

// A prior may pin a start component to 1e-9: differences need more room than that.
constexpr double kLeastStartStep = 1e-5;

// A shared value may have moved far below its nominal size (but zero is no size).
double Size(const SharedParameter& s, double value) {
  return std::clamp(std::abs(value), 0.01 * s.scale, s.scale);
}

// Times of the events that act on the motion.
std::vector<double> CrossingTimes(const Trajectory& trajectory) {
  std::vector<double> times;
  for (const Event& e : trajectory.events) {
    if (e.kind != EventKind::kApex) times.push_back(e.time);
  }
  return times;
}

struct TrialReport {
  std::vector<double> errors;  // per column; NaN: zero column
  std::vector<CertificateFlag> flags;
};

void Flag(const TrialProblem& trial, const Trajectory& trajectory,
          std::vector<CertificateFlag>& flags) {
  if (trajectory.least_crossing_rate < kNearGrazing)
    flags.push_back({trial.file, "an event is met almost tangentially (grazing)"});
  if (trajectory.has_simultaneous_events)
    flags.push_back({trial.file, "two events at one instant: derivatives are one-sided"});
  if (trajectory.nearest_miss < kNearMiss)
    flags.push_back({trial.file, "another event sequence is very near (a guard almost crossed)"});
}

TrialReport CheckTrial(const FitProblem& problem, const TrialProblem& trial,
                       const Eigen::VectorXd& shared, const OwnValues& start,
                       const JacobianSource& source) {
  const TrialEvaluator evaluator(problem, trial);
  const int n = problem.shared_count(), width = evaluator.column_count();
  const IntegratorOptions tight = Tight(problem.integrator);
  TrialReport report;
  Trajectory analytic;
  if (source)
    source(evaluator, {shared, start, true}, analytic);
  else
    evaluator.Simulate({shared, start, true}, problem.integrator, analytic);
  Flag(trial, analytic, report.flags);
  report.errors.assign(width, std::numeric_limits<double>::quiet_NaN());

  Trajectory shifted;
  const std::size_t crossings = CrossingTimes(analytic).size();
  const std::size_t columns = problem.channels.size();
  for (int k = 0; k < width; ++k) {
    if (k >= n && !trial.own[k - n].free) continue;
    const double h = k < n ? kStep * Size(problem.shared[k], shared[k])
                           : std::max(kStep * trial.own[k - n].scale, kLeastStartStep);
    // An event beyond the last row comes before it where a value is shifted.
    double first_new = std::numeric_limits<double>::infinity();
    const auto simulate = [&](double offset, std::vector<double>& samples) {
      Eigen::VectorXd p = shared;
      OwnValues z = start;
      (k < n ? p[k] : z[k - n]) += offset;
      evaluator.Simulate({p, z, false}, tight, shifted);
      samples = shifted.samples;
      const std::vector<double> met = CrossingTimes(shifted);
      if (met.size() > crossings) first_new = std::min(first_new, met[crossings]);
    };
    std::vector<double> plus, minus, plus_half, minus_half;
    simulate(h, plus);
    simulate(-h, minus);
    simulate(0.5 * h, plus_half);
    simulate(-0.5 * h, minus_half);

    // An event moves by about h dt_e/dp: velocities jump or kink there.
    const auto near_event = [&](double time) {
      for (std::size_t e = 0; e < analytic.events.size(); ++e) {
        if (analytic.events[e].kind == EventKind::kApex) continue;
        const double reach =
            2.0 * h * std::abs(analytic.event_time_sensitivities[e * width + k]) + 1e-9;
        if (std::abs(time - analytic.events[e].time) < reach) return true;
      }
      return false;
    };
    double difference = 0.0, norm = 0.0;
    for (std::size_t row = 0; row < trial.row_times.size(); ++row) {
      if (trial.row_times[row] >= first_new || near_event(trial.row_times[row])) continue;
      for (std::size_t c = 0; c < columns; ++c) {
        const std::size_t cell = row * columns + c;
        const double wide = (plus[cell] - minus[cell]) / (2.0 * h);
        const double narrow = (plus_half[cell] - minus_half[cell]) / h;
        const double richardson = (4.0 * narrow - wide) / 3.0;
        const double value = analytic.sensitivities[cell * width + k];
        if (!std::isfinite(richardson) || !std::isfinite(value)) continue;
        const double weight = 1.0 / problem.channels[c].sigma;
        difference += std::pow((value - richardson) * weight, 2);
        norm += std::pow(value * weight, 2);
      }
    }
    if (norm > 0.0)
      report.errors[k] = std::sqrt(difference / norm);
    else if (difference > 0.0)
      report.errors[k] = std::numeric_limits<double>::infinity();
  }
  return report;
}

}  // namespace

GradientCertificate CertifyGradients(const FitProblem& problem,
                                     const std::vector<TrialProblem>& trials,
                                     const Eigen::VectorXd& shared,
                                     const std::vector<OwnValues>& starts, int jobs,
                                     const JacobianSource& source) {
  std::vector<TrialReport> reports(trials.size());
  ParallelFor(static_cast<int>(trials.size()), jobs, [&](int i) {
    reports[i] = CheckTrial(problem, trials[i], shared, starts[i], source);
  });
  GradientCertificate out;
  out.max_relative_error = std::numeric_limits<double>::quiet_NaN();
  const auto take = [&](const CertificateColumn& column) {
    out.columns.push_back(column);
    if (!column.relative_error) return;
    if (!(*column.relative_error <= out.max_relative_error)) {
      out.max_relative_error = *column.relative_error;
      out.worst_parameter = column.name;
    }
  };
  const int n = problem.shared_count();
  for (int k = 0; k < n; ++k) {
    CertificateColumn column{problem.shared[k].name, "", std::nullopt};
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const double error = reports[i].errors[k];
      if (std::isnan(error) || (column.relative_error && error <= *column.relative_error)) continue;
      column.relative_error = error;
      column.trial = trials[i].file;
    }
    take(column);
  }
  for (std::size_t i = 0; i < trials.size(); ++i) {
    for (int k = 0; k < trials[i].own_count(); ++k) {
      const double error = reports[i].errors[n + k];
      if (!std::isnan(error))
        take({trials[i].file + "." + trials[i].own[k].name, trials[i].file, error});
    }
    out.flags.insert(out.flags.end(), reports[i].flags.begin(), reports[i].flags.end());
  }
  return out;
}

}  // namespace hoplab
