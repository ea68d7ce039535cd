#include "fitting/diagnosis/varying.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fitting/deviation.h"
#include "fitting/diagnosis/heterogeneity.h"
#include "fitting/discrepancy/matern_filter.h"
#include "fitting/eliminated_trial.h"
#include "fitting/trial_noise.h"
#include "fitting/uncertainty.h"

namespace hoplab {
namespace {

constexpr double kAtRest = 0.03;  // change of a spread's logarithm
constexpr int kMostRounds = 20;

// Gives the trials deviations of the values, at the sizes they seem to have.
void Begin(const std::vector<VaryingValue>& values, VaryingModel& v) {
  FittedModel& m = v.model;
  for (const VaryingValue& value : values) {
    for (TrialProblem& t : m.problem.trials) AddDeviation(m.problem, value.place, value.spread, t);
    for (std::size_t i = 0; i < v.train.size(); ++i) {
      if (!AddDeviation(m.problem, value.place, value.spread, v.train[i])) continue;
      const SharedParameter& s = m.problem.shared[static_cast<std::size_t>(value.place)];
      const double size = std::isfinite(value.sizes[i]) ? value.sizes[i] : value.mean;
      OwnValues& own = m.initial_states[i];
      own.conservativeResize(own.size() + 1);
      own[own.size() - 1] = std::clamp(size, s.lower, s.upper) - m.shared[value.place];
    }
  }
}

// Gives all trials this prior of their deviations.
void SetPrior(int place, double sigma, VaryingModel& v) {
  for (TrialProblem& t : v.model.problem.trials) SetSpread(place, sigma, t);
  for (TrialProblem& t : v.train) SetSpread(place, sigma, t);
}
void SetPriors(VaryingModel& v) {
  for (const VaryingValue& value : v.values) SetPrior(value.place, value.spread, v);
}

// By what factor the discrepancy widens the variance of one trial's size: c'(I + K) c/c'c, c its
// column beside the trial's other own values, K the discrepancy's covariance, both in units of
// sigma. The mean over trials.
double Inflation(const VaryingModel& v, int place) {
  const FittedModel& m = v.model;
  if (m.problem.noise.IsWhite()) return 1.0;
  double sum = 0.0, trials = 0.0;
  for (std::size_t i = 0; i < v.train.size(); ++i) {
    TrialProblem trial = v.train[i];
    const std::optional<int> k = DeviationOf(place, trial);
    if (!k) continue;
    const TrialEvaluator evaluator(m.problem, v.train[i]);
    TrialEvaluation e;
    EvaluationRequest request{m.shared, m.initial_states[i], true};
    request.whiten = false;
    evaluator.Evaluate(request, e);
    if (!e.complete) continue;
    trial.own[static_cast<std::size_t>(*k)].free = false;
    const int n = m.problem.shared_count();
    const Eigen::MatrixXd c =
        ProjectedColumns(OwnBasis(trial, e, n), e, {{place, trial.own.back().scale}}).leftCols(1);
    double smooth = 0.0;
    for (std::size_t ch = 0; ch < evaluator.channel_rows().size(); ++ch) {
      const ChannelRows& rows = evaluator.channel_rows()[ch];
      const double ratio = AmplitudeIn(m.problem.noise, trial, ch);
      if (ratio > 0.0)
        smooth += MaternProduct(rows.times, rows.rows, ratio, m.problem.noise.time_scale, c)(0, 0);
    }
    if (!(c.squaredNorm() > 0.0)) continue;
    sum += 1.0 + smooth / c.squaredNorm();
    trials += 1.0;
  }
  return trials > 0.0 ? sum / trials : 1.0;
}

// Deviations that the shared value has left behind a bound are put on it: what acts stays, and the
// trial answers to it.
void PutInside(VaryingModel& v) {
  FittedModel& m = v.model;
  for (std::size_t i = 0; i < v.train.size(); ++i) {
    for (int k = 0; k < v.train[i].own_count(); ++k) {
      const auto [low, high] =
          OwnBounds(m.problem, v.train[i].own[static_cast<std::size_t>(k)], m.shared);
      m.initial_states[i][k] = std::clamp(m.initial_states[i][k], low, high);
    }
  }
}

// The values as they are at the refit; how far the spreads have moved, as logarithms.
double Look(VaryingModel& v, std::vector<Heterogeneity>& seen, int jobs) {
  double moved = 0.0;
  seen.clear();
  for (VaryingValue& value : v.values) {
    const Heterogeneity h = seen.emplace_back(HeterogeneityAt(v.model, v.train, value.place, jobs));
    if (h.spread > 0.0) moved = std::max(moved, std::abs(std::log(h.spread / value.spread)));
    value.mean = v.model.shared[value.place];
    value.spread = h.spread;
    value.std_errors = h.std_errors;
    value.std_errors.resize(v.train.size(), std::numeric_limits<double>::quiet_NaN());
    value.sizes.clear();
    for (std::size_t i = 0; i < v.train.size(); ++i) {
      const bool acts = DeviationOf(value.place, v.train[i]).has_value();
      value.sizes.push_back(acts ? ActingShared(v.model.problem, v.train[i], v.model.shared,
                                                v.model.initial_states[i])[value.place]
                                 : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return moved;
}

// log of the integral over a spread of its prior and the likelihood over that at its maximum, which
// is a normal one of the spread's logarithm. It is known no better than its own size.
double LogSpreadIntegral(const SharedParameter& s, const Heterogeneity& h) {
  const double u = h.spread / s.scale;
  return LogSizePrior(u, /*one_sided=*/true) + std::log(u) +
         0.5 * std::log(2.0 * std::numbers::pi / std::max(h.curvature, 1.0));
}

void AddIntervals(VaryingModel& v, int jobs) {
  const Uncertainty u =
      AssessUncertainty(v.model.problem, v.train, v.model.shared, v.model.initial_states, {}, jobs);
  for (VaryingValue& value : v.values)
    value.ci95 = u.parameters[static_cast<std::size_t>(value.place)].Wider();
}

// Squares of data and priors, the deviations' priors being the spreads.
double SquareOf(const VaryingModel& v) {
  double sum = 0.0;
  for (std::size_t i = 0; i < v.train.size(); ++i) {
    TrialEvaluation e;
    TrialEvaluator(v.model.problem, v.train[i])
        .Evaluate({v.model.shared, v.model.initial_states[i]}, e);
    sum += e.white_square + e.residuals.tail(e.residuals.size() - e.data_residuals).squaredNorm();
  }
  return sum;
}

// The values that differ at all, to first order.
std::vector<VaryingValue> Differing(const FittedModel& model, const std::vector<int>& places,
                                    const RefitSettings& settings) {
  const std::vector<Heterogeneity> seen =
      HeterogeneityOf(UnderWhiteNoise(model), *settings.train, settings.jobs);
  std::vector<VaryingValue> values;
  for (const int place : places) {
    const Heterogeneity& h = seen[static_cast<std::size_t>(place)];
    if (h.spread > 0.0)
      values.push_back({.place = place, .mean = h.mean, .spread = h.spread, .sizes = h.sizes});
  }
  return values;
}

}  // namespace

void SetRidges(VaryingModel& v) {
  for (const VaryingValue& value : v.values)
    SetPrior(value.place, value.spread / std::sqrt(Inflation(v, value.place)), v);
}

FittedModel UnderWhiteNoise(FittedModel model) {
  model.problem.noise = {};
  return model;
}

void BringToRest(VaryingModel& v, const RefitSettings& settings, const NoiseModel& also) {
  RefitSettings own = settings;
  own.train = &v.train;
  v.converged = false;
  std::vector<Heterogeneity> seen;
  for (; v.rounds < kMostRounds && !v.converged; ++v.rounds) {
    if (settings.stop && *settings.stop) return;
    SetRidges(v);
    // Another ridge is another cost: what the last one came to says nothing.
    v.model.cost = std::numeric_limits<double>::infinity();
    if (!EndFit(v.model, own)) return;
    PutInside(v);
    SetPriors(v);
    SettleNoise(v.model, own, also);
    if (!v.model.settled) return;
    v.converged = Look(v, seen, settings.jobs) < kAtRest;
    if (std::any_of(v.values.begin(), v.values.end(),
                    [](const VaryingValue& value) { return !(value.spread > 0.0); })) {
      v.converged = false;
      return;
    }
  }
  if (!v.converged) return;
  v.log_z = v.model.evidence.log_z();
  for (std::size_t k = 0; k < v.values.size(); ++k)
    v.log_z += LogSpreadIntegral(
        v.model.problem.shared[static_cast<std::size_t>(v.values[k].place)], seen[k]);
  AddIntervals(v, settings.jobs);
  v.square = SquareOf(v);
}

VaryingModel RefitVarying(const FittedModel& model, const std::vector<int>& places,
                          const RefitSettings& settings) {
  VaryingModel v;
  v.model = UnderWhiteNoise(model);
  v.train = *settings.train;
  v.values = Differing(model, places, settings);
  if (v.values.empty()) {
    v.converged = true;
    return v;
  }
  Begin(v.values, v);
  BringToRest(v, settings, model.problem.noise);
  std::vector<int> left;
  for (const VaryingValue& value : v.values)
    if (value.spread > 0.0) left.push_back(value.place);
  if (left.size() < v.values.size()) return RefitVarying(model, left, settings);
  if (v.converged) v.gain = v.log_z - model.evidence.log_z();
  return v;
}

}  // namespace hoplab
