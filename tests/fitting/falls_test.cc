// Falls at the end of a record, on paths in closed form, and in the drops of a rig.
#include "fitting/falls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "datasets/read_dataset.h"
#include "fitting/fit_dataset.h"
#include "fitting/problem.h"
#include "fitting/trace_faults.h"
#include "tests/support/sampled_heights.h"

namespace hoplab {
namespace {

using namespace testing;

// One hop, and then a fall to the ground, on which the body comes to lie.
double HopsAndFalls(double t) {
  constexpr double kLies_m = 0.03;
  if (t < 0.1) return 0.18 - 0.04 * std::sin(31.4 * t);
  const double since = t - 0.1;
  return std::max(0.18 + 1.3 * since - 0.5 * kG * since * since, kLies_m);
}
constexpr double kTop_s = 0.1 + 1.3 / kG;

// However it is sampled, the end is the top of that flight; a deep stance is no fall.
TEST(FindTopBeforeFall, FindsTheTopOfTheLastFlight) {
  int all = 0;
  for (const Sampling& sampling : kSamplings) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const RandomStream random(seed, 13 + static_cast<std::uint64_t>(sampling.rate));
      const Samples s = Sampled(HopsAndFalls, 0.7, sampling.rate, sampling.sigma, random);
      const auto top = FindTopBeforeFall(s, 0.18, 0.045, 6.0 * sampling.sigma);
      ASSERT_TRUE(top) << sampling.rate << " Hz, seed " << seed;
      const double off = std::sqrt(12.0 * sampling.sigma / kG) + 1.0 / sampling.rate;
      EXPECT_NEAR(s.t[*top] - 0.3, kTop_s, off) << sampling.rate << " Hz, seed " << seed;
      ++all;
    }
  }
  EXPECT_EQ(all, 240);
}

// Stances of 0.1 s, 40 mm deep, and flights of 0.25 s.
double Hopping(double t) {
  constexpr double kStance_s = 0.1, kFlight_s = 0.25;
  const double since = std::fmod(t, kStance_s + kFlight_s);
  if (since < kStance_s) return 0.18 - 0.04 * std::sin(kPi * since / kStance_s);
  const double flown = since - kStance_s;
  return 0.18 + 0.5 * kG * flown * (kFlight_s - flown);
}

// Downhill a body comes below any height, and hops on; so does one that dips deep, and one whose
// marker is lost for a moment.
TEST(FindTopBeforeFall, SaysNothingOfABodyThatHopsOn) {
  int all = 0;
  for (const double down : {0.0, 0.02, 0.05, 0.1, 0.2})  // m/s
    for (const double until : {2.0, 4.0, 5.03, 6.0, 6.11}) {
      const auto path = [&](double t) { return Hopping(t) - down * t; };
      const Samples s = Sampled(path, until, 500, 0.001, RandomStream(2, ++all));
      EXPECT_FALSE(FindTopBeforeFall(s, 0.18, 0.045, 0.006)) << down << " m/s, " << until << " s";
    }
  EXPECT_EQ(all, 25);
  const auto deep = [](double t) { return 0.15 - 0.14 * std::sin(20.0 * t); };
  const Samples dips = Sampled(deep, 1.02, 500, 0.001, RandomStream(1, 1));
  EXPECT_FALSE(FindTopBeforeFall(dips, 0.18, 0.045, 0.006));
  Samples lost = Sampled(Hopping, 0.78, 500, 0.001, RandomStream(1, 2));
  lost.y[lost.size() - 10] = 0.0;
  EXPECT_FALSE(FindTopBeforeFall(lost, 0.18, 0.045, 0.006));
}

// A marker that is seen in the air for a sample, after the fall, is no flight.
TEST(FindTopBeforeFall, TakesNoStraySampleForAFlight) {
  Samples s = Sampled(HopsAndFalls, 0.8, 500, 0.0005, RandomStream(4, 1));
  const auto before = FindTopBeforeFall(s, 0.18, 0.045, 0.003);
  ASSERT_TRUE(before);
  s.y[*before + 130] = 0.3;
  EXPECT_EQ(FindTopBeforeFall(s, 0.18, 0.045, 0.003), before);
}

// All columns end there, and what follows is told.
TEST(FallenBody, EndsItsTrial) {
  MechanismSpec leg;
  leg.gravity_m_per_s2 = kG;
  leg.c_leg.rest_radius_m = 0.09;
  const Dataset recorded =
      OneTrial(leg, Sampled(HopsAndFalls, 0.8, 500, 0.0005, RandomStream(5, 1)));
  const std::vector<TraceFault> faults = FindTraceFaults(recorded);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].kind, TraceFault::Kind::kFall);
  const Trial rest = WithoutFaults(recorded, faults).trials[0];
  EXPECT_EQ(rest.trace.time_s.size(), faults[0].rows.front());
  EXPECT_EQ(rest.trace.columns[0].values.size(), faults[0].rows.front());
  EXPECT_EQ(faults[0].rows.back() + 1, recorded.trials[0].trace.time_s.size());
  EXPECT_NEAR(rest.trace.time_s.back() - 0.3, kTop_s, 0.03);
  const std::vector<std::string> told = FaultSentences(recorded, faults, false);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].substr(0, 38), "the body falls to the ground at the en");
  // Where the simulation is told to go on further down, so does the trial.
  leg.fall_height_m = 0.01;
  EXPECT_TRUE(
      FindTraceFaults(OneTrial(leg, Sampled(HopsAndFalls, 0.8, 500, 0.0005, RandomStream(5, 1))))
          .empty());
}

// A trial whose body goes on in flight from its last row, falls, and comes to lie on the ground.
void LetFall(Trial& trial, RandomStream random) {
  constexpr int kBack = 10;
  Trace& trace = trial.trace;
  const double step = trace.time_s[1] - trace.time_s[0];
  for (TraceColumn& column : trace.columns) {
    std::vector<double>& values = column.values;
    const bool falls = column.name == "body_y_m";
    const double g = falls ? kG : 0.0, last = values.back();
    const double speed = (last - values[values.size() - 1 - kBack]) / (kBack * step);
    for (int k = 1; k <= 300; ++k) {
      const double since = step * k;
      const double flown =
          last + (speed - 0.5 * g * kBack * step) * since - 0.5 * g * since * since;
      values.push_back((falls ? std::max(flown, 0.02) : flown) + 5e-4 * random.Normal());
    }
  }
  while (trace.time_s.size() < trace.columns[0].values.size())
    trace.time_s.push_back(trace.time_s.back() + step);
}

// The rig's drops, two of which end in a fall: the fit is that of the drops without it.
TEST(FallenBody, IsFittedUpToItsLastFlight) {
  const Dataset plain = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/rig-drops");
  Dataset fallen = plain;
  for (std::size_t i = 0; i < 2; ++i) LetFall(fallen.trials[i], RandomStream(9, i));
  const FitProblem problem = MakeProblem(fallen, {});
  ASSERT_EQ(problem.trace_faults.size(), 2U);
  for (const TraceFault& fault : problem.trace_faults)
    EXPECT_EQ(fault.kind, TraceFault::Kind::kFall);
  EXPECT_NE(problem.notes.front().find("falls to the ground"), std::string::npos);
  const auto modulus = [](const Dataset& dataset) {
    return FitDataset(dataset, {}, {}).result.shared[0];
  };
  EXPECT_NEAR(modulus(fallen) / modulus(plain), 1.0, 2e-3);
}

}  // namespace
}  // namespace hoplab
