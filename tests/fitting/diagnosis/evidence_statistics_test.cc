// Laplace's evidence of many models against the same integral by sampling.
// ctest -L statistics
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/fitting/diagnosis/study.h"
#include "tests/support/sampled_evidence.h"

namespace hoplab::testing {
namespace {

struct EvidenceCase {
  const char* what;
  std::vector<EffectSpec> planted;
  std::vector<std::string> causes;  // of the model
  std::uint64_t seed = 5;
  std::vector<double> disturbance = {};  // amplitudes of a process on the traces, in sigma
  double within = 0.3;                   // nats
};

struct CaseFit {
  NullFit fit;
  FittedModel model;

  CaseFit(const EvidenceCase& of, Discrepancy discrepancy) : fit(DatasetFor(of)), model(fit.null) {
    const RefitSettings settings = fit.SettingsOf(discrepancy);
    for (const std::string& name : of.causes) {
      const std::array added = {CandidateOf(name)};
      // From well inside the bounds.
      const Eigen::VectorXd size =
          Eigen::VectorXd::Constant(1, 0.1 * added[0].Parameter(0).typical);
      model = Refit(model, added, size, settings);
    }
    Settle(model, settings);
  }
  static Dataset DatasetFor(const EvidenceCase& of) {
    Dataset dataset = DatasetOf(ShortWorld(of.planted, of.seed));
    if (!of.disturbance.empty()) Disturb(dataset, of.disturbance, of.seed);
    return dataset;
  }
};

const std::vector<std::string> kColumns = {
    "model and data", "values in sizes", "Laplace",
    "sampled",        "difference",      "linearised at the mean of the samples"};

// Of all but the modulus and the damper.
std::string SizesOf(const FittedModel& model) {
  std::string text;
  for (Eigen::Index k = 2; k < model.shared.size(); ++k) {
    const SharedParameter& s = model.problem.shared[static_cast<std::size_t>(k)];
    text += Cell("%s %.2f ", s.name.c_str(), (model.shared[k] - s.initial) / s.scale);
  }
  return text;
}

// Laplace's value with the model linearised at the mean of the samples, not at the least squares.
double AtTheMean(const CaseFit& f, const Eigen::VectorXd& mean, bool discrepancy) {
  const FitProblem& problem = f.model.problem;
  Eigen::VectorXd shared(problem.shared_count());
  Eigen::Index at = 0;
  for (double& value : shared) {
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(at)];
    value = std::clamp(mean[at++] * s.scale, s.lower, s.upper);
  }
  std::vector<OwnValues> initial_states = f.model.initial_states;
  for (std::size_t i = 0; i < initial_states.size(); ++i) {
    for (Eigen::Index k = 0; k < initial_states[i].size(); ++k)
      initial_states[i][k] = mean[at++] * f.fit.train[i].own[static_cast<std::size_t>(k)].scale;
  }
  const RestrictedLikelihood likelihood(problem, f.fit.train, shared, initial_states, 1);
  const Evidence e = EvidenceOf(problem, shared, likelihood, likelihood, problem.noise);
  return discrepancy ? e.discrepancy : e.white;
}

void Tell(const EvidenceCase& of, const CaseFit& f, bool discrepancy, std::string values,
          const SamplingSettings& settings, Report& report) {
  const ComparedEvidence e = CompareEvidence(of.what, f.model, f.fit.train, discrepancy, settings);
  const double at_the_mean = AtTheMean(f, e.sampled.mean, discrepancy);
  report.Row({of.what, std::move(values), Cell("%.2f", e.laplace),
              Cell("%.2f +- %.2f", e.sampled.log_value, e.sampled.std_error),
              Cell("%+.2f", e.difference()), Cell("%+.2f", at_the_mean - e.sampled.log_value)});
  EXPECT_LT(e.sampled.std_error, 0.1) << of.what << ", seed " << of.seed;
  EXPECT_NEAR(e.difference(), 0.0, of.within) << of.what << ", seed " << of.seed;
  EXPECT_NEAR(at_the_mean, e.sampled.log_value, 0.3) << of.what << ", seed " << of.seed;
}

TEST(DiagnosisStatistics, TheEvidenceUnderWhiteNoiseIsTheSampledOne) {
  const EffectSpec bias = EffectOfSize("touchdown_angle_bias", 0.02);
  const EffectSpec drag = EffectOfSize("air_drag", 0.03);
  const EffectSpec loss = EffectOfSize("touchdown_loss", 0.004);
  const std::vector<EvidenceCase> cases = {
      {"a cause well seen", {bias}, {"touchdown_angle_bias"}},
      {"a small one", {EffectOfSize("touchdown_angle_bias", 0.003)}, {"touchdown_angle_bias"}},
      {"one that is not there", {}, {"touchdown_angle_bias"}, 1},
      {"the same", {}, {"touchdown_angle_bias"}, 2},
      {"two causes", {bias, drag}, {"touchdown_angle_bias", "air_drag"}},
      {"two, one not there", {bias}, {"touchdown_angle_bias", "gravity_scale"}},
      {"three, one not there", {bias, drag}, {"touchdown_angle_bias", "air_drag", "gravity_scale"}},
      {"not there, at its bound", {}, {"air_drag"}, 1},
      {"the same", {}, {"touchdown_loss"}, 3},
      {"small, at its bound", {loss}, {"touchdown_loss"}, 1},
      {"two at their bounds", {}, {"air_drag", "touchdown_loss"}, 1},
      {"near its bound", {}, {"air_drag"}, 3},
      {"the same", {}, {"touchdown_loss"}, 2},
      {"the same", {loss}, {"touchdown_loss"}, 4}};
  Report report("7-evidence-white", "Evidence under white noise, in nats");
  report.Head(kColumns);
  for (const EvidenceCase& c : cases) {
    const CaseFit f(c, Discrepancy::kNone);
    ASSERT_TRUE(f.model.ok()) << c.what;
    SamplingSettings settings;
    settings.draws = 4000;
    settings.proposals = 2000;
    Tell(c, f, false, SizesOf(f.model), settings, report);
  }
}

SamplingSettings ForADiscrepancy() {
  return {.warm_up = 16'000, .chains = 8, .draws = 16'000, .proposals = 8'000};
}

// The values an evidence is taken at are those of least squares under white noise; the likelihood
// with a discrepancy has its optimum elsewhere, often some standard errors off, and the samples are
// drawn around that. So this tests that the linear model, continued from the least squares, is good
// enough there, and that the prior is that of where the likelihood leads.
TEST(DiagnosisStatistics, TheEvidenceWithADiscrepancyIsTheSampledOne) {
  const EffectSpec bias = EffectOfSize("touchdown_angle_bias", 0.02);
  const EffectSpec more = EffectOfSize("touchdown_angle_bias", 0.03);
  const std::vector<EvidenceCase> cases = {
      {"a process on the traces", {}, {}, 1, {3.0, 3.0}},
      {"the same", {}, {}, 3, {3.0, 3.0}},
      {"on one channel", {}, {}, 1, {0.0, 3.0}},
      {"and a cause", {bias}, {"touchdown_angle_bias"}, 1, {3.0, 3.0}},
      {"the same", {bias}, {"touchdown_angle_bias"}, 3, {3.0, 3.0}},
      {"and a cause at its bound", {}, {"air_drag"}, 2, {3.0, 3.0}},
      // Known misses: with a cause missing the likelihood's optimum is four standard errors from
      // the least squares (the modulus 1.33 and 1.24 of its scale), and the model is not straight
      // between. Linearised at the optimum the value is right, as the last column says.
      {"a cause that the model lacks", {more}, {}, 1, {}, 0.7},
      {"the same", {more}, {}, 4, {}, 0.45}};
  Report report("7-evidence", "Evidence with a discrepancy, in nats");
  report.Head(kColumns);
  for (const EvidenceCase& c : cases) {
    const CaseFit f(c, Discrepancy::kMatern);
    ASSERT_TRUE(f.model.ok()) << c.what;
    const hoplab::NoiseModel& noise = f.model.problem.noise;
    ASSERT_FALSE(noise.IsWhite()) << c.what;
    const std::string values =
        SizesOf(f.model) + Cell("amplitudes %.1f, %.1f sigma, %.3f s", noise.amplitude[0],
                                noise.amplitude[1], noise.time_scale);
    Tell(c, f, true, values, ForADiscrepancy(), report);
  }
}

// Where no discrepancy pays none is counted. What that leaves out of the whole evidence.
TEST(DiagnosisStatistics, ADiscrepancyThatDoesNotPayIsNoPartOfTheEvidence) {
  Report report("7-evidence-none", "Evidence of a discrepancy that was not found, in nats");
  report.Head({"seed", "white, Laplace", "discrepancy, sampled", "whole, Laplace", "whole"});
  for (const std::uint64_t seed : {1, 2, 3}) {
    const EvidenceCase c = {"no cause", {}, {}, seed};
    const CaseFit f(c, Discrepancy::kMatern);
    ASSERT_TRUE(f.model.problem.noise.IsWhite()) << seed;
    ComparedEvidence e = CompareEvidence(c.what, f.model, f.fit.train, true, ForADiscrepancy());
    Evidence whole = f.model.evidence;
    whole.discrepancy = e.sampled.log_value;
    report.Row({Cell("%d", static_cast<int>(seed)), Cell("%.2f", whole.white),
                Cell("%.2f +- %.2f", whole.discrepancy, e.sampled.std_error),
                Cell("%.2f", f.model.evidence.log_z()), Cell("%.2f", whole.log_z())});
    EXPECT_NEAR(f.model.evidence.log_z(), whole.log_z(), 0.3) << seed;
  }
}

}  // namespace
}  // namespace hoplab::testing
