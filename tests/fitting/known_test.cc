// What a dataset knows of causes, held against the catalogue and used by fit and diagnosis.

#include "fitting/known.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fitting/diagnosis/candidate.h"
#include "fitting/diagnosis/score.h"
#include "tests/support/fit_cases.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;
using testing::SmallDataset;

Dataset Knowing(std::vector<KnownSpec> known) {
  static const Dataset kDataset = SmallDataset(1, 0);
  Dataset dataset = kDataset;
  for (KnownSpec& k : known) k.origin.place = "hops/dataset.yaml:9";
  dataset.known = std::move(known);
  return dataset;
}
FitProblem ProblemKnowing(std::vector<KnownSpec> known, const ProblemOptions& options = {}) {
  return MakeProblem(Knowing(std::move(known)), options);
}
std::string ErrorKnowing(const std::vector<KnownSpec>& known, const ProblemOptions& options = {}) {
  return InputErrorOf([&] { ProblemKnowing(known, options); });
}

const Candidate* Find(const std::vector<Candidate>& candidates, const std::string& name) {
  for (const Candidate& c : candidates)
    if (c.Name() == name) return &c;
  return nullptr;
}

TEST(KnownCauses, WhatIsRuledOutIsNoCandidate) {
  const std::size_t all = CandidatesOf(ProblemKnowing({}), {}).size();
  const FitProblem p = ProblemKnowing({{"gravity_scale"}, {"boom_inertia"}});
  const std::vector<Candidate> candidates = CandidatesOf(p, {});
  EXPECT_EQ(candidates.size(), all - 2);
  EXPECT_EQ(Find(candidates, "gravity_scale"), nullptr);
  EXPECT_EQ(Find(candidates, "boom_inertia"), nullptr);
  EXPECT_NE(Find(candidates, "air_drag"), nullptr);
}

// Nothing holds a ball: 16 % less gravity is no cause of its motion, whatever it fits.
TEST(KnownCauses, GravityOfAFreeBallIsThatOfTheEarth) {
  MechanismSpec ball;
  ball.type = MechanismKind::kBall;
  const auto open_in = [](const MechanismSpec& mechanism, std::vector<KnownSpec> said) {
    const KnownCauses known(WithFactsOf(mechanism, std::move(said)));
    return known.Open(*FindEffect("gravity_scale"), 0)->upper;
  };
  EXPECT_EQ(open_in(ball, {}), 0.005);
  EXPECT_EQ(open_in(ball, {{"gravity_scale", "", 0.2}}), 0.2);  // a drop through water, say
  ball.on_guide = true;                                         // which may have a counterweight
  EXPECT_EQ(open_in(ball, {}), 1.0);
  EXPECT_EQ(open_in(MechanismSpec(), {}), 1.0);
}

// A draught of 0.1 N is usual on a body of 1 kg; a ball of 3 g would fly up in it.
TEST(KnownCauses, TypicalForcesAreThoseOfABodyOfItsMass) {
  Parameters<double> body;
  body.m = 0.003;
  const KnownCauses light({}, {}, body);
  const auto share = [&](const char* effect) {
    return light.Open(*FindEffect(effect), 0)->typical /
           FindEffect(effect)->info.parameters[0].typical;
  };
  EXPECT_DOUBLE_EQ(share("constant_force"), 0.003);
  EXPECT_DOUBLE_EQ(share("air_drag"), 0.003);
  EXPECT_DOUBLE_EQ(share("leg_mass"), 0.003);
  EXPECT_DOUBLE_EQ(share("ground_compliance"), 1.0 / 0.003);
  EXPECT_DOUBLE_EQ(share("foot_slip"), 1.0 / 0.003);
  EXPECT_EQ(share("camera_roll"), 1.0);
  EXPECT_EQ(share("leg_material_damping"), 1.0);
  const KnownCauses bounded({{"constant_force", "", 1e-4}}, {}, body);
  EXPECT_EQ(bounded.Open(*FindEffect("constant_force"), 0)->typical, 1e-4);
}

TEST(KnownCauses, WhatAddsToAStatedValueTakesMostOfItAtMost) {
  const Effect& heavier = *FindEffect("swinging_leg_mass");
  Parameters<double> robot;
  robot.robot = RobotParameters<double>();
  EXPECT_EQ(KnownCauses({}, {}, robot).Open(heavier, 0)->lower, 0.0);
  robot.robot->leg_mass = 0.05;
  EXPECT_DOUBLE_EQ(KnownCauses({}, {}, robot).Open(heavier, 0)->lower, -0.045);
  EXPECT_EQ(KnownCauses({}, {}, robot).Open(heavier, 0)->upper, heavier.info.parameters[0].upper);
}

// Of an arc of pi r, r = 20 mm, a hub may hold 10 mm more and nine tenths of 6 mm less.
TEST(KnownCauses, AClampEndsBeforeItsLegDoes) {
  Parameters<double> stated;
  stated.r = 0.02;
  stated.robot = RobotParameters<double>();
  stated.robot->clamp = 0.006;
  const KnownCauses known({}, {}, stated);
  const std::optional<EffectParameter> p = known.Open(*FindEffect("hub_clamp"), 0);
  ASSERT_TRUE(p.has_value());
  EXPECT_DOUBLE_EQ(p->upper, 0.01);
  EXPECT_DOUBLE_EQ(p->lower, -0.0054);
}

TEST(KnownCauses, AnEffectWithEveryParameterRuledOutIsRuledOut) {
  const FitProblem p = ProblemKnowing({{"boom_inertia", "mu_x"}, {"boom_inertia", "mu_y"}});
  EXPECT_EQ(Find(CandidatesOf(p, {}), "boom_inertia"), nullptr);
}

TEST(KnownCauses, AParameterThatIsRuledOutIsNotTriedAndTheOtherKeepsItsPlace) {
  const FitProblem p = ProblemKnowing({{"boom_inertia", "mu_x"}});
  const std::vector<Candidate> candidates = CandidatesOf(p, {.only = {"boom_inertia"}});
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_EQ(ParameterCount(candidates), 1);
  const FitProblem extended = Extend(p, candidates);
  EXPECT_EQ(extended.shared.back().name, "boom_inertia.mu_y");
  EXPECT_EQ(extended.shared.back().direction.component, 1);
  EXPECT_EQ(extended.shared_count(), p.shared_count() + 1);
}

TEST(KnownCauses, ABoundHoldsForTestsAndForTheRefit) {
  const FitProblem p = ProblemKnowing({{"camera_roll", "", 0.002}});
  const std::vector<Candidate> candidates = CandidatesOf(p, {.only = {"camera_roll"}});
  ASSERT_EQ(candidates.size(), 1u);
  const SharedParameter s = Extend(p, candidates).shared.back();
  EXPECT_EQ(s.lower, -0.002);
  EXPECT_EQ(s.upper, 0.002);
  EXPECT_LE(s.scale, 0.002);
  const Hypothesis h = HypothesesOf(candidates).front();
  EXPECT_EQ(h.lower[0], -0.002);
  EXPECT_EQ(h.upper[0], 0.002);
}

TEST(KnownCauses, ABoundNeverGoesBeyondAPhysicalOne) {
  const FitProblem p = ProblemKnowing({{"air_drag", "", 0.5}}, {.with_effects = {"air_drag"}});
  EXPECT_EQ(p.shared.back().lower, 0.0);
  EXPECT_EQ(p.shared.back().upper, 0.5);
}

TEST(KnownCauses, AreToldInTheNotes) {
  const FitProblem p =
      ProblemKnowing({{"gravity_scale"}, {"camera_roll", "", 0.002}, {"boom_inertia", "mu_x"}});
  const std::string note = "known of the set-up: gravity_scale none, camera_roll." +
                           std::string(FindEffect("camera_roll")->info.parameters[0].name) +
                           " at most 0.002 rad, boom_inertia.mu_x none";
  EXPECT_EQ(std::count(p.notes.begin(), p.notes.end(), note), 1) << p.notes.front();
}

TEST(KnownCauses, WhatIsRuledOutCannotBeAskedForWithTheReason) {
  const std::string reason =
      "is ruled out by hops/dataset.yaml:9 (known: gravity_scale: none). Remove the line there if "
      "the effect may be present after all.";
  EXPECT_EQ(ErrorKnowing({{"gravity_scale"}}, {.with_effects = {"gravity_scale"}}),
            "--with: effect gravity_scale; " + reason);
  EXPECT_EQ(InputErrorOf([] {
              CandidatesOf(ProblemKnowing({{"gravity_scale"}}), {.only = {"gravity_scale"}});
            }),
            "--effects: effect gravity_scale; " + reason);
}

struct BadKnown {
  KnownSpec known;
  ProblemOptions options;
  const char* says;
};

void PrintTo(const BadKnown& bad, std::ostream* out) { *out << bad.says; }

class BadKnownCause : public ::testing::TestWithParam<BadKnown> {};

TEST_P(BadKnownCause, IsToldWithPlaceValueRuleAndRemedy) {
  const std::string error = ErrorKnowing({GetParam().known}, GetParam().options);
  EXPECT_EQ(error.rfind(GetParam().says, 0), 0u) << error;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadKnownCause,
    ::testing::Values(
        BadKnown{{"gravity_skale"},
                 {},
                 "hops/dataset.yaml:9: effect gravity_skale; is not in the catalogue. Did you mean "
                 "gravity_scale?"},
        BadKnown{{"boom_inertia", "mu_z"},
                 {},
                 "hops/dataset.yaml:9: known.boom_inertia.mu_z; is not a parameter of this effect. "
                 "Did you mean mu_"},
        BadKnown{{"boom_inertia", "", 0.1},
                 {},
                 "hops/dataset.yaml:9: known.boom_inertia.at_most; the effect has 2 parameters: "
                 "mu_x, mu_y. Say of which, as boom_inertia: {mu_x: {at_most: 0.1}}."},
        BadKnown{{"sensor_scale_x", "", 2.0},
                 {},
                 "hops/dataset.yaml:9: known.sensor_scale_x.gain.at_most = 2; says nothing: the "
                 "parameter is in [-0.5, 0.5] - anyway. Give it in parts of one, or remove the "
                 "line."},
        BadKnown{{"air_drag"},
                 {.fix = {{"air_drag.c_drag", 0.05}}},
                 "--fix: air_drag.c_drag = 0.05; is known to be 0, by hops/dataset.yaml:9."},
        BadKnown{{"air_drag", "", 0.01},
                 {.fix = {{"air_drag.c_drag", 0.05}}},
                 "--fix: air_drag.c_drag = 0.05; is known to be in [0, 0.01] N s^2/m^2, by "
                 "hops/dataset.yaml:9."},
        BadKnown{{"air_drag"},
                 {.free = {"E", "air_drag.c_drag"}},
                 "--free: air_drag.c_drag; is known to be null: known of the set-up is air_drag "
                 "none. Remove the line under `known` if it may be present after all."}));

TEST(KnownCauses, TheSameIsNotSaidTwice) {
  EXPECT_EQ(ErrorKnowing({{"boom_inertia"}, {"boom_inertia", "mu_y"}}),
            "hops/dataset.yaml:9: known.boom_inertia.mu_y; is said already at hops/dataset.yaml:9. "
            "Remove one of the two.");
}

TEST(KnownCauses, NullMayStillBeStated) {
  EXPECT_EQ(ErrorKnowing({{"air_drag"}}, {.fix = {{"air_drag.c_drag", 0.0}}}), "(no error)");
}

}  // namespace
}  // namespace hoplab
