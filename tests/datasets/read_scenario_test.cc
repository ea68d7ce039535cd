#include "datasets/read_scenario.h"

#include <gtest/gtest.h>

#include "base/units.h"
#include "tests/datasets/small_dataset.h"
#include "tests/support/input_error_of.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;
using testing::Replace;

const char* const kScenario =
    "format: hoplab-scenario/1\n"  // 1
    "name: controlled-hopping\n"   // 2
    "law: large_deflection\n"      // 3
    "mechanism: {type: c_leg, body_mass_kg: 1.0, gravity_m_per_s2: 9.81, leg: {rest_radius_m: "
    "0.09, E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: 0.0038, damping_N_s_per_m: 3.0}}\n"
    "controller: {kp_N_s: 4.0, v_des_m_per_s: 1.8}\n"                            // 5
    "touchdown_angle_deg: 40\n"                                                  // 6
    "initial: {x_m: 0, y_m: 0.3, vx_m_per_s: 1.0, vy_m_per_s: 0}\n"              // 7
    "stop: {time_s: 15, hops: 60}\n"                                             // 8
    "effects: {air_drag: {c_drag: 0.05}}\n"                                      // 9
    "search:\n"                                                                  // 10
    "  over: {touchdown_angle_deg: [15, 60], controller.kp_N_s: [0.5, 12]}\n"    // 11
    "  objective: convergence_time\n"                                            // 12
    "  constraints: {min_speed_m_per_s: 0.5, max_torque_N_m: 10}\n"              // 13
    "  budget: 2000\n"                                                           // 14
    "sweep:\n"                                                                   // 15
    "  grid: {mechanism.leg.E_Pa: [21.1e9, 22.0e9], initial.y_m: [0.2, 0.3]}\n"  // 16
    "  outputs: [convergence_time_s, stiffness_min_N_per_m]\n"                   // 17
    "dataset:\n"                                                                 // 18
    "  name: made\n"                                                             // 19
    "  sample_rate_hz: 500\n"                                                    // 20
    "  channels: {body_x_m: {sigma: 0.001}}\n"                                   // 21
    "  trials:\n"                                                                // 22
    "    - {role: train, touchdown_angle_deg: 25}\n"                             // 23
    "    - {role: test, initial: {y_m: 0.25}, controller: null}\n";              // 24

ScenarioDocument Document(const std::string& text = kScenario) {
  return ScenarioDocument::FromText(text, "s.yaml");
}

std::string ScenarioErrorWith(const std::string& from, const std::string& to) {
  return InputErrorOf([&] { Document(Replace(kScenario, from, to)).Read(); });
}

std::string ErrorWithSet(const std::string& option) {
  return InputErrorOf([&] {
    ScenarioDocument document = Document();
    document.SetFromOption(option);
    document.Read();
  });
}

std::string WithVariant(const std::string& variant) {
  return Replace(kScenario, "damping_N_s_per_m: 3.0}",
                 "damping_N_s_per_m: 3.0, variant: " + variant + "}");
}

TEST(ReadScenario, ReadsTheReadingOfThePublishedLaw) {
  EXPECT_EQ(Document().Read().mechanism.variant, ThesisVariant());
  const ThesisVariant all =
      Document(WithVariant("{rolling: explicit, angle_rate: virtual_leg, rolling_radius: rest, "
                           "damping_rate: deflection, stiffness_radius: rest, stiffness_angle: "
                           "virtual_leg, torque_sign: printed}"))
          .Read()
          .mechanism.variant;
  EXPECT_EQ(all.rolling, ThesisVariant::Rolling::kExplicit);
  EXPECT_EQ(all.angle_rate, ThesisVariant::AngleRate::kVirtualLeg);
  EXPECT_EQ(all.rolling_radius, ThesisVariant::RollingRadius::kRest);
  EXPECT_EQ(all.damping_rate, ThesisVariant::DampingRate::kDeflection);
  EXPECT_EQ(all.stiffness_radius, ThesisVariant::StiffnessRadius::kRest);
  EXPECT_EQ(all.stiffness_angle, ThesisVariant::StiffnessAngle::kVirtualLeg);
  EXPECT_EQ(all.torque_sign, ThesisVariant::TorqueSign::kPrinted);
  ScenarioDocument document = Document();
  document.SetFromOption("mechanism.leg.variant.damping_rate=hip");
  EXPECT_EQ(document.Read().mechanism.variant.damping_rate, ThesisVariant::DampingRate::kHip);
}

TEST(ReadScenario, RefusesAVariantItDoesNotKnow) {
  const auto error = [](const std::string& variant) {
    return InputErrorOf([&] { Document(WithVariant(variant)).Read(); });
  };
  EXPECT_NE(error("{rolling: implict}").find("mechanism.leg.variant.rolling"), std::string::npos);
  EXPECT_NE(error("{rolling: implict}").find("implicit"), std::string::npos);
  EXPECT_NE(error("{rollin: implicit}").find("rolling"), std::string::npos);
  const std::string straight = InputErrorOf([] {
    Document(Replace(Replace(kScenario, "type: c_leg", "type: straight_leg"),
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
  const std::string with = Replace(kScenario, "touchdown_angle_deg: 40\n",
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
      Document(Replace(kScenario, "{air_drag: {c_drag: 0.05}}",
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
  EXPECT_EQ(search.objective, ObjectiveKind::kConvergenceTime);
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
           Replace(kScenario,
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
      *Document(Replace(kScenario,
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
  const std::string text(kScenario);
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

// ---- bad input

TEST(BadScenario, AMisspeltKeyGetsTheNearestKnownOne) {
  EXPECT_EQ(ScenarioErrorWith("  budget:", "  budjet:"),
            "s.yaml:14: search.budjet; unknown key. Did you mean budget?");
}

TEST(BadScenario, AnUnknownObjectiveIsRefused) {
  EXPECT_EQ(
      ScenarioErrorWith("objective: convergence_time", "objective: haste"),
      "s.yaml:12: search.objective = haste; must be one of convergence_time, spectral_radius, "
      "weighted, speed, cost_of_transport, peak_torque. Write one of these words.");
}

TEST(BadScenario, ASearchKeyThatIsNoneOfTheScenarioIsRefused) {
  EXPECT_EQ(ScenarioErrorWith("controller.kp_N_s:", "controller.kpp_N_s:"),
            "s.yaml:11: controller.kpp_N_s; unknown key. Did you mean kp_N_s?");
}

TEST(BadScenario, ASearchRangeBeyondThePhysicalOneIsRefused) {
  EXPECT_EQ(ScenarioErrorWith("[0.5, 12]", "[-0.5, 12]"),
            "s.yaml:11: controller.kp_N_s = -0.5; must be in [0, 1e6] N s. Check the sign.");
}

TEST(BadScenario, AnEmptySearchRangeIsRefused) {
  EXPECT_EQ(
      ScenarioErrorWith("[0.5, 12]", "[12, 0.5]"),
      "s.yaml:11: search.over.controller.kp_N_s[1] = 0.5; must be greater than the low end, 12. "
      "Swap the two or widen the range.");
}

TEST(BadScenario, ASearchRangeHasTwoEnds) {
  EXPECT_EQ(
      ScenarioErrorWith("[0.5, 12]", "[0.5, 1, 12]"),
      "s.yaml:11: search.over.controller.kp_N_s = (a list); must be two numbers, [low, high]. "
      "Remove the others.");
}

TEST(BadScenario, ASweepDoesNotVaryText) {
  EXPECT_EQ(
      ScenarioErrorWith("initial.y_m: [0.2, 0.3]", "law: [1, 2]"),
      "s.yaml:16: law; must be a number of the mechanism, the controller, the start, the stop or "
      "an effect. Give a key such as mechanism.leg.E_Pa.");
}

TEST(BadScenario, ASweepHasOneDesign) {
  EXPECT_EQ(ScenarioErrorWith("  outputs:", "  list: [{initial.y_m: 1}]\n  outputs:"),
            "s.yaml:15: sweep; must have exactly one of grid, list and latin_hypercube. "
            "Remove or add one of them.");
}

TEST(BadScenario, AnOutputMayNotStandTwice) {
  EXPECT_EQ(ScenarioErrorWith("stiffness_min_N_per_m", "convergence_time_s"),
            "s.yaml:17: sweep.outputs[1] = convergence_time_s; stands twice in the list. "
            "Remove one of the two.");
}

TEST(BadScenario, AnEffectParameterIsANumber) {
  EXPECT_EQ(ScenarioErrorWith("c_drag: 0.05", "c_drag: much"),
            "s.yaml:9: effects.air_drag.c_drag = much; is not a number; must be any finite number. "
            "Write a number such as 0.09 or 22e9, without unit.");
}

TEST(BadScenario, AFractionOfAHopIsRefused) {
  EXPECT_EQ(ScenarioErrorWith("hops: 60", "hops: 6.5"),
            "s.yaml:8: stop.hops = 6.5; must be a whole number. Remove the fraction.");
}

TEST(BadScenario, NoiseToGenerateCannotBeEstimated) {
  EXPECT_EQ(
      ScenarioErrorWith("{sigma: 0.001}", "{sigma: estimate}"),
      "s.yaml:21: dataset.channels.body_x_m.sigma = estimate; must be a number: there is nothing "
      "to estimate it from yet. Write the noise to add, 1 standard deviation.");
}

TEST(BadScenario, GeneratedTrialsNeedATrainTrial) {
  EXPECT_EQ(ScenarioErrorWith("role: train", "role: test"),
            "s.yaml:22: dataset.trials = (a list); at least one trial must have role: train. "
            "Change the role of the trials to fit.");
}

TEST(BadScenario, ADatasetIsToldWhatReadsIt) {
  EXPECT_EQ(ScenarioErrorWith("hoplab-scenario/1", "hoplab-dataset/1"),
            "s.yaml:1: format = hoplab-dataset/1; must be hoplab-scenario/1. "
            "This is a dataset: check, fit and diagnose read it.");
}

TEST(BadScenario, AFileThatIsNotThereIsReported) {
  EXPECT_EQ(InputErrorOf([] { ReadScenario("/nowhere/s.yaml"); }),
            "/nowhere/s.yaml: there is no such file. Check the name.");
}

// ---- --set

TEST(SetScenario, ReplacesANumber) {
  const testing::TempFolder temp;
  testing::WriteText(temp.path() / "s.yaml", kScenario);
  const Scenario scenario =
      ReadScenario(temp.path() / "s.yaml", {"mechanism.leg.E_Pa=21e9", "touchdown_angle_deg=30"});
  EXPECT_EQ(scenario.mechanism.c_leg.E_Pa, 21e9);
  EXPECT_EQ(scenario.touchdown_angle_rad, DegToRad(30));
}

TEST(SetScenario, TheLaterOfTwoWins) {
  ScenarioDocument document = Document();
  document.Set("law", "thesis");
  document.Set("law", "consistent");
  EXPECT_EQ(document.Read().law, "consistent");
}

TEST(SetScenario, AddsAnEffect) {
  ScenarioDocument document = Document();
  document.SetFromOption("effects.foot_slip.c_slip = 0.1");
  const Scenario scenario = document.Read();
  ASSERT_EQ(scenario.effects.size(), 2u);
  EXPECT_EQ(scenario.effects[1].parameters[0], (NamedNumber{"c_slip", 0.1}));
  EXPECT_EQ(scenario.effects[1].origin.place, "--set effects.foot_slip.c_slip");
}

TEST(SetScenario, ReplacesASearchRangeUnderItsDottedKey) {
  ScenarioDocument document = Document();
  document.Set("search.over.controller.kp_N_s", "[1, 2]");
  EXPECT_EQ(document.Read().search->over[1], (KeyRange{"controller.kp_N_s", 1, 2}));
}

TEST(SetScenario, ReachesATrialOfTheList) {
  ScenarioDocument document = Document();
  document.Set("dataset.trials.1.role", "train");
  EXPECT_EQ(document.Read().dataset->trials[1].role, TrialRole::kTrain);
}

TEST(SetScenario, NullRemovesABlock) {
  ScenarioDocument document = Document();
  document.Set("controller", "null");
  document.Set("search", "null");
  EXPECT_FALSE(document.Read().controller);
}

TEST(SetScenario, AnUnknownKeyIsReportedAtTheOption) {
  EXPECT_EQ(ErrorWithSet("mechanism.leg.E_GPa=21"),
            "--set mechanism.leg.E_GPa: mechanism.leg.E_GPa; is written E_Pa: the unit in its name "
            "does not belong to it. Rename it to E_Pa and give the value in Pa.");
}

TEST(SetScenario, AValueOutOfRangeIsReportedAtTheOption) {
  EXPECT_EQ(ErrorWithSet("touchdown_angle_deg=200"),
            "--set touchdown_angle_deg: touchdown_angle_deg = 200; must be in (-90, 180) deg. "
            "Check the unit: deg is meant.");
}

TEST(SetScenario, AnOptionWithoutEqualsIsRefused) {
  EXPECT_EQ(ErrorWithSet("law"),
            "--set: law; must be key=value. For example --set mechanism.leg.E_Pa=21e9.");
}

TEST(SetScenario, AnEmptyValueIsAMissingOne) {
  EXPECT_EQ(ErrorWithSet("mechanism.body_mass_kg="),
            "--set mechanism.body_mass_kg: mechanism; the key body_mass_kg has no value. "
            "Add body_mass_kg: a number in (0, 1e6] kg.");
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
