#include "fitting/problem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fitting/model_of_spec.h"
#include "fitting/trial_evaluator.h"
#include "tests/support/fit_cases.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::SmallDataset;

std::string MessageOf(const Dataset& d, const ProblemOptions& o) {
  return testing::InputErrorOf([&] { MakeProblem(d, o); });
}

TEST(Problem, FreesModulusAndDampingOfACLegByDefault) {
  const FitProblem p = MakeProblem(SmallDataset(), {});
  EXPECT_EQ(p.shared_names(), (std::vector<std::string>{"E", "d"}));
  EXPECT_EQ(p.law, Law::kElastica);
  EXPECT_EQ(p.shared[0].initial, 20e9);
  EXPECT_EQ(p.shared[0].unit, "Pa");
}

TEST(Problem, AFixedDefaultIsNotFree) {
  const FitProblem p = MakeProblem(SmallDataset(), {.fix = {{"d", 2.5}}});
  EXPECT_EQ(p.shared_names(), (std::vector<std::string>{"E"}));
  EXPECT_EQ(p.trials[0].parameters.d, 2.5);
}

TEST(Problem, AnEffectJoinsWithItsParametersFree) {
  const FitProblem p = MakeProblem(SmallDataset(), {.with_effects = {"air_drag"}});
  EXPECT_EQ(p.shared_names(), (std::vector<std::string>{"E", "d", "air_drag.c_drag"}));
  ASSERT_EQ(p.effects.size(), 1u);
  EXPECT_TRUE(p.effects[0].IsNull());
}

TEST(Problem, AnEffectCanBeHeldAtAValue) {
  const FitProblem p = MakeProblem(SmallDataset(), {.fix = {{"air_drag.c_drag", 0.05}}});
  EXPECT_EQ(p.shared_names(), (std::vector<std::string>{"E", "d"}));
  ASSERT_EQ(p.effects.size(), 1u);
  EXPECT_EQ(p.effects[0].values[0], 0.05);
}

TEST(Problem, StartsOffTheBounds) {
  Dataset d = SmallDataset();
  for (Trial& t : d.trials) t.mechanism.c_leg.damping_N_s_per_m = 0.0;
  const FitProblem p = MakeProblem(d, {.with_effects = {"air_drag"}});
  const Eigen::VectorXd start = InitialShared(p);
  for (int i = 0; i < p.shared_count(); ++i) {
    EXPECT_GT(start[i], p.shared[i].lower) << p.shared[i].name;
    EXPECT_LT(start[i], p.shared[i].upper) << p.shared[i].name;
  }
}

TEST(Problem, UnknownParameterIsToldWithTheNearest) {
  const std::string message = MessageOf(SmallDataset(), {.free = {"restitutoin"}});
  EXPECT_NE(message.find("--free: restitutoin; is not a parameter of the mechanism c_leg"),
            std::string::npos)
      << message;
}

TEST(Problem, UnknownEffectIsToldWithTheNearest) {
  const std::string message = MessageOf(SmallDataset(), {.with_effects = {"airdrag"}});
  EXPECT_NE(message.find("air_drag"), std::string::npos) << message;
}

TEST(Problem, AnEffectForLegsIsRefusedForABall) {
  Dataset d = SmallDataset();
  d.mechanism.type = MechanismKind::kBall;
  const std::string message = MessageOf(d, {.with_effects = {"touchdown_angle_bias"}});
  EXPECT_NE(message.find("does not apply to the mechanism ball"), std::string::npos) << message;
}

TEST(Problem, ALawOfAnotherMechanismIsRefused) {
  const std::string message = MessageOf(SmallDataset(), {.law = "ball"});
  EXPECT_NE(message.find("is not a law of the mechanism c_leg"), std::string::npos) << message;
}

TEST(Problem, AParameterThatDiffersBetweenTrialsCannotBeShared) {
  Dataset d = SmallDataset();
  d.trials[0].controller = ControllerSpec{2.0, 1.8, {}};
  d.trials[1].controller = ControllerSpec{3.0, 1.8, {}};
  const std::string message = MessageOf(d, {.free = {"E", "kp"}});
  EXPECT_NE(message.find("differs between the trials"), std::string::npos) << message;
}

TEST(Problem, AFixedValueOutOfItsRangeIsRefused) {
  const std::string message = MessageOf(SmallDataset(), {.fix = {{"E", -4.0}}});
  EXPECT_NE(message.find("--fix: E = -4; must be in (0, 1e13] Pa. Check the sign."),
            std::string::npos)
      << message;
}

// What no dataset may state is not held either.
TEST(Problem, AFixedValueIsOneThatADatasetMayState) {
  for (const auto& [name, value, range] :
       {std::tuple("kp", -5.0, "[0, 1e6] N s"), std::tuple("kappa", 0.0, "(0, 10]"),
        std::tuple("g", 0.0, "(0, 1000] m/s^2"), std::tuple("theta_td", 3.2, "rad")}) {
    const std::string message = MessageOf(SmallDataset(), {.fix = {{name, value}}});
    EXPECT_NE(message.find(std::string("must be in ")), std::string::npos) << name << message;
    EXPECT_NE(message.find(range), std::string::npos) << message;
  }
}

TEST(Problem, NothingLeftToFitIsRefused) {
  const std::string message = MessageOf(SmallDataset(), {.fix = {{"E", 2e10}, {"d", 1.0}}});
  EXPECT_NE(message.find("leaves nothing to fit"), std::string::npos) << message;
}

TEST(Problem, AStartThatIsNotStatedIsReadOffTheFirstFlight) {
  Dataset d = SmallDataset();
  const StateSpec truth = testing::HopScenario(2).dataset->trials[0].initial.value();
  d.trials[0].initial.reset();
  d.trials[0].initial_sigma.reset();
  const FitProblem p = MakeProblem(d, {});
  EXPECT_NEAR(p.trials[0].start[1], truth.y_m, 0.002);
  EXPECT_NEAR(p.trials[0].start[2], truth.vx_m_per_s, 0.03);
  EXPECT_NEAR(p.trials[0].start[3], truth.vy_m_per_s, 0.03);
  EXPECT_TRUE(std::isinf(p.trials[0].own[0].prior_sigma));
}

TEST(Problem, PlaceAlongTheGroundIsHeldWhereNoChannelSeesIt) {
  Dataset d = SmallDataset();
  d.channels.erase(d.channels.begin());  // body_x_m
  for (Trial& t : d.trials) t.initial_sigma.reset();
  const FitProblem p = MakeProblem(d, {});
  EXPECT_FALSE(p.trials[0].own[0].free);
  EXPECT_TRUE(p.trials[0].own[1].free);
}

TEST(Problem, NoiseIsEstimatedFromTheTracesWhenAsked) {
  Dataset d = SmallDataset(3, 0, 5, 500.0);
  for (ChannelSpec& c : d.channels) c.sigma.reset();
  const FitProblem p = MakeProblem(d, {});
  for (const ChannelProblem& c : p.channels) {
    EXPECT_TRUE(c.sigma_estimated);
    EXPECT_NEAR(c.sigma, 0.001, 0.0001) << NameOf(c.channel);  // the truth is 1 mm
  }
  EXPECT_EQ(p.notes.size(), 2u);
}

TEST(Problem, MissingSamplesAreNotCounted) {
  Dataset d = SmallDataset();
  const FitProblem whole = MakeProblem(d, {});
  d.trials[0].trace.columns[0].values[5] = std::nan("");
  d.trials[0].trace.columns[1].values[9] = std::nan("");
  const FitProblem holed = MakeProblem(d, {});
  EXPECT_EQ(holed.trials[0].sample_count, whole.trials[0].sample_count - 2);
}

TEST(Problem, ContactColumnsGiveSwitchingTimes) {
  Dataset d = SmallDataset();
  d.channels = {{Channel::kContact, 1.0}};
  TraceColumn contact{"contact", {}};
  for (std::size_t i = 0; i < d.trials[0].trace.time_s.size(); ++i)
    contact.values.push_back(i >= 10 && i < 15 ? 1.0 : 0.0);
  for (Trial& t : d.trials) {
    TraceColumn c = contact;
    c.values.resize(t.trace.time_s.size(), 0.0);
    t.trace.columns.push_back(c);
  }
  const FitProblem p = MakeProblem(d, {});
  ASSERT_EQ(p.trials[0].contact.touchdown_s.size(), 1u);
  ASSERT_EQ(p.trials[0].contact.liftoff_s.size(), 1u);
  EXPECT_NEAR(p.trials[0].contact.touchdown_s[0], 0.095, 1e-12);  // rows 9 and 10 at 100 Hz
  EXPECT_NEAR(p.trials[0].contact.liftoff_s[0], 0.145, 1e-12);
  EXPECT_NEAR(p.trials[0].contact.touchdown_sigma_s[0], 0.01 / std::sqrt(12.0), 1e-12);
  // A sigma in the column's unit, 0 or 1, says nothing of times, and is not passed over in silence.
  const auto told = [](const FitProblem& problem) {
    return std::any_of(problem.notes.begin(), problem.notes.end(), [](const std::string& note) {
      return note.starts_with("the sigma of contact is not used");
    });
  };
  EXPECT_TRUE(told(p));
  d.channels = {{Channel::kContact, std::nullopt}};
  EXPECT_FALSE(told(MakeProblem(d, {})));
}

// Dropped from 0.5 m above its touch-down; its switch closes for a row at each bounce.
TEST(Problem, ABallsContactColumnGivesItsBouncesOnly) {
  constexpr double kG = 9.81, kRestitution = 0.8, kRadius = 0.05, kDrop = 0.5;
  Dataset d = SmallDataset(1, 0);
  Trial& trial = d.trials[0];
  trial.mechanism = {};
  trial.mechanism.type = MechanismKind::kBall;
  trial.mechanism.body_mass_kg = 0.1;
  trial.mechanism.gravity_m_per_s2 = kG;
  trial.mechanism.ball = {kRadius, kRestitution, 0.1};
  d.mechanism = trial.mechanism;
  d.channels = {{Channel::kBodyY, 0.001}, {Channel::kContact, 1.0}};
  trial.initial = StateSpec{0.0, kRadius + kDrop, 0.0, 0.0};
  trial.trace = {};
  trial.trace.columns = {{"body_y_m", {}}, {"contact", {}}};
  double meets = std::sqrt(2.0 * kDrop / kG), speed = 0.0, left = 0.0, from = kRadius + kDrop;
  for (int row = 0; row < 180; ++row) {
    const double t = 0.005 * row;
    const bool bounced = t > meets;
    if (bounced) {
      speed = kRestitution * (left == 0.0 ? kG * meets : speed);
      left = meets;
      from = kRadius;
      meets += 2.0 * speed / kG;
    }
    const double since = t - left;
    trial.trace.time_s.push_back(t);
    trial.trace.columns[0].values.push_back(from + speed * since - 0.5 * kG * since * since);
    trial.trace.columns[1].values.push_back(bounced ? 1.0 : 0.0);
  }
  const FitProblem p = MakeProblem(d, {});
  const TrialProblem& t = p.trials[0];
  EXPECT_EQ(t.contact.touchdown_s.size(), 2u);
  EXPECT_TRUE(t.contact.liftoff_s.empty());
  EXPECT_EQ(t.sample_count, 182);
  TrialEvaluation e;
  TrialEvaluator(p, t).Evaluate({InitialShared(p), t.start}, e);
  EXPECT_TRUE(e.complete);
  EXPECT_LT(e.residuals.cwiseAbs().maxCoeff(), 3.0);
}

}  // namespace
}  // namespace hoplab
