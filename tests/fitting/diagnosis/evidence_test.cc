#include "fitting/diagnosis/evidence.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::EffectOfSize;
using testing::NullFit;

TEST(LogSizePrior, IsADensity) {
  const auto density = [](double u) { return std::exp(LogSizePrior(u, false)); };
  double sum = 0.0;
  for (const auto& [a, b] : {std::pair{0.0, 0.1}, {0.1, 1.0}, {1.0, 10.0}, {10.0, 300.0}})
    sum += boost::math::quadrature::gauss_kronrod<double, 61>::integrate(density, a, b);
  EXPECT_NEAR(2.0 * sum, 1.0, 1e-9);
  EXPECT_NEAR(LogSizePrior(1.7, true) - LogSizePrior(1.7, false), std::log(2.0), 1e-12);
}

TEST(LogSizePrior, IsSurprisedNeitherByATenthNorByTenTimesTheTypicalSize) {
  // A normal density of one typical size would find ten of them e^-50 as likely.
  EXPECT_GT(LogSizePrior(10.0, false) - LogSizePrior(1.0, false), -5.0);
  EXPECT_GT(LogSizePrior(0.1, false), LogSizePrior(1.0, false));
}

// The evidence of one cause under white noise, its integral over the size and the base values done
// by quadrature over the size, the rest by its best fit and curvature at each size.
double LogEvidenceBySlices(const NullFit& fit, const FittedModel& e) {
  const double at = e.shared[e.shared.size() - 1];
  const SharedParameter& s = e.problem.shared.back();
  // Curvature at the optimum says how far to look.
  const Uncertainty u = AssessUncertainty(e.problem, fit.train, e.shared, e.initial_states, {}, 1);
  const double sigma = *u.parameters.back().std_error;
  double peak = 0.0;
  const auto log_slice = [&](double value) {
    SolveRequest q;
    q.problem = &e.problem;
    q.trials = &fit.train;
    q.shared = e.shared;
    q.shared[q.shared.size() - 1] = value;
    q.initial_states = e.initial_states;
    q.held = {e.problem.shared_count() - 1};
    const SolveResult r = Solve(q);
    FitProblem rest = e.problem;
    rest.shared.pop_back();
    rest.effects.back().values[0] = value;
    LikelihoodDetail detail;
    detail.prior_widths = PriorWidths(rest, r.shared.head(rest.shared_count()));
    const RestrictedLikelihood likelihood(rest, fit.train, r.shared.head(rest.shared_count()),
                                          r.initial_states, 1, detail);
    double sum = likelihood.At({}) + 0.5 * rest.shared_count() * std::log(2.0 * std::numbers::pi);
    for (int k = 0; k < rest.shared_count(); ++k)
      sum += LogSizePrior(r.shared[k] / rest.shared[k].scale, rest.shared[k].lower >= 0.0);
    return sum + LogSizePrior((value - s.initial) / s.scale, s.lower >= s.initial);
  };
  peak = log_slice(at);
  const auto slice = [&](double value) { return std::exp(log_slice(value) - peak); };
  const double integral = boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
      slice, at - 6.0 * sigma, at + 6.0 * sigma, 0);
  return peak + std::log(integral / s.scale);
}

// What is known to a thousandth of itself is no surprise where it was stated.
TEST(PriorWidths, OfAStatedScaleOrOffsetCountFromWhatIsStated) {
  FitProblem problem;
  const SharedParameter scale{.name = "torque.scale",
                              .unit = "-",
                              .direction = {.of = SensitivityDirection::Of::kInput, .component = 1},
                              .lower = 0.5,
                              .upper = 1.5,
                              .initial = 1.0,
                              .scale = 1e-3};
  SharedParameter clock = scale;
  clock.direction = {.of = SensitivityDirection::Of::kClock};
  clock.initial = 0.02;
  problem.shared = {scale, clock};
  const Eigen::VectorXd widths = PriorWidths(problem, Eigen::Vector2d(1.001, 0.022));
  EXPECT_NEAR(widths[0], 1.0, 1e-9);
  EXPECT_NEAR(widths[1], 2.0, 1e-9);
}

TEST(EvidenceOf, IsTheIntegralOverTheSize) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.02)}});
  FittedModel e = fit.RefittedWith(CandidateOf("touchdown_angle_bias"));
  Settle(e, fit.SettingsOf(Discrepancy::kNone));
  EXPECT_NEAR(e.evidence.white, LogEvidenceBySlices(fit, e), 0.3);
}

TEST(EvidenceOf, PrefersTheTruthByFar) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}});
  FittedModel truth = fit.RefittedWith(CandidateOf("touchdown_angle_bias"));
  FittedModel other = fit.RefittedWith(CandidateOf("air_drag"));
  Settle(truth, fit.Settings());
  Settle(other, fit.Settings());
  EXPECT_GT(truth.evidence.log_z(), fit.settled.evidence.log_z() + 10.0);
  EXPECT_GT(truth.evidence.log_z(), other.evidence.log_z() + 10.0);
  EXPECT_LT(truth.evidence.discrepancy_probability(), 0.5);
  EXPECT_GT(fit.settled.evidence.discrepancy_probability(), 0.99);
}

TEST(EvidenceOf, ACauseThatIsNotTherePaysForItsRoom) {
  int preferred = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const NullFit fit({.seed = seed});
    FittedModel e = fit.RefittedWith(CandidateOf("touchdown_angle_bias"));
    Settle(e, fit.Settings());
    preferred += e.evidence.log_z() > fit.settled.evidence.log_z();
  }
  EXPECT_LE(preferred, 1);
}

// Two causes that move the data alike in any size: what neither can be told from counts once.
TEST(EvidenceOf, WhatTheDataDoNotTellIsNoGain) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}});
  const testing::Twin twin("touchdown_angle_bias", "twin");
  FittedModel one = fit.RefittedWith(CandidateOf("touchdown_angle_bias"));
  FittedModel two = Refit(one, std::array{twin.candidate()}, Eigen::VectorXd::Zero(1),
                          fit.SettingsOf(Discrepancy::kNone));
  Settle(one, fit.SettingsOf(Discrepancy::kNone));
  Settle(two, fit.SettingsOf(Discrepancy::kNone));
  EXPECT_LT(two.evidence.log_z(), one.evidence.log_z() + 1.0);
}

}  // namespace
}  // namespace hoplab
