#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/support/robot_energy.h"
#include "tests/support/robot_requests.h"

// The energy of a robot whose legs have mass and nothing dampens, M82 to M92, M98.

namespace hoplab {
namespace {

using namespace testing;

// Between events energy stays. Where a leg lands or leaves it is only lost; rolling to the toe and
// back changes it by parts of the order of the load.
struct EnergyChanges {
  double between = 0.0, gained = 0.0, rolling = 0.0;
  int steps = 0, on_ice = 0;

  void Add(const SimulationRequest& q, double friction) {
    const EnergyRun at = RunWithEnergy(q);
    std::size_t next = 0;
    for (std::size_t i = 1; i < at.energy.size(); ++i) {
      const double change = at.energy[i] - at.energy[i - 1];
      bool lands_or_leaves = false, rolls = false;
      for (; next < at.run.events.size() && at.run.events[next].time < at.times[i]; ++next) {
        const EventKind kind = at.run.events[next].kind;
        lands_or_leaves = lands_or_leaves || kind == EventKind::kTouchdown ||
                          kind == EventKind::kLiftoff || kind == EventKind::kBrush;
        rolls = rolls || kind == EventKind::kRollingToToe || kind == EventKind::kToeToRolling;
      }
      if (rolls) {
        if (!lands_or_leaves) rolling = std::max(rolling, std::abs(change));
      } else if (lands_or_leaves) {
        gained = std::max(gained, change);
      } else {
        between = std::max(between, std::abs(change));
        ++steps;
        on_ice += friction == 0.0 && i > 100 ? 1 : 0;
      }
    }
  }
};

EnergyChanges EnergyChangesWith(double mass) {
  EnergyChanges all;
  for (MotorControl control : {MotorControl::kLocked, MotorControl::kHeld}) {
    for (double friction : {std::numeric_limits<double>::infinity(), 0.0}) {
      for (unsigned seed = 1; seed <= 10; ++seed) {
        Parameters<double> p = RobotParametersFor(2 + static_cast<int>(seed % 2));
        p.robot->leg_mass = mass;
        p.robot->control = control;
        p.robot->motor_kd = 0.0;
        p.robot->clamp = 0.006;
        p.robot->friction = friction;
        all.Add(RandomRobotDrop(p, seed, 1.0), friction);
      }
    }
  }
  std::printf(
      "energy with legs of %.0f g, worst change in 1 ms: %.1e J of 7, %d ms; gained at most %.1e "
      "where legs land or leave, changed by %.1e where they roll to the toe\n",
      1e3 * mass, all.between, all.steps, all.gained, all.rolling);
  return all;
}

TEST(RobotLegMass, EnergyStaysBetweenEventsAndIsOnlyLost) {
  for (double mass : {0.01, 0.08}) {
    const EnergyChanges all = EnergyChangesWith(mass);
    EXPECT_LT(all.between, 1e-9);
    EXPECT_LT(all.gained, 1e-9);
    EXPECT_LT(all.rolling, 0.5 * mass);  // J a kilogram: it goes with the mass
    EXPECT_GT(all.steps, 6000);
    EXPECT_GT(all.on_ice, 1000);
  }
}

}  // namespace
}  // namespace hoplab
