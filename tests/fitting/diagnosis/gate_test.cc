#include "fitting/diagnosis/gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::NullFit;

std::string RefusalOf(const NullFit& fit) { return CheckGate(fit.null, fit.train, 1).Refusal(); }

TEST(Gate, OpensForAFitOfCleanData) {
  const NullFit fit{testing::World{}};
  const Gate gate = CheckGate(fit.null, fit.train, 1);
  EXPECT_TRUE(gate.passed()) << gate.Refusal();
  EXPECT_EQ(gate.Refusal(), "");
  std::vector<std::string> names;
  for (const GateCheck& c : gate.checks) names.push_back(c.name);
  EXPECT_EQ(names, (std::vector<std::string>{"fit", "events", "noise", "gradients"}));
}

TEST(Gate, TellsAFitThatIsNoMinimum) {
  NullFit fit{testing::World{}};
  EXPECT_TRUE(CheckGate(fit.null, fit.train, 1).at_minimum);
  fit.null.shared[0] *= 1.01;
  const Gate gate = CheckGate(fit.null, fit.train, 1);
  EXPECT_TRUE(gate.passed()) << gate.Refusal();
  EXPECT_FALSE(gate.at_minimum);
  EXPECT_NE(gate.checks.front().text.find("no minimum"), std::string::npos);
}

TEST(Gate, RefusesAFitThatFailed) {
  NullFit fit{testing::World{}};
  fit.null.status = SolveStatus::kFailed;
  const std::string refusal = RefusalOf(fit);
  EXPECT_EQ(refusal.rfind("fit: ", 0), 0u) << refusal;
  EXPECT_NE(refusal.find(NameOf(SolveStatus::kFailed)), std::string::npos) << refusal;
}

TEST(Gate, LooksNoFurtherThanAFitThatFailed) {
  NullFit fit{testing::World{}};
  fit.null.status = SolveStatus::kFailed;
  const Gate gate = CheckGate(fit.null, fit.train, 1);
  EXPECT_EQ(gate.checks.size(), 1u);
  EXPECT_FALSE(gate.passed());
}

TEST(Gate, RefusesATrialThatFallsAndNamesIt) {
  NullFit fit{testing::World{}};
  fit.train[1].parameters.theta_td = 80.0 * std::numbers::pi / 180.0;
  const std::string refusal = RefusalOf(fit);
  EXPECT_EQ(refusal.rfind("events: train-2.csv", 0), 0u) << refusal;
}

TEST(Gate, RefusesNoiseThatIsNotKnown) {
  for (double sigma : {std::nan(""), 0.0}) {
    NullFit fit{testing::World{}};
    fit.null.problem.channels[1].sigma = sigma;
    const Gate gate = CheckGate(fit.null, fit.train, 1);
    EXPECT_FALSE(gate.passed());
    for (const GateCheck& c : gate.checks) {
      if (c.name == "noise") {
        EXPECT_FALSE(c.passed) << c.text;
      }
    }
  }
}

TEST(Gate, RefusesGradientsThatDifferFromDifferences) {
  // A solver that takes a hop in a few coarse steps differentiates its own errors.
  NullFit fit{testing::World{}};
  fit.null.problem.integrator.relative_tolerance = 1e-2;
  fit.null.problem.integrator.absolute_tolerance = 1e-2;
  const std::string refusal = RefusalOf(fit);
  EXPECT_EQ(refusal.rfind("gradients: ", 0), 0u) << refusal;
}

// Times of contacts are no samples, which derivatives are compared of.
TEST(Gate, SaysOfContactTimesAloneThatGradientsCannotBeChecked) {
  NullFit fit{testing::World{}};
  fit.null.problem.channels.clear();
  for (TrialProblem& t : fit.train) {
    t.data.clear();
    t.sample_count = 0;
  }
  const Gate gate = CheckGate(fit.null, fit.train, 1);
  EXPECT_TRUE(gate.Refusal().starts_with("gradients: could not be checked")) << gate.Refusal();
  EXPECT_FALSE(gate.OnlyGradientsFailed()) << "finer steps compare no more";
}

// A certificate of trials that differ by `worst`, and by `clear` where none has a flag.
GradientCertificate Certificate(double worst, double clear) {
  GradientCertificate c;
  c.max_relative_error = worst;
  c.max_error_without_flags = clear;
  c.worst_parameter = "E";
  return c;
}

TEST(Gate, TrustsGradientsThatDifferOnlyWhereAnEventGrazes) {
  const GateCheck grazing = CheckGradients(Certificate(2e-2, 1e-8));
  EXPECT_TRUE(grazing.passed);
  EXPECT_NE(grazing.text.find("2.0e-02 (E) in a trial where"), std::string::npos) << grazing.text;
  EXPECT_NE(grazing.text.find("agree to 1.0e-08"), std::string::npos) << grazing.text;
}

TEST(Gate, RefusesGradientsThatDifferInATrialWithoutAFlag) {
  EXPECT_FALSE(CheckGradients(Certificate(2e-2, 2e-2)).passed);
  EXPECT_FALSE(CheckGradients(Certificate(2e-2, std::nan(""))).passed);
  EXPECT_FALSE(CheckGradients(Certificate(std::nan(""), std::nan(""))).passed);
}

TEST(CorrectNoise, KeepsNoiseThatIsStatedRight) {
  for (double rate : {100.0, 250.0}) {
    FitProblem p = MakeProblem(testing::DatasetOf({.rate_hz = rate}), {});
    EXPECT_TRUE(CorrectNoise(p).empty()) << rate;
    EXPECT_EQ(p.channels[0].sigma, 0.001);
    EXPECT_EQ(p.channels[1].sigma, 0.001);
  }
}

TEST(CorrectNoise, ReplacesASigmaStatedTooSmall) {
  Dataset d = testing::DatasetOf({.rate_hz = 250.0});
  d.channels[1].sigma = 0.0004;
  FitProblem p = MakeProblem(d, {});
  const std::vector<std::string> notes = CorrectNoise(p);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].rfind("body_y_m: ", 0), 0u) << notes[0];
  EXPECT_NEAR(p.channels[1].sigma, 0.001, 0.0002);
  EXPECT_TRUE(p.channels[1].sigma_estimated);
  EXPECT_EQ(p.channels[0].sigma, 0.001);
}

TEST(CorrectNoise, LeavesASigmaStatedTooLarge) {
  // Stated noise may hold more than the flights show: a camera that drifts.
  Dataset d = testing::DatasetOf({.rate_hz = 250.0});
  d.channels[1].sigma = 0.003;
  FitProblem p = MakeProblem(d, {});
  EXPECT_TRUE(CorrectNoise(p).empty());
  EXPECT_EQ(p.channels[1].sigma, 0.003);
}

TEST(CorrectNoise, LeavesNoiseThatWasEstimated) {
  Dataset d = testing::DatasetOf({.rate_hz = 250.0});
  d.channels[0].sigma.reset();
  FitProblem p = MakeProblem(d, {});
  const double before = p.channels[0].sigma;
  EXPECT_TRUE(CorrectNoise(p).empty());
  EXPECT_EQ(p.channels[0].sigma, before);
}

}  // namespace
}  // namespace hoplab
