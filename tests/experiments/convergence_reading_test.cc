#include "experiments/study/convergence_reading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

using Speed = ConvergenceReading::Speed;
using Entry = ConvergenceReading::Entry;
using Steady = ConvergenceReading::Steady;

// Hops of half a second; speeds at their apexes, lift-offs a tenth of a second before.
SpeedHistory HistoryOf(const std::vector<double>& speeds) {
  SpeedHistory history;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double apex = 0.5 * static_cast<double>(i + 1);
    history.apex.push_back({apex, speeds[i]});
    history.flight.push_back({apex - 0.1, speeds[i]});
    history.hop_mean.push_back({apex, 0.9 * speeds[i]});
  }
  return history;
}

// Passes through the band at the second hop, and stays in it from the fifth.
const std::vector<double> kSpeeds = {0.8, 1.0, 1.1, 1.05, 1.001, 1.0, 1.0, 1.0, 1.0, 1.0};

TEST(ConvergenceReading, AreAllCombinationsOnceTheDefaultFirst) {
  const std::vector<ConvergenceReading> readings = AllConvergenceReadings();
  EXPECT_EQ(readings.size(), 24U);
  EXPECT_EQ(readings.front(), ConvergenceReading());
  EXPECT_EQ(NameOf(readings.front()), "flight,stays,last_five");
  for (const ConvergenceReading& r : readings)
    EXPECT_EQ(std::count(readings.begin(), readings.end(), r), 1) << NameOf(r);
}

TEST(ConvergenceReading, OfApexesThatStayIsTheConvergenceTimeOfTheSheet) {
  const SpeedHistory history = HistoryOf(kSpeeds);
  const ConvergenceTime ours = ConvergenceTimeOf(history, {.speed = Speed::kApex});
  const ConvergenceTime sheet = ConvergenceTimeOf(history.apex);
  EXPECT_EQ(ours.time, sheet.time);
  EXPECT_EQ(ours.hops, sheet.hops);
  EXPECT_EQ(ours.steady_speed, sheet.steady_speed);
  EXPECT_EQ(ours.band, sheet.band);
}

TEST(ConvergenceReading, TellsAFlightByItsLiftoff) {
  EXPECT_DOUBLE_EQ(ConvergenceTimeOf(HistoryOf(kSpeeds), {}).time, 2.4);
}

TEST(ConvergenceReading, TheFirstEntryComesBeforeTheOneThatStays) {
  EXPECT_DOUBLE_EQ(ConvergenceTimeOf(HistoryOf(kSpeeds), {.entry = Entry::kFirst}).time, 0.9);
}

TEST(ConvergenceReading, TheMeanOverAHopIsToldAtItsEnd) {
  EXPECT_DOUBLE_EQ(ConvergenceTimeOf(HistoryOf(kSpeeds), {.speed = Speed::kHopMean}).time, 2.5);
}

TEST(ConvergenceReading, TheBandMayBeAboutTheLastHopOrTheSteadyOne) {
  // The last five hops still drift by 1.6 %.
  const SpeedHistory history = HistoryOf({0.8, 0.982, 0.986, 0.990, 0.994, 0.998});
  EXPECT_EQ(ConvergenceTimeOf(history, {}).band, ConvergenceTime::Band::kOnePercent);
  EXPECT_DOUBLE_EQ(ConvergenceTimeOf(history, {}).steady_speed, 0.99);
  const ConvergenceTime last = ConvergenceTimeOf(history, {.steady = Steady::kLastHop});
  EXPECT_EQ(last.band, ConvergenceTime::Band::kTwoPercent);
  EXPECT_DOUBLE_EQ(last.steady_speed, 0.998);
  const ConvergenceReading fixed{.steady = Steady::kFixedPoint};
  EXPECT_FALSE(ConvergenceTimeOf(history, fixed).converged());  // not known
  EXPECT_FALSE(ConvergenceTimeOf(history, fixed, 1.02).converged());
  EXPECT_DOUBLE_EQ(ConvergenceTimeOf(history, fixed, 0.99).time, 0.9);
}

TEST(ConvergenceReading, OfEveryInstantNeedsTheSpeedToHoldInStanceToo) {
  SpeedHistory history = HistoryOf(kSpeeds);
  for (int i = 0; i <= 50; ++i) {
    const double t = 0.1 * i;
    const bool stands = i % 5 == 3;  // braked by two percent and a half
    history.instant.push_back({t, (t < 2.0 ? 0.9 : 1.0) * (stands ? 0.975 : 1.0)});
  }
  EXPECT_FALSE(ConvergenceTimeOf(history, {.speed = Speed::kInstant}).converged());
  for (ApexSpeed& at : history.instant) at.vx = at.time < 2.0 ? 0.9 : 1.0;
  EXPECT_NEAR(ConvergenceTimeOf(history, {.speed = Speed::kInstant}).time, 2.0, 1e-9);
}

TEST(ConvergenceReading, OfARunWithoutFiveHopsIsNone) {
  for (const ConvergenceReading& reading : AllConvergenceReadings())
    EXPECT_FALSE(ConvergenceTimeOf(HistoryOf({1.0, 1.0, 1.0, 1.0}), reading, 1.0).converged())
        << NameOf(reading);
}

}  // namespace
}  // namespace hoplab
