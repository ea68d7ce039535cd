#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "tests/support/gradient_check.h"

namespace hoplab::testing {

/// Every parameter that the run uses, its start, delay and scale of each input.
inline std::vector<SensitivityDirection> Directions(const SimulationRequest& q) {
  std::vector<SensitivityDirection> directions;
  for (ParameterId id : ParametersOf(MechanismOf(q.law))) {
    const bool unused =
        id == ParameterId::kThetaTd || id == ParameterId::kKp || id == ParameterId::kVDes;
    if (!unused) directions.push_back(SensitivityDirection::Parameter(id));
  }
  for (std::size_t i = 0; i < q.initial.size(); ++i)
    directions.push_back(SensitivityDirection::InitialState(static_cast<int>(i)));
  for (std::size_t i = 0; i < q.inputs.size(); ++i) {
    directions.push_back(SensitivityDirection::InputDelay(static_cast<int>(i)));
    directions.push_back(SensitivityDirection::InputScale(static_cast<int>(i)));
  }
  return directions;
}

/// That the derivatives of its rows agree with Richardson differences.
inline void ExpectExact(SimulationRequest q, const std::vector<SensitivityDirection>& directions) {
  q.horizon = 0.9;
  if (q.law != Law::kBall) q.max_hops = 2;
  const double end = Simulate(q).end_time - 0.01;  // changed a little it still lasts so long
  std::vector<double> rows;
  for (double t = 0.0031; t < end; t += 0.0173) rows.push_back(t);
  const std::vector<Channel> channels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVx,
                                         Channel::kBodyVy};
  q.row_times = rows;
  q.channels = channels;
  q.directions = directions;
  const std::vector<ColumnCheck> checks = CheckGradient(q);
  ASSERT_FALSE(checks.empty());
  double worst = 0.0, oracle = 0.0;
  for (const ColumnCheck& check : checks) {
    EXPECT_EQ(Complaint(check), "");
    if (check.nothing_to_see) continue;
    worst = std::max(worst, check.error);
    oracle = std::max(oracle, check.oracle_error);
  }
  std::printf("%zu columns: off by %.1e at most, the differences themselves by %.1e\n",
              checks.size(), worst, oracle);
}

}  // namespace hoplab::testing
