// M23 on series whose convergence time is known by construction.
#include "optimize/convergence_time.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hoplab {
namespace {

using Band = ConvergenceTime::Band;

// Apexes every 0.4 s.
std::vector<ApexSpeed> Series(const std::vector<double>& speeds) {
  std::vector<ApexSpeed> apexes;
  for (std::size_t i = 0; i < speeds.size(); ++i)
    apexes.push_back({0.4 * static_cast<double>(i + 1), speeds[i]});
  return apexes;
}

TEST(ConvergenceTime, IsTheFirstApexFromWhichAllLieInTheBand) {
  const ConvergenceTime t =
      ConvergenceTimeOf(Series({1.0, 1.5, 1.97, 2.01, 1.99, 2.0, 2.0, 2.0, 2.0, 2.0}));
  EXPECT_EQ(t.band, Band::kOnePercent);
  EXPECT_DOUBLE_EQ(t.time, 1.6);
  EXPECT_EQ(t.hops, 4);
  EXPECT_DOUBLE_EQ(t.steady_speed, 2.0);
}

TEST(ConvergenceTime, AnApexThatLeavesTheBandLaterStartsItAgain) {
  const ConvergenceTime t =
      ConvergenceTimeOf(Series({2.0, 2.0, 2.03, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0}));
  EXPECT_EQ(t.hops, 4);
}

TEST(ConvergenceTime, TheSeriesThatIsSteadyFromTheStartConvergesAtItsFirstApex) {
  const ConvergenceTime t = ConvergenceTimeOf(Series({2.0, 2.0, 2.0, 2.0, 2.0}));
  EXPECT_EQ(t.hops, 1);
  EXPECT_DOUBLE_EQ(t.time, 0.4);
}

TEST(ConvergenceTime, WhatOscillatesByOneAndAHalfPercentHasTheAsterisk) {
  const ConvergenceTime t =
      ConvergenceTimeOf(Series({1.0, 2.05, 2.03, 1.97, 2.03, 1.97, 2.03, 1.97, 2.03}));
  EXPECT_EQ(t.band, Band::kTwoPercent);
  EXPECT_EQ(t.hops, 3);
}

TEST(ConvergenceTime, WhatOscillatesByThreePercentDoesNotConverge) {
  const ConvergenceTime t =
      ConvergenceTimeOf(Series({1.94, 2.06, 1.94, 2.06, 1.94, 2.06, 1.94, 2.06}));
  EXPECT_EQ(t.band, Band::kNone);
  EXPECT_TRUE(std::isnan(t.time));
  EXPECT_EQ(t.hops, -1);
  EXPECT_NEAR(t.spread, 0.03, 0.01);
}

TEST(ConvergenceTime, FewerThanFiveApexesSayNothing) {
  const ConvergenceTime t = ConvergenceTimeOf(Series({2.0, 2.0, 2.0, 2.0}));
  EXPECT_EQ(t.band, Band::kNone);
  EXPECT_TRUE(std::isnan(t.steady_speed));
}

TEST(ConvergenceTime, BackwardHoppingConvergesAsForwardDoes) {
  const ConvergenceTime t = ConvergenceTimeOf(Series({-1.0, -2.0, -2.0, -2.0, -2.0, -2.0}));
  EXPECT_EQ(t.hops, 2);
}

TEST(ConvergenceTime, OfAGeometricApproachItIsTheClosedForm) {
  // vx = 2 (1 - 0.5 rho^n): within 1 % from n = ceil(ln(0.01/0.5)/ln(rho)) on.
  for (const double rho : {0.5, 0.7, 0.9}) {
    std::vector<double> speeds;
    for (int n = 1; n <= 200; ++n) speeds.push_back(2.0 * (1.0 - 0.5 * std::pow(rho, n)));
    const ConvergenceTime t = ConvergenceTimeOf(Series(speeds));
    EXPECT_EQ(t.hops, static_cast<int>(std::ceil(std::log(0.02) / std::log(rho)))) << rho;
  }
}

}  // namespace
}  // namespace hoplab
