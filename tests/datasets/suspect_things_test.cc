#include "datasets/suspect_things.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/units.h"

namespace hoplab {
namespace {

constexpr double kGravity = 9.81;
constexpr double kStep_s = 0.002;
constexpr double kSigma_m = 0.0005;

// A ball of radius 2 cm that bounces without loss from 0.3 m, sampled with noise.
Dataset Bouncing() {
  Dataset dataset;
  dataset.origin.place = "hops/dataset.yaml";
  dataset.mechanism.type = MechanismKind::kBall;
  dataset.mechanism.body_mass_kg = 1;
  dataset.mechanism.gravity_m_per_s2 = kGravity;
  dataset.mechanism.ball = {0.02, 1, 0};
  dataset.channels = {{Channel::kBodyX, kSigma_m, {"hops/dataset.yaml:10"}},
                      {Channel::kBodyY, kSigma_m, {"hops/dataset.yaml:11"}}};
  for (int i = 0; i < 2; ++i) {
    RandomStream random(7, static_cast<std::uint64_t>(i));
    Trial trial;
    trial.file = i == 0 ? "train.csv" : "test.csv";
    trial.role = i == 0 ? TrialRole::kTrain : TrialRole::kTest;
    trial.origin.place = i == 0 ? "hops/dataset.yaml:13" : "hops/dataset.yaml:17";
    trial.mechanism = dataset.mechanism;
    trial.touchdown_angle_rad = DegToRad(25);
    trial.initial = StateSpec{0, 0.3, 1, 0};
    trial.trace.columns = {{"body_x_m", {}}, {"body_y_m", {}}};
    const double fall_s = std::sqrt(2 * 0.28 / kGravity);
    for (int k = 0; k < 500; ++k) {
      const double time = k * kStep_s;
      const double since_apex = std::remainder(time, 2 * fall_s);
      trial.trace.time_s.push_back(time);
      trial.trace.columns[0].values.push_back(time + kSigma_m * random.Normal());
      trial.trace.columns[1].values.push_back(0.3 - kGravity / 2 * since_apex * since_apex +
                                              kSigma_m * random.Normal());
    }
    dataset.trials.push_back(trial);
  }
  return dataset;
}

using Warnings = std::vector<std::string>;

void Scale(std::vector<double>* values, double factor) {
  for (double& value : *values) value *= factor;
}

TEST(SuspectThings, FindsNothingInAnHonestDataset) {
  EXPECT_EQ(SuspectThings(Bouncing()), Warnings{});
}

TEST(SuspectThings, SeesTimesInMilliseconds) {
  Dataset dataset = Bouncing();
  Scale(&dataset.trials[0].trace.time_s, 1000);
  EXPECT_EQ(SuspectThings(dataset),
            Warnings{"hops/train.csv: time_s spans 998 s in steps of 2 s, which looks like "
                     "milliseconds"});
}

TEST(SuspectThings, SeesMillisecondsByTheFallWhereTheStepIsFine) {
  Dataset dataset = Bouncing();
  Trace& trace = dataset.trials[0].trace;
  Scale(&trace.time_s, 200);  // the same heights sampled at a fifth of a millisecond, as if in ms
  for (double& height : trace.columns[1].values) height = 0.3 - (0.3 - height) / 25;
  const Warnings warnings = SuspectThings(dataset);
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings[0],
            "hops/train.csv: time_s spans 200 s in steps of 0.4 s, which looks like milliseconds");
}

TEST(SuspectThings, SeesHeightsInMillimetres) {
  Dataset dataset = Bouncing();
  for (Trial& trial : dataset.trials) Scale(&trial.trace.columns[1].values, 1000);
  dataset.channels[1].sigma = 0.5;
  const Warnings warnings = SuspectThings(dataset);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("which looks like millimetres"), std::string::npos) << warnings[0];
}

TEST(SuspectThings, SeesAConstantChannel) {
  Dataset dataset = Bouncing();
  for (double& value : dataset.trials[1].trace.columns[0].values) value = 0.25;
  EXPECT_EQ(SuspectThings(dataset),
            Warnings{"hops/test.csv: body_x_m is 0.25 throughout: a constant channel measures "
                     "nothing"});
}

TEST(SuspectThings, SeesASingleSample) {
  Dataset dataset = Bouncing();
  dataset.trials[0].trace = {{0}, {{"body_x_m", {0}}, {"body_y_m", {0.3}}}};
  EXPECT_EQ(SuspectThings(dataset),
            Warnings{"hops/train.csv: has a single sample, which shows no motion"});
}

TEST(SuspectThings, SeesATrialWithoutAnyChannel) {
  Dataset dataset = Bouncing();
  dataset.trials[0].trace = {{0, 0.1}, {{"extra", {0, 1}}}};
  EXPECT_EQ(SuspectThings(dataset),
            Warnings{"hops/train.csv: has no sample of any channel and says nothing"});
}

TEST(SuspectThings, SeesAStartBelowTheTouchdownHeight) {
  Dataset dataset = Bouncing();
  dataset.trials[0].initial->y_m = 0.001;
  EXPECT_EQ(
      SuspectThings(dataset),
      Warnings{"hops/dataset.yaml:13: initial.y_m = 0.001 lies below the touch-down height of "
               "0.02 m; the first row must lie in flight"});
}

TEST(SuspectThings, SeesAFirstRowBelowTheTouchdownHeight) {
  Dataset dataset = Bouncing();
  dataset.trials[0].initial.reset();
  dataset.trials[0].trace.columns[1].values[0] = 0.001;
  EXPECT_EQ(
      SuspectThings(dataset),
      Warnings{"hops/train.csv: body_y_m starts at 0.001, below the touch-down height of 0.02 "
               "m; the first row must lie in flight"});
}

TEST(SuspectThings, SeesATraceThatIsNeverInFlight) {
  Dataset dataset = Bouncing();
  dataset.trials[0].mechanism.ball.radius_m = 0.5;
  EXPECT_EQ(SuspectThings(dataset),
            Warnings{"hops/train.csv: body_y_m never reaches the touch-down height of 0.5 m: the "
                     "trace is never in flight"});
}

TEST(SuspectThings, SeesAnAngleInRadians) {
  Dataset dataset = Bouncing();
  dataset.trials[0].touchdown_angle_rad = DegToRad(0.44);
  EXPECT_EQ(
      SuspectThings(dataset),
      Warnings{"hops/dataset.yaml:13: touchdown_angle_deg = 0.44 looks like radians; in degrees "
               "it would be 25.2"});
}

TEST(SuspectThings, AnAngleOfZeroIsNoRadian) {
  Dataset dataset = Bouncing();
  for (Trial& trial : dataset.trials) trial.touchdown_angle_rad = 0;
  EXPECT_EQ(SuspectThings(dataset), Warnings{});
}

TEST(SuspectThings, SeesAStartThatMovesTheOtherWay) {
  Dataset dataset = Bouncing();
  for (double& x : dataset.trials[1].trace.columns[0].values) x = -x;
  const Warnings warnings = SuspectThings(dataset);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].rfind("hops/dataset.yaml:17: initial.vx_m_per_s = 1, but body_x_m begins "
                              "at -",
                              0),
            0U)
      << warnings[0];
}

TEST(SuspectThings, SeesAStartThatIsThrownUpOtherwise) {
  Dataset dataset = Bouncing();
  dataset.trials[0].initial->vy_m_per_s = 2;
  const Warnings warnings = SuspectThings(dataset);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].rfind("hops/dataset.yaml:13: initial.vy_m_per_s = 2, but body_y_m", 0), 0U)
      << warnings[0];
}

TEST(SuspectThings, SeesASigmaFarAboveTheNoise) {
  Dataset dataset = Bouncing();
  dataset.channels[0].sigma = 0.5;
  const Warnings warnings = SuspectThings(dataset);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].substr(0, 81),
            "hops/dataset.yaml:10: body_x_m: sigma = 0.5 is far above the noise of the traces,");
}

TEST(SuspectThings, SeesASigmaFarBelowTheNoise) {
  Dataset dataset = Bouncing();
  dataset.channels[1].sigma = 5e-6;
  const Warnings warnings = SuspectThings(dataset);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].substr(0, 82),
            "hops/dataset.yaml:11: body_y_m: sigma = 5e-6 is far below the noise of the traces,");
}

TEST(SuspectThings, SeesThatNothingIsHeldOut) {
  Dataset dataset = Bouncing();
  dataset.trials.pop_back();
  EXPECT_EQ(
      SuspectThings(dataset),
      Warnings{"hops/dataset.yaml: no trial has role: test, so nothing is held out to measure a "
               "fit on"});
}

// Of 500 samples the median of the absolute values has a standard error of 5 %; three of them.
constexpr double kNoiseTolerance = 0.15;

TEST(HighFrequencyNoise, MeasuresWhiteNoiseOnAParabola) {
  const Dataset dataset = Bouncing();
  const Trace& trace = dataset.trials[0].trace;
  const double noise = HighFrequencyNoise(trace.time_s, trace.columns[1].values);
  EXPECT_NEAR(noise / kSigma_m, 1, kNoiseTolerance);
}

TEST(HighFrequencyNoise, IsUnknownForAShortTrace) {
  EXPECT_TRUE(std::isnan(HighFrequencyNoise({0, 1, 2}, {0, 1, 2})));
}

TEST(ApparentGravity, IsThatOfAFreeFall) {
  std::vector<double> times, heights;
  for (int k = 0; k < 50; ++k) {
    times.push_back(k * 0.004 + (k % 3) * 0.001);
    heights.push_back(1 - kGravity / 2 * times.back() * times.back());
  }
  // An exact parabola: what is left is rounding over the square of a window of 6 of 50 samples.
  EXPECT_NEAR(ApparentGravity(times, heights), kGravity, 1e-9);
}

TEST(ApparentGravity, IsUnknownForAShortTrace) {
  EXPECT_TRUE(std::isnan(ApparentGravity({0, 1}, {0, 1})));
}

TEST(SuspectThings, ALegThickerThanItsRadiusIsToldInMillimetres) {
  Dataset dataset = Bouncing();
  dataset.mechanism.type = MechanismKind::kCLeg;
  dataset.mechanism.c_leg.rest_radius_m = 0.09;
  dataset.mechanism.c_leg.thickness_m = 0.0022;
  const std::size_t usual = SuspectThings(dataset).size();
  dataset.mechanism.c_leg.thickness_m = 2.2;
  const std::vector<std::string> warnings = SuspectThings(dataset);
  ASSERT_EQ(warnings.size(), usual + 1);
  EXPECT_NE(
      std::find(warnings.begin(), warnings.end(),
                "hops/dataset.yaml: thickness_m = 2.2 is more than the leg's radius; in metres "
                "it may be 0.0022"),
      warnings.end());
}

}  // namespace
}  // namespace hoplab
