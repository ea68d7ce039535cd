#include "fitting/noise_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "datasets/read_dataset.h"
#include "fitting/diagnosis/gate.h"
#include "fitting/diagnosis/linearise_at.h"
#include "fitting/diagnosis/localise.h"
#include "fitting/diagnosis/null_fit.h"
#include "fitting/diagnosis/verdict.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::DatasetOf;

constexpr double kMarginal = 1e-3;  // m

// Hops whose noise is alike in neighbouring samples, of first order in time.
Dataset HopsWithAlikeNoise(std::uint64_t seed, double rho) {
  Dataset d = DatasetOf({.train = 6, .seed = seed, .sigma_m = 1e-9, .rate_hz = 200.0});
  for (ChannelSpec& c : d.channels) c.sigma = kMarginal;
  RandomStream random(seed, 78);
  for (Trial& trial : d.trials) {
    for (TraceColumn& column : trial.trace.columns) {
      double noise = random.Normal();
      for (double& value : column.values) {
        value += kMarginal * noise;
        noise = rho * noise + std::sqrt(1.0 - rho * rho) * random.Normal();
      }
    }
  }
  return d;
}
// What a diagnosis makes of a stated noise, as the correlation that this is.
double CorrelationIn(const Dataset& dataset, std::size_t channel) {
  FitProblem problem = MakeProblem(dataset, {});
  const double stated = problem.channels[channel].sigma;
  CorrectNoise(problem);
  const double square = std::pow(problem.channels[channel].sigma / stated, 2);
  return (square - 1.0) / (square + 1.0);
}

TEST(NoiseCorrelation, OfWhiteNoiseIsNone) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const std::size_t channel : {0, 1})
      EXPECT_EQ(CorrelationIn(HopsWithAlikeNoise(seed, 0.0), channel), 0.0) << seed;
  }
  for (const char* name : {"rig-drops", "rig-controlled", "rig-drops-undamped", "robot-drops",
                           "robot-pronk", "robot-walk"}) {
    const Dataset rig = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/" + name);
    for (const std::size_t channel : {0, 1}) EXPECT_EQ(CorrelationIn(rig, channel), 0.0) << name;
  }
}

// A share of the rows is missing.
Dataset WithDroppedRows(Dataset dataset, double share, std::uint64_t seed) {
  RandomStream random(seed, 79);
  for (Trial& trial : dataset.trials) {
    Trace& trace = trial.trace;
    for (std::size_t row = trace.time_s.size() - 1; row > 0; --row) {
      if (random.Uniform(0.0, 1.0) > share) continue;
      const auto at = static_cast<std::ptrdiff_t>(row);
      trace.time_s.erase(trace.time_s.begin() + at);
      for (TraceColumn& column : trace.columns) column.values.erase(column.values.begin() + at);
    }
  }
  return dataset;
}

// What is beside a gap is no neighbour of what is behind it; others are.
TEST(NoiseCorrelation, IsNotThatOfGaps) {
  constexpr double kDropped = 0.02, kAlike = 0.6;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Dataset white = WithDroppedRows(HopsWithAlikeNoise(seed, 0.0), kDropped, seed);
    const Dataset alike = WithDroppedRows(HopsWithAlikeNoise(seed, kAlike), kDropped, seed);
    for (const std::size_t channel : {0, 1}) {
      EXPECT_EQ(CorrelationIn(white, channel), 0.0) << seed;
      EXPECT_NEAR(CorrelationIn(alike, channel), kAlike, 0.25) << seed;
    }
  }
}

TEST(NoiseCorrelation, IsThatOfNeighboursInFlight) {
  for (const double rho : {0.5, 0.7}) {
    double sum = 0.0;
    constexpr int kSeeds = 10;
    for (int seed = 1; seed <= kSeeds; ++seed)
      sum += CorrelationIn(HopsWithAlikeNoise(static_cast<std::uint64_t>(seed), rho), 1);
    EXPECT_NEAR(sum / kSeeds, rho, 0.1);
  }
}

TEST(NoiseCorrelation, OfAFlightThatTrembles) {
  // White noise beside a vibration is alike in neighbouring samples, too, but no noise of first
  // order is as smooth.
  constexpr double kRate_Hz = 214.0, kNoise = 4e-5, kSwing = 4e-4;
  RandomStream random(5, 79);
  std::vector<double> times, white, trembling;
  for (int i = 0; i < 2000; ++i) {
    times.push_back(i / kRate_Hz);
    white.push_back(kNoise * random.Normal());
    trembling.push_back(white.back() +
                        kSwing * std::sin(2.0 * std::numbers::pi * 23.0 * times.back()));
  }
  const SampledColumn columns[] = {{times, white}, {times, trembling}};
  EXPECT_EQ(NoiseCorrelation({columns, 1}), 0.0);
  EXPECT_EQ(NoiseCorrelation({columns + 1, 1}), 0.0);
}

TEST(NoiseCorrelation, CountsAsWhiteNoiseOfTheSameStrengthWhereMotionIsSlow) {
  // The mean of n samples has the variance sigma^2 (1 + rho)/((1 - rho) n) for large n.
  constexpr double kRho = 0.6;
  constexpr int kSamples = 4000;
  double sum = 0.0;
  for (int lag = -kSamples; lag <= kSamples; ++lag)
    sum += (1.0 - std::abs(lag) / static_cast<double>(kSamples)) * std::pow(kRho, std::abs(lag));
  EXPECT_NEAR(WhiteStrength(kRho), std::sqrt(sum), 1e-3);
  EXPECT_EQ(WhiteStrength(0.0), 1.0);
  EXPECT_NEAR(SeenByParabolas(0.0), 1.0, 1e-12);
}

TEST(NoiseCorrelation, OfADiagnosisMakesTheStatedNoiseStronger) {
  FitProblem white = MakeProblem(HopsWithAlikeNoise(3, 0.0), {});
  EXPECT_TRUE(CorrectNoise(white).empty());
  FitProblem alike = MakeProblem(HopsWithAlikeNoise(3, 0.6), {});
  const std::vector<std::string> notes = CorrectNoise(alike);
  ASSERT_EQ(notes.size(), alike.channels.size());
  EXPECT_NE(notes[0].find("the noise of neighbouring samples is alike (correlation 0."),
            std::string::npos);
  for (const ChannelProblem& c : alike.channels)
    EXPECT_NEAR(c.sigma / kMarginal, WhiteStrength(0.6), 0.5);
}

// Sigma is that of slow motion; each sample scatters by less.
TEST(NoiseCorrelation, LeavesASquareOfItsOwn) {
  double over_rows = 0.0, over_noise = 0.0, over_expected = 0.0;
  constexpr int kSeeds = 5;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Diagnosis d;
    std::vector<TrialProblem> train;
    FitNull(MakeProblem(HopsWithAlikeNoise(static_cast<std::uint64_t>(seed), 0.6), {}), {}, d,
            train);
    Linearisation at = LineariseAt(d.plain, {}, train, 1);
    over_rows += at.chi2() / at.degrees_of_freedom() / kSeeds;
    at.alike_rows = AlikeRows(train, d.noise_squares);
    over_noise += at.chi2() / at.degrees_of_freedom() / kSeeds;
    const Localisation l = Localise(Linearise(d.plain.problem, d.plain.problem.shared_count(),
                                              train, d.plain.shared, d.plain.initial_states, 1),
                                    d.noise_squares);
    over_expected += l.chi2 / l.expected / kSeeds;
  }
  EXPECT_LT(over_rows, 0.4);
  EXPECT_NEAR(over_noise, 1.0, 0.1);
  EXPECT_NEAR(over_expected, 1.0, 0.1);
}

// What a model lacks is told over the noise as it is.
TEST(NoiseCorrelation, HidesNoMisfit) {
  Dataset lossy = HopsWithAlikeNoise(3, 0.6);
  const Dataset sound = DatasetOf({.train = 6, .seed = 3, .sigma_m = 1e-9, .rate_hz = 200.0});
  const Dataset moved = DatasetOf({.effects = {testing::EffectOfSize("touchdown_angle_bias", 0.02)},
                                   .train = 6,
                                   .seed = 3,
                                   .sigma_m = 1e-9,
                                   .rate_hz = 200.0});
  for (std::size_t i = 0; i < lossy.trials.size(); ++i)
    for (std::size_t c = 0; c < lossy.trials[i].trace.columns.size(); ++c) {
      std::vector<double>& values = lossy.trials[i].trace.columns[c].values;
      const std::vector<double>&with = moved.trials[i].trace.columns[c].values,
            &without = sound.trials[i].trace.columns[c].values;
      for (std::size_t row = 0; row < std::min({values.size(), with.size(), without.size()}); ++row)
        values[row] += with[row] - without[row];
    }
  const Diagnosis d = Diagnose(lossy, testing::OptionsWith({"touchdown_angle_bias", "air_drag"}));
  EXPECT_GT(MisfitOverNoise(d.detection), 0.3);
  ASSERT_TRUE(d.extension);
  EXPECT_GT(d.extension->explained, 0.8);
  EXPECT_LT(d.extension->explained, 1.0);
}

}  // namespace
}  // namespace hoplab
