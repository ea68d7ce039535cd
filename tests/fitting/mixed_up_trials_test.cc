// Records of another engine's rig, with what is stated of two trials written to each other.

#include "fitting/mixed_up_trials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/units.h"
#include "datasets/read_dataset.h"
#include "datasets/touchdowns.h"
#include "fitting/problem.h"

namespace hoplab {
namespace {

Dataset Shipped(const std::string& name) {
  return ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/" + name);
}
std::vector<std::string> SaidOf(const Dataset& dataset) {
  return MixedUpTrials(MakeProblem(dataset, {}));
}
bool NamesBoth(const std::string& sentence, const Trial& a, const Trial& b) {
  return sentence.find(a.file) != std::string::npos && sentence.find(b.file) != std::string::npos;
}

TEST(MixedUpTrials, NothingIsSaidOfRecordsThatAreRight) {
  for (const char* name : {"rig-drops", "rig-controlled", "rig-drops-undamped", "robot-drops"})
    EXPECT_TRUE(SaidOf(Shipped(name)).empty()) << name;
}

TEST(MixedUpTrials, NothingIsSaidOfAWrongModulusOrMass) {
  for (const char* name : {"rig-drops", "rig-controlled", "rig-drops-undamped"}) {
    for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
      Dataset stiff = Shipped(name), heavy = stiff;
      for (Trial& trial : stiff.trials) trial.mechanism.c_leg.E_Pa *= factor;
      for (Trial& trial : heavy.trials) trial.mechanism.body_mass_kg *= factor;
      EXPECT_TRUE(SaidOf(stiff).empty()) << name << ' ' << factor;
      EXPECT_TRUE(SaidOf(heavy).empty()) << name << ' ' << factor;
    }
  }
}

TEST(MixedUpTrials, AnglesOfTwoTrialsAreTold) {
  const Dataset rig = Shipped("rig-drops");
  int pairs = 0;
  for (std::size_t i = 0; i < rig.trials.size(); ++i) {
    for (std::size_t j = i + 1; j < rig.trials.size(); ++j) {
      Dataset mixed = rig;
      Trial &a = mixed.trials[i], &b = mixed.trials[j];
      std::swap(a.touchdown_angle_rad, b.touchdown_angle_rad);
      if (std::abs(RadToDeg(a.touchdown_angle_rad - b.touchdown_angle_rad)) < 7.0) continue;
      const std::vector<std::string> said = SaidOf(mixed);
      ++pairs;
      ASSERT_EQ(said.size(), 1U) << a.file << ' ' << b.file;
      EXPECT_TRUE(NamesBoth(said[0], a, b)) << said[0];
      EXPECT_NE(said[0].find("touchdown_angle_deg:"), std::string::npos) << said[0];
    }
  }
  EXPECT_GT(pairs, 15);
}

// Angles that are stated one a landing, and where they are uncertain are each trial's own values.
TEST(MixedUpTrials, AnglesOfEachLandingAreTold) {
  for (const bool uncertain : {false, true}) {
    Dataset mixed = Shipped("rig-drops");
    std::swap(mixed.trials[1].touchdown_angle_rad, mixed.trials[4].touchdown_angle_rad);
    for (Trial& trial : mixed.trials) {
      const double height = TouchdownHeight(trial.mechanism, trial.touchdown_angle_rad);
      const auto landings = TouchdownTimes(trial.trace, [&](auto, auto) { return height; }).size();
      trial.touchdown_angles_rad.assign(landings, trial.touchdown_angle_rad);
      if (uncertain) trial.touchdown_angle_sigma_rad = DegToRad(1.0);
    }
    const std::vector<std::string> said = SaidOf(mixed);
    ASSERT_EQ(said.size(), 1U) << uncertain;
    EXPECT_TRUE(NamesBoth(said[0], mixed.trials[1], mixed.trials[4])) << said[0];
  }
}

TEST(MixedUpTrials, OfOneAngleOnlyTheStartsAreTold) {
  Dataset mixed = Shipped("rig-drops");
  for (Trial& trial : mixed.trials) trial.touchdown_angle_rad = mixed.trials[3].touchdown_angle_rad;
  mixed.trials = {mixed.trials[3], mixed.trials[4]};  // 4 deg apart
  std::swap(mixed.trials[0].initial, mixed.trials[1].initial);
  const std::vector<std::string> said = SaidOf(mixed);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("each other's initial, or file:"), std::string::npos) << said[0];
}

TEST(MixedUpTrials, FilesOfTwoTrialsAreTold) {
  Dataset mixed = Shipped("rig-drops");
  std::swap(mixed.trials[0].trace, mixed.trials[3].trace);
  const std::vector<std::string> said = SaidOf(mixed);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(NamesBoth(said[0], mixed.trials[0], mixed.trials[3])) << said[0];
  EXPECT_NE(said[0].find("and initial, or file"), std::string::npos) << said[0];
}

TEST(MixedUpTrials, TwoPairsAreTold) {
  Dataset mixed = Shipped("rig-drops");
  std::swap(mixed.trials[0].touchdown_angle_rad, mixed.trials[3].touchdown_angle_rad);
  std::swap(mixed.trials[1].trace, mixed.trials[5].trace);
  EXPECT_EQ(SaidOf(mixed).size(), 2U);
}

// One angle alone is no exchange: `diagnose` names it as that trial's own.
TEST(MixedUpTrials, NothingIsSaidOfOneAngle) {
  Dataset mixed = Shipped("rig-drops");
  mixed.trials[2].touchdown_angle_rad += DegToRad(10.0);
  EXPECT_TRUE(SaidOf(mixed).empty());
}

}  // namespace
}  // namespace hoplab
