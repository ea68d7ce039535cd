#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/robot_columns.h"
#include "tests/support/robot_requests.h"
#include "tests/support/robot_rods.h"
#include "tests/support/tolerances.h"

// Legs of a robot that get stiffer or softer as time goes on: E (1 + gamma_E t).

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

constexpr double kDrift = 0.4;  // 1/s

Parameters<double> Arcs(double leg_mass, double compliance) {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->friction = 0.9;
  p.robot->damping = 3e-4;
  p.robot->rotor_inertia = 4e-3;
  p.robot->leg_mass = leg_mass;
  p.robot->ground_compliance = compliance;
  return p;
}
Parameters<double> Rods() {
  Parameters<double> p = RodParametersFor(2);
  p.robot->friction = 0.9;
  p.robot->damping = 3e-4;
  p.robot->rotor_inertia = 4e-3;
  return p;
}

SimulationRequest Drop(const Parameters<double>& p, double horizon) {
  SimulationRequest q =
      p.robot->straight_legs ? RandomRodDrop(p, 2, horizon) : RandomRobotDrop(p, 2, horizon);
  q.integrator.relative_tolerance = kOracleRelative;
  // Errors of a leg's own rate count by what they move the leg (ErrorUnit).
  q.integrator.absolute_tolerance = (p.robot->leg_mass > 0.0 ? 1e-2 : 1.0) * kOracleAbsolute;
  return q;
}

bool Stands(const Trajectory& run) {
  return std::any_of(run.final_feet.begin(), run.final_feet.end(),
                     [](const Foot& foot) { return foot.stance != Foot::Stance::kFlight; });
}

// At any instant legs that drift accelerate the robot as legs of that stiffness do.
TEST(RobotStiffnessDrift, IsTheStiffnessOfThatInstant) {
  for (const Parameters<double>& p : {Arcs(0.0, 0.0), Arcs(0.0, 1e-5), Rods()}) {
    int standing = 0;
    for (double t = 0.06; t < 0.2; t += 0.01) {
      SimulationRequest q = Drop(p, t);
      const std::array effects = {EffectOf("stiffness_drift", kDrift)};
      q.effects = effects;
      const Trajectory drifts = Simulate(q);
      ASSERT_EQ(drifts.outcome, Outcome::kCompleted);
      if (!Stands(drifts)) continue;
      ++standing;
      q.effects = {};
      q.initial = drifts.final_state;
      q.feet = drifts.final_feet;
      q.horizon = 1e-9;
      const double share = 1.0 + kDrift * t;
      q.parameters.E *= share;
      for (double& E : q.parameters.robot->E) E *= share;
      q.parameters.k *= share;
      q.parameters.robot->lateral_stiffness *= share;
      const Trajectory as_stiff = Simulate(q);
      for (std::size_t k = 0; k < drifts.final_rate.size(); ++k)
        EXPECT_NEAR(drifts.final_rate[k], as_stiff.final_rate[k],
                    1e-5 * std::max(1.0, std::abs(drifts.final_rate[k])))
            << k << " at " << t;
    }
    EXPECT_GE(standing, 4);
  }
}

// A run that begins later in the trial begins with stiffer legs that drift by less of that.
TEST(RobotStiffnessDrift, CountsFromTheFirstRowOfTheTrial) {
  for (const Parameters<double>& p : {Arcs(0.0, 0.0), Arcs(0.01, 1e-5), Rods()}) {
    const double later = 0.5, grown = 1.0 + kDrift * later;
    SimulationRequest q = Drop(p, 0.25);
    const std::array effects = {EffectOf("stiffness_drift", kDrift)};
    q.effects = effects;
    const Trajectory first = Simulate(q);
    q.parameters.time_origin = later;
    const Trajectory second = Simulate(q);
    q.parameters.time_origin = 0.0;
    q.parameters.E *= grown;
    for (double& E : q.parameters.robot->E) E *= grown;
    q.parameters.k *= grown;
    q.parameters.robot->lateral_stiffness *= grown;
    const std::array less = {EffectOf("stiffness_drift", kDrift / grown)};
    q.effects = less;
    const Trajectory same = Simulate(q);
    ASSERT_EQ(second.outcome, Outcome::kCompleted);
    ASSERT_EQ(second.final_state.size(), same.final_state.size());
    for (std::size_t k = 0; k < same.final_state.size(); ++k)
      EXPECT_NEAR(second.final_state[k], same.final_state[k], 1e-9) << k;
    EXPECT_GT(std::abs(second.final_state[1] - first.final_state[1]), 1e-4);
  }
}

TEST(RobotStiffnessDrift, HasTheDerivativesOfDifferences) {
  for (const Parameters<double>& p : {Arcs(0.0, 1e-5), Arcs(0.01, 0.0), Rods()}) {
    for (const double size : {0.0, kDrift}) {
      SimulationRequest q = Drop(p, 0.2);
      const std::array effects = {EffectOf("stiffness_drift", size)};
      q.effects = effects;
      const ParameterId stiffness =
          p.robot->straight_legs ? ParameterId::kStiffness : ParameterId::kE;
      EXPECT_GE(ExpectRobotExact(q, {},
                                 {D::EffectParameter(0, 0), D::Parameter(stiffness),
                                  D::Parameter(ParameterId::kLegDamping), D::InitialState(1)}),
                6)
          << size;
    }
  }
}

}  // namespace
}  // namespace hoplab
