#include "fitting/trial_evaluator.h"

#include <algorithm>
#include <cmath>

#include "fitting/contact_reading.h"
#include "fitting/deviation.h"
#include "fitting/driven_trial.h"
#include "fitting/trial_noise.h"
#include "model/mechanism_traits.h"
#include "model/pose_filter.h"

namespace hoplab {
namespace {

// A contact time may be simulated somewhat after the last stamp.
constexpr double kContactMargin = 0.11;  // s
// Beyond the last reading, so that it never lies on the horizon itself.
constexpr double kReadingMargin = 0.01;  // s

// A filter looks at what comes after the last row.
bool FiltersPose(const EffectSetting& s) { return s.effect->info.filter != RecordFilter::kNone; }

// The latest a row stamped `last` may be read, whatever values within their bounds the effects that
// shift time (a delay, a clock) come to have.
double LatestReading(std::span<const EffectSetting> settings, double last) {
  std::vector<const Effect*> effects;
  for (const EffectSetting& s : settings) {
    if (s.effect->hooks0.change_observation_time || s.effect->hooks0.change_pose_time)
      effects.push_back(s.effect);
  }
  if (effects.empty()) return last;
  std::stable_sort(effects.begin(), effects.end(),
                   [](const Effect* a, const Effect* b) { return a->info.order < b->info.order; });
  for (const Effect* effect : effects) {
    std::array<double, kMaxEffectParameters> lower{}, upper{};
    for (std::size_t i = 0; i < effect->info.parameters.size(); ++i) {
      lower[i] = effect->info.parameters[i].lower;
      upper[i] = effect->info.parameters[i].upper;
    }
    for (const auto change :
         {effect->hooks0.change_pose_time, effect->hooks0.change_observation_time}) {
      if (!change) continue;
      double at_lower = last, at_upper = last;
      change(lower.data(), at_lower);
      change(upper.data(), at_upper);
      last = std::max({last, at_lower, at_upper});
    }
  }
  return last + kReadingMargin;
}

constexpr long kMostSteps = 20000;

// Event times of one kind, with their place in the trajectory.
struct EventTime {
  double time;
  std::size_t index;
};
std::vector<EventTime> TimesOf(const Trajectory& trajectory, EventKind kind) {
  std::vector<EventTime> times;
  for (std::size_t i = 0; i < trajectory.events.size(); ++i) {
    if (trajectory.events[i].kind == kind) times.push_back({trajectory.events[i].time, i});
  }
  return times;
}

// r -> sign(r) sqrt(rho(r^2)), so that half the sum of squares is the loss; returns d/dr.
double ApplyLoss(const Loss& loss, double& r) {
  if (loss.kind == LossKind::kSquared) return 1.0;
  const double q = r / loss.scale;
  const double root = std::sqrt(1.0 + q * q);
  // rho = 2 c^2 (root - 1) in the form that does not cancel near zero.
  const double transformed = r * std::sqrt(2.0 / (1.0 + root));
  const double slope = transformed == 0.0 ? 1.0 : r / (transformed * root);
  r = transformed;
  return slope;
}

// Where among a trial's inputs the one of a shared direction is; -1: it has none.
int InputPlace(const TrialProblem& trial, const SensitivityDirection& direction) {
  for (std::size_t i = 0; i < trial.inputs.size(); ++i)
    if (static_cast<int>(trial.inputs[i].kind) == direction.index) return static_cast<int>(i);
  return -1;
}

// A shared direction in one trial's request: an input by its place there. What does not act in the
// trial is differentiated by something else, and its column emptied.
SensitivityDirection DirectionIn(const TrialProblem& trial, const SharedParameter& shared) {
  SensitivityDirection d = shared.direction;
  if (d.of != SensitivityDirection::Of::kInput) return d;
  d.index = InputPlace(trial, d);
  return d.index >= 0 ? d : SensitivityDirection::InitialState(0);
}

}  // namespace

bool ActsIn(const SharedParameter& parameter, const TrialProblem& trial) {
  if (!Holds(parameter.only_recordings, trial.recording)) return false;
  return parameter.direction.of != SensitivityDirection::Of::kInput ||
         InputPlace(trial, parameter.direction) >= 0;
}

void ApplyShared(const FitProblem& problem, const TrialProblem& trial,
                 const Eigen::Ref<const Eigen::VectorXd>& shared, Parameters<double>& parameters,
                 std::vector<EffectSetting>& effects) {
  effects = problem.effects;
  for (int i = 0; i < problem.shared_count(); ++i) {
    if (!ActsIn(problem.shared[i], trial)) continue;
    const SensitivityDirection& d = problem.shared[i].direction;
    if (d.of == SensitivityDirection::Of::kParameter)
      Field(parameters, d.parameter) = shared[i];
    else if (d.of == SensitivityDirection::Of::kEffect)
      effects[d.index].values[d.component] = shared[i];
  }
}

std::vector<double> InitialOf(const TrialProblem& trial, const Eigen::Ref<const OwnValues>& own) {
  std::vector<double> initial;
  for (int k = 0; k < trial.own_count(); ++k) {
    if (trial.own[k].direction.of == SensitivityDirection::Of::kInitialState)
      initial.push_back(own[k]);
  }
  return initial;
}

TrialEvaluator::TrialEvaluator(const FitProblem& problem, const TrialProblem& trial)
    : problem_(&problem), trial_(&trial) {
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    channels_.push_back(problem.channels[c].channel);
    sigma_.push_back(SigmaIn(problem, trial, c));
  }
  for (const SharedParameter& s : problem.shared) directions_.push_back(DirectionIn(trial, s));
  for (const OwnParameter& o : trial.own) {
    const bool deviates = o.deviation_of >= 0;
    directions_.push_back(deviates ? directions_[static_cast<std::size_t>(o.deviation_of)]
                                   : o.direction);
  }
  channel_rows_.resize(channels_.size());
  int row = 0;
  for (std::size_t cell = 0; cell < trial.data.size(); ++cell) {
    if (std::isnan(trial.data[cell])) continue;
    ChannelRows& c = channel_rows_[cell % channels_.size()];
    c.rows.push_back(row++);
    c.times.push_back(trial.row_times[cell / channels_.size()]);
  }
  horizon_ = LatestReading(problem.effects, trial.row_times.back()) + LatestClock(problem, trial);
  if (problem.uses_contact) horizon_ += kContactMargin;
  if (std::any_of(problem.effects.begin(), problem.effects.end(), FiltersPose))
    horizon_ = std::max(horizon_, trial.row_times.back() + kFilterMargin);
  residual_count_ = static_cast<int>(trial.sample_count);
  for (const OwnParameter& o : trial.own) residual_count_ += std::isfinite(o.prior_sigma) ? 1 : 0;
  residual_count_ += static_cast<int>(trial.shared_priors.size());
}

void TrialEvaluator::Simulate(const EvaluationRequest& request, const IntegratorOptions& integrator,
                              Trajectory& out) const {
  TrialRequest trial_request;
  FillTrialRequest(*problem_, *trial_, request.shared, request.own, trial_request);
  SimulationRequest& sim = trial_request.request;
  sim.fly_on = request.fly_on;
  sim.horizon = horizon_;
  sim.row_times = trial_->row_times;
  sim.channels = channels_;
  const ColumnRange columns = ColumnsOf(request);
  if (request.want_jacobian)
    sim.directions = std::span(directions_)
                         .subspan(static_cast<std::size_t>(columns.first),
                                  static_cast<std::size_t>(columns.count));
  sim.integrator = integrator;
  // Hop traces take hundreds of steps. Values at which one takes this many (a leg that chatters, a
  // damper far too stiff) are not where a fit is going, and must not hold it up.
  sim.integrator.max_steps = std::min(integrator.max_steps, kMostSteps);
  hoplab::Simulate(sim, out);
}

namespace {

// The loss on the first `rows` residuals.
void ApplyLossTo(int rows, const EvaluationRequest& request, TrialEvaluation& out) {
  if (request.loss.kind == LossKind::kSquared) return;
  for (int i = 0; i < rows; ++i) {
    const double slope = ApplyLoss(request.loss, out.residuals[i]);
    if (request.want_jacobian) out.jacobian.row(i) *= slope;
  }
}

}  // namespace

void TrialEvaluator::Evaluate(const EvaluationRequest& request, TrialEvaluation& out) const {
  Trajectory& trajectory = out.trajectory;
  Simulate(request, problem_->integrator, trajectory);
  out.complete = out.evaluated = false;
  out.data_residuals = static_cast<int>(trial_->sample_count);
  out.residuals.resize(residual_count_);
  const ColumnRange wanted = ColumnsOf(request);
  const auto width = static_cast<std::size_t>(wanted.count);
  if (request.want_jacobian) out.jacobian.resize(residual_count_, wanted.count);
  int next = 0;
  bool complete = true;
  const auto add = [&](double residual, const double* slopes, double scale) {
    out.residuals[next] = residual;
    if (request.want_jacobian) {
      for (int k = 0; k < wanted.count; ++k) out.jacobian(next, k) = scale * slopes[k];
    }
    ++next;
  };

  const std::size_t columns = channels_.size();
  for (std::size_t cell = 0; cell < trial_->data.size(); ++cell) {
    if (std::isnan(trial_->data[cell])) continue;
    if (std::isnan(trajectory.samples[cell])) return;
    const bool in_run = static_cast<int>(cell / columns) < trajectory.rows_in_run;
    complete = complete && in_run;
    const double weight = 1.0 / sigma_[cell % columns];
    add((trajectory.samples[cell] - trial_->data[cell]) * weight,
        request.want_jacobian ? &trajectory.sensitivities[cell * width] : nullptr, weight);
  }
  const ContactReading contact(*problem_, *trial_, request);
  std::vector<double> slopes(width);
  const auto add_times = [&](EventKind kind, const std::vector<double>& measured,
                             const std::vector<double>& sigma) {
    const std::vector<EventTime> simulated = TimesOf(trajectory, kind);
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const bool made = i < simulated.size();
      complete = complete && made;
      const double time = made ? simulated[i].time : horizon_;
      for (std::size_t k = 0; request.want_jacobian && k < width; ++k)
        slopes[k] =
            (made ? trajectory.event_time_sensitivities[simulated[i].index * width + k] : 0.0) -
            contact.Slope(measured[i], directions_[static_cast<std::size_t>(wanted.first) + k]);
      add((time - contact.Time(measured[i])) / sigma[i], slopes.data(), 1.0 / sigma[i]);
    }
    return complete || request.fly_on;
  };
  const EventKind down =
      TraitsOf(problem_->law).has_stance ? EventKind::kTouchdown : EventKind::kBounce;
  if (!add_times(down, trial_->contact.touchdown_s, trial_->contact.touchdown_sigma_s)) return;
  if (!add_times(EventKind::kLiftoff, trial_->contact.liftoff_s, trial_->contact.liftoff_sigma_s))
    return;

  out.white_square = out.residuals.head(next).squaredNorm();
  out.half_log_determinant = 0.0;
  if (request.whiten && !problem_->noise.IsWhite()) Whiten(out, request.want_jacobian);
  ApplyLossTo(next, request, out);
  ClearCut(request, next, out);
  AddPriors(request, next, out);
  out.complete = out.evaluated && complete;
}

// A deviation beyond the bounds moves nothing, nor does its value: the first `rows` of their
// columns.
void TrialEvaluator::ClearCut(const EvaluationRequest& request, int rows,
                              TrialEvaluation& out) const {
  if (!request.want_jacobian) return;
  const ColumnRange columns = ColumnsOf(request);
  const auto clear = [&](int place) {
    const int k = place - columns.first;
    if (k >= 0 && k < columns.count) out.jacobian.col(k).head(rows).setZero();
  };
  for (int k = 0; k < trial_->own_count(); ++k) {
    const int of = trial_->own[static_cast<std::size_t>(k)].deviation_of;
    if (of < 0) continue;
    const SharedParameter& s = problem_->shared[static_cast<std::size_t>(of)];
    if (!IsCut(s, request.shared[of], request.own[k])) continue;
    clear(of);
    clear(problem_->shared_count() + k);
  }
}

// The rows from `next` on. What does not act in the trial moves none of the rows before.
void TrialEvaluator::AddPriors(const EvaluationRequest& request, int next,
                               TrialEvaluation& out) const {
  const ColumnRange columns = ColumnsOf(request);
  const int shared = problem_->shared_count(), data = next;
  // A prior is not a measurement with outliers: no loss on it.
  const auto add = [&](double residual, int column, double sigma) {
    out.residuals[next] = residual;
    if (request.want_jacobian) {
      out.jacobian.row(next).setZero();
      const int k = column - columns.first;
      if (k >= 0 && k < columns.count) out.jacobian(next, k) = 1.0 / sigma;
    }
    ++next;
  };
  for (int k = 0; k < trial_->own_count(); ++k) {
    const OwnParameter& o = trial_->own[static_cast<std::size_t>(k)];
    if (std::isfinite(o.prior_sigma))
      add((request.own[k] - o.prior_mean) / o.prior_sigma, shared + k, o.prior_sigma);
  }
  for (const SharedPrior& prior : trial_->shared_priors)
    add((request.shared[prior.shared] - prior.mean) / prior.sigma, prior.shared, prior.sigma);
  for (int k = 0; request.want_jacobian && k < columns.count; ++k) {
    const int place = columns.first + k;
    if (place < shared && !ActsIn(problem_->shared[static_cast<std::size_t>(place)], *trial_))
      out.jacobian.col(k).head(data).setZero();
  }
  out.evaluated = next == residual_count_;
}

double TrialEvaluator::WhitenRows(const NoiseModel& noise,
                                  Eigen::Ref<RowMajorMatrix> block,  // NOLINT: a view, written to
                                  Eigen::VectorXd* log_roots) const {
  double half_log_determinant = 0.0;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const double ratio = AmplitudeIn(noise, *trial_, c);
    if (!(ratio > 0.0)) continue;
    const ChannelRows& at = channel_rows_[c];
    half_log_determinant +=
        WhitenMatern(at.times, at.rows, ratio, noise.time_scale, block, log_roots);
  }
  return half_log_determinant;
}

void TrialEvaluator::Whiten(TrialEvaluation& out, bool jacobian) const {
  const Eigen::Index columns = jacobian ? out.jacobian.cols() : 0;
  RowMajorMatrix block(out.data_residuals, columns + 1);
  if (jacobian) block.leftCols(columns) = out.jacobian.topRows(out.data_residuals);
  block.col(columns) = out.residuals.head(out.data_residuals);
  out.half_log_determinant = WhitenRows(problem_->noise, block);
  if (jacobian) out.jacobian.topRows(out.data_residuals) = block.leftCols(columns);
  out.residuals.head(out.data_residuals) = block.col(columns);
}

}  // namespace hoplab
