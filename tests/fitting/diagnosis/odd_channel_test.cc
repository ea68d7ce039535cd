// A sensor beside those of the pose that is late, or wrong: the channel is told, not a cause.
#include "fitting/diagnosis/odd_channel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fitting/diagnosis/verdict.h"
#include "tests/support/butterworth.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using namespace testing;

constexpr double kRate_Hz = 500.0;

// Height and what a force plate reads.
Dataset HopsOnAPlate(const std::vector<EffectSpec>& effects = {}) {
  Scenario s = HopScenario(2);
  s.effects = effects;
  s.dataset->sample_rate_hz = kRate_Hz;
  s.dataset->channels = {{Channel::kBodyY, 1e-3}, {Channel::kGroundForceY, 0.5}};
  std::vector<GenerateTrial>& trials = s.dataset->trials;
  trials.erase(trials.begin() + 7, trials.end());
  trials.erase(trials.begin() + 4, trials.begin() + 6);
  GenerateOptions options;
  options.seed = 7;
  Dataset d = GenerateDataset(s, options).dataset;
  for (Trial& t : d.trials) t.mechanism.c_leg.E_Pa *= 1.1;
  d.mechanism.c_leg.E_Pa *= 1.1;
  return d;
}
template <class Change>
Dataset WithForces(Dataset d, const Change& change) {
  for (Trial& trial : d.trials)
    for (TraceColumn& column : trial.trace.columns)
      if (column.name == ChannelName(Channel::kGroundForceY)) column.values = change(column.values);
  return d;
}

Diagnosis DiagnosisOf(const Dataset& d) {
  DiagnosisOptions options;
  options.fit.jobs = 2;
  return Diagnose(d, options);
}
double ModulusError(const Diagnosis& d, const Dataset& truth) {
  return d.null.shared[0] / (truth.mechanism.c_leg.E_Pa / 1.1) - 1.0;
}

TEST(OddChannel, ThatIsLateIsGivenItsOwnClock) {
  const Dataset hops = HopsOnAPlate();
  const Diagnosis sound = DiagnosisOf(hops);
  EXPECT_EQ(sound.verdict, Verdict::kAdequate);
  EXPECT_FALSE(sound.odd_channel.has_value());
  constexpr std::size_t kRows = 3;
  const Dataset late = WithForces(hops, [](std::vector<double> forces) {
    forces.insert(forces.begin(), kRows, 0.0);
    forces.resize(forces.size() - kRows);
    return forces;
  });
  const Diagnosis d = DiagnosisOf(late);
  EXPECT_EQ(d.verdict, Verdict::kAdequate);
  ASSERT_TRUE(d.odd_channel.has_value());
  EXPECT_EQ(d.odd_channel->channel, Channel::kGroundForceY);
  ASSERT_TRUE(d.odd_channel->offset_s.has_value());
  const double offset = -static_cast<double>(kRows) / kRate_Hz;
  EXPECT_NEAR(*d.odd_channel->offset_s, offset, 2e-4);
  ASSERT_TRUE(d.odd_channel->offset_ci95.has_value());
  EXPECT_LE(d.odd_channel->offset_ci95->first, offset);
  EXPECT_GE(d.odd_channel->offset_ci95->second, offset);
  EXPECT_LT(std::abs(ModulusError(d, hops)), 0.01);
}

TEST(OddChannel, ThatIsFilteredIsLeftOut) {
  const Dataset hops = HopsOnAPlate();
  const Dataset filtered = WithForces(hops, [](const std::vector<double>& forces) {
    return Butterworth(25.0 / kRate_Hz).Forward(forces);
  });
  const Diagnosis d = DiagnosisOf(filtered);
  EXPECT_EQ(d.verdict, Verdict::kAdequate);
  ASSERT_TRUE(d.odd_channel.has_value());
  EXPECT_EQ(d.odd_channel->channel, Channel::kGroundForceY);
  EXPECT_FALSE(d.odd_channel->offset_s.has_value());
  EXPECT_EQ(d.problem.channels.size(), 1U);
  EXPECT_LT(std::abs(ModulusError(d, hops)), 0.01);
}

// A cause that only the force shows is a cause: with E free, heights alone do not know the mass.
TEST(OddChannel, IsNoneWhereACauseExplainsIt) {
  const Diagnosis d = DiagnosisOf(HopsOnAPlate({EffectOfSize("body_mass_scale", 0.06)}));
  EXPECT_FALSE(d.odd_channel.has_value());
  ASSERT_TRUE(NamesSomething(d));
  EXPECT_EQ(d.extension->ToldCauses().front()->cause.Name(), "body_mass_scale");
}

}  // namespace
}  // namespace hoplab
