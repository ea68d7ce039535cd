// Noise of traces that were smoothed, and what a filter does near their ends.
#include "fitting/filtered_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "datasets/read_dataset.h"
#include "fitting/diagnosis/gate.h"
#include "fitting/smoothed_ends.h"
#include "tests/support/butterworth.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using namespace testing;

// The integral of f over all numbers, f even and small beyond 40, by Simpson's rule.
template <class F>
double Integral(const F& f) {
  constexpr int kParts = 40000;
  const double h = 40.0 / kParts;
  double sum = f(0.0) + f(40.0);
  for (int i = 1; i < kParts; ++i) sum += (i % 2 ? 4.0 : 2.0) * f(h * i);
  return 2.0 * sum * h / 3.0;
}

// M118: white noise whose spectrum a filter has cut: of many samples in one of the filter's times,
// that of M105 and M117, of a power of two.
TEST(NoiseShape, HasTheCorrelationOfTheFiltersSpectrum) {
  const double time = 0.012, step = time / 40.0;
  const auto two = [](double x) { return 1.0 / std::pow(1.0 + std::pow(x, 4), 2); };
  const auto one = [](double x) { return 1.0 / (1.0 + std::pow(x, 4)); };
  const auto compare = [&](RecordFilter filter, const auto& spectrum) {
    const FilteredWhite noise = FilterWhite(filter, time, step, 200);
    const double all = Integral(spectrum);
    for (const std::size_t lag : {0, 10, 40, 80, 160}) {
      const double t = static_cast<double>(lag) * step / time;
      const double at = Integral([&](double x) { return std::cos(x * t) * spectrum(x); }) / all;
      EXPECT_NEAR(noise.correlation[lag], at, 2e-3) << lag;
    }
    // Its density at frequency 0 over the mean of all that rows so far apart see.
    EXPECT_NEAR(noise.strength * noise.strength, 2.0 * std::numbers::pi * time / (step * all),
                2e-3 * noise.strength * noise.strength);
  };
  compare(RecordFilter::kTwoPass, two);
  compare(RecordFilter::kOnePass, one);
}

TEST(NoiseShape, OfAMeanAndOfExponentialSmoothingInClosedForm) {
  const FilteredWhite mean = FilterWhite(RecordFilter::kMovingAverage, 0.014, 0.002, 10);
  for (std::size_t lag = 0; lag < 10; ++lag)
    EXPECT_NEAR(mean.correlation[lag], std::max(0.0, 1.0 - static_cast<double>(lag) / 7.0), 1e-12);
  EXPECT_NEAR(mean.strength, std::sqrt(7.0), 1e-12);
  const double alike = 0.6;
  const FilteredWhite first =
      FilterWhite(RecordFilter::kFirstOrder, -0.002 / std::log(alike), 0.002, 4);
  EXPECT_NEAR(first.correlation[3], alike * alike * alike, 1e-12);
  EXPECT_NEAR(first.strength, std::sqrt((1.0 + alike) / (1.0 - alike)), 1e-12);
}

Dataset Hops(std::uint64_t seed, double rate_hz, double sigma_m) {
  return DatasetOf({.train = 6, .hops = 3, .seed = seed, .sigma_m = sigma_m, .rate_hz = rate_hz});
}

// Which filter hops went through, by its noise alone: its time, and as white noise of the same
// strength what there was before.
struct Through {
  const char* name;
  double rate;
  RecordFilter filter;
  double time, time_within, mean_within;
  Dataset (*make)(const Dataset&);
};
template <int kHertz>
Dataset ToAndFro(const Dataset& d) {
  return Smoothed(d, kHertz);
}
template <int kHertz>
Dataset Forward(const Dataset& d) {
  return SmoothedLate(d, kHertz);
}
Dataset MeanOfSeven(const Dataset& d) { return Averaged(d, 7); }
class FilteredNoiseOf : public ::testing::TestWithParam<Through> {};
void PrintTo(const Through& c, std::ostream* out) { *out << c.name; }

TEST_P(FilteredNoiseOf, IsFoundInHops) {
  const Through& through = GetParam();
  const double white = 0.8e-3;
  double sum = 0.0, worst = 0.0;
  constexpr int kSeeds = 6;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const FitProblem problem = MakeProblem(through.make(Hops(seed, through.rate, white)), {});
    const std::optional<FilteredNoise> noise = FindFilteredNoise(problem);
    ASSERT_TRUE(noise.has_value()) << "seed " << seed;
    EXPECT_EQ(noise->shape.filter, through.filter) << "seed " << seed;
    EXPECT_NEAR(noise->shape.time / through.time, 1.0, through.time_within) << "seed " << seed;
    for (const std::size_t channel : {0, 1}) {
      const double found = noise->sigma[channel] * noise->shape.strength / white;
      sum += found / (2.0 * kSeeds);
      worst = std::max(worst, std::abs(std::log(found)));
    }
  }
  std::printf("  %3.0f rows a second: %.2f of the noise, worst %.2f times\n", through.rate, sum,
              std::exp(worst));
  EXPECT_NEAR(sum, 1.0, through.mean_within);
  EXPECT_LT(worst, std::log(1.7));
}
INSTANTIATE_TEST_SUITE_P(, FilteredNoiseOf,
                         ::testing::Values(Through{"ToAndFro15", 200.0, RecordFilter::kTwoPass,
                                                   FilterTime(15.0), 0.25, 0.2, &ToAndFro<15>},
                                           Through{"ToAndFro12", 400.0, RecordFilter::kTwoPass,
                                                   FilterTime(12.0), 0.25, 0.2, &ToAndFro<12>},
                                           Through{"ToAndFro20", 400.0, RecordFilter::kTwoPass,
                                                   FilterTime(20.0), 0.25, 0.25, &ToAndFro<20>},
                                           Through{"Forward30", 200.0, RecordFilter::kOnePass,
                                                   FilterTime(30.0), 0.25, 0.2, &Forward<30>},
                                           // What a stance leaves lasts longer.
                                           Through{"Forward15", 400.0, RecordFilter::kOnePass,
                                                   FilterTime(15.0), 0.35, 0.3, &Forward<15>},
                                           Through{"MeanOfSeven", 200.0,
                                                   RecordFilter::kMovingAverage, 7.0 / 200.0, 0.01,
                                                   0.2, &MeanOfSeven}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(FilteredNoise, IsNoneOfNoiseThatIsWhite) {
  EXPECT_FALSE(FindFilteredNoise(MakeProblem(Hops(1, 400.0, 1e-3), {})).has_value());
  for (const char* name : {"rig-drops", "robot-drops"}) {
    const Dataset rig = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/" + name);
    EXPECT_FALSE(FindFilteredNoise(MakeProblem(rig, {})).has_value()) << name;
  }
}

// Rows that are missing, here and there or in one place, change neither the filter nor its ends.
TEST(FilteredNoise, IsFoundWhereRowsAreMissing) {
  const double cut_off = 15.0, tau = FilterTime(cut_off);
  const Dataset whole = Smoothed(Hops(4, 400.0, 0.8e-3), cut_off);
  for (const bool one_gap : {false, true}) {
    Dataset hops = whole;
    RandomStream random(4, 9);
    for (std::size_t k = 0; k < hops.trials.size(); ++k) {
      Trace& trace = hops.trials[k].trace;
      const auto goes = [&](std::size_t row) {
        if (one_gap) return k == 2 && row > 150 && row < 250;
        return random.Uniform(0.0, 1.0) < 0.03;
      };
      std::vector<std::size_t> rows;
      for (std::size_t row = 0; row < trace.time_s.size(); ++row)
        if (!goes(row)) rows.push_back(row);
      const auto thin = [&](std::vector<double>& values) {
        for (std::size_t i = 0; i < rows.size(); ++i) values[i] = values[rows[i]];
        values.resize(rows.size());
      };
      thin(trace.time_s);
      for (TraceColumn& column : trace.columns) thin(column.values);
    }
    const std::optional<FilteredNoise> noise = FindFilteredNoise(MakeProblem(hops, {}));
    ASSERT_TRUE(noise.has_value()) << one_gap;
    EXPECT_NEAR(noise->shape.time / tau, 1.0, 0.25) << one_gap;
    EXPECT_NEAR(FindSmoothedEnds(hops).size(), FindSmoothedEnds(whole).size(), 0.5) << one_gap;
  }
}

// A recorder that was left on for a day between two hops.
TEST(FlightTops, ALongGapIsNotFilled) {
  PlaceTrace trace{.gravity = 9.81};
  for (int i = 0; i < 400; ++i) {
    trace.times.push_back(0.005 * i + (i < 200 ? 0.0 : 86400.0) + (i < 100 ? 0.0 : 0.005));
    trace.y.push_back(0.2 + 0.01 * i);
  }
  std::vector<PlaceTrace> traces = {trace};
  FindFlightTops(traces);
  EXPECT_EQ(traces[0].y.size(), 401U);  // the row that is missing
  EXPECT_EQ(traces[0].times.size(), traces[0].y.size());
}

// A diagnosis counts it as white noise of the strength it had; noise that is stated so is kept.
TEST(FilteredNoise, CountsByWhatItWas) {
  const double white = 0.8e-3, cut_off = 15.0;
  Dataset hops = Smoothed(Hops(3, 400.0, white), cut_off);
  FitProblem stated = MakeProblem(hops, {});
  EXPECT_TRUE(CorrectNoise(stated).empty());
  EXPECT_EQ(stated.channels[0].sigma, white);
  for (ChannelSpec& channel : hops.channels) channel.sigma.reset();
  FitProblem estimated = MakeProblem(hops, {});
  const std::vector<std::string> notes = CorrectNoise(estimated);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find("went through a filter"), std::string::npos) << notes[0];
  for (const ChannelProblem& channel : estimated.channels)
    EXPECT_NEAR(channel.sigma / white, 1.0, 0.35);
  const FilteredWhite filtered =
      FilterWhite(RecordFilter::kTwoPass, FilterTime(cut_off), 1.0 / 400.0, 1);
  const double square = std::pow(filtered.strength, -2);
  for (const double found : NoiseSquares(estimated)) EXPECT_NEAR(found / square, 1.0, 0.25);
}

// ---- the ends ---------------------------------------------------------------------------------

TEST(SmoothedEnds, ReachFiveTimeConstants) {
  const Dataset hops = Smoothed(Hops(2, 400.0, 0.8e-3), 15.0);
  const std::vector<TraceFault> ends = FindSmoothedEnds(hops);
  EXPECT_EQ(ends.size(), 4 * hops.trials.size());  // two channels, two ends
  for (const TraceFault& end : ends) {
    const std::vector<double>& times = hops.trials[end.trial].trace.time_s;
    const double reach = times[end.rows.back()] - times[end.rows.front()];
    EXPECT_NEAR(reach / (5.0 * FilterTime(15.0)), 1.0, 0.2);
    EXPECT_TRUE(end.rows.front() == 0 || end.rows.back() + 1 == times.size());
  }
  EXPECT_TRUE(FindSmoothedEnds(Hops(2, 400.0, 0.8e-3)).empty());
}

TEST(SmoothedEnds, LeaveThreeQuartersOfAShortTrial) {
  Dataset hops = Smoothed(Hops(2, 400.0, 0.8e-3), 12.0);
  Trace& trace = hops.trials[0].trace;
  trace.time_s.resize(80);  // of 0.2 s
  for (TraceColumn& column : trace.columns) column.values.resize(80);
  int ends = 0;
  for (const TraceFault& end : FindSmoothedEnds(hops)) {
    if (end.trial != 0) continue;
    ++ends;
    EXPECT_LE(end.rows.size(), 10U);
  }
  EXPECT_EQ(ends, 4);
}

TEST(SmoothedEnds, AreMissing) {
  const Dataset hops = Smoothed(Hops(2, 400.0, 0.8e-3), 15.0);
  const std::vector<TraceFault> faults = FindTraceFaults(hops);
  const Dataset kept = WithoutFaults(hops, faults);
  const std::size_t rows = hops.trials[0].trace.time_s.size();
  ASSERT_EQ(kept.trials[0].trace.time_s.size(), rows);
  const std::vector<double>& y = *kept.trials[0].trace.Find(Channel::kBodyY);
  EXPECT_TRUE(std::isnan(y.front()) && std::isnan(y.back()));
  EXPECT_FALSE(std::isnan(y[rows / 2]));
  const std::vector<std::string> sentences = FaultSentences(hops, faults, /*kept=*/false);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_NE(sentences[0].find("a filter makes up what lies beyond their ends"), std::string::npos)
      << sentences[0];
}

}  // namespace
}  // namespace hoplab
