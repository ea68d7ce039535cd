// Derivatives of a robot's motion against differences: by every effect, and over random sequences
// of events.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "model/effects/effect.h"
#include "model/simulate.h"
#include "tests/support/gradient_check.h"
#include "tests/support/robot_requests.h"

namespace hoplab {
namespace {

using namespace testing;

// Every effect that means something on a robot, off its null, legs and motors one by one.
TEST(Robot, EffectsHaveTheDerivativesOfDifferences) {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->friction = 0.9;
  p.robot->damping = 3e-4;
  p.robot->rotor_inertia = 4e-3;  // slower than a real one: fewer steps
  p.robot->torque_limit = 4.0;
  const SimulationRequest held = RobotDrop(p, {0.0, 0.2, 0.3, -0.2, 0.03, 0.2}, 0.14);
  int columns = 0;
  for (const Effect* effect : AllEffects()) {
    const bool of_clock = effect->info.name.starts_with("gait_");
    if (!AppliesTo(*effect, Law::kRobot, LegMass::kNone, 0, of_clock ? 3 : 2)) continue;
    SimulationRequest q = of_clock ? WalkingDrop(0.14) : held;
    // Teeth hardly move the events: differences of their times see the steps of a coarser run.
    q.integrator.relative_tolerance = 1e-12;
    q.integrator.absolute_tolerance = 1e-13;
    std::array<EffectSetting, 1> effects = {EffectSetting::Null(*effect)};
    std::vector<SensitivityDirection> directions;
    for (std::size_t i = 0; i < effect->info.parameters.size(); ++i) {
      effects[0].values[i] += 0.3 * effect->info.parameters[i].typical;
      directions.push_back(SensitivityDirection::EffectParameter(0, static_cast<int>(i)));
    }
    q.effects = effects;
    const Trajectory run = Simulate(q);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << effect->info.name;
    std::vector<double> rows;
    for (double t = 0.004; t < run.end_time - 0.008; t += 0.011) {
      bool clear = true;
      for (const Event& e : run.events) clear = clear && std::abs(e.time - t) > 3e-3;
      if (clear) rows.push_back(t);
    }
    const std::array channels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyPitch,
                                 Channel::kLegAngle1, Channel::kLegAngle2};
    q.row_times = rows;
    q.channels = channels;
    q.directions = directions;
    bool seen = false;
    for (const ColumnCheck& check : CheckGradient(q)) {
      EXPECT_EQ(Complaint(check), "") << effect->info.name;
      seen = seen || !check.nothing_to_see;
      ++columns;
    }
    EXPECT_TRUE(seen) << effect->info.name;
  }
  EXPECT_GT(columns, 40);
}

// A slippery floor is the floor of that friction, and nothing where it holds whatever the load.
TEST(Robot, ASlipperyFloorIsOneOfLessFriction) {
  for (const double stated : {1.0, 0.9, std::numeric_limits<double>::infinity()}) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->friction = stated;
    SimulationRequest q = RobotDrop(p, {0.0, 0.2, 0.5, -0.2, 0.03, 0.2}, 0.14);
    const auto end_of = [](const SimulationRequest& request) {
      const std::vector<double> z = Simulate(request).final_state;
      return Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size()))
          .eval();
    };
    const Eigen::VectorXd holds = end_of(q);
    std::array<EffectSetting, 1> effects = {
        EffectSetting::Null(*FindEffect("foot_coulomb_friction"))};
    q.effects = effects;
    // Differentiated where it is nothing.
    const std::array at_null = {SensitivityDirection::EffectParameter(0, 0)};
    q.directions = at_null;
    EXPECT_LT((end_of(q) - holds).norm(), 1e-9);
    for (const double slope : Simulate(q).final_sensitivities) {
      EXPECT_TRUE(std::isfinite(slope));
      EXPECT_TRUE(std::isfinite(stated) || slope == 0.0);
    }
    q.directions = {};
    effects[0].values[0] = 1.5;
    const Eigen::VectorXd slips = end_of(q);
    q.effects = {};
    q.parameters.robot->friction = 1.0 / (1.0 / stated + 1.5);
    EXPECT_LT((slips - end_of(q)).norm(), 1e-9);  // the sums round otherwise
    EXPECT_GT((slips - holds).norm(), 1e-3);
  }
}

using D = SensitivityDirection;

std::vector<double> RowsClearOfEvents(const Trajectory& run) {
  std::vector<double> rows;
  for (double t = 0.004; t < run.end_time - 0.002; t += 0.011) {
    bool clear = true;
    for (const Event& e : run.events) clear = clear && std::abs(e.time - t) > 1e-3;
    if (clear) rows.push_back(t);
  }
  return rows;
}

// Random drops of two and three legs, feet that hold or slide, and robots that walk by a clock.
TEST(Robot, DerivativesAreThoseOfDifferencesOverRandomSequences) {
  const std::vector<D> held = {D::Parameter(ParameterId::kE1),
                               D::Parameter(ParameterId::kE2),
                               D::Parameter(ParameterId::kLegDamping),
                               D::Parameter(ParameterId::kR),
                               D::Parameter(ParameterId::kPitchInertia),
                               D::Parameter(ParameterId::kComX),
                               D::Parameter(ParameterId::kMotorKp),
                               D::Parameter(ParameterId::kClamp),
                               D::Parameter(ParameterId::kFriction),
                               D::InitialState(1),
                               D::InitialState(2),
                               D::InitialState(4),
                               D::InitialState(5)};
  double worst = 0.0;
  int columns = 0, sequences = 0;
  std::map<std::string, int> seen;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const bool walks = seed % 5 == 0;
    Parameters<double> p = walks ? Walking() : RobotParametersFor(2 + static_cast<int>(seed % 2));
    p.robot->own_moduli = true;
    for (int i = 0; i < kMaxLegs; ++i) p.robot->E[i] = p.E * (1.0 + 0.1 * i);
    if (seed % 3 != 0) p.robot->friction = 0.5 + 0.1 * seed;
    if (seed % 4 != 0) p.robot->damping = 3e-4;
    p.robot->com_x = 0.004;
    p.robot->clamp = 0.005;
    p.robot->rotor_inertia = 4e-3;  // slower than a real one: fewer steps
    SimulationRequest q =
        walks ? RobotDrop(p, {0.0, 0.2, 0.4, 0.0, 0.02, 0.1}, 0.3) : RandomRobotDrop(p, seed, 0.32);
    std::vector<D> directions = held;
    if (!(p.robot->friction < 1e6))
      std::erase_if(directions, [](const D& d) {
        return d.of == D::Of::kParameter && d.parameter == ParameterId::kFriction;
      });
    if (walks) directions.push_back(D::Parameter(ParameterId::kClockPeriod));
    // Some of them each time, all of them over the seeds.
    std::mt19937 random(seed);
    std::shuffle(directions.begin(), directions.end(), random);
    directions.resize(5);
    const Trajectory run = Simulate(q);
    if (run.outcome != Outcome::kCompleted || run.has_simultaneous_events) continue;
    for (const Event& e : run.events) ++seen[std::string(NameOf(e.kind))];
    const std::vector<double> rows = RowsClearOfEvents(run);
    const std::array channels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyPitch,
                                 Channel::kLegAngle1, Channel::kLegAngle2};
    q.row_times = rows;
    q.channels = channels;
    q.directions = directions;
    ++sequences;
    for (const ColumnCheck& check : CheckGradient(q)) {
      EXPECT_EQ(Complaint(check), "") << "seed " << seed;
      if (!check.nothing_to_see) worst = std::max(worst, check.error);
      ++columns;
    }
  }
  std::printf("derivatives: %d columns of %d sequences, worst %.1e;", columns, sequences, worst);
  for (const auto& [name, count] : seen) std::printf(" %s %d", name.c_str(), count);
  std::printf("\n");
  EXPECT_GE(sequences, 7);
}

}  // namespace
}  // namespace hoplab
