#include "fitting/trial_evaluator.h"

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

// A contact time may be simulated somewhat after the last stamp.
constexpr double kContactMargin = 0.11;  // s
// Beyond the last reading, so that it never lies on the horizon itself.
constexpr double kReadingMargin = 0.01;  // s

// The latest a row stamped `last` may be read, whatever values within their bounds the effects that
// shift time (a delay, a clock) come to have.
double LatestReading(std::span<const EffectSetting> settings, double last) {
  std::vector<const Effect*> effects;
  for (const EffectSetting& s : settings) {
    if (s.effect->hooks0.change_observation_time) effects.push_back(s.effect);
  }
  if (effects.empty()) return last;
  std::stable_sort(effects.begin(), effects.end(),
                   [](const Effect* a, const Effect* b) { return a->info.order < b->info.order; });
  for (const Effect* effect : effects) {
    double at_lower = last, at_upper = last;
    std::array<double, kMaxEffectParameters> lower{}, upper{};
    for (std::size_t i = 0; i < effect->info.parameters.size(); ++i) {
      lower[i] = effect->info.parameters[i].lower;
      upper[i] = effect->info.parameters[i].upper;
    }
    effect->hooks0.change_observation_time(lower.data(), at_lower);
    effect->hooks0.change_observation_time(upper.data(), at_upper);
    last = std::max({last, at_lower, at_upper});
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

}  // namespace

bool ActsIn(const SharedParameter& parameter, const TrialProblem& trial) {
  return parameter.only_recording.empty() || parameter.only_recording == trial.recording;
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
    else
      effects[d.index].values[d.component] = shared[i];
  }
}

TrialEvaluator::TrialEvaluator(const FitProblem& problem, const TrialProblem& trial)
    : problem_(&problem), trial_(&trial) {
  for (const ChannelProblem& c : problem.channels) {
    channels_.push_back(c.channel);
    sigma_.push_back(c.sigma);
  }
  for (const SharedParameter& s : problem.shared) directions_.push_back(s.direction);
  for (int i = 0; i < 4; ++i) directions_.push_back(SensitivityDirection::InitialState(i));
  horizon_ = trial.row_times.back();
  if (problem.uses_contact) horizon_ += kContactMargin;
  horizon_ = std::max(horizon_, LatestReading(problem.effects, trial.row_times.back()));
  residual_count_ = static_cast<int>(trial.sample_count);
  for (double sigma : trial.prior_sigma) residual_count_ += std::isfinite(sigma) ? 1 : 0;
}

void TrialEvaluator::Simulate(const EvaluationRequest& request, const IntegratorOptions& integrator,
                              Trajectory& out) const {
  SimulationRequest sim;
  sim.law = problem_->law;
  sim.liftoff = trial_->liftoff;
  sim.parameters = trial_->parameters;
  std::vector<EffectSetting> effects;
  ApplyShared(*problem_, *trial_, request.shared, sim.parameters, effects);
  sim.effects = effects;
  sim.initial = request.start;
  sim.horizon = horizon_;
  sim.row_times = trial_->row_times;
  sim.channels = channels_;
  if (request.want_jacobian) sim.directions = directions_;
  sim.integrator = integrator;
  // Hop traces take hundreds of steps. Values at which one takes this many (a leg that chatters, a
  // damper far too stiff) are not where a fit is going, and must not hold it up.
  sim.integrator.max_steps = std::min(integrator.max_steps, kMostSteps);
  hoplab::Simulate(sim, out);
}

void TrialEvaluator::Evaluate(const EvaluationRequest& request, TrialEvaluation& out) const {
  Trajectory& trajectory = out.trajectory;
  Simulate(request, problem_->integrator, trajectory);
  out.complete = false;
  out.data_residuals = static_cast<int>(trial_->sample_count);
  out.residuals.resize(residual_count_);
  const int shared = problem_->shared_count();
  const int width = shared + 4;
  if (request.want_jacobian) out.jacobian.resize(residual_count_, width);

  int next = 0;
  const auto add = [&](double residual, const double* slopes, double scale) {
    const double slope = ApplyLoss(request.loss, residual);
    out.residuals[next] = residual;
    if (request.want_jacobian) {
      for (int k = 0; k < width; ++k) out.jacobian(next, k) = slope * scale * slopes[k];
    }
    ++next;
  };

  const std::size_t columns = channels_.size();
  for (std::size_t cell = 0; cell < trial_->data.size(); ++cell) {
    if (std::isnan(trial_->data[cell])) continue;
    if (std::isnan(trajectory.samples[cell])) return;
    const double weight = 1.0 / sigma_[cell % columns];
    add((trajectory.samples[cell] - trial_->data[cell]) * weight,
        request.want_jacobian ? &trajectory.sensitivities[cell * width] : nullptr, weight);
  }
  const auto add_times = [&](EventKind kind, const std::vector<double>& measured,
                             const std::vector<double>& sigma) {
    const std::vector<EventTime> simulated = TimesOf(trajectory, kind);
    if (simulated.size() < measured.size()) return false;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      add((simulated[i].time - measured[i]) / sigma[i],
          request.want_jacobian ? &trajectory.event_time_sensitivities[simulated[i].index * width]
                                : nullptr,
          1.0 / sigma[i]);
    }
    return true;
  };
  const EventKind down = problem_->law == Law::kBall ? EventKind::kBounce : EventKind::kTouchdown;
  if (!add_times(down, trial_->contact.touchdown_s, trial_->contact.touchdown_sigma_s)) return;
  if (!add_times(EventKind::kLiftoff, trial_->contact.liftoff_s, trial_->contact.liftoff_sigma_s))
    return;

  // The prior is not a measurement with outliers: no loss on it.
  for (int i = 0; i < 4; ++i) {
    if (!std::isfinite(trial_->prior_sigma[i])) continue;
    out.residuals[next] = (request.start[i] - trial_->prior_mean[i]) / trial_->prior_sigma[i];
    if (request.want_jacobian) {
      out.jacobian.row(next).setZero();
      out.jacobian(next, shared + i) = 1.0 / trial_->prior_sigma[i];
    }
    ++next;
  }
  if (request.want_jacobian) {
    for (int k = 0; k < shared; ++k) {
      if (!ActsIn(problem_->shared[k], *trial_)) out.jacobian.col(k).setZero();
    }
  }
  out.complete = next == residual_count_;
}

TrialProblem CutTrial(const FitProblem& problem, const TrialProblem& trial, int first, int last) {
  TrialProblem cut = trial;
  const std::size_t width = problem.channels.size();
  const double origin = trial.row_times[first], end = trial.row_times[last - 1] - origin;
  cut.row_times.assign(trial.row_times.begin() + first, trial.row_times.begin() + last);
  for (double& t : cut.row_times) t -= origin;
  cut.begin_s += origin;
  cut.parameters.time_origin += origin;
  cut.data.assign(trial.data.begin() + static_cast<std::ptrdiff_t>(first * width),
                  trial.data.begin() + static_cast<std::ptrdiff_t>(last * width));
  cut.sample_count =
      std::count_if(cut.data.begin(), cut.data.end(), [](double v) { return !std::isnan(v); });
  const auto cut_times = [&](const std::vector<double>& times, const std::vector<double>& sigmas,
                             std::vector<double>& out, std::vector<double>& out_sigmas) {
    out.clear();
    out_sigmas.clear();
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double t = times[i] - origin;
      if (t <= 0.0 || t >= end) continue;
      out.push_back(t);
      out_sigmas.push_back(sigmas[i]);
      ++cut.sample_count;
    }
  };
  cut_times(trial.contact.touchdown_s, trial.contact.touchdown_sigma_s, cut.contact.touchdown_s,
            cut.contact.touchdown_sigma_s);
  cut_times(trial.contact.liftoff_s, trial.contact.liftoff_sigma_s, cut.contact.liftoff_s,
            cut.contact.liftoff_sigma_s);
  if (first > 0) cut.prior_sigma.fill(std::numeric_limits<double>::infinity());
  return cut;
}

}  // namespace hoplab
