// What a trace shows that no body does, on paths in closed form: free flight, bounces, rest.

#include "fitting/trace_faults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>

#include "base/random.h"
#include "base/units.h"
#include "datasets/read_dataset.h"
#include "fitting/problem.h"
#include "tests/support/fit_cases.h"

namespace hoplab {
namespace {

using testing::SmallDataset;
using Rows = std::vector<std::size_t>;
using Kind = TraceFault::Kind;

constexpr double kSigma = 0.0005;

struct Path {
  std::function<double(double)> height = [](double t) { return 0.3 + 1.5 * t - 4.905 * t * t; };
  double sigma = kSigma;
  std::size_t rows = 300;
  double step = 0.002;
  std::uint64_t seed = 1;
};

// One trial whose heights are those of the path, with noise.
Dataset Recorded(const Path& path) {
  Dataset dataset;
  dataset.channels = {{Channel::kBodyY, kSigma, {}}};
  RandomStream random(5, path.seed);
  Trial trial;
  trial.file = "drop.csv";
  trial.trace.columns = {{"body_y_m", {}}};
  for (std::size_t i = 0; i < path.rows; ++i) {
    const double t = static_cast<double>(i) * path.step;
    trial.trace.time_s.push_back(t);
    trial.trace.columns[0].values.push_back(path.height(t) + path.sigma * random.Normal());
  }
  dataset.trials = {trial};
  return dataset;
}
std::vector<double>& Heights(Dataset& dataset) { return dataset.trials[0].trace.columns[0].values; }

// Meets the ground every 0.2 s at 1 m/s and leaves it as fast.
double Bouncing(double t) {
  const double since = std::fmod(t, 0.2);
  return 0.5 * 9.81 * since * (0.2 - since);
}
// A leg of stiffness that carries from 0.1 to 0.2 s, without and with a force when it touches down.
double Stance(double t, double blow) {
  if (t < 0.1) return 0.2 - 1.5 * (t - 0.1) - 4.905 * (t - 0.1) * (t - 0.1);
  const double w = kPi / 0.1, u = std::min(t, 0.2) - 0.1;
  const double inside = 0.2 - 1.5 / w * std::sin(w * u) + blow * u * (0.1 - u);
  return t < 0.2 ? inside : inside + 1.5 * (t - 0.2) - 4.905 * (t - 0.2) * (t - 0.2);
}

Rows RowsOf(const std::vector<TraceFault>& faults, Kind kind) {
  for (const TraceFault& fault : faults)
    if (fault.kind == kind) return fault.rows;
  return {};
}

TEST(TraceFaults, AreNoneInFlightsBouncesAndStances) {
  const std::vector<std::function<double(double)>> paths = {
      Path().height, Bouncing, [](double t) { return Stance(t, 0.0); },
      [](double t) { return Stance(t, 2.0); }};
  for (std::uint64_t seed = 1; seed <= 25; ++seed)
    for (const auto& height : paths)
      for (const double step : {0.002, 0.008, 0.03})
        EXPECT_TRUE(FindTraceFaults(Recorded({height, kSigma, 300, step, seed})).empty())
            << "seed " << seed << " step " << step;
}

// Flight under gravity and half a sine of stance [s], left at `speed` [m/s].
std::function<double(double)> Hops(double speed, double stance) {
  return [=](double t) {
    const double flight = 2.0 * speed / 9.81, w = kPi / stance;
    const double u = std::fmod(t, flight + stance);
    return u < flight ? 0.3 + speed * u - 4.905 * u * u
                      : 0.3 - speed / w * std::sin(w * (u - flight));
  };
}

// Hops of all kinds, sampled finely and coarsely: a stance is no stray, however few its samples.
TEST(TraceFaults, AreNoneInStancesThatAreSampledCoarsely) {
  for (const double stance : {0.05, 0.1, 0.2})
    for (const double speed : {0.5, 1.0, 2.0})
      for (const double step : {0.002, 0.005, 0.01, 1.0 / 60.0})
        for (const double sigma : {0.0002, 0.0005})
          for (std::uint64_t seed = 1; seed <= 5; ++seed)
            EXPECT_TRUE(
                FindTraceFaults(Recorded({Hops(speed, stance), sigma, 200, step, seed})).empty())
                << stance << ' ' << speed << ' ' << step << ' ' << sigma << ' ' << seed;
}

// Where too many samples are off the motion before them nothing can be told: a grid of 5 mm, and
// 60 samples a second of a motion that changes within three.
TEST(TraceFaults, AreNotLookedForWhereSamplesAreRough) {
  for (const double stance : {0.05, 0.1, 0.15, 0.2})
    for (int i = 0; i <= 20; ++i) {
      const double speed = 0.5 + 0.1 * i;
      Dataset coarse = Recorded({Hops(speed, stance), 0.0});
      for (double& height : Heights(coarse)) height = 0.005 * std::round(height / 0.005);
      EXPECT_TRUE(FindTraceFaults(coarse).empty()) << stance << ' ' << speed;
      for (std::uint64_t seed = 1; seed <= 5; ++seed)
        EXPECT_TRUE(
            FindTraceFaults(Recorded({Hops(speed, stance), 0.001, 300, 1.0 / 60.0, seed})).empty())
            << stance << ' ' << speed << ' ' << seed;
    }
}

TEST(TraceFaults, ABlowJustBeforeTheEndIsNotStray) {
  for (std::size_t rows = 200; rows < 206; ++rows)
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const auto bounce = [](double t) { return t < 0.4 ? 1.0 - 3.0 * t : -0.2 + 3.0 * (t - 0.4); };
      EXPECT_TRUE(FindTraceFaults(Recorded({bounce, kSigma, rows, 0.002, seed})).empty()) << rows;
      EXPECT_TRUE(FindTraceFaults(Recorded({bounce, 0.0, rows, 0.002, seed})).empty()) << rows;
    }
}

// Where the six samples beside it are no smooth motion, by chance, nothing is told.
TEST(TraceFaults, TheFirstAndTheLastSampleMayBeStray) {
  int all = 0, found = 0;
  for (const auto& height : {Path().height, std::function<double(double)>(Bouncing)})
    for (const double off : {0.04, -0.04})
      for (std::uint64_t seed = 1; seed <= 25; ++seed, ++all) {
        Dataset dataset = Recorded({height, kSigma, 250, 0.002, seed});
        Heights(dataset).front() += off;
        Heights(dataset).back() += off;
        const Rows rows = RowsOf(FindTraceFaults(dataset), Kind::kStray);
        if (rows == Rows{0, 249}) ++found;
        for (const std::size_t row : rows) EXPECT_TRUE(row == 0 || row == 249) << row;
      }
  EXPECT_GE(found, 95 * all / 100);
}

// A ball that is returned at half its speed within the first step was faster than it is ever seen;
// no leg returns a body so.
TEST(TraceFaults, ALossyBounceInTheFirstStepIsNotStray) {
  const auto bounce = [](double t) {
    const double since = t - 0.0034;
    return since < 0.0 ? -3.0 * since : 1.5 * since - 4.905 * since * since;
  };
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Dataset dataset = Recorded({bounce, 0.0002, 60, 0.004, seed});
    dataset.trials[0].mechanism.type = MechanismKind::kBall;
    EXPECT_EQ(RowsOf(FindTraceFaults(dataset), Kind::kStray), Rows{}) << seed;
    dataset.trials[0].mechanism.type = MechanismKind::kCLeg;
    EXPECT_EQ(RowsOf(FindTraceFaults(dataset), Kind::kStray), Rows{0}) << seed;
  }
}

// What a tracker shows for a moment after it had lost the body.
TEST(TraceFaults, ARemnantBehindAGapIsFound) {
  Dataset dataset = Recorded({});
  std::vector<double>& heights = Heights(dataset);
  for (std::size_t row = 288; row < 298; ++row) heights[row] = std::nan("");
  EXPECT_TRUE(FindTraceFaults(dataset).empty());
  heights[298] += 0.5;
  heights[299] += 0.5;
  EXPECT_EQ(RowsOf(FindTraceFaults(dataset), Kind::kStray), (Rows{298, 299}));
}

TEST(TraceFaults, AreNoneWhereNoNoiseIs) {
  for (const double step : {0.0005, 0.002, 0.01}) {
    EXPECT_TRUE(FindTraceFaults(Recorded({Bouncing, 0.0, 400, step})).empty());
    EXPECT_TRUE(FindTraceFaults(Recorded({[](double t) { return Stance(t, 2.0); }, 0.0, 400, step}))
                    .empty());
  }
}

TEST(TraceFaults, AStraySampleIsFoundWhereverItLies) {
  for (const std::size_t row : {1, 2, 57, 120, 150, 297, 298}) {
    Dataset dataset = Recorded({Bouncing});
    Heights(dataset)[row] += 0.03;
    const std::vector<TraceFault> faults = FindTraceFaults(dataset);
    ASSERT_EQ(faults.size(), 1U) << row;
    EXPECT_EQ(faults[0].kind, Kind::kStray);
    EXPECT_EQ(faults[0].rows, Rows{row});
    EXPECT_NEAR(faults[0].largest, 0.03, 0.004);
  }
}

// A camera beside a log that is eight times as fast: cells between its pictures are blank, or hold
// the last one.
TEST(TraceFaults, AreFoundInAChannelThatIsSlowerThanItsRows) {
  for (const bool held : {false, true}) {
    Dataset dataset = Recorded({.rows = 2400, .step = 0.0005});
    std::vector<double>& heights = Heights(dataset);
    heights[400] += 0.03;
    for (std::size_t row = 1600; row < heights.size(); ++row) heights[row] -= 0.02;
    for (std::size_t row = 0; row < heights.size(); ++row)
      if (row % 8 != 0) heights[row] = held ? heights[row - 1] : std::nan("");
    EXPECT_EQ(RowsOf(FindTraceFaults(dataset), Kind::kStray), Rows{400}) << held;
    EXPECT_EQ(RowsOf(FindTraceFaults(dataset), Kind::kJump), Rows{1600}) << held;
  }
}

TEST(TraceFaults, ABlowIsNotTakenForAStraySample) {
  // A ball that leaves the ground in another direction than it came, and one that is caught.
  const auto wall = [](double t) { return t < 0.2 ? 3.0 * t : 0.6 - 2.0 * (t - 0.2); };
  const auto caught = [](double t) { return t < 0.2 ? 3.0 * t : 0.6; };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_TRUE(FindTraceFaults(Recorded({wall, kSigma, 300, 0.002, seed})).empty());
    EXPECT_TRUE(FindTraceFaults(Recorded({caught, kSigma, 300, 0.002, seed})).empty());
  }
}

TEST(TraceFaults, SamplesThatStrayOneBesideTheOtherAreAllFound) {
  Dataset dataset = Recorded({});
  const std::vector<double> off = {0.04, -0.02, 0.1, 0.05, -0.03, 0.02};
  Rows expected;
  for (std::size_t i = 0; i < off.size(); ++i) {
    Heights(dataset)[120 + i] += off[i];
    expected.push_back(120 + i);
  }
  for (const std::size_t row : {200, 203}) {  // each in the neighbourhood of the other
    Heights(dataset)[row] += 0.02;
    expected.push_back(row);
  }
  EXPECT_EQ(RowsOf(FindTraceFaults(dataset), Kind::kStray), expected);
}

// Close to one another, so that two are among the six that say how the ball moves, or just before
// or after a bounce, where the motion on one side alone leads past it. Few rows, as of a film.
TEST(TraceFaults, StraySamplesOfAShortFilmAreFoundInPairsAndBesideABounce) {
  for (const Rows& off : {Rows{14, 16}, Rows{14, 15}, Rows{38}, Rows{39}, Rows{42}, Rows{43}}) {
    const Path film{[](double t) { return Bouncing(t + 0.1); }, 0.002, 72, 0.0025};
    Dataset dataset = Recorded(film);
    EXPECT_TRUE(FindTraceFaults(dataset).empty());
    for (const std::size_t row : off) Heights(dataset)[row] += 0.2;
    EXPECT_EQ(RowsOf(FindTraceFaults(dataset), Kind::kStray), off) << off.front();
  }
}

TEST(TraceFaults, AMarkerThatIsTakenForAnotherAndBackIsStray) {
  Dataset dataset = Recorded({});
  Rows expected;
  for (std::size_t row = 80; row < 140; ++row) {
    Heights(dataset)[row] += 0.05;
    expected.push_back(row);
  }
  const std::vector<TraceFault> faults = FindTraceFaults(dataset);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].rows, expected);
}

TEST(TraceFaults, WhatJumpsIsMissingFromThereOn) {
  Dataset dataset = Recorded({});
  for (std::size_t row = 150; row < 300; ++row) Heights(dataset)[row] -= 0.01;
  const std::vector<TraceFault> faults = FindTraceFaults(dataset);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].kind, Kind::kJump);
  EXPECT_EQ(faults[0].rows, Rows{150});
  EXPECT_NEAR(faults[0].largest, 0.01, 0.003);
  Dataset without = WithoutFaults(dataset, faults);
  for (std::size_t row = 0; row < 300; ++row)
    EXPECT_EQ(std::isnan(Heights(without)[row]), row >= 150) << row;
  EXPECT_EQ(FaultSentences(dataset, faults, false),
            std::vector<std::string>{
                "body_y_m jumps by 0.00862 m, in drop.csv at 0.3 s, while the motion goes on, as "
                "where a camera or a marker is moved; what follows is not compared"});
}

TEST(TraceFaults, ASensorThatHoldsItsValueIsFoundByItsDigits) {
  Dataset dataset = Recorded({});
  std::vector<double>& heights = Heights(dataset);
  Rows expected;
  for (std::size_t row = 60; row < 80; ++row) {
    heights[row] = heights[59];
    expected.push_back(row);
  }
  const std::vector<TraceFault> faults = FindTraceFaults(dataset);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].kind, Kind::kHeld);
  EXPECT_EQ(faults[0].rows, expected);
}

// At the lowest place of a stance the body comes back to where the sensor stopped.
TEST(TraceFaults, ASensorThatHoldsAcrossAReversalIsFoundByTheMotionAround) {
  Dataset dataset = Recorded({[](double t) { return Stance(t, 0.0); }, kSigma, 150});
  std::vector<double>& heights = Heights(dataset);
  Rows expected;
  for (std::size_t row = 69; row < 82; ++row) {
    heights[row] = heights[68];
    expected.push_back(row);
  }
  ASSERT_LT(std::abs(heights[82] - heights[68]), 0.004);
  EXPECT_EQ(RowsOf(FindTraceFaults(dataset), Kind::kHeld), expected);
}

// Slow along one axis, fast along the other.
TEST(TraceFaults, ASensorThatHoldsOneChannelHoldsTheOther) {
  constexpr std::size_t kFirst = 150, kEnd = 156;
  const auto held = [&](bool both) {
    Dataset dataset = Recorded({});
    const Dataset slow = Recorded({.height = [](double t) { return 0.02 * t; }, .seed = 3});
    dataset.channels.push_back({Channel::kBodyX, kSigma, {}});
    Trace& trace = dataset.trials[0].trace;
    trace.columns.push_back({"body_x_m", slow.trials[0].trace.columns[0].values});
    for (std::size_t c = both ? 0 : 1; c < 2; ++c)
      for (std::size_t row = kFirst; row < kEnd; ++row)
        trace.columns[c].values[row] = trace.columns[c].values[kFirst - 1];
    std::vector<Channel> channels;
    for (const TraceFault& fault : FindTraceFaults(dataset))
      if (fault.kind == Kind::kHeld) channels.push_back(fault.channel);
    return channels;
  };
  EXPECT_EQ(held(true), (std::vector<Channel>{Channel::kBodyY, Channel::kBodyX}));
  EXPECT_TRUE(held(false).empty());
}

// 2 mm a step of the sensor: slow motion gives equal samples.
TEST(TraceFaults, ACoarseSensorHoldsNothing) {
  Dataset dataset = Recorded({});
  for (double& height : Heights(dataset)) height = 0.002 * std::round(height / 0.002);
  EXPECT_TRUE(FindTraceFaults(dataset).empty());
}

// A thousandth of a degree is no decimal of a radian: some samples are equal by chance.
TEST(TraceFaults, AnAngleWrittenInDegreesHoldsNothing) {
  std::size_t equal = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Dataset dataset = Recorded({[](double t) { return 0.2 - 0.5 * t; }, kSigma, 300, 0.002, seed});
    dataset.channels = {{Channel::kBodyPitch, kSigma, {}}};
    TraceColumn& pitch = dataset.trials[0].trace.columns[0];
    pitch.name = "body_pitch_rad";
    for (double& angle : pitch.values) angle = DegToRad(1e-3 * std::round(1e3 * RadToDeg(angle)));
    for (std::size_t i = 1; i < pitch.values.size(); ++i)
      equal += pitch.values[i] == pitch.values[i - 1] ? 1 : 0;
    EXPECT_TRUE(FindTraceFaults(dataset).empty()) << seed;
  }
  EXPECT_GT(equal, 0U);
}

// Its samples are alike since nothing moves, at first or after a fast fall.
TEST(TraceFaults, ABodyAtRestIsNotHeld) {
  const auto released = [](double t) {
    return t < 0.1 ? 1.0 : 1.0 - 4.905 * (t - 0.1) * (t - 0.1);
  };
  Dataset dataset = Recorded({released, 0.0});
  EXPECT_TRUE(FindTraceFaults(dataset).empty());
  dataset = Recorded({released});
  for (double& height : Heights(dataset)) height = 0.002 * std::round(height / 0.002);
  EXPECT_TRUE(FindTraceFaults(dataset).empty());
  // It sticks where it lands, without noise, and is pulled off later.
  const auto sticks = [&](double t) {
    return t < 0.4 ? 1.0 - 4.905 * t * t : 0.2152 + (t < 0.5 ? 0.0 : 2.0 * (t - 0.5) * (t - 0.5));
  };
  Dataset landed = Recorded({sticks});
  for (std::size_t row = 200; row < 252; ++row) Heights(landed)[row] = 0.2152;
  EXPECT_TRUE(RowsOf(FindTraceFaults(landed), Kind::kHeld).empty());
}

// As a simulated pitch, which nothing turns before the first foot lands.
TEST(TraceFaults, WhatIsExactlyAtRestAtFirstIsNotHeld) {
  const auto rocks = [](double t) { return t < 0.1 ? 0.0 : 0.1 * std::sin(25.0 * (t - 0.1)); };
  const auto swings = [](double t) {
    return t < 0.1 ? 1.0 : 1.0 - 0.05 * (1.0 - std::cos(30.0 * (t - 0.1)));
  };
  EXPECT_TRUE(FindTraceFaults(Recorded({rocks, 0.0})).empty());
  EXPECT_TRUE(FindTraceFaults(Recorded({swings, 0.0})).empty());
}

TEST(TraceFaults, AreToldOnceAChannelAndKind) {
  Dataset dataset = Recorded({});
  Heights(dataset)[50] += 0.02;
  dataset.trials.push_back(Recorded({.seed = 2}).trials[0]);
  dataset.trials[1].file = "other.csv";
  for (const std::size_t row : {20, 90}) dataset.trials[1].trace.columns[0].values[row] -= 0.06;
  const std::vector<TraceFault> faults = FindTraceFaults(dataset);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(FaultSentences(dataset, faults, false),
            std::vector<std::string>{
                "3 samples of body_y_m in 2 trials, first in drop.csv at 0.1 s, lie off the motion "
                "before and after by up to 0.0603 m; they are not compared"});
  EXPECT_EQ(FaultSentences(dataset, {faults[0]}, true),
            std::vector<std::string>{
                "1 sample of body_y_m, in drop.csv at 0.1 s, lies off the "
                "motion before and after by up to 0.0192 m; it is compared all the same"});
}

TEST(TraceFaults, AreNotComparedUnlessAskedFor) {
  Dataset dataset = SmallDataset();
  const long all = MakeProblem(dataset, {}).trials[0].sample_count;
  for (TraceColumn& column : dataset.trials[0].trace.columns)
    if (column.name == "body_y_m") column.values[40] += 0.05;
  const FitProblem without = MakeProblem(dataset, {});
  EXPECT_EQ(without.trials[0].sample_count, all - 1);
  ASSERT_EQ(without.trace_faults.size(), 1U);
  ASSERT_EQ(without.notes.size(), 1U);
  ProblemOptions options;
  options.keep_stray = true;
  const FitProblem with = MakeProblem(dataset, options);
  EXPECT_EQ(with.trials[0].sample_count, all);
  EXPECT_EQ(with.trace_faults.size(), 1U);
}

TEST(TraceFaults, AreNoneInTheDatasetsThatComeAlong) {
  for (const char* name : {"rig-drops", "rig-drops-undamped", "rig-controlled", "robot-drops",
                           "robot-pronk", "robot-walk"})
    EXPECT_TRUE(
        FindTraceFaults(ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/" + name)).empty())
        << name;
}

}  // namespace
}  // namespace hoplab
