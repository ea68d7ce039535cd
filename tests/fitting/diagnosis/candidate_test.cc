#include "fitting/diagnosis/candidate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/diagnosed_hops.h"
#include "tests/support/formulas.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::DatasetOf;
using testing::InputErrorOf;

std::vector<std::string> NamesOf(const std::vector<Candidate>& candidates) {
  std::vector<std::string> names;
  for (const Candidate& c : candidates) names.push_back(c.Name());
  return names;
}

FitProblem Problem() { return MakeProblem(DatasetOf({}), {}); }

TEST(Candidates, AreEveryEffectThatAppliesInTheOrderOfTheCatalogue) {
  std::vector<std::string> expected;
  for (const Effect* effect : AllEffects()) {
    const bool filters = effect->info.filter != RecordFilter::kNone;  // white noise rules it out
    const bool is_delay_of_all = effect->info.name == "pose_delay";   // all channels are its pose
    if (AppliesTo(*effect, Law::kElastica) && !filters && !is_delay_of_all &&
        !IsPartOf(Law::kElastica, *effect))
      expected.emplace_back(effect->info.name);
  }
  EXPECT_EQ(NamesOf(CandidatesOf(Problem(), {})), expected);
}

// White noise does not tell of a filter, so it is no candidate at first.
TEST(Candidates, KeepFiltersThatTheNoiseDoesNotTellOfApart) {
  const std::vector<std::string> all = {"sensor_low_pass", "sensor_causal_low_pass",
                                        "sensor_moving_average", "sensor_exponential_filter"};
  std::vector<std::string> unseen = NamesOf(UnseenFilters(Problem(), {}));
  EXPECT_TRUE(std::is_permutation(unseen.begin(), unseen.end(), all.begin(), all.end()));
  unseen = NamesOf(UnseenFilters(Problem(), {.without = {"sensor_low_pass"}}));
  EXPECT_EQ(unseen.size(), all.size() - 1);
  EXPECT_EQ(std::count(unseen.begin(), unseen.end(), "sensor_low_pass"), 0);
  const CandidateOptions asked{.only = {"sensor_low_pass"}};
  EXPECT_TRUE(UnseenFilters(Problem(), asked).empty());
  EXPECT_EQ(NamesOf(CandidatesOf(Problem(), asked)), std::vector<std::string>{"sensor_low_pass"});
}

// A torque bends an elastica, which therefore cannot lack it (M120); the other laws can.
TEST(Candidates, HoldNothingThatTheLawHasInItself) {
  const CandidateOptions bending{.only = {"torque_bending"}};
  EXPECT_EQ(
      InputErrorOf([&] { CandidatesOf(Problem(), bending); }),
      "--effects: torque_bending; is part of the law elastica, which cannot lack it. Leave it "
      "out; --with torque_bending fits its share.");
  FitProblem other = Problem();
  other.law = Law::kLargeDeflection;
  EXPECT_EQ(NamesOf(CandidatesOf(other, bending)), std::vector<std::string>{"torque_bending"});
}

TEST(Candidates, OfAFreeBallHoldNoFrictionOfAGuide) {
  FitProblem ball;
  ball.law = Law::kBall;
  ball.trials.resize(1);
  const auto guides = [&](const CandidateOptions& options) {
    const std::vector<std::string> names = NamesOf(CandidatesOf(ball, options));
    return std::count_if(names.begin(), names.end(),
                         [](const std::string& name) { return name.starts_with("guide_"); });
  };
  EXPECT_EQ(guides({}), 0);
  EXPECT_EQ(guides({.only = {"guide_coulomb_friction"}}), 1);
  ball.trials[0].parameters.on_guide = true;
  EXPECT_EQ(guides({}), 2);
}

// Of one coordinate, or of hops straight up, a picture's scale is that coordinate's.
TEST(Candidates, HoldAScaleOfThePictureWhereBothCoordinatesMove) {
  const auto has_it = [](const FitProblem& problem) {
    const std::vector<std::string> names = NamesOf(CandidatesOf(problem, {}));
    return std::count(names.begin(), names.end(), "camera_scale");
  };
  FitProblem ball;
  ball.law = Law::kBall;
  ball.trials.resize(1);
  ball.channels = {{Channel::kBodyY, 1e-3, false}};
  EXPECT_EQ(has_it(ball), 0);
  ball.channels.push_back({Channel::kBodyX, 1e-3, false});
  EXPECT_EQ(has_it(ball), 1);
  ball.trials[0].parameters.on_guide = true;
  EXPECT_EQ(has_it(ball), 0);
}

// A pose that is late is a recording that is late, but for channels that are not the pose.
TEST(Candidates, OfAPoseAloneHaveOneDelay) {
  FitProblem robot;
  robot.law = Law::kRobot;
  robot.trials.resize(1);
  robot.trials[0].parameters.robot = RobotParameters<double>();
  robot.trials[0].parameters.robot->legs = 2;
  robot.channels = {{Channel::kBodyX, 1e-3, false}, {Channel::kBodyPitch, 1e-3, false}};
  const auto has_delay = [&](const CandidateOptions& options) {
    const std::vector<std::string> names = NamesOf(CandidatesOf(robot, options));
    return std::find(names.begin(), names.end(), "pose_delay") != names.end();
  };
  EXPECT_FALSE(has_delay({}));
  EXPECT_TRUE(has_delay({.only = {"pose_delay"}}));
  robot.channels.push_back({Channel::kLegAngle1, 1e-3, false});
  EXPECT_TRUE(has_delay({}));
}

// A contact is no pose: a hopper's tracker may be late against its contact switch.
TEST(Candidates, OfAHopperWithContactsHaveADelayOfItsPose) {
  FitProblem hopper;
  hopper.law = Law::kElastica;
  hopper.trials.resize(1);
  hopper.channels = {{Channel::kBodyX, 1e-3, false}, {Channel::kBodyY, 1e-3, false}};
  const auto has_delay = [&] {
    const std::vector<std::string> names = NamesOf(CandidatesOf(hopper, {}));
    return std::find(names.begin(), names.end(), "pose_delay") != names.end();
  };
  EXPECT_FALSE(has_delay());
  hopper.uses_contact = true;
  EXPECT_TRUE(has_delay());
}

// On one leg what rubs in its hip is what rubs in every hip; on two it is not.
TEST(Candidates, OfARobotOnOneLegAreNotNamedTwice) {
  FitProblem robot;
  robot.law = Law::kRobot;
  robot.trials.resize(1);
  const auto count = [&](int legs, const std::string& start) {
    robot.trials[0].parameters.robot = RobotParameters<double>();
    robot.trials[0].parameters.robot->legs = legs;
    const std::vector<std::string> names = NamesOf(CandidatesOf(robot, {}));
    return std::count_if(names.begin(), names.end(),
                         [&](const std::string& name) { return name.starts_with(start); });
  };
  for (const char* name : {"hip_viscous_friction", "hip_coulomb_friction", "motor_gain"}) {
    EXPECT_EQ(count(1, name), 1) << name;
    EXPECT_EQ(count(2, name), 3) << name;
  }
  EXPECT_EQ(count(2, "leg_stiffness"), 2);
}

FitProblem TwoLeggedRobot() {
  FitProblem robot;
  robot.law = Law::kRobot;
  robot.trials.resize(1);
  robot.trials[0].parameters.robot = RobotParameters<double>();
  robot.trials[0].parameters.robot->legs = 2;
  return robot;
}
bool Holds(const FitProblem& problem, const std::string& name) {
  const std::vector<std::string> names = NamesOf(CandidatesOf(problem, {}));
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Motors that are locked, have none, or are told a torque of the log have no limit to lose.
TEST(Candidates, OfARobotHoldALimitOfTorqueWhereItHasOne) {
  FitProblem problem = TwoLeggedRobot();
  RobotParameters<double>& robot = *problem.trials[0].parameters.robot;
  robot.control = MotorControl::kClock;
  robot.torque_limit = 10.0;
  EXPECT_TRUE(Holds(problem, "torque_limit_loss"));
  problem.trials[0].inputs.resize(1);
  problem.trials[0].inputs[0].kind = InputKind::kHipTorque2;
  EXPECT_FALSE(Holds(problem, "torque_limit_loss"));
  problem.trials[0].inputs.clear();
  robot.control = MotorControl::kLocked;
  EXPECT_FALSE(Holds(problem, "torque_limit_loss"));
  robot.control = MotorControl::kClock;
  robot.torque_limit = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(Holds(problem, "torque_limit_loss"));
}

// The scale of a told torque that is fitted is the gain of its motor by another name.
TEST(Candidates, HoldNoGainWhoseInputsScaleIsFitted) {
  FitProblem robot = TwoLeggedRobot();
  for (const char* name : {"motor_gain", "motor_gain_1", "motor_gain_2"})
    EXPECT_TRUE(Holds(robot, name)) << name;
  SharedParameter scale;
  scale.direction.of = SensitivityDirection::Of::kInput;
  scale.direction.index = static_cast<int>(InputKind::kHipTorque2);
  scale.direction.component = 1;
  robot.shared.push_back(scale);
  EXPECT_FALSE(Holds(robot, "motor_gain"));
  EXPECT_TRUE(Holds(robot, "motor_gain_1"));
  EXPECT_FALSE(Holds(robot, "motor_gain_2"));
  FitProblem hopper = Problem();
  EXPECT_TRUE(Holds(hopper, "torque_gain"));
  scale.direction.index = static_cast<int>(InputKind::kHipTorque);
  hopper.shared.push_back(scale);
  EXPECT_FALSE(Holds(hopper, "torque_gain"));
}

// Motors that are held have no clock that could be wrong.
TEST(Candidates, OfARobotHoldAClockWhereItHasOne) {
  FitProblem robot = TwoLeggedRobot();
  const auto of_clocks = [&](const CandidateOptions& options) {
    const std::vector<std::string> names = NamesOf(CandidatesOf(robot, options));
    return std::count_if(names.begin(), names.end(),
                         [](const std::string& name) { return name.starts_with("gait_"); });
  };
  EXPECT_EQ(of_clocks({}), 0);
  EXPECT_EQ(of_clocks({.only = {"gait_duty_shift"}}), 1);
  robot.trials[0].parameters.robot->control = MotorControl::kClock;
  EXPECT_EQ(of_clocks({}), 7);  // period, duty, sweep, offset; phase of all, of one, of the other
}

// What a formula is called says nothing of what it needs.
TEST(Candidates, HoldAFormulaByWhateverName) {
  for (const char* name : {"gait_cable", "guide_cable"}) {
    const FormulaSource source =
        testing::Source("body_force_along", "-c * speed^2",
                        {testing::Factor("c", "N s^2/m^2", 0.0, 10.0, 0.02)}, name);
    FitProblem problem = Problem();
    problem.formulas = {&FormulaEffect(source)};
    const std::vector<std::string> names = NamesOf(CandidatesOf(problem, {}));
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  }
}

TEST(Candidates, DoNotDependOnTheOrderInWhichTheyAreNamed) {
  const CandidateOptions options{.only = {"touchdown_loss", "air_drag"}};
  EXPECT_EQ(NamesOf(CandidatesOf(Problem(), options)),
            (std::vector<std::string>{"air_drag", "touchdown_loss"}));
}

TEST(Candidates, LeaveOutWhatIsNamedWithout) {
  const std::vector<std::string> all = NamesOf(CandidatesOf(Problem(), {}));
  const std::vector<std::string> fewer =
      NamesOf(CandidatesOf(Problem(), {.without = {"air_drag"}}));
  EXPECT_EQ(fewer.size() + 1, all.size());
  EXPECT_EQ(std::count(fewer.begin(), fewer.end(), "air_drag"), 0);
}

TEST(Candidates, AreNotWhatIsSimulatedAlready) {
  const FitProblem p = MakeProblem(DatasetOf({}), {.with_effects = {"air_drag"}});
  const std::vector<std::string> names = NamesOf(CandidatesOf(p, {}));
  EXPECT_EQ(std::count(names.begin(), names.end(), "air_drag"), 0);
}

TEST(Candidates, AnUnknownNameIsRefusedWithTheNearestOne) {
  const std::string error = InputErrorOf([] { CandidatesOf(Problem(), {.only = {"air_dragg"}}); });
  EXPECT_EQ(error.rfind("--effects", 0), 0u) << error;
  EXPECT_NE(error.find("air_dragg"), std::string::npos) << error;
  EXPECT_NE(error.find("air_drag?"), std::string::npos) << error;
}

TEST(Candidates, AnUnknownNameToLeaveOutSaysWhichOptionItWas) {
  const std::string error = InputErrorOf([] { CandidatesOf(Problem(), {.without = {"storm"}}); });
  EXPECT_EQ(error.rfind("--without", 0), 0u) << error;
}

TEST(Candidates, AnEffectOfAnotherMechanismIsRefusedWithARemedy) {
  FitProblem ball;
  ball.law = Law::kBall;
  const std::string error =
      InputErrorOf([&] { CandidatesOf(ball, {.only = {"leg_material_damping"}}); });
  EXPECT_NE(error.find("does not apply to the mechanism ball"), std::string::npos) << error;
  EXPECT_NE(error.find("`hoplab effects`"), std::string::npos) << error;
}

TEST(Candidate, InOneRecordingSaysWhich) {
  const Candidate c{FindEffect("air_drag"), {"train-2.csv"}};
  EXPECT_EQ(c.Name(), "air_drag in train-2.csv");
}

TEST(Extend, AppendsTheParametersAtTheirNullWithBoundsAndUnit) {
  const FitProblem before = Problem();
  const Candidate c = CandidateOf("gravity_scale");
  const FitProblem after = Extend(before, std::array{c});
  ASSERT_EQ(after.shared_count(), before.shared_count() + 1);
  const SharedParameter& s = after.shared.back();
  const EffectParameter& p = c.effect->info.parameters[0];
  EXPECT_EQ(s.name, "gravity_scale.gamma");
  EXPECT_EQ(s.unit, p.unit);
  EXPECT_EQ(s.initial, p.null);
  EXPECT_EQ(s.lower, p.lower);
  EXPECT_EQ(s.upper, p.upper);
  EXPECT_EQ(s.scale, p.typical);
  EXPECT_TRUE(after.effects.back().IsNull());
}

TEST(Extend, NullValuesAreThoseOfAllParametersInOrder) {
  const std::vector<Candidate> two = {CandidateOf("air_drag"), CandidateOf("touchdown_loss")};
  EXPECT_EQ(ParameterCount(two), 2);
  EXPECT_EQ(NullValues(two), Eigen::Vector2d(two[0].effect->info.parameters[0].null,
                                             two[1].effect->info.parameters[0].null));
}

TEST(Extend, ChangesNoBitOfTheResidualsAtNull) {
  const FitProblem before = Problem();
  const std::vector<Candidate> all = CandidatesOf(before, {.without = {"sensor_delay"}});
  const FitProblem after = Extend(before, all);
  Eigen::VectorXd shared(after.shared_count());
  shared << InitialShared(before), NullValues(all);
  TrialEvaluation plain, extended;
  const TrialProblem& trial = before.trials[0];
  TrialEvaluator(before, trial).Evaluate({InitialShared(before), trial.start, false}, plain);
  TrialEvaluator(after, trial).Evaluate({shared, trial.start, false}, extended);
  ASSERT_TRUE(plain.complete);
  EXPECT_EQ(plain.residuals, extended.residuals);
}

TEST(Extend, AnEffectInOneRecordingActsOnlyThere) {
  const FitProblem before = Problem();
  const FitProblem after =
      Extend(before, std::array{Candidate{FindEffect("air_drag"), {"train-2.csv"}}});
  EXPECT_EQ(after.shared.back().name, "air_drag.c_drag@train-2.csv");
  Eigen::VectorXd shared(after.shared_count());
  shared << InitialShared(before), 0.1;
  for (const TrialProblem& trial : after.trials) {
    TrialEvaluation plain, with, columns;
    TrialEvaluator(before, trial).Evaluate({InitialShared(before), trial.start, false}, plain);
    TrialEvaluator(after, trial).Evaluate({shared, trial.start, false}, with);
    TrialEvaluator(after, trial).Evaluate({shared, trial.start, true}, columns);
    const bool there = trial.file == "train-2.csv";
    EXPECT_EQ(plain.residuals != with.residuals, there) << trial.file;
    EXPECT_EQ(columns.jacobian.col(after.shared_count() - 1).norm() > 0.0, there) << trial.file;
  }
}

}  // namespace
}  // namespace hoplab
