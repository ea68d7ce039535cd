// A hopper whose tracker is late against its contact switch.
#include <gtest/gtest.h>

#include "fitting/diagnosis/diagnosis.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

Dataset LateHops() {
  Scenario scenario = testing::HopScenario(2);
  scenario.effects = {testing::EffectOfSize("pose_delay", 0.006)};
  scenario.dataset->sample_rate_hz = 500.0;
  scenario.dataset->channels.push_back({Channel::kContact, {}});
  return GenerateDataset(scenario, {}).dataset;
}

// The contacts alone tell of it, so they count on held-out trials, too.
TEST(LatePose, OfAHopperIsToldByItsContacts) {
  DiagnosisOptions options;
  options.fit.jobs = 2;
  const Diagnosis d = Diagnose(LateHops(), options);
  ASSERT_EQ(d.refusal, "");
  EXPECT_EQ(d.verdict, Verdict::kNamed);
  ASSERT_TRUE(d.extension);
  ASSERT_EQ(d.extension->MainCauses().size(), 1u);
  EXPECT_EQ(d.extension->MainCauses().front()->cause.Name(), "pose_delay");
  EXPECT_EQ(d.extension->causes.size(), 1u);
  EXPECT_NEAR(d.naming.best.ValuesOf(0)[0], 0.006, 0.0004);
  EXPECT_TRUE(d.extension->gain.IsClaim());
}

}  // namespace
}  // namespace hoplab
