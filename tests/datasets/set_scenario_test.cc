// Values of a scenario replaced by `--set`.

#include <gtest/gtest.h>

#include "base/units.h"
#include "datasets/read_scenario.h"
#include "tests/datasets/small_scenario.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

using namespace testing;

TEST(SetScenario, ReplacesANumber) {
  const testing::TempFolder temp;
  testing::WriteText(temp.path() / "s.yaml", kSmallScenario);
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

}  // namespace
}  // namespace hoplab
