#include "fitting/generate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/nan.h"
#include "base/random.h"
#include "fitting/noise.h"
#include "tests/support/hop_scenarios.h"
#include "tests/support/input_error_of.h"
#include "tests/support/robot_drops.h"

namespace hoplab {
namespace {

using testing::HopScenario;

TEST(Generate, TheSameSeedGivesTheSameDataset) {
  GenerateOptions options;
  options.seed = 42;
  const Scenario s = HopScenario(2);
  EXPECT_EQ(GenerateDataset(s, options).dataset, GenerateDataset(s, options).dataset);
  options.seed = 43;
  EXPECT_NE(GenerateDataset(s, options).dataset.trials[0].trace,
            GenerateDataset(s, {.seed = 42}).dataset.trials[0].trace);
}

TEST(Generate, RefusesALegThatStartsAtAnotherAngleThanItsTrialsSay) {
  Scenario s = HopScenario(2);
  s.start_angle_rad = 0.5;
  EXPECT_NE(testing::InputErrorOf([&] { GenerateDataset(s, {}); }).find("start_angle_deg"),
            std::string::npos);
}

TEST(Generate, LeavingATrialOutDoesNotChangeTheOthers) {
  Scenario s = HopScenario(2);
  const Dataset whole = GenerateDataset(s, {}).dataset;
  s.dataset->trials.pop_back();
  const Dataset less = GenerateDataset(s, {}).dataset;
  for (std::size_t i = 0; i < less.trials.size(); ++i)
    EXPECT_EQ(less.trials[i].trace, whole.trials[i].trace);
}

TEST(Generate, NoiseHasTheStatedSize) {
  const Scenario s = HopScenario(3);
  const Dataset noisy = GenerateDataset(s, {}).dataset;
  const Dataset clean = GenerateDataset(s, {.noise = 0.0}).dataset;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < noisy.trials.size(); ++i) {
    for (std::size_t c = 0; c < 2; ++c) {
      const auto& a = noisy.trials[i].trace.columns[c].values;
      const auto& b = clean.trials[i].trace.columns[c].values;
      for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
      count += static_cast<double>(a.size());
    }
  }
  EXPECT_NEAR(std::sqrt(sum / count), 0.001, 3 * 0.001 / std::sqrt(2 * count));
}

TEST(Generate, AnEffectChangesTheTraceButNotTheDescription) {
  Scenario s = HopScenario(2);
  const Dataset plain = GenerateDataset(s, {}).dataset;
  s.effects.push_back({"air_drag", {{"c_drag", 0.05, {}}}, {}});
  const Dataset dragged = GenerateDataset(s, {}).dataset;
  EXPECT_NE(plain.trials[0].trace, dragged.trials[0].trace);
  EXPECT_EQ(plain.source, dragged.source);
  EXPECT_EQ(plain.mechanism, dragged.mechanism);
}

TEST(Generate, StatedInitialStatesAreOffByTheirSigma) {
  const Scenario s = HopScenario(2);
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Dataset d = GenerateDataset(s, {.seed = seed}).dataset;
    for (std::size_t i = 0; i < d.trials.size(); ++i, ++count) {
      const double off = d.trials[i].initial->y_m - s.dataset->trials[i].initial->y_m;
      sum += off * off;
    }
  }
  EXPECT_NEAR(std::sqrt(sum / count), 0.002, 3 * 0.002 / std::sqrt(2.0 * count));
}

// A dataset that is read: no doubt is told of a speed that the guide holds at 0.
TEST(Generate, OnAGuideTheStatedSpeedAlongTheGroundIsNothing) {
  Scenario s = HopScenario(2);
  s.mechanism.on_guide = true;
  for (GenerateTrial& trial : s.dataset->trials) {
    trial.mechanism.on_guide = true;
    trial.initial->vx_m_per_s = 0.0;
  }
  for (const Trial& trial : GenerateDataset(s, {}).dataset.trials) {
    EXPECT_EQ(trial.initial->vx_m_per_s, 0.0);
    EXPECT_NE(trial.initial->y_m, s.dataset->trials[0].initial->y_m);
  }
}

TEST(Generate, ARunThatFallsIsCutAndSaidSo) {
  Scenario s = HopScenario(2);
  s.stop.hops = 30;  // a passive leg falls before
  const GeneratedDataset g = GenerateDataset(s, {});
  ASSERT_FALSE(g.notes.empty());
  EXPECT_NE(g.notes[0].find("fell"), std::string::npos) << g.notes[0];
}

TEST(Generate, UnknownEffectIsRefusedWithItsPlace) {
  Scenario s = HopScenario(2);
  s.effects.push_back({"air_darg", {}, {"hop.yaml:12"}});
  const std::string message = testing::InputErrorOf([&] { GenerateDataset(s, {}); });
  EXPECT_NE(message.find("hop.yaml:12: effect air_darg"), std::string::npos) << message;
  EXPECT_NE(message.find("air_drag"), std::string::npos) << message;
}

TEST(Generate, AnEffectValueOutOfItsBoundsIsRefused) {
  Scenario s = HopScenario(2);
  s.effects.push_back({"air_drag", {{"c_drag", -1.0, {"hop.yaml:13"}}}, {}});
  const std::string message = testing::InputErrorOf([&] { GenerateDataset(s, {}); });
  EXPECT_NE(message.find("hop.yaml:13: air_drag.c_drag = -1; must be in [0, 10] N s^2/m^2"),
            std::string::npos)
      << message;
}

TEST(EstimateNoise, NeedsEnoughWindows) {
  const std::vector<double> t = {0, 1, 2, 3}, v = {0, 1, 0, 1};
  const SampledColumn column{t, v};
  EXPECT_TRUE(std::isnan(EstimateNoise({&column, 1})));
}

// A motor that rests shows one count of its encoder, or two.
TEST(EstimateNoise, IsNoLessThanADigits) {
  constexpr double kCount = 0.003;
  std::vector<double> times, angles;
  for (int i = 0; i < 400; ++i) {
    times.push_back(0.002 * i);
    angles.push_back(0.3 + (i < 350 ? 0.0 : kCount * ((i - 350) / 10)));
  }
  const SampledColumn column{times, angles};
  EXPECT_NEAR(EstimateNoise({&column, 1}), kCount / std::sqrt(12.0), 1e-6);
  // What moves on by more than its noise from sample to sample has no such digit.
  RandomStream random(3, 1);
  for (int i = 0; i < 400; ++i)
    angles[static_cast<std::size_t>(i)] = 0.01 * i + 1e-4 * random.Normal();
  EXPECT_NEAR(EstimateNoise({&column, 1}), 1e-4, 2e-5);
}

TEST(EstimateNoise, StancesInTheWindowsOfALowRateDoNotRaiseIt) {
  Scenario s = HopScenario(2);
  s.dataset->sample_rate_hz = 100.0;  // every third window of twelve rows meets a stance
  double mean = 0.0;
  constexpr int kSeeds = 20;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    GenerateOptions options;
    options.seed = static_cast<std::uint64_t>(seed);
    const Dataset d = GenerateDataset(s, options).dataset;
    std::vector<SampledColumn> columns;
    for (const Trial& t : d.trials) columns.push_back({t.trace.time_s, t.trace.columns[1].values});
    const double estimate = EstimateNoise(columns);
    EXPECT_LT(estimate, 1.25e-3) << seed;  // what would overrule the stated 1 mm
    mean += estimate / kSeeds;
  }
  EXPECT_NEAR(mean, 1e-3, 0.05e-3);
}

// At 25 pictures a second twelve are longer than a flight; so they are where the log has blank rows
// between them.
TEST(EstimateNoise, IsThatOfShorterWindowsWhereAllOthersMeetAStance) {
  Scenario s = HopScenario(3);
  for (const int blanks : {0, 3}) {
    s.dataset->sample_rate_hz = 25.0 * (1 + blanks);
    double mean = 0.0;
    constexpr int kSeeds = 20;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      GenerateOptions options;
      options.seed = static_cast<std::uint64_t>(seed);
      Dataset d = GenerateDataset(s, options).dataset;
      std::vector<SampledColumn> columns;
      for (Trial& t : d.trials) {
        std::vector<double>& heights = t.trace.columns[1].values;
        for (std::size_t row = 0; row < heights.size(); ++row)
          if (row % static_cast<std::size_t>(1 + blanks) != 0) heights[row] = kNaN;
        columns.push_back({t.trace.time_s, heights});
      }
      const double estimate = EstimateNoise(columns);
      EXPECT_LT(estimate, 2e-3) << seed;
      mean += estimate / kSeeds;
    }
    EXPECT_NEAR(mean, 1e-3, 0.15e-3) << blanks;
  }
}

// A pose that is early ends before the other channels do: rows stay, their pose is blank.
TEST(Generate, ARowHasWhatItsChannelsHave) {
  Scenario s = testing::RobotDrops();
  const Dataset plain = GenerateDataset(s, {}).dataset;
  s.effects = {{"pose_delay", {{"tau", -0.02}}}};
  const Dataset early = GenerateDataset(s, {}).dataset;
  const Trace &all = plain.trials[0].trace, &some = early.trials[0].trace;
  EXPECT_EQ(some.time_s, all.time_s);
  EXPECT_TRUE(std::isnan(some.Find(Channel::kBodyX)->back()));
  EXPECT_TRUE(std::isfinite(some.Find(Channel::kLegAngle1)->back()));
  EXPECT_TRUE(std::isfinite(*(some.Find(Channel::kBodyX)->end() - 15)));
}

}  // namespace
}  // namespace hoplab
