#include "datasets/read_scenario.h"

#include <gtest/gtest.h>

#include "base/units.h"
#include "tests/datasets/small_scenario.h"

namespace hoplab {
namespace {

using namespace testing;

std::string WithReading(const std::string& reading) {
  return Replace(kSmallScenario, "damping_N_s_per_m: 3.0}",
                 "damping_N_s_per_m: 3.0, variant: " + reading + "}");
}

TEST(ReadScenario, ReadsTheReadingOfThePublishedLaw) {
  EXPECT_EQ(Document().Read().mechanism.reading, ThesisReading());
  const ThesisReading all =
      Document(WithReading("{rolling: explicit, angle_rate: virtual_leg, rolling_radius: rest, "
                           "damping_rate: deflection, stiffness_radius: rest, stiffness_angle: "
                           "virtual_leg, torque_sign: printed}"))
          .Read()
          .mechanism.reading;
  EXPECT_EQ(all.rolling, ThesisReading::Rolling::kExplicit);
  EXPECT_EQ(all.angle_rate, ThesisReading::AngleRate::kVirtualLeg);
  EXPECT_EQ(all.rolling_radius, ThesisReading::RollingRadius::kRest);
  EXPECT_EQ(all.damping_rate, ThesisReading::DampingRate::kDeflection);
  EXPECT_EQ(all.stiffness_radius, ThesisReading::StiffnessRadius::kRest);
  EXPECT_EQ(all.stiffness_angle, ThesisReading::StiffnessAngle::kVirtualLeg);
  EXPECT_EQ(all.torque_sign, ThesisReading::TorqueSign::kPrinted);
  ScenarioDocument document = Document();
  document.SetFromOption("mechanism.leg.variant.damping_rate=hip");
  EXPECT_EQ(document.Read().mechanism.reading.damping_rate, ThesisReading::DampingRate::kHip);
}

TEST(ReadScenario, RefusesAReadingItDoesNotKnow) {
  const auto error = [](const std::string& reading) {
    return InputErrorOf([&] { Document(WithReading(reading)).Read(); });
  };
  EXPECT_NE(error("{rolling: implict}").find("mechanism.leg.variant.rolling"), std::string::npos);
  EXPECT_NE(error("{rolling: implict}").find("implicit"), std::string::npos);
  EXPECT_NE(error("{rollin: implicit}").find("rolling"), std::string::npos);
  const std::string straight = InputErrorOf([] {
    Document(Replace(Replace(kSmallScenario, "type: c_leg", "type: straight_leg"),
                     "{rest_radius_m: 0.09, E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: "
                     "0.0038, damping_N_s_per_m: 3.0}",
                     "{rest_length_m: 0.2, stiffness_N_per_m: 5000, damping_N_s_per_m: 3.0, "
                     "variant: {rolling: explicit}}"))
        .Read();
  });
  EXPECT_NE(straight.find("a straight leg knows torque_sign alone"), std::string::npos);
}

TEST(ReadScenario, ReadsWhatARunNeeds) {
  const Scenario scenario = Document().Read();
  EXPECT_EQ(scenario.name, "controlled-hopping");
  EXPECT_EQ(scenario.law, "large_deflection");
  EXPECT_EQ(scenario.law_origin.place, "s.yaml:3");
  EXPECT_EQ(scenario.mechanism.c_leg.E_Pa, 22e9);
  EXPECT_EQ(scenario.controller, (ControllerSpec{4, 1.8, {}}));
  EXPECT_EQ(scenario.touchdown_angle_rad, DegToRad(40));
  EXPECT_EQ(scenario.initial, (StateSpec{0, 0.3, 1, 0}));
  EXPECT_EQ(scenario.stop, (StopSpec{15, 60}));
}

TEST(ReadScenario, ReadsTheAngleALegStartsAt) {
  EXPECT_FALSE(Document().Read().start_angle_rad.has_value());
  const std::string with = Replace(kSmallScenario, "touchdown_angle_deg: 40\n",
                                   "touchdown_angle_deg: 18\nstart_angle_deg: 40\n");
  EXPECT_DOUBLE_EQ(Document(with).Read().start_angle_rad.value(), DegToRad(40.0));
  EXPECT_NE(ScenarioErrorWith("stop: {", "start_angle_deg: 200\nstop: {").find("start_angle_deg"),
            std::string::npos);
  EXPECT_NE(ScenarioErrorWith("touchdown_angle_deg: 40\n",
                              "touchdown_angle_deg: [40, 18]\nstart_angle_deg: 40\n")
                .find("Remove one of them"),
            std::string::npos);
}

TEST(ReadScenario, KeepsEffectsInOrderWithTheirPlaces) {
  const Scenario scenario =
      Document(Replace(kSmallScenario, "{air_drag: {c_drag: 0.05}}",
                       "\n  foot_slip: {c_slip: 1e-3}\n  air_drag:\n    c_drag: 0.05"))
          .Read();
  ASSERT_EQ(scenario.effects.size(), 2u);
  EXPECT_EQ(scenario.effects[0].name, "foot_slip");
  EXPECT_EQ(scenario.effects[1].name, "air_drag");
  EXPECT_EQ(scenario.effects[1].origin.place, "s.yaml:11");
  EXPECT_EQ(scenario.effects[1].parameters[0], (NamedNumber{"c_drag", 0.05}));
  EXPECT_EQ(scenario.effects[1].parameters[0].origin.place, "s.yaml:12");
}

TEST(ReadScenario, ReadsASearch) {
  const SearchSpec search = *Document().Read().search;
  EXPECT_EQ(search.over, (std::vector<KeyRange>{{"touchdown_angle_deg", 15, 60},
                                                {"controller.kp_N_s", 0.5, 12}}));
  EXPECT_EQ(search.objective, SearchObjective::kConvergenceTime);
  EXPECT_EQ(search.constraints,
            (std::vector<NamedNumber>{{"min_speed_m_per_s", 0.5}, {"max_torque_N_m", 10}}));
  EXPECT_EQ(search.budget, 2000);
}

TEST(ReadScenario, ReadsASweepOverAGrid) {
  const SweepSpec sweep = *Document().Read().sweep;
  EXPECT_EQ(sweep.kind, SweepKind::kGrid);
  EXPECT_EQ(sweep.grid, (std::vector<SweepAxis>{{"mechanism.leg.E_Pa", {21.1e9, 22e9}},
                                                {"initial.y_m", {0.2, 0.3}}}));
  EXPECT_EQ(sweep.outputs[1].name, "stiffness_min_N_per_m");
}

TEST(ReadScenario, ReadsASweepOverAList) {
  const SweepSpec sweep =
      *Document(
           Replace(kSmallScenario,
                   "grid: {mechanism.leg.E_Pa: [21.1e9, 22.0e9], initial.y_m: "
                   "[0.2, 0.3]}",
                   "list: [{initial.y_m: 0.2, stop.hops: 5}, {initial.y_m: 0.3, stop.hops: 6}]"))
           .Read()
           .sweep;
  EXPECT_EQ(sweep.kind, SweepKind::kList);
  ASSERT_EQ(sweep.list.size(), 2u);
  EXPECT_EQ(sweep.list[1], (std::vector<NamedNumber>{{"initial.y_m", 0.3}, {"stop.hops", 6}}));
}

TEST(ReadScenario, ReadsALatinHypercube) {
  const SweepSpec sweep =
      *Document(Replace(kSmallScenario,
                        "grid: {mechanism.leg.E_Pa: [21.1e9, 22.0e9], initial.y_m: "
                        "[0.2, 0.3]}",
                        "latin_hypercube: {samples: 1000, ranges: {initial.y_m: [0.2, 0.3]}}"))
           .Read()
           .sweep;
  EXPECT_EQ(sweep.kind, SweepKind::kLatinHypercube);
  EXPECT_EQ(sweep.samples, 1000);
  EXPECT_EQ(sweep.ranges, (std::vector<KeyRange>{{"initial.y_m", 0.2, 0.3}}));
}

TEST(ReadScenario, ReadsTheTrialsToGenerateOverItsOwnValues) {
  const GenerateSpec generate = *Document().Read().dataset;
  EXPECT_EQ(generate.name, "made");
  EXPECT_EQ(generate.sample_rate_hz, 500);
  EXPECT_EQ(generate.channels, (std::vector<ChannelSpec>{{Channel::kBodyX, 0.001}}));
  ASSERT_EQ(generate.trials.size(), 2u);
  EXPECT_EQ(generate.trials[0].file, "train-1.csv");
  EXPECT_EQ(generate.trials[0].touchdown_angle_rad, DegToRad(25));
  EXPECT_EQ(generate.trials[0].controller, (ControllerSpec{4, 1.8, {}}));
  EXPECT_EQ(generate.trials[0].initial, (StateSpec{0, 0.3, 1, 0}));
  EXPECT_EQ(generate.trials[1].file, "test-2.csv");
  EXPECT_EQ(generate.trials[1].touchdown_angle_rad, DegToRad(40));
  EXPECT_FALSE(generate.trials[1].controller);
  EXPECT_EQ(generate.trials[1].initial, (StateSpec{0, 0.25, 1, 0}));
}

TEST(ReadScenario, OnlyFormatNameMechanismAndAngleAreRequired) {
  const std::string text(kSmallScenario);
  const std::size_t controller = text.find("controller:");
  const Scenario scenario =
      Document(Replace(text.substr(0, controller), "law: large_deflection\n", "") +
               "touchdown_angle_deg: 40\n")
          .Read();
  EXPECT_FALSE(scenario.law);
  EXPECT_FALSE(scenario.initial);
  EXPECT_FALSE(scenario.stop.time_s);
  EXPECT_EQ(InputErrorOf([&] { RequireInitial(scenario); }),
            "s.yaml: must have the key initial. "
            "Add initial: {x_m: 0, y_m: 0.3, vx_m_per_s: 1, vy_m_per_s: 0}.");
}

// ---- points of a sweep

TEST(ScenarioAt, SetsNumbersAndDropsTheTask) {
  const Scenario scenario =
      Document().ReadAt({{"mechanism.leg.E_Pa", 21e9}, {"initial.y_m", 0.25}}, "point 3");
  EXPECT_EQ(scenario.mechanism.c_leg.E_Pa, 21e9);
  EXPECT_EQ(scenario.initial->y_m, 0.25);
  EXPECT_FALSE(scenario.search);
  EXPECT_FALSE(scenario.sweep);
  EXPECT_FALSE(scenario.dataset);
}

TEST(ScenarioAt, ANewThicknessGivesANewSection) {
  const Scenario thick = Document().ReadAt({{"mechanism.leg.thickness_m", 0.0076}}, "point 3");
  EXPECT_DOUBLE_EQ(thick.mechanism.c_leg.second_moment_m4,
                   8 * Document().Read().mechanism.c_leg.second_moment_m4);
}

TEST(ScenarioAt, ANumberOutOfRangeIsReportedAtThePoint) {
  EXPECT_EQ(InputErrorOf([] {
              Document().ReadAt({{"mechanism.leg.E_Pa", -1}}, "point 3");
            }),
            "point 3: mechanism.leg.E_Pa = -1; must be in (0, 1e13] Pa. Check the sign.");
}

}  // namespace
}  // namespace hoplab
