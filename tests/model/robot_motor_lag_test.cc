#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/support/gradient_check.h"
#include "tests/support/robot_requests.h"

// Motors that follow what they are told after a while, M86.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

constexpr double kPeriod = 0.4, kDuty = 0.6, kSweep = 0.8;

Parameters<double> ClockedParameters(double leg_mass = 0.0) {
  Parameters<double> p = RobotParametersFor(2);
  RobotParameters<double>& robot = *p.robot;
  robot.control = MotorControl::kClock;
  robot.period = kPeriod;
  robot.duty = kDuty;
  robot.sweep = kSweep;
  robot.offset = 0.3;
  robot.phase = {0.0, 0.0, 0.0, 0.0};
  robot.friction = 1.0;
  robot.damping = 3e-4;
  robot.leg_mass = leg_mass;
  return p;
}

SimulationRequest WithLag(const Parameters<double>& p, double lag, double height, double horizon,
                          std::array<EffectSetting, 1>& effects) {
  effects = {EffectSetting::Null(*FindEffect("motor_lag"))};
  effects[0].values[0] = lag;
  SimulationRequest q = RobotDrop(p, {0.0, height, 0.3, 0.0, 0.02, 0.1}, horizon);
  q.effects = effects;
  return q;
}

// In the air a motor is a linear system of its angle, its rate and its torque; the clock's corner
// kicks it off its reference. Closed form by the eigenvalues of that system.
TEST(MotorLag, IsALinearSystemInTheAir) {
  const Parameters<double> p = ClockedParameters();
  const RobotParameters<double>& robot = *p.robot;
  const double corner = kDuty * kPeriod;
  const double slow = -kSweep / corner;
  const double fast = -(2.0 * std::numbers::pi - kSweep) / ((1.0 - kDuty) * kPeriod);
  for (const double lag : {0.5e-3, 3e-3, 0.02}) {
    Eigen::Matrix3d A;
    A << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 / robot.rotor_inertia, -robot.motor_kp / lag,
        -robot.motor_kd / lag, -1.0 / lag;
    const Eigen::EigenSolver<Eigen::Matrix3d> modes(A);
    const Eigen::Vector3cd share = modes.eigenvectors().partialPivLu().solve(
        Eigen::Vector3d(0.0, slow - fast, 0.0).cast<std::complex<double>>());
    for (const double after : {0.004, 0.02}) {
      std::array<EffectSetting, 1> effects;
      const Trajectory run = Simulate(WithLag(p, lag, 2.0, corner + after, effects));
      ASSERT_EQ(run.outcome, Outcome::kCompleted);
      const Eigen::Vector3d off =
          (modes.eigenvectors() *
           (modes.eigenvalues() * after).array().exp().matrix().asDiagonal() * share)
              .real();
      const double reference = robot.offset - 0.5 * kSweep + fast * after;
      EXPECT_NEAR(run.final_state[6], reference + off[0], 1e-8) << lag;
      EXPECT_NEAR(run.final_state[8], fast + off[1], 1e-6) << lag;
      ASSERT_EQ(run.final_state.size(), 14u);
      EXPECT_NEAR(run.final_state[12], off[2], 1e-6) << lag;
    }
  }
}

// Its first order and its own state meet where one gives way to the other.
TEST(MotorLag, AShortOneGoesOverIntoALongOne) {
  for (const double leg_mass : {0.0, 0.01}) {
    const Parameters<double> p = ClockedParameters(leg_mass);
    std::array<EffectSetting, 1> effects;
    const Trajectory none = Simulate(WithLag(p, 0.0, 0.2, 0.35, effects));
    const Trajectory brief = Simulate(WithLag(p, 0.9999e-5, 0.2, 0.35, effects));
    const Trajectory state = Simulate(WithLag(p, 1.0001e-5, 0.2, 0.35, effects));
    ASSERT_EQ(none.outcome, Outcome::kCompleted);
    ASSERT_EQ(none.final_state.size() + 2, state.final_state.size());
    double moved = 0.0;
    for (std::size_t i = 0; i < 10; ++i) {
      const double change = std::abs(state.final_state[i] - none.final_state[i]);
      moved = std::max(moved, change);
      EXPECT_NEAR(brief.final_state[i], state.final_state[i], 2e-5 + 0.02 * change) << i;
    }
    EXPECT_GT(moved, 1e-4) << leg_mass;  // it does something
  }
}

// At null, from above: against extrapolated differences, over corners of the clock, landings and
// feet that slide; with and without mass of the legs.
TEST(MotorLag, HasItsDerivativeAtNull) {
  for (const double leg_mass : {0.0, 0.01}) {
    const Parameters<double> p = ClockedParameters(leg_mass);
    std::array<EffectSetting, 1> effects;
    SimulationRequest q = WithLag(p, 0.0, 0.2, 0.3, effects);
    const std::array directions = {D::EffectParameter(0, 0)};
    q.directions = directions;
    const Trajectory exact = Simulate(q);
    ASSERT_EQ(exact.outcome, Outcome::kCompleted);
    const auto at = [&](double lag) {
      std::array<EffectSetting, 1> with;
      return Simulate(WithLag(p, lag, 0.2, 0.3, with)).final_state;
    };
    // One-sided: four steps take its curvature out.
    const double h = 1.2e-5;
    const std::vector<double> f0 = at(0.0);
    std::array<std::vector<double>, 4> f;
    for (int k = 0; k < 4; ++k) f[k] = at(std::ldexp(h, k));
    double size = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < 10; ++i) {
      std::array<double, 4> d;
      for (int k = 0; k < 4; ++k) d[k] = (f[k][i] - f0[i]) / std::ldexp(h, k);
      for (int order = 1; order < 4; ++order) {
        const double power = std::ldexp(1.0, order);
        for (int k = 0; k + order < 4; ++k) d[k] = (power * d[k] - d[k + 1]) / (power - 1.0);
      }
      size = std::max(size, std::abs(d[0]));
      worst = std::max(worst, std::abs(exact.final_sensitivities[i] - d[0]));
    }
    std::printf("  legs of %.3f kg: derivative at null off by %.1e of %.1e\n", leg_mass, worst,
                size);
    EXPECT_LT(worst, 1e-5 * size) << leg_mass;
  }
}

}  // namespace
}  // namespace hoplab
