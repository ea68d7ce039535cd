#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <string>

#include "base/units.h"
#include "model/mechanisms/robot.h"
#include "model/mechanisms/robot_leg_bending.h"
#include "model/simulate.h"
#include "tests/support/gradient_check.h"
#include "tests/support/robot_energy.h"
#include "tests/support/robot_requests.h"

// A robot whose legs have mass, M82, M83, and on the ground M89 to M92.

namespace hoplab {
namespace {

using namespace testing;

// ---- the legs as points ----------------------------------------------------------------------

// Coordinates: x, y, pitch, angles of the motors, how far each leg is bent.
using Coordinates = std::vector<double>;

// Kinetic energy, weight and momentum of a robot whose legs are points, told apart from
// the equations of motion: places of points, their velocities by dual numbers. What a leg is bent
// by adds to them to the first order (M98): it is not turned itself.
class Points {
 public:
  explicit Points(const Parameters<double>& p) : p_(p) {}

  struct Sum {
    double lagrangian = 0.0, x = 0.0, y = 0.0, about_origin = 0.0, mass = 0.0;
  };
  Sum Of(const Coordinates& q, const Coordinates& v) const {
    const RobotParameters<double>& robot = *p_.robot;
    std::vector<Jet<1>> at;
    for (std::size_t i = 0; i < q.size(); ++i) at.push_back(Seeded<Jet<1>>(q[i], 0, v[i]));
    Sum sum;
    const auto put = [&](double mass, const Vector2<Jet<1>>& from, double x, double y,
                         const Jet<1>& turn, const Vector2<double>& by = {0.0, 0.0},
                         const Jet<1>& bent = Jet<1>(0.0)) {
      const Jet<1> c = cos(turn), s = sin(turn);
      const Jet<1> px = from.x + c * x - s * y, py = from.y + s * x + c * y;
      const double off_x = c.a * by.x - s.a * by.y, off_y = s.a * by.x + c.a * by.y;
      const double vx = px.v[0] + bent.v[0] * off_x, vy = py.v[0] + bent.v[0] * off_y;
      sum.lagrangian += mass * (0.5 * (vx * vx + vy * vy) - p_.g * (py.a + bent.a * off_y));
      sum.x += mass * vx;
      sum.y += mass * vy;
      sum.about_origin += mass * (px.a * vy - py.a * vx);
      sum.mass += mass;
      return Vector2<Jet<1>>{px, py};
    };
    const Vector2<Jet<1>> body{at[0], at[1]};
    put(p_.m, body, robot.com_x, robot.com_y, at[2]);
    sum.lagrangian += 0.5 * robot.pitch_inertia * v[2] * v[2];
    sum.about_origin += robot.pitch_inertia * v[2];
    for (int i = 0; i < robot.legs; ++i) {
      const std::size_t motor = 3 + static_cast<std::size_t>(i);
      const Jet<1>& bent = at[motor + static_cast<std::size_t>(robot.legs)];
      const Vector2<Jet<1>> hip = put(0.0, body, robot.hip_x[i], robot.hip_y[i], at[2]);
      // Gauss's rule of three points on each of 40 pieces.
      constexpr int kPieces = 40;
      for (int k = 0; k < 3 * kPieces; ++k) {
        const double at_rule = (k % 3 - 1) * std::sqrt(0.15),
                     weight = k % 3 == 1 ? 4.0 / 9 : 5.0 / 18;
        const double along = kPi * (std::floor(k / 3.0) + 0.5 + at_rule) / kPieces;
        put(robot.leg_mass * weight / kPieces, hip, -p_.r * std::sin(along),
            -p_.r * (1 - std::cos(along)), at[2] + at[motor], BendingAt(kPi - along, 0.0), bent);
      }
      sum.lagrangian += 0.5 * robot.rotor_inertia * v[motor] * v[motor];
    }
    return sum;
  }

 private:
  Parameters<double> p_;
};

double Slope(double h, const std::function<double(double)>& f) {
  const auto d = [&](double step) { return (f(step) - f(-step)) / (2 * step); };
  return (4 * d(0.5 * h) - d(h)) / 3;
}

Parameters<double> WithLegs(int legs, double mass) {
  Parameters<double> p = RobotParametersFor(legs);
  p.robot->leg_mass = mass;
  return p;
}

// dp/dt of each coordinate's momentum less the Lagrangian's slope is the motor's torque on its
// angle, what the material resists on how far a leg is bent, nothing on the others.
TEST(RobotLegMass, EquationsAreLagrangesOfPointsAlongTheLegs) {
  std::mt19937 random(7);
  const auto in = [&](double most) {
    return std::uniform_real_distribution<double>(-most, most)(random);
  };
  double worst = 0.0;
  for (int trial = 0; trial < 6; ++trial) {
    const int legs = 1 + trial % 4;
    Parameters<double> p = WithLegs(legs, 0.2);
    p.robot->com_x = 0.02;
    p.robot->com_y = -0.015;
    p.robot->rotor_inertia = 0.02;  // slow enough for differences
    p.robot->damping = 3e-4;
    for (int i = 0; i < legs; ++i) p.robot->hip_y[i] = in(0.03);
    MechanismSetup<double> setup;
    setup.parameters = p;
    Robot<double> robot(setup);
    std::vector<double> z(static_cast<std::size_t>(robot.size()), 0.0), dz(z.size());
    z = {in(1), 1 + in(0.2), in(1), in(1), in(3), in(5)};
    z.resize(dz.size());
    for (int i = 0; i < legs; ++i) {
      z[6 + i] = in(3);
      z[6 + legs + i] = in(30);
    }
    robot.Begin(Mode::kFlight, z.data());
    for (int i = 0; i < legs; ++i) {
      z[6 + 3 * legs + i] = in(1);
      z[6 + 4 * legs + i] = in(0.01);
    }
    robot.Derivative(Mode::kFlight, 0.0, z.data(), dz.data());
    Coordinates q = {z[0], z[1], z[4]}, v = {z[2], z[3], z[5]}, a = {dz[2], dz[3], dz[5]};
    for (int i = 0; i < legs; ++i) {
      q.push_back(z[6 + i]);
      v.push_back(z[6 + legs + i]);
      a.push_back(dz[6 + legs + i]);
    }
    for (int i = 0; i < legs; ++i) {
      q.push_back(z[6 + 4 * legs + i]);
      v.push_back(z[6 + 3 * legs + i]);
      a.push_back(dz[6 + 3 * legs + i]);
    }
    const Points points(p);
    const double stiffness = FirstBending().stiffness * p.E * p.I / std::pow(p.r, 3);
    const auto momentum = [&](std::size_t k, double t) {
      Coordinates at = q, speed = v;
      for (std::size_t i = 0; i < q.size(); ++i) {
        at[i] += t * (v[i] + 0.5 * t * a[i]);
        speed[i] += t * a[i];
      }
      // Of the second degree in the speeds: any step does.
      return Slope(1.0, [&](double step) {
        Coordinates moved = speed;
        moved[k] += step;
        return points.Of(at, moved).lagrangian;
      });
    };
    for (std::size_t k = 0; k < q.size(); ++k) {
      const double force =
          Slope(1e-4, [&](double t) { return momentum(k, t); }) - Slope(1e-3, [&](double step) {
            Coordinates moved = q;
            moved[k] += step;
            return points.Of(moved, v).lagrangian;
          });
      double torque = 0.0;
      if (k >= q.size() - legs)
        torque = -stiffness * (q[k] + p.robot->damping * v[k]);
      else if (k >= 3)
        torque = p.robot->motor_kp * (p.robot->angle[k - 3] - q[k]) - p.robot->motor_kd * v[k];
      worst = std::max(worst, std::abs(force - torque));
    }
  }
  std::printf("Lagrange's equations, worst of forces and torques up to 200: %.1e\n", worst);
  EXPECT_LT(worst, 1e-6);
}

// Motors that drive their legs round change no momentum of the whole, nor, without gravity, its
// angular momentum about a point that rests.
TEST(RobotLegMass, MomentumStaysInFlight) {
  for (MotorControl control : {MotorControl::kHeld, MotorControl::kClock}) {
    Parameters<double> p = WithLegs(3, 0.05);
    p.robot->control = control;
    p.robot->period = 0.2;
    p.robot->sweep = 0.8;
    p.robot->com_x = 0.01;
    p.robot->torque_limit = 6.0;
    p.robot->phase = {0.1, 0.6, 0.3};
    const std::vector<double> start = {0.0, 3.0, 0.4, 0.5, 0.1, 1.5};
    const Points points(p);
    for (double gravity : {9.81, 0.0}) {
      p.g = gravity;
      std::array<double, 3> first{};
      for (double t : {0.013, 0.21, 0.4}) {
        SimulationRequest q = RobotDrop(p, start, t);
        if (control == MotorControl::kHeld)
          q.initial.insert(q.initial.end(), {0.9, 0.2, 0.4, 3.0, -8.0, 20.0});
        const Trajectory run = RunWithEnergy(q).run;
        ASSERT_EQ(run.outcome, Outcome::kCompleted);
        const std::vector<double>& z = run.final_state;
        Coordinates at = {z[0], z[1], z[4]}, speed = {z[2], z[3], z[5]};
        for (std::size_t i = 0; i < 3; ++i) at.push_back(z[6 + i]), speed.push_back(z[9 + i]);
        for (std::size_t i = 0; i < 3; ++i) at.push_back(z[18 + i]), speed.push_back(z[15 + i]);
        EXPECT_NE(at.back(), 0.0);  // it bends
        const Points::Sum sum = points.Of(at, speed);
        const std::array<double, 3> now = {sum.x, sum.y + sum.mass * p.g * t, sum.about_origin};
        if (first[1] == 0.0) first = now;
        EXPECT_NEAR(now[0], first[0], 1e-10);
        EXPECT_NEAR(now[1], first[1], 1e-10);
        if (gravity == 0.0) {
          EXPECT_NEAR(now[2], first[2], 1e-10);
        }
        if (t > 0.3) {
          EXPECT_GT(std::abs(z[5] - start[5]), 0.01);  // legs turn the body
        }
      }
    }
  }
}

// At no mass the equations of the massless leg run; a hair of mass, rigid on the ground, changes a
// hair.
TEST(RobotLegMass, VanishesContinuously) {
  const auto end = [](double mass) {
    Parameters<double> p = WithLegs(2, mass);
    p.robot->friction = 0.8;
    p.robot->damping = 3e-4;
    return Simulate(RobotDrop(p, {0.0, 0.22, 0.3, 0.0, 0.03, 0.2}, 0.25)).final_state;
  };
  const std::vector<double> none = end(0.0), hair = end(1e-9), more = end(2e-9);
  for (int i : {0, 1, 2, 3, 4, 5}) {
    EXPECT_NEAR(hair[i], none[i], 1e-6) << i;
    EXPECT_NEAR(more[i] - none[i], 2 * (hair[i] - none[i]), 1e-9) << i;
  }
}

// ---- derivatives -----------------------------------------------------------------------------

using D = SensitivityDirection;

TEST(RobotLegMass, DerivativesAreThoseOfDifferences) {
  const std::vector<D> all = {D::Parameter(ParameterId::kLegMass),
                              D::Parameter(ParameterId::kE),
                              D::Parameter(ParameterId::kR),
                              D::Parameter(ParameterId::kPitchInertia),
                              D::Parameter(ParameterId::kRotorInertia),
                              D::Parameter(ParameterId::kComX),
                              D::Parameter(ParameterId::kGravity),
                              D::InitialState(1),
                              D::InitialState(4),
                              D::InitialState(5)};
  double worst = 0.0;
  int columns = 0;
  std::map<std::string, int> seen;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const bool walks = seed % 4 == 0;
    Parameters<double> p = WithLegs(2 + static_cast<int>(seed % 2), seed == 3 ? 0.0 : 0.03);
    RobotParameters<double>& robot = *p.robot;
    robot.friction = 0.5 + 0.1 * seed;
    robot.damping = 3e-4;
    robot.com_x = 0.004;
    robot.rotor_inertia = 4e-3;  // slower than a real one: fewer steps
    if (walks) {
      robot.control = MotorControl::kClock;
      robot.period = 0.45;
      robot.duty = 0.6;
      robot.sweep = 0.8;
      robot.offset = 0.25;
      robot.phase = {0.1, 0.6, 0.1};
      robot.torque_limit = 6.0;
    }
    SimulationRequest q =
        walks ? RobotDrop(p, {0.0, 0.2, 0.4, 0.0, 0.02, 0.1}, 0.3) : RandomRobotDrop(p, seed, 0.3);
    const Trajectory run = Simulate(q);
    if (run.outcome != Outcome::kCompleted || run.has_simultaneous_events) continue;
    for (const Event& e : run.events) ++seen[std::string(NameOf(e.kind))];
    std::vector<double> rows;
    for (double t = 0.004; t < run.end_time - 0.002; t += 0.011) {
      bool clear = true;
      for (const Event& e : run.events) clear = clear && std::abs(e.time - t) > 1e-3;
      if (clear) rows.push_back(t);
    }
    std::vector<D> directions = {all.front()};  // the mass always, of the others some
    for (std::size_t k = 0; k < 3; ++k)
      directions.push_back(all[1 + (3 * std::size_t{seed} + k) % 9]);
    if (seed == 3)  // a mass of nothing has a derivative on one side
      directions.erase(directions.begin());
    const std::array channels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyPitch,
                                 Channel::kLegAngle1, Channel::kLegAngle2};
    q.row_times = rows;
    q.channels = channels;
    q.directions = directions;
    for (const ColumnCheck& check : CheckGradient(q)) {
      EXPECT_EQ(Complaint(check), "") << "seed " << seed;
      if (!check.nothing_to_see) worst = std::max(worst, check.error);
      ++columns;
    }
  }
  std::printf("derivatives: %d columns, worst %.1e;", columns, worst);
  for (const auto& [name, count] : seen) std::printf(" %s %d", name.c_str(), count);
  std::printf("\n");
  EXPECT_GE(columns, 20);
}

}  // namespace
}  // namespace hoplab
