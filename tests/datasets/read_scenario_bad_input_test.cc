// Scenarios that are refused: the whole message, with place, value, rule and remedy.

#include <gtest/gtest.h>

#include "base/units.h"
#include "datasets/read_scenario.h"
#include "tests/datasets/small_scenario.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

using namespace testing;

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

TEST(BadScenario, AStartAlongTheGroundOnAGuideIsRefused) {
  EXPECT_EQ(
      ScenarioErrorWith("gravity_m_per_s2: 9.81,", "gravity_m_per_s2: 9.81, guide: vertical,"),
      "s.yaml:7: initial; begins with vx_m_per_s = 1, and a vertical guide holds the body "
      "along the ground. Write vx_m_per_s: 0, or guide: none.");
  const std::string held = Replace(Replace(kSmallScenario, "gravity_m_per_s2: 9.81,",
                                           "gravity_m_per_s2: 9.81, guide: vertical,"),
                                   "vx_m_per_s: 1.0", "vx_m_per_s: 0");
  EXPECT_NO_THROW(Document(held).Read());
  EXPECT_EQ(InputErrorOf([&] { Document(Replace(held, "{y_m: 0.25}", "{vx_m_per_s: 2}")).Read(); }),
            "s.yaml:24: dataset.trials[1]; begins with vx_m_per_s = 2, and a vertical guide holds "
            "the body along the ground. Write vx_m_per_s: 0, or guide: none.");
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

}  // namespace
}  // namespace hoplab
