// Traces that were smoothed before they were logged: known by their noise, and the filter named.
#include "fitting/smoothed_traces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <string_view>

#include "base/random.h"
#include "datasets/read_dataset.h"
#include "datasets/smoothness.h"
#include "fitting/diagnosis/diagnosis.h"
#include "tests/support/butterworth.h"

namespace hoplab {
namespace {

using testing::Averaged;
using testing::FilterTime;
using testing::Smoothed;
using testing::SmoothedLate;
using testing::Thinned;

Dataset Shipped(const std::string& name) {
  return ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/" + name);
}

TEST(SmoothedTraces, AreKnownByTheirNoise) {
  using C = Channel;
  for (const char* name : {"rig-drops", "rig-controlled", "rig-drops-undamped", "robot-drops",
                           "robot-pronk", "robot-walk"}) {
    const Dataset raw = Shipped(name);
    EXPECT_TRUE(SmoothedTraces(MakeProblem(raw, {})).empty()) << name;
    std::vector<C> expected = {C::kBodyX, C::kBodyY};
    if (raw.mechanism.type == MechanismKind::kRobot) expected.push_back(C::kBodyPitch);
    for (const double cut_off : {6.0, 12.0, 25.0}) {
      const FitProblem problem = MakeProblem(Smoothed(raw, cut_off), {});
      EXPECT_EQ(SmoothedChannels(problem), expected) << name << " " << cut_off << " Hz";
      EXPECT_EQ(SmoothedTraces(problem).size(), 1U);
    }
    EXPECT_EQ(SmoothedChannels(MakeProblem(Smoothed(Thinned(raw, 5), 12.0), {})), expected) << name;
  }
}

// White noise and noise on a grid, long and short.
TEST(SmoothedTraces, WhiteNoiseIsNone) {
  double most = -1.0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    RandomStream random(seed, 3);
    const std::size_t rows = 200 + 20 * (seed % 50);
    const double digit = seed % 2 ? 0.0 : 1.5;  // standard deviations
    std::vector<double> times, values;
    for (std::size_t i = 0; i < rows; ++i) {
      times.push_back(0.002 * static_cast<double>(i));
      const double noise = random.Normal();
      values.push_back(digit > 0.0 ? digit * std::round(noise / digit) : noise);
    }
    const SampledColumn column{times, values};
    most = std::fmax(most, SmoothnessOfNoise(std::span(&column, 1)));
  }
  EXPECT_LT(most, -0.1);
  EXPECT_GT(most, -0.6);
}

// Few samples a second: the third differences are those of the motion.
TEST(SmoothedTraces, VideoOfAHopIsNone) {
  for (const double rate : {25.0, 30.0, 60.0, 120.0}) {
    RandomStream random(4, static_cast<std::uint64_t>(rate));
    std::vector<double> times, heights;
    for (int i = 0; i < static_cast<int>(10.0 * rate); ++i) {
      times.push_back(i / rate);
      const double since = std::fmod(times.back(), 0.4);
      const double path = since < 0.3 ? 0.5 * 9.81 * since * (0.3 - since)
                                      : -0.047 * std::sin(std::numbers::pi * (since - 0.3) / 0.1);
      heights.push_back(path + 0.001 * random.Normal());
    }
    const SampledColumn column{times, heights};
    EXPECT_FALSE(IsSmoothed(std::span(&column, 1))) << rate << " Hz";
  }
}

// What a diagnosis of the rig's drops says of traces that went through a filter.
struct ThroughFilter {
  const char* name;
  bool noise_stated;
  const char* effect;
  double time, within;  // of the filter [s]
  Dataset (*filter)(const Dataset&);
};
void PrintTo(const ThroughFilter& c, std::ostream* out) { *out << c.name; }
Dataset TwelveHertz(const Dataset& d) { return Smoothed(d, 12.0); }
Dataset TwentyHertzLate(const Dataset& d) { return SmoothedLate(d, 20.0); }
Dataset MeansOfThree(const Dataset& d) { return Averaged(d, 3); }

// A filter rounds the corners of every stance, and may be late. Named with it are the causes that
// the rig has, and its modulus is right: with the sensor's noise stated, and with that of the
// filtered traces, which is smaller and lasts for some samples.
class FilteredRig : public ::testing::TestWithParam<ThroughFilter> {};
TEST_P(FilteredRig, IsDiagnosedThroughItsFilter) {
  const ThroughFilter& c = GetParam();
  Dataset rig = c.filter(Thinned(Shipped("rig-drops"), 4));
  if (!c.noise_stated)
    for (ChannelSpec& channel : rig.channels) channel.sigma.reset();
  DiagnosisOptions options;
  options.fit.jobs = 2;
  const Diagnosis d = Diagnose(rig, options);
  ASSERT_TRUE(d.extension.has_value());
  std::set<std::string> names;
  for (const CauseReport* cause : d.extension->MainCauses()) names.insert(cause->cause.Name());
  EXPECT_EQ(names, (std::set<std::string>{"leg_mass", "leg_material_damping", c.effect}));
  const auto value = [&](const std::string& name) {
    const std::vector<std::string> all = d.naming.best.problem.shared_names();
    const auto place = std::find(all.begin(), all.end(), name) - all.begin();
    return d.naming.best.shared[place];
  };
  EXPECT_NEAR(value("E") / 21.99e9, 1.0, 0.01);
  const std::string_view parameter = FindEffect(c.effect)->info.parameters[0].name;
  EXPECT_NEAR(value(std::string(c.effect) + "." + std::string(parameter)), c.time, c.within);
  EXPECT_NEAR(value("leg_material_damping.tau"), 400e-6, 30e-6);
  EXPECT_NEAR(value("leg_mass.m_leg"), 0.010, 0.004);
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [&](const std::string& warning) {
    return warning.find(std::string("--with ") + c.effect) != std::string::npos;
  }));
}
INSTANTIATE_TEST_SUITE_P(
    , FilteredRig,
    ::testing::Values(
        ThroughFilter{"NoiseStated", true, "sensor_low_pass", FilterTime(12.0), 3e-4, &TwelveHertz},
        ThroughFilter{"NoiseEstimated", false, "sensor_low_pass", FilterTime(12.0), 3e-4,
                      &TwelveHertz},
        // Run over samples 8 ms apart it is late by what 7.28 ms would be of slow motion, and cuts
        // as 7.96 ms do at its cut-off.
        ThroughFilter{"Late", false, "sensor_causal_low_pass", 7.62e-3, 3.5e-4, &TwentyHertzLate},
        ThroughFilter{"Means", false, "sensor_moving_average", 0.024, 2e-3, &MeansOfThree}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace hoplab
