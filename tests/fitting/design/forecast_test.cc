#include "fitting/design/forecast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "fitting/design/trial_design.h"
#include "fitting/uncertainty.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

Eigen::MatrixXd Nats(std::initializer_list<double> upper_and_lower) {
  Eigen::MatrixXd nats = Eigen::MatrixXd::Zero(2, 2);
  nats(0, 1) = upper_and_lower.begin()[0];
  nats(1, 0) = upper_and_lower.begin()[1];
  return nats;
}

TEST(ExpectedEntropy, OfATrialThatSaysNothingIsTheEntropyThereWas) {
  const std::vector<double> weights = {0.7, 0.3};
  EXPECT_NEAR(LogExpectedEntropy(weights, Nats({0.0, 0.0})), std::log(EntropyOf(weights)), 1e-12);
  const std::vector<double> three = {0.5, 0.3, 0.2};
  EXPECT_NEAR(LogExpectedEntropy(three, Eigen::MatrixXd::Zero(3, 3)), std::log(EntropyOf(three)),
              1e-12);
}

TEST(ExpectedEntropy, IsWhatDrawnTrialsLeave) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise;
  for (const double d : {0.5, 3.0, 8.0}) {
    const std::vector<double> weights = {0.6, 0.4};
    double sum = 0.0;
    constexpr int kDraws = 400'000;
    for (int n = 0; n < kDraws; ++n) {
      const std::size_t truth = n % 10 < 6 ? 0 : 1;
      const double ratio = d + std::sqrt(2.0 * d) * noise(random);
      const double other = weights[1 - truth] * std::exp(-ratio);
      const double p = weights[truth] / (weights[truth] + other);
      sum += EntropyOf(std::vector<double>{p, 1.0 - p});
    }
    EXPECT_NEAR(std::exp(LogExpectedEntropy(weights, Nats({d, d}))), sum / kDraws,
                0.02 * sum / kDraws)
        << d;
  }
}

TEST(ExpectedEntropy, FallsWithTheNatsHoweverManyTheyAre) {
  const std::vector<double> weights = {0.5, 0.5};
  double last = 0.0;
  for (const double d : {1.0, 10.0, 100.0, 400.0, 900.0}) {
    const double log_left = LogExpectedEntropy(weights, Nats({d, d}));
    EXPECT_TRUE(std::isfinite(log_left)) << d;
    EXPECT_LT(log_left, last) << d;
    last = log_left;
  }
}

// A discrepancy makes a smooth difference less telling, whether rivals are refitted or not.
TEST(SeparationForecast, ByRefitsIsUnderTheNoiseOfTheRivals) {
  const testing::NullFit fit{
      testing::World{.effects = {testing::EffectOfSize("touchdown_loss", 0.02)}}};
  std::vector<FittedModel> rivals = {
      fit.RefittedWith(testing::CandidateOf("touchdown_loss")),
      fit.RefittedWith(testing::CandidateOf("touchdown_angle_bias"))};
  const DesignSpace space = DefaultSpace(fit.problem, fit.train);
  const TrialProblem trial =
      TrialOf(space.At(std::vector<double>(space.Searched().size(), 0.4)), space.like);
  const auto forecast = [&](bool by_refits) {
    if (by_refits) return ForecastByRefits(rivals, fit.train, trial, 1);
    std::vector<RecordedInformation> information;
    for (const FittedModel& rival : rivals) information.push_back(InformationOf(rival, fit.train));
    return ForecastLinearly(rivals, information, trial, 1);
  };
  const SeparationForecast white = forecast(true);
  for (FittedModel& rival : rivals) {
    rival.problem.noise.amplitude.assign(rival.problem.channels.size(), 3.0);
    rival.problem.noise.time_scale = 0.1;
  }
  const SeparationForecast refitted = forecast(true), linear = forecast(false);
  for (const SeparationForecast* f : {&white, &refitted, &linear}) ASSERT_FALSE(f->failure);
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 0)}) {
    EXPECT_GT(white.nats(i, j), 0.5);
    EXPECT_LT(refitted.nats(i, j), 0.5 * white.nats(i, j));
    EXPECT_NEAR(refitted.nats(i, j) / linear.nats(i, j), 1.0, 0.2);
  }
}

// The interval of the fitted problem with one trial more, against the forecast of it.
TEST(ForecastInterval, IsTheIntervalOfTheFitWithThatTrial) {
  const testing::NullFit fit{testing::World{}};
  const RecordedInformation information = InformationOf(fit.null, fit.train);
  const Uncertainty now =
      AssessUncertainty(fit.problem, fit.train, fit.null.shared, fit.null.initial_states, {}, 1);
  for (int k = 0; k < fit.problem.shared_count(); ++k) {
    const double half = ForecastInterval(fit.null, information, k, nullptr).half_width;
    EXPECT_NEAR(half / (1.959963984540054 * *now.parameters[k].std_error), 1.0, 1e-8);
  }

  const DesignSpace space = DefaultSpace(fit.problem, fit.train);
  std::vector<double> middle(space.Searched().size(), 0.4);
  TrialProblem trial = TrialOf(space.At(middle), space.like);
  Trajectory run;
  TrialEvaluator(fit.problem, trial)
      .Simulate({fit.null.shared, trial.start, false}, fit.problem.integrator, run);
  ASSERT_TRUE(IsComplete(run.outcome));
  std::vector<TrialProblem> more = fit.train;
  more.push_back(trial);
  more.back().data = run.samples;
  more.back().sample_count = static_cast<long>(run.samples.size());
  std::vector<OwnValues> initial_states = fit.null.initial_states;
  initial_states.push_back(trial.start);
  const Uncertainty then =
      AssessUncertainty(fit.problem, more, fit.null.shared, initial_states, {}, 1);
  for (int k = 0; k < fit.problem.shared_count(); ++k) {
    const SharpeningForecast forecast = ForecastInterval(fit.null, information, k, &trial);
    ASSERT_FALSE(forecast.failure);
    EXPECT_NEAR(forecast.half_width / (1.959963984540054 * *then.parameters[k].std_error), 1.0,
                1e-6);
    EXPECT_LT(forecast.half_width, 1.959963984540054 * *now.parameters[k].std_error);
  }
}

TEST(ForecastInterval, NamesWhyADesignIsWorthNothing) {
  const testing::NullFit fit{testing::World{}};
  const DesignSpace space = DefaultSpace(fit.problem, fit.train);
  TrialDesign design = space.At(std::vector<double>(space.Searched().size(), 0.4));
  design.height = 0.001;
  const TrialProblem trial = TrialOf(design, space.like);
  const SharpeningForecast forecast =
      ForecastInterval(fit.null, InformationOf(fit.null, fit.train), 0, &trial);
  ASSERT_TRUE(forecast.failure);
  EXPECT_EQ(forecast.failure->Name(), NameOf(Outcome::kStartsInGround));
  EXPECT_EQ(forecast.failure->Sentence(), SentenceOf(Outcome::kStartsInGround));
  const ForecastFailure of_a_rival{Outcome::kFellArc, "air_drag"};
  EXPECT_EQ(of_a_rival.Name(), "fell_arc under air_drag");
  EXPECT_EQ((ForecastFailure{std::nullopt, "air_drag"}.Name()), "no refit of air_drag");
  EXPECT_EQ(of_a_rival.Sentence(), "fell: the leg rolled up to the hip under air_drag");
}

}  // namespace
}  // namespace hoplab
