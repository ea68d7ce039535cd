#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/support/gradient_check.h"

namespace hoplab::testing {

/// Channels of a robot on two legs that can be differentiated.
inline constexpr std::array kRobotChannels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyPitch,
                                              Channel::kLegAngle1, Channel::kLegAngle2};

/// Rows over a run, none within `apart` [s] of an event, nor of one of `others` [s].
inline std::vector<double> RowsApart(const Trajectory& run, const std::vector<double>& others,
                                     double apart) {
  std::vector<double> rows;
  for (double t = 0.0041; t < run.end_time - 0.004; t += 0.0107) {
    const auto near = [&](double at) { return std::abs(at - t) < apart; };
    if (std::none_of(run.events.begin(), run.events.end(),
                     [&](const Event& e) { return near(e.time); }) &&
        std::none_of(others.begin(), others.end(), near))
      rows.push_back(t);
  }
  return rows;
}

/// That derivatives of rows, final state and events agree with Richardson differences; gives how
/// many columns show something.
inline int ExpectRobotExact(SimulationRequest q, const std::vector<double>& others,
                            const std::vector<SensitivityDirection>& directions,
                            double apart = 1e-3) {
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kCompleted);
  const std::vector<double> rows = RowsApart(run, others, apart);
  q.row_times = rows;
  q.channels = kRobotChannels;
  q.directions = directions;
  int seen = 0;
  for (const ColumnCheck& check : CheckGradient(q)) {
    EXPECT_EQ(Complaint(check), "");
    seen += !check.nothing_to_see;
  }
  return seen;
}

}  // namespace hoplab::testing
