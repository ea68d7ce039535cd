#include "fitting/diagnosis/separate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::EffectOfSize;
using testing::NullFit;

// Two explanations of the same change of speed at the ground.
struct Rivals {
  NullFit fit{testing::World{.effects = {EffectOfSize("touchdown_loss", 0.02)}}};
  std::vector<FittedModel> models = {fit.RefittedWith(CandidateOf("touchdown_loss")),
                                     fit.RefittedWith(CandidateOf("touchdown_angle_bias"))};
};

// A noiseless recording of `truth` by a design.
TrialProblem Recorded(const FittedModel& truth, const TrialDesign& design,
                      const std::vector<TrialProblem>& train) {
  TrialProblem trial = *std::find_if(train.begin(), train.end(),
                                     [&](const TrialProblem& t) { return t.file == design.like; });
  trial.file = trial.recording = "proposed.csv";
  trial.parameters.theta_td = design.touchdown_angle;
  if (design.kp) trial.parameters.kp = *design.kp;
  trial.start = Eigen::Vector4d(trial.start[0], design.height, design.speed, 0.0);
  for (int k = 0; k < 4; ++k) trial.own[k].prior_mean = trial.start[k];
  Trajectory run;
  TrialEvaluator(truth.problem, trial)
      .Simulate({truth.shared, trial.start, false}, truth.problem.integrator, run);
  EXPECT_TRUE(IsComplete(run.outcome));
  trial.data = run.samples;
  trial.sample_count = static_cast<long>(trial.data.size());
  return trial;
}

// Nats by which the rival, refitted to the old trials and a new one, falls further behind.
double NatsOf(const Rivals& r, const TrialDesign& design) {
  std::vector<TrialProblem> more = r.fit.train;
  more.push_back(Recorded(r.models[0], design, r.fit.train));
  std::array<double, 2> cost;
  for (std::size_t i = 0; i < 2; ++i) {
    SolveRequest request;
    request.problem = &r.models[i].problem;
    request.trials = &more;
    request.shared = r.models[i].shared;
    request.initial_states = r.models[i].initial_states;
    request.initial_states.push_back(more.back().start);
    cost[i] = Solve(request).cost;
  }
  return (cost[1] - cost[0]) - (r.models[1].cost - r.models[0].cost);
}

TEST(ProposeExperiment, SeparatesRivalsBetterThanARepetition) {
  const Rivals r;
  const auto proposed = ProposeExperiment(r.models, r.fit.train, 1);
  ASSERT_TRUE(proposed);
  const TrialProblem& like = r.fit.train[r.fit.train.size() / 2];
  const TrialDesign again{like.file, like.parameters.theta_td, like.start[1], like.start[2],
                          std::nullopt};
  const double nats = NatsOf(r, proposed->design);
  EXPECT_GT(nats, 1.5 * NatsOf(r, again));
  EXPECT_GT(nats, 0.0);
}

TEST(ProposeExperiment, ForetellsWhatTheTrialBrings) {
  const Rivals r;
  const auto proposed = ProposeExperiment(r.models, r.fit.train, 1);
  ASSERT_TRUE(proposed);
  const double nats = NatsOf(r, proposed->design);
  EXPECT_NEAR(proposed->expected_nats / nats, 1.0, 0.05);
}

TEST(ProposeExperiment, NamesTheRivalThatIsHardestToTellApart) {
  Rivals r;
  const testing::Twin twin("touchdown_loss", "twin_of_loss");
  r.models.push_back(r.fit.RefittedWith(twin.candidate()));
  const auto proposed = ProposeExperiment(r.models, r.fit.train, 1);
  ASSERT_TRUE(proposed);
  EXPECT_EQ(proposed->closest_rival, "twin_of_loss");
}

TEST(ProposeExperiment, SeparatesNoTwins) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_loss", 0.02)}});
  const testing::Twin twin("touchdown_loss", "twin_of_loss");
  const std::vector<FittedModel> models = {fit.RefittedWith(CandidateOf("touchdown_loss")),
                                           fit.RefittedWith(twin.candidate())};
  const auto proposed = ProposeExperiment(models, fit.train, 1);
  if (proposed) {
    EXPECT_LT(proposed->expected_nats, 0.01);
  }
  EXPECT_FALSE(proposed && proposed->Separates());
}

TEST(ProposeExperiment, IsAbsentWithoutARival) {
  const NullFit fit{testing::World{}};
  EXPECT_FALSE(ProposeExperiment(std::vector{fit.null}, fit.train, 1));
  EXPECT_FALSE(ProposeExperiment(std::vector<FittedModel>{}, fit.train, 1));
}

TEST(ProposeExperiment, IsAbsentWhereNoDesignCanBeSimulated) {
  Rivals r;
  for (FittedModel& model : r.models) model.shared[0] = 1e8;  // a leg like rubber
  EXPECT_FALSE(ProposeExperiment(r.models, r.fit.train, 1));
}

TEST(ProposeExperiment, DoesNotDependOnTheNumberOfJobs) {
  const Rivals r;
  const auto one = ProposeExperiment(r.models, r.fit.train, 1);
  const auto four = ProposeExperiment(r.models, r.fit.train, 4);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->expected_nats, four->expected_nats);
  EXPECT_EQ(Describe(one->design), Describe(four->design));
}

TEST(Describe, SaysADesignInWords) {
  const TrialDesign design{"a.csv", 25.0 * std::numbers::pi / 180.0, 0.35, 1.2, std::nullopt};
  EXPECT_EQ(Describe(design), "drop from 0.35 m at 1.2 m/s with a touch-down angle of 25 deg");
  TrialDesign driven = design;
  driven.kp = 2.0;
  EXPECT_EQ(Describe(driven), Describe(design) + " and a controller gain of 2 N s");
}

}  // namespace
}  // namespace hoplab
