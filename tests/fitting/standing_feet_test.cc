#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "datasets/read_dataset.h"
#include "datasets/suspect_things.h"
#include "fitting/fit_dataset.h"

// Records of a robot that begin with feet on the ground, M119.

namespace hoplab {
namespace {

constexpr double kBegin_s = 0.36, kLong_s = 0.45;

// Value and slope of the line through the rows within 10 ms of one.
struct Line {
  double value = 0.0, slope = 0.0;
};
Line LineAt(const Trace& trace, Channel channel, std::size_t row) {
  const std::vector<double>& y = *trace.Find(channel);
  std::vector<double> t, v;
  for (std::size_t i = row - 5; i <= row + 5; ++i) {
    t.push_back(trace.time_s[i] - trace.time_s[row]);
    v.push_back(y[i]);
  }
  double mean = 0.0;
  for (double value : v) mean += value / static_cast<double>(v.size());
  return {mean, MedianSlope(t, v)};
}

// The engine's walk from mid-stride on: as one who switches the log on then would state it.
Dataset WalkFromMidStride() {
  Dataset walk = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/robot-walk");
  walk.trials.erase(walk.trials.begin() + 2, walk.trials.begin() + 5);
  for (Trial& trial : walk.trials) {
    Trace& trace = trial.trace;
    const auto at = [&](double time) {
      return std::lower_bound(trace.time_s.begin(), trace.time_s.end(), time) -
             trace.time_s.begin();
    };
    const auto begin = at(kBegin_s), end = at(kBegin_s + kLong_s);
    const auto row = static_cast<std::size_t>(begin);
    const Line x = LineAt(trace, Channel::kBodyX, row), y = LineAt(trace, Channel::kBodyY, row),
               pitch = LineAt(trace, Channel::kBodyPitch, row);
    trial.initial->x_m = x.value;
    trial.initial->y_m = y.value;
    trial.initial->vx_m_per_s = x.slope;
    trial.initial->vy_m_per_s = y.slope;
    trial.initial->pitch_rad = pitch.value;
    trial.initial->pitch_rate_rad_per_s = pitch.slope;
    MotorsSpec& motors = *trial.controller->motors;
    for (double& phase : motors.phases) phase += trace.time_s[row] / motors.period_s;
    for (TraceColumn& column : trace.columns)
      column.values = {column.values.begin() + begin, column.values.begin() + end};
    trace.time_s = {trace.time_s.begin() + begin, trace.time_s.begin() + end};
  }
  return walk;
}

// The engine had E I 5.6565 N m^2 in each leg, I 1.8355e-10 m^4, and 400 us.
TEST(StandingFeet, AreFittedWhereARecordBeginsInMidStride) {
  const DatasetFit fit = FitDataset(WalkFromMidStride(), {}, {});
  EXPECT_TRUE(fit.result.stop.IsMinimum());
  const std::vector<std::string> names = fit.problem.shared_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double value = fit.result.shared[static_cast<Eigen::Index>(i)];
    std::printf("%s %.4g\n", names[i].c_str(), value);
    if (names[i] == "leg_damping")
      EXPECT_NEAR(value, 4e-4, 6e-5);
    else
      EXPECT_NEAR(value, 30.82e9, 0.03 * 30.82e9) << names[i];
  }
  double ahead = 0.0;
  for (std::size_t i = 0; i < fit.result.initial_states.size(); ++i) {
    const TrialProblem& trial = fit.problem.trials[i];
    for (int k = 0; k < trial.own_count(); ++k)
      if (trial.own[static_cast<std::size_t>(k)].name.starts_with("foot_ahead"))
        ahead = std::max(ahead, std::abs(fit.result.initial_states[i][k]));
  }
  std::printf("foot ahead by %.1f mm\n", 1e3 * ahead);
  EXPECT_GT(ahead, 1e-3);
}

TEST(StandingFeet, AreToldOfTheTrialsThatHaveThem) {
  const FitProblem problem = MakeProblem(WalkFromMidStride(), {});
  ASSERT_FALSE(problem.notes.empty());
  EXPECT_EQ(problem.notes.back().find(
                "3 trials begin with a foot on the ground (train-1.csv, ...): how far"),
            0U)
      << problem.notes.back();
  const FitProblem whole =
      MakeProblem(ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/robot-walk"), {});
  for (const TrialProblem& trial : whole.trials) EXPECT_EQ(trial.own_count(), 6) << trial.file;
}

}  // namespace
}  // namespace hoplab
