#include <gtest/gtest.h>

#include "model/hybrid/engine.h"
#include "tests/support/piecewise_linear.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;

// Half a unit of the last printed digit.
constexpr double kPrinted = 0.5e-10;

// x(0.125), d x(0.125)/d slope_a.
struct Result {
  double x[2], d[2];
  std::vector<Event> events;
};

Result SwitchedRun(const IntegratorOptions& options) {
  using T = Jet<kNarrowJet>;
  PiecewiseLinear<T> system;
  PiecewiseLinear<double> values;
  PiecewiseLinear<Jet<1>> rates;
  system.slope_a = Seeded<T>(2.75, 0, 1.0);
  RowReader<T> no_rows;
  Trajectory out;
  Engine<T> engine({system, values, rates}, options, {.horizon = 0.125}, no_rows, out);
  const T z0[2] = {T(0.0), T(1.0)};
  engine.Run(Mode::kRolling, z0);
  const T* z = engine.final_state();
  return {{Value(z[0]), Value(z[1])}, {Slope(z[0], 0), Slope(z[1], 0)}, out.events};
}

TEST(SwitchedLinearSystem, StateMatchesThePublishedDigits) {
  const Result r =
      SwitchedRun({.relative_tolerance = kOracleRelative, .absolute_tolerance = kOracleAbsolute});
  EXPECT_NEAR(r.x[0], -0.3161266570, kPrinted);
  EXPECT_NEAR(r.x[1], -0.2381449819, kPrinted);
  ASSERT_FALSE(r.events.empty());
  for (const Event& e : r.events) EXPECT_EQ(e.kind, EventKind::kSwitch);
}

TEST(SwitchedLinearSystem, DerivativeByTheSwitchingSlopeMatchesThePublishedDigits) {
  const Result r =
      SwitchedRun({.relative_tolerance = kOracleRelative, .absolute_tolerance = kOracleAbsolute});
  EXPECT_NEAR(r.d[0], -0.1027231879, kPrinted);
  EXPECT_NEAR(r.d[1], 0.0703041416, kPrinted);
}

TEST(SwitchedLinearSystem, SwitchesLieOnTheirLines) {
  const Result r =
      SwitchedRun({.relative_tolerance = kOracleRelative, .absolute_tolerance = kOracleAbsolute});
  for (const Event& e : r.events) {
    const double slope = e.mode_before == Mode::kRolling ? 2.75 : 0.36;
    EXPECT_NEAR(e.y - slope * e.x, 0.0, kEventResidual);
  }
}

TEST(SwitchedLinearSystem, ErkStepGivesTheSameDerivative) {
  const Result r = SwitchedRun(
      {.kind = IntegratorKind::kErkStep, .relative_tolerance = 1e-12, .absolute_tolerance = 1e-13});
  EXPECT_NEAR(r.d[0], -0.1027231879, 1e-9);
  EXPECT_NEAR(r.d[1], 0.0703041416, 1e-9);
}

TEST(SwitchedLinearSystem, CvodesGivesTheSameDerivative) {
  // Backward differentiation errs by about the tolerance per step, over some 1000 steps here.
  const Result r = SwitchedRun(
      {.kind = IntegratorKind::kCvodes, .relative_tolerance = 1e-11, .absolute_tolerance = 1e-12});
  EXPECT_NEAR(r.d[0], -0.1027231879, 1e-7);
  EXPECT_NEAR(r.d[1], 0.0703041416, 1e-7);
}

}  // namespace
}  // namespace hoplab
