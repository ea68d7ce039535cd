// Hands before a flight and after it, on paths in closed form: free fall, falls against friction,
// stances.
#include "fitting/handled_ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/random.h"
#include "base/units.h"
#include "datasets/read_dataset.h"
#include "fitting/check.h"
#include "fitting/fit_dataset.h"
#include "fitting/problem.h"
#include "fitting/trace_faults.h"
#include "tests/support/sampled_heights.h"

namespace hoplab {
namespace {

using namespace testing;

double Falling(double since, double acceleration) {
  return since > 0.0 ? -0.5 * acceleration * since * since : 0.0;
}

TEST(FindRelease, FindsWhenABodyThatIsHeldIsLetGo) {
  int found = 0, within = 0, all = 0;
  for (const Sampling& sampling : kSamplings) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      RandomStream random(seed, static_cast<std::uint64_t>(sampling.rate));
      const double release = random.Uniform(0.1, 0.6), moves = random.Uniform(-0.03, 0.03);
      const Samples s =
          Sampled([&](double t) { return 0.3 + moves * t + Falling(t - release, kG); },
                  release + 0.15, sampling.rate, sampling.sigma, random);
      const auto seen = FindRelease(s, sampling.sigma, kG);
      ++all;
      if (!seen) continue;
      ++found;
      within += std::abs(seen->time_s - 0.3 - release) < 2.0 * seen->doubt_s ? 1 : 0;
      EXPECT_LT(seen->doubt_s, 0.01);
      EXPECT_NEAR(seen->time_s - 0.3, release, 0.02);
      EXPECT_NEAR(seen->rise_m, moves * release, 5.0 * sampling.sigma);
      ASSERT_LT(seen->first, s.size());
      EXPECT_GE(s.t[seen->first], seen->time_s);
      EXPECT_LT(s.t[seen->first - 1], seen->time_s);
    }
  }
  EXPECT_EQ(all, 240);
  EXPECT_GE(found, 230);
  EXPECT_NEAR(static_cast<double>(within) / found, 0.95, 0.05);
}

// Falls from the first sample on, thrown up or down, against a counterweight, against air, into a
// stance: whatever the rate and the noise.
TEST(FindRelease, HonestFlightsHaveNone) {
  int all = 0;
  for (const Sampling& sampling : kSamplings) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      RandomStream random(seed, 7 + static_cast<std::uint64_t>(sampling.rate));
      const double speed = random.Uniform(-0.8, 1.2), share = random.Uniform(0.5, 1.0);
      const double drag = random.Uniform(0.0, 3.0), stance = random.Uniform(0.03, 0.12);
      const double lands = random.Uniform(0.01, 0.2);
      const auto path = [&](double t) {
        const double a = share * kG, limit = a / std::max(drag, 1e-3);
        const double fall =
            (speed + limit) * (1.0 - std::exp(-std::max(drag, 1e-3) * t)) / std::max(drag, 1e-3) -
            limit * t;
        if (fall > -lands) return 0.3 + fall;
        return 0.3 - lands + 0.5 * stance * std::sin(2.0 * (fall + lands) / stance);
      };
      const Samples s = Sampled(path, 0.6, sampling.rate, sampling.sigma, random);
      EXPECT_FALSE(FindRelease(s, sampling.sigma, kG).has_value())
          << sampling.rate << " Hz, seed " << seed;
      ++all;
    }
  }
  EXPECT_EQ(all, 600);
}

// A hop, and a hand that takes the body somewhere in its second flight and holds it.
TEST(FindCatch, FindsTheHandAndNoApex) {
  constexpr double kLands = 0.2;
  int found = 0, late = 0;
  for (const Sampling& sampling : kSamplings) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      RandomStream random(seed, 11 + static_cast<std::uint64_t>(sampling.rate));
      const double up = random.Uniform(1.2, 1.6), flight = 2.0 * up / kG;
      const double at = random.Uniform(0.3, 0.9) * flight, soft = random.Uniform(0.005, 0.04);
      const auto free = [&](double t) { return kLands + up * t - 0.5 * kG * t * t; };
      const auto caught = [&](double t) {
        if (t < at) return free(t);
        return free(at) + (up - kG * at) * soft * (1.0 - std::exp(-(t - at) / soft));
      };
      // A stance of 0.1 s before.
      const auto hop = [&](const std::function<double(double)>& path) {
        return [path](double t) {
          return t < 0.1 ? kLands - 0.03 * std::sin(31.4 * t) : path(t - 0.1);
        };
      };
      const Samples s = Sampled(hop(caught), 0.1 + at + 0.5, sampling.rate, sampling.sigma, random);
      const auto first = FindCatch(s, sampling.sigma, kG, kLands);
      if (first) {
        ++found;
        late += s.t[*first] - 0.3 > 0.1 + at ? 1 : 0;
      }
      const Samples cut = Sampled(hop(free), 0.1 + random.Uniform(0.2, 0.8) * flight, sampling.rate,
                                  sampling.sigma, random);
      EXPECT_FALSE(FindCatch(cut, sampling.sigma, kG, kLands).has_value())
          << sampling.rate << " Hz, seed " << seed;
    }
  }
  EXPECT_GE(found, 225);
  EXPECT_EQ(late, 0);
}

// Rest that is none in the air: on the ground with a marker that is 10 mm high, on an upright leg;
// and a body that is let go and caught without a stance.
TEST(FindTraceFaults, RestOnTheGroundIsNoCatchAndAShortFallLeavesItsRows) {
  MechanismSpec ball;
  ball.type = MechanismKind::kBall;
  ball.gravity_m_per_s2 = kG;
  ball.ball.radius_m = 0.02;
  const auto bouncing = [](double t) {
    double speed = 1.4, begin = 0.0;
    while (speed > 0.02 && t > begin + 2.0 * speed / kG) {
      begin += 2.0 * speed / kG;
      speed *= 0.7;
    }
    const double since = std::min(t - begin, 2.0 * speed / kG);
    return 0.03 + speed * since - 0.5 * kG * since * since;
  };
  const Samples rests = Sampled(bouncing, 3.0, 250, 0.0005, RandomStream(1, 1));
  EXPECT_TRUE(FindTraceFaults(OneTrial(ball, rests)).empty());

  MechanismSpec leg;
  leg.gravity_m_per_s2 = kG;
  leg.c_leg.rest_radius_m = 0.09;
  const auto stands = [](double t) {
    const double since = t - 0.159;
    return since < 0.0 ? 0.3 - 0.5 * kG * t * t
                       : 0.176 - 0.039 * std::exp(-8.0 * since) * std::sin(40.0 * since);
  };
  EXPECT_TRUE(FindTraceFaults(OneTrial(leg, Sampled(stands, 1.0, 500, 0.0005, RandomStream(2, 1))))
                  .empty());

  const auto caught = [](double t) {
    return 0.4 - 0.5 * kG * std::pow(std::clamp(t - 0.5, 0.0, 0.12), 2);
  };
  for (const double rate : {500.0, 1000.0, 2000.0}) {
    const Dataset short_fall = OneTrial(leg, Sampled(caught, 1.2, rate, 0.001, RandomStream(3, 1)));
    const std::vector<TraceFault> faults = FindTraceFaults(short_fall);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].kind, TraceFault::Kind::kBeforeRelease);
    const Dataset rest = WithoutFaults(short_fall, faults);
    EXPECT_NEAR(rest.trials[0].trace.time_s.front(), 0.8, 0.01);
    EXPECT_EQ(rest.trials[0].trace.time_s.size(), rest.trials[0].trace.columns[0].values.size());
  }
}

// All columns end where the hand shows, and all that follows is told.
TEST(CaughtBody, EndsItsTrial) {
  MechanismSpec leg;
  leg.gravity_m_per_s2 = kG;
  leg.c_leg.rest_radius_m = 0.09;
  const auto path = [](double t) {
    if (t < 0.1) return 0.18 - 0.04 * std::sin(31.4 * t);
    const double since = std::min(t - 0.1, 0.1);  // caught on its way up
    return 0.18 + 1.3 * since - 0.5 * kG * since * since;
  };
  const Dataset recorded = OneTrial(leg, Sampled(path, 0.6, 500, 0.0005, RandomStream(5, 1)));
  const std::vector<TraceFault> faults = FindTraceFaults(recorded);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].kind, TraceFault::Kind::kAfterCatch);
  const Trial rest = WithoutFaults(recorded, faults).trials[0];
  const std::size_t rows = recorded.trials[0].trace.time_s.size();
  EXPECT_EQ(rest.trace.time_s.size(), faults[0].rows.front());
  EXPECT_EQ(rest.trace.columns[0].values.size(), faults[0].rows.front());
  EXPECT_EQ(faults[0].rows.size(), rows - faults[0].rows.front());
  EXPECT_LT(rest.trace.time_s.back(), 0.3 + 0.2);
  EXPECT_GT(rest.trace.time_s.back(), 0.3 + 0.1);
  const std::vector<std::string> told = FaultSentences(recorded, faults, false);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].substr(0, 30), "the body rests in the air at t");
}

// The same drops with a hand before them, the same fit.
TEST(HeldBody, IsFittedAsIfItsLogBeganAtTheRelease) {
  const Dataset plain = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/rig-drops");
  Dataset held = plain;
  RandomStream random(3, 1);
  for (Trial& trial : held.trials) {
    const std::size_t rows = 40 + static_cast<std::size_t>(random.Uniform(0.0, 100.0));
    const double step = trial.trace.time_s[1] - trial.trace.time_s[0];
    for (TraceColumn& column : trial.trace.columns) {
      std::vector<double> values;
      for (std::size_t i = 0; i < rows; ++i)
        values.push_back(column.values[0] + 5e-4 * random.Normal());
      column.values.insert(column.values.begin(), values.begin(), values.end());
    }
    trial.trace.time_s.clear();
    for (std::size_t i = 0; i < trial.trace.columns[0].values.size(); ++i)
      trial.trace.time_s.push_back(step * static_cast<double>(i));
  }
  const FitProblem problem = MakeProblem(held, {});
  ASSERT_EQ(problem.trace_faults.size(), held.trials.size());
  for (std::size_t i = 0; i < held.trials.size(); ++i) {
    const TraceFault& fault = problem.trace_faults[i];
    EXPECT_EQ(fault.kind, TraceFault::Kind::kBeforeRelease);
    EXPECT_NEAR(static_cast<double>(problem.trials[i].row_times.size()),
                static_cast<double>(plain.trials[i].trace.time_s.size()), 3.0);
    // What is stated is moved on to the first row.
    const double since = problem.trials[i].begin_s - fault.release.time_s;
    EXPECT_NEAR(problem.trials[i].start[3], held.trials[i].initial->vy_m_per_s - kG * since, 1e-12);
  }
  EXPECT_EQ(problem.notes.front().substr(0, 22), "the body is held until");
  const auto modulus = [](const Dataset& dataset) {
    return FitDataset(dataset, {}, {}).result.shared[0];
  };
  EXPECT_NEAR(modulus(held) / modulus(plain), 1.0, 2e-3);
  ProblemOptions keep;
  keep.keep_stray = true;
  EXPECT_EQ(MakeProblem(held, keep).trials[0].row_times.size(), held.trials[0].trace.time_s.size());
}

// A log that is switched on while the leg stands: the first trials of the rig, from their lowest
// point on.
TEST(RecordFromAStance, BeginsAtTheTopOfItsFirstFlight) {
  const Dataset plain = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/rig-drops");
  Dataset late = plain;
  for (std::size_t i = 0; i < 2; ++i) {
    Trace& trace = late.trials[i].trace;
    const std::vector<double>& y = *trace.Find(Channel::kBodyY);
    const auto landed = std::min_element(y.begin(), y.begin() + 150) - y.begin();
    for (TraceColumn& column : trace.columns)
      column.values.erase(column.values.begin(), column.values.begin() + landed);
    trace.time_s.erase(trace.time_s.begin(), trace.time_s.begin() + landed);
  }
  const FitProblem problem = MakeProblem(late, {});
  ASSERT_EQ(problem.trace_faults.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const TrialProblem& trial = problem.trials[i];
    EXPECT_EQ(problem.trace_faults[i].kind, TraceFault::Kind::kBeforeFlight);
    EXPECT_NEAR(trial.start[3], 0.0, 0.15);  // at the top, but for noise
    EXPECT_TRUE(std::isinf(trial.own[1].prior_sigma));
  }
  EXPECT_NE(problem.notes.front().find("begins in a stance"), std::string::npos);
  EXPECT_TRUE(DataWarnings(late, problem).empty()) << DataWarnings(late, problem)[0];
  const auto modulus = [](const Dataset& dataset) {
    return FitDataset(dataset, {}, {}).result.shared[0];
  };
  EXPECT_NEAR(modulus(late) / modulus(plain), 1.0, 1e-2);
  ProblemOptions keep;
  keep.keep_stray = true;
  EXPECT_NE(DataWarnings(late, MakeProblem(late, keep))[0].find("must lie in flight"),
            std::string::npos);
  EXPECT_EQ(MakeProblem(late, keep).trials[0].row_times.size(), late.trials[0].trace.time_s.size());
}

// From late in a stance on, where the body is a little below its landing height: that is no flight
// if no start in flight is stated.
TEST(RecordFromAStance, IsSeenLateInItWhereNoFlightIsStated) {
  const Dataset plain = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/rig-drops");
  Dataset late = plain;
  Trial& trial = late.trials[0];
  const double lands = TouchdownHeight(trial.mechanism, trial.touchdown_angle_rad);
  const std::vector<double>& y = *trial.trace.Find(Channel::kBodyY);
  auto row = std::min_element(y.begin(), y.begin() + 150) - y.begin();
  while (y[static_cast<std::size_t>(row)] < lands - 0.006) ++row;
  for (TraceColumn& column : trial.trace.columns)
    column.values.erase(column.values.begin(), column.values.begin() + row);
  trial.trace.time_s.erase(trial.trace.time_s.begin(), trial.trace.time_s.begin() + row);
  EXPECT_TRUE(MakeProblem(late, {}).trace_faults.empty());  // it is said to begin in flight
  trial.initial.reset();
  trial.initial_sigma.reset();
  const FitProblem problem = MakeProblem(late, {});
  ASSERT_EQ(problem.trace_faults.size(), 1U);
  EXPECT_EQ(problem.trace_faults[0].kind, TraceFault::Kind::kBeforeFlight);
  EXPECT_NEAR(problem.trials[0].start[3], 0.0, 0.15);
}

TEST(FindTopAfterStance, SaysNothingOfFlightsAndOfWhatNeverFlies) {
  Samples s;
  for (int i = 0; i < 100; ++i) {
    s.t.push_back(0.002 * i);
    s.y.push_back(0.15 + 0.02 * std::sin(0.1 * i));
    s.row.push_back(static_cast<std::size_t>(i));
  }
  EXPECT_FALSE(FindTopAfterStance(s, true, 0.18, 0.001, 10));  // stays on the ground
  // 10 mm below: where it lands is not known so well.
  EXPECT_FALSE(FindTopAfterStance(s, true, 0.16, 0.001, 10));
  EXPECT_FALSE(FindTopAfterStance(s, true, 0.168, 0.001, 95));  // too little is left
  const auto top = FindTopAfterStance(s, true, 0.168, 0.001, 10);
  ASSERT_TRUE(top);
  EXPECT_EQ(*top, 16U);
}

TEST(FindTopAfterStance, SeesAStanceByItsDepthWhereTheRecordBeginsAtItsStart) {
  Samples s;
  for (int i = 0; i < 100; ++i) {
    s.t.push_back(0.002 * i);
    s.y.push_back(0.15 - 0.02 * std::sin(0.1 * i));  // 5 mm below, 25 mm later
    s.row.push_back(static_cast<std::size_t>(i));
  }
  const auto top = FindTopAfterStance(s, true, 0.155, 0.001, 10);
  ASSERT_TRUE(top);
  EXPECT_EQ(*top, 47U);
  EXPECT_FALSE(FindTopAfterStance(s, true, 0.152, 0.001, 10));  // 2 mm: it may be landing
  EXPECT_FALSE(FindTopAfterStance(s, false, 0.1515, 0.001, 10));
  EXPECT_TRUE(FindTopAfterStance(s, false, 0.1525, 0.001, 10));  // no start in flight is stated
}

}  // namespace
}  // namespace hoplab
