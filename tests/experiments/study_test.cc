// The published numbers, the settings of every caption, and what is read off a run.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "experiments/study/energy_causes.h"
#include "experiments/study/published_tables.h"
#include "experiments/study/study_claims.h"
#include "experiments/study/study_figures.h"
#include "experiments/study/study_tables.h"
#include "tests/support/input_error_of.h"
#include "tests/support/study_cases.h"

namespace hoplab::testing {
namespace {

TEST(PublishedTables, HoldThePrintedNumbers) {
  const PublishedTable& initial_states = FindPublishedTable("table_6_1_convergence_d0");
  ASSERT_EQ(initial_states.rows.size(), 25u);
  EXPECT_EQ(initial_states.rows.back(), (std::vector<double>{1.2, 0.4, 4.0, 0}));
  EXPECT_EQ(FindPublishedTable("table_6_2_convergence_d6").Column("convergence_time_s")[2], 0.2);
  const PublishedTable& modulus = FindPublishedTable("table_6_3_modulus_d0");
  ASSERT_EQ(modulus.rows.size(), 10u);
  EXPECT_TRUE(std::isnan(modulus.Column("convergence_time_s")[3])) << "no convergence at 21.4";
  EXPECT_EQ(FindPublishedTable("table_6_4_modulus_d6").Column("k_max_N_per_m").back(), 6500);
  EXPECT_EQ(FindPublishedTable("table_6_5_energy_percent").Column("energy_percent")[0], 103.12);
}

struct Caption {
  const char* figure;
  const char* across;
  const char* up;
  std::size_t curves;
  double angle_deg, speed, damping;  // of the last curve
  bool controlled;
};

TEST(StudyFigures, HaveTheSettingsOfTheirCaptions) {
  const Caption captions[] = {{"figure-6.5", "x_m", "y_m", 4, 20, 0.6, 3, false},
                              {"figure-6.7", "time_s", "leg_length_m", 1, 0, 0, 3, false},
                              {"figure-6.8", "time_s", "leg_length_m", 1, 20, 0.6, 0, false},
                              {"figure-6.10", "time_s", "stiffness_N_per_m", 4, 20, 0.6, 3, false},
                              {"figure-6.11", "x_m", "y_m", 1, 15, 0, 0, false},
                              {"figure-6.16", "time_s", "energy_J", 1, 15, 0, 3, false},
                              {"figure-6.18", "time_s", "vx_m_per_s", 1, 20, 1, 0, false},
                              {"figure-6.20", "x_m", "y_m", 1, 20, 1, 3, false},
                              {"figure-6.24", "time_s", "y_m", 1, 40, 1, 0, true},
                              {"figure-6.26", "time_s", "vx_m_per_s", 1, 40, 1, 3, true},
                              {"figure-6.31", "time_s", "energy_J", 2, 40, 1, 0, true},
                              {"figure-6.32", "time_s", "vx_m_per_s", 2, 40, 1, 3, true},
                              {"figure-4.5", "time_s", "y_m", 1, 40, 1, 3, true}};
  const Study study = MadeUpStudy();
  for (const Caption& caption : captions) {
    const StudyFigure figure = RunStudyFigure(caption.figure, study);
    EXPECT_EQ(figure.columns[0].name, caption.across) << caption.figure;
    EXPECT_EQ(figure.columns[1].name, caption.up) << caption.figure;
    ASSERT_EQ(figure.curves.size(), caption.curves) << caption.figure;
    const CaptionSettings& settings = *figure.curves.back().settings;
    EXPECT_NEAR(settings.touchdown_angle_rad, DegToRad(caption.angle_deg), 1e-15);
    EXPECT_EQ(settings.start_speed_m_per_s, caption.speed) << caption.figure;
    EXPECT_EQ(settings.damping_N_s_per_m, caption.damping) << caption.figure;
    EXPECT_EQ(settings.controlled, caption.controlled) << caption.figure;
    EXPECT_EQ(settings.start_height_m, 0.3);
    EXPECT_EQ(settings.modulus_Pa, 22e9);
    EXPECT_GT(figure.curves.back().rows.size(), 100u) << caption.figure;
  }
}

TEST(StudyFigures, EveryOneOfThemHasCurvesWithNumbers) {
  const Study study = MadeUpStudy();
  for (const std::string& name : StudyFigureNames()) {
    const StudyFigure figure = RunStudyFigure(name, study);
    for (const StudyCurve& curve : figure.curves) {
      double finite = 0.0;
      for (const std::vector<double>& row : curve.rows) finite += std::isfinite(row[1]) ? 1 : 0;
      EXPECT_GT(finite, 10.0) << name << " " << curve.label;
    }
  }
}

TEST(HoppingRun, MeanLegOfAVerticalBounceFollowsFromMomentum) {
  // While it stands the spring gives 2 m v against gravity: mean force 2 m v/T + m g.
  CaptionSettings settings{.start_height_m = 0.3, .start_speed_m_per_s = 0.0, .hops = 1};
  settings.straight = StraightSpringLeg{5000.0, 0.18};
  const double m = 3.0, g = 9.81, step = 1e-5;
  const HoppingRun run = RunHopping(HopperOfCaption(MadeUpStudy(), settings), step);
  const std::vector<StanceRange> stances = StancesOf(run);
  ASSERT_EQ(stances.size(), 1u);
  const double stance = step * static_cast<double>(stances[0].end - stances[0].begin);
  const double speed = std::sqrt(2.0 * g * (0.3 - 0.18));
  const StraightSpringLeg mean = MeanLeg(run);
  EXPECT_NEAR(mean.stiffness_N_per_m, 5000.0, 1e-9);
  // A sample more or less at each end: speed times step, over the stance.
  EXPECT_NEAR(mean.rest_length_m, 0.18 - (2.0 * m * speed / stance + m * g) / 5000.0,
              2.0 * speed * step);
}

TEST(HoppingRun, EnergyOfAnApexIsThatOfItsHeightAndSpeed) {
  const HoppingRun run =
      RunHopping(HopperOfCaption(MadeUpStudy(), StudyCaptions::Controlled(0)), 0.0);
  ASSERT_GT(run.apexes.size(), 3u);
  EXPECT_TRUE(run.samples.empty());
  for (const ApexPoint& apex : run.apexes)
    EXPECT_NEAR(apex.energy_J,
                3.0 * (9.81 * apex.height_m + 0.5 * apex.speed_m_per_s * apex.speed_m_per_s), 1e-9);
}

TEST(HoppingRun, SteadyStiffnessLooksAtTheLastFiveHopsOnly) {
  HoppingRun run;
  for (int i = 0; i < 9; ++i) {
    run.apexes.push_back({1.0 * i, 0, 0.3, 1, 1});
    run.samples.push_back({0.5 + i, 0, 0.2, 1, 1, 0, 0.2, i < 3 ? 9000.0 : 4000.0 + i, true});
  }
  const StiffnessRange range = SteadyStiffness(run);
  EXPECT_EQ(range.min_N_per_m, 4003.0);
  EXPECT_EQ(range.max_N_per_m, 4007.0);
  run.apexes.resize(5);
  EXPECT_TRUE(std::isnan(SteadyStiffness(run).min_N_per_m));
}

TEST(Study, CannotBeMadeOfEveryScenario) {
  const auto error = [](const std::string& set) {
    return InputErrorOf([&] {
      ScenarioDocument document = ScenarioDocument::FromText(kStudyConstants, "study.yaml");
      document.SetFromOption(set);
      StudyOfScenario(document.Read(), IntegratorOptions{});
    });
  };
  EXPECT_NE(error("controller=null").find("controller"), std::string::npos);
  EXPECT_NE(error("initial=null").find("initial"), std::string::npos);
  EXPECT_NE(error("law=straight_leg").find("law"), std::string::npos);
}

TEST(EnergyTable, StartsWhereTheConstantsSay) {
  Study study = MadeUpStudy();
  const double slow = EnergyPercent(study, DegToRad(35), 0.0);
  study.constants.initial->vx_m_per_s = 1.4;
  EXPECT_NE(slow, EnergyPercent(study, DegToRad(35), 0.0));
  // Leg and ground hold nothing at an apex: a law that conserves energy gives all of it back.
  const Study consistent = WithLaw(study, Law::kConsistent);
  EXPECT_NEAR(EnergyPercent(consistent, DegToRad(35), 0.0), 100.0, 1e-6);
  EXPECT_LT(EnergyPercent(consistent, DegToRad(35), 6.0), 99.0);
}

TEST(EnergyCauses, CornersAreTheLawsTheyShouldBe) {
  const Study study = MadeUpStudy();
  for (const double angle : {25.0, 45.0}) {
    const EnergyCauses causes = EnergyCausesAt(study, DegToRad(angle));
    EXPECT_NEAR(causes.with_rolling,
                EnergyPercent(WithLaw(study, Law::kNoSlip), DegToRad(angle), 0), 1e-6);
    EXPECT_NEAR(causes.with_both, causes.consistent, 1e-6);
    EXPECT_NEAR(causes.consistent, 100.0, 1e-6);
    EXPECT_NEAR(causes.removed_by_rolling + causes.removed_by_tip, causes.thesis - causes.with_both,
                1e-9);
    EXPECT_LT(std::abs(causes.integration_error), 1e-4 * std::abs(causes.thesis - 100.0))
        << "the gain is the law's, not the solver's";
  }
}

TEST(StudyClaims, AlternativesAreJudgedOnEveryCheck) {
  const StudyClaim claim = RunStudyClaim("claim-c", MadeUpStudy());
  EXPECT_EQ(claim.checks.size(), 4u);
  ASSERT_EQ(claim.alternatives.size(), 4u) << "three laws and the other lift-off";
  for (const ClaimAlternative& other : claim.alternatives)
    EXPECT_EQ(other.holds.size(), claim.checks.size()) << other.setting;
  EXPECT_EQ(claim.verdict, VerdictOf(claim.checks, claim.alternatives));
}

}  // namespace
}  // namespace hoplab::testing
