#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "base/units.h"
#include "model/mechanisms/robot.h"
#include "model/mechanisms/robot_leg_bending.h"
#include "model/simulate.h"
#include "tests/support/robot_requests.h"

// What a robot's legs with mass take up and give as they land and leave: M90, M91.

namespace hoplab {
namespace {

using namespace testing;

// A robot's velocities and what they carry, told apart from the equations of motion: momentum,
// angular momentum about a point, kinetic energy, and what goes with one leg's base.
struct Carried {
  double x = 0.0, y = 0.0, about = 0.0, energy = 0.0;
  std::vector<double> motor;
};

struct LegNow {
  bool down = false;
  double own = 0.0;  // speed of its foot; in the air, rate of its bending
};

class Momenta {
 public:
  Momenta(const Parameters<double>& p, const std::vector<double>& place) : p_(p), z_(place) {}

  // A leg as a matrix by (hip along, up, base), its mean velocity and turn about the hip.
  struct Matrix {
    Eigen::Matrix3d mass;
    Eigen::Matrix<double, 2, 3> mean;
    Eigen::Vector3d turn;
    Eigen::Vector3d bending;  // by the mode of the leg in the air
  };
  double Beta(int leg) const { return z_[4] + z_[6 + leg]; }
  Eigen::Vector2d HipOf(int leg) const {
    const RobotParameters<double>& robot = *p_.robot;
    return Eigen::Rotation2Dd(z_[4]) * Eigen::Vector2d(robot.hip_x[leg], robot.hip_y[leg]);
  }
  // Of unit mass: standing on its arc, or rigid.
  Matrix Standing(int leg) const {
    const auto s = LegShapeByQuadrature(kPi - Beta(leg));
    const double r = p_.r;
    Matrix m;
    m.mass << s[0], s[1], r * s[3], s[1], s[2], r * s[4], r * s[3], r * s[4], r * r * s[5];
    m.mean << s[6], s[7], r * s[8], s[9], s[10], r * s[11];
    m.turn << r * s[12], r * s[13], r * r * s[14];
    m.bending << s[15], s[16], r * s[17];
    return m;
  }
  Matrix Rigid(int leg) const {
    const double b = Beta(leg), r = p_.r;
    const double x = r * (std::sin(b) - 2 / kPi * std::cos(b)),
                 y = r * (-std::cos(b) - 2 / kPi * std::sin(b));
    Matrix m;
    m.mass << 1, 0, -y, 0, 1, x, -y, x, 2 * r * r;
    m.mean << 1, 0, -y, 0, 1, x;
    m.turn << -y, x, 2 * r * r;
    const Eigen::Vector2d mode =
        Eigen::Rotation2Dd(b) * Eigen::Vector2d(FirstBending().along, FirstBending().up);
    m.bending << mode.x(), mode.y(), r * FirstBending().about;
    return m;
  }
  Eigen::Vector3d Motion(int leg, const std::vector<double>& z) const {
    const Eigen::Vector2d hip = HipOf(leg);
    return {z[2] - z[5] * hip.y(), z[3] + z[5] * hip.x(),
            z[5] + z[6 + p_.robot->legs + static_cast<std::size_t>(leg)]};
  }
  static double EnergyInAir(const Matrix& rigid, const Eigen::Vector3d& is, double own) {
    return 0.5 * is.dot(rigid.mass * is) + own * rigid.bending.dot(is) + 0.5 * own * own;
  }
  // Velocities of `z`; about a point of the ground.
  Carried Of(const std::vector<double>& z, const std::vector<LegNow>& legs, double ground_x) const {
    const RobotParameters<double>& robot = *p_.robot;
    Carried sum;
    const Eigen::Vector2d com =
        Eigen::Rotation2Dd(z_[4]) * Eigen::Vector2d(robot.com_x, robot.com_y);
    const Eigen::Vector2d v(z[2] - z[5] * com.y(), z[3] + z[5] * com.x());
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    const Eigen::Vector2d body(z_[0] - ground_x, z_[1]);
    sum.x = p_.m * v.x();
    sum.y = p_.m * v.y();
    sum.about = p_.m * cross(body + com, v) + robot.pitch_inertia * z[5];
    sum.energy = 0.5 * (p_.m * v.squaredNorm() + robot.pitch_inertia * z[5] * z[5]);
    for (int i = 0; i < robot.legs; ++i) {
      const double m = robot.leg_mass, rate = z[6 + robot.legs + i];
      const LegNow& leg = legs[i];
      sum.motor.push_back(robot.rotor_inertia * rate);
      sum.energy += 0.5 * robot.rotor_inertia * rate * rate;
      if (!leg.down) {
        const Matrix rigid = Rigid(i);
        const Eigen::Vector3d is = Motion(i, z);
        const Eigen::Vector2d mean = rigid.mean * is + leg.own * rigid.bending.head<2>();
        sum.x += m * mean.x();
        sum.y += m * mean.y();
        sum.about +=
            m * (cross(body + HipOf(i), mean) + rigid.turn.dot(is) + leg.own * rigid.bending.z());
        sum.energy += m * EnergyInAir(rigid, is, leg.own);
        continue;
      }
      const Matrix is = Standing(i);
      const Eigen::Vector2d carried(leg.own, 0.0);
      Eigen::Vector3d over = Motion(i, z);
      over.x() -= leg.own;
      const Eigen::Vector2d mean = is.mean * over + carried;
      const Eigen::Vector2d centre = Rigid(i).mean.block<2, 1>(0, 2);  // k x rho
      const Eigen::Vector2d rho(centre.y(), -centre.x());
      sum.x += m * mean.x();
      sum.y += m * mean.y();
      sum.about += m * (cross(body + HipOf(i), mean) + is.turn.dot(over) + cross(rho, carried));
      sum.energy += m * (0.5 * over.dot(is.mass * over) + leg.own * (is.mean * over).x() +
                         0.5 * leg.own * leg.own);
    }
    return sum;
  }

 private:
  Parameters<double> p_;
  std::vector<double> z_;
};

// Two legs, the first of which touches the ground this very moment, with mass 0.2 kg each.
struct Landing {
  Parameters<double> p;
  std::vector<double> z;

  explicit Landing(unsigned seed, double friction) : p(RobotParametersFor(2)) {
    std::mt19937 random(seed);
    const auto in = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    RobotParameters<double>& robot = *p.robot;
    robot.leg_mass = 0.2;
    robot.friction = friction;
    robot.com_x = 0.01;
    robot.com_y = -0.02;
    robot.hip_y[0] = 0.015;
    z.assign(16, 0.0);
    z[0] = 0.3;
    z[2] = in(-0.6, 0.6);
    z[3] = in(-1.5, -0.5);
    z[4] = in(-0.05, 0.05);
    z[5] = in(-1.0, 1.0);
    z[6] = in(0.2, 1.2);
    z[7] = 2.2;  // its leg is up
    z[8] = in(-8.0, 4.0);
    z[9] = in(-8.0, 8.0);
    z[12] = in(-1.0, 1.0);  // they ring
    z[13] = in(-1.0, 1.0);
    z[14] = in(-0.002, 0.002);
    const double beta = z[4] + z[6];
    const double hip = std::sin(z[4]) * robot.hip_x[0] + std::cos(z[4]) * robot.hip_y[0];
    z[1] = p.r * (1 + std::cos(beta)) - hip;
  }
  double ContactX() const {
    const RobotParameters<double>& robot = *p.robot;
    return z[0] + std::cos(z[4]) * robot.hip_x[0] - std::sin(z[4]) * robot.hip_y[0] +
           p.r * std::sin(z[4] + z[6]);
  }
};

int GuardOf(const Robot<double>& robot, Mode mode, EventKind kind, int leg) {
  for (int i = 0; i < robot.GuardCount(mode); ++i) {
    const GuardSpec guard = robot.Guard(mode, i);
    if (guard.event == kind && guard.leg == leg) return i;
  }
  return -1;
}

// The ground's impulse goes through the contact, and within the cone: what is about the contact is
// kept, a foot that slides takes friction, and what holds takes none from allowed motions.
TEST(RobotLegBlow, TakesNothingFromWhatIsFree) {
  double worst = 0.0, lost_least = 1.0, lost_most = 0.0;
  int holds = 0, slides = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const double mu = seed % 4 == 0 ? std::numeric_limits<double>::infinity() : 0.1 * (seed % 4);
    const Landing at(seed, mu);
    MechanismSetup<double> setup;
    setup.parameters = at.p;
    Robot<double> robot(setup);
    std::vector<double> z = at.z;
    z[1] += 1e-9;  // still in the air
    const Mode mode = robot.Begin(Mode::kFlight, z.data());
    ASSERT_EQ(mode, Mode::kFlight);
    z = at.z;
    const int guard = GuardOf(robot, mode, EventKind::kTouchdown, 0);
    ASSERT_GE(guard, 0);
    robot.Reset(mode, guard, 0.0, z.data());
    std::vector<Foot> feet;
    robot.TellFeet(feet);
    const double foot = z[12];
    EXPECT_EQ(z[14], 0.0);
    const double spot = at.ContactX();
    const Momenta momenta(at.p, at.z);
    const Carried before = momenta.Of(at.z, {{false, at.z[12]}, {false, at.z[13]}}, spot),
                  after = momenta.Of(z, {{true, foot}, {false, z[13]}}, spot);
    const double along = after.x - before.x, up = after.y - before.y;
    worst = std::max(worst, std::abs(after.about - before.about));
    EXPECT_GT(up, 0.0) << seed;
    if (foot == 0.0) {  // it held in the blow; it may begin to slide then
      ++holds;
      EXPECT_LE(std::abs(along), mu * up + 1e-12) << seed;
    } else {
      ++slides;
      worst = std::max(worst, std::abs(along + feet[0].slides * mu * up));
      EXPECT_GT(foot * feet[0].slides, 0.0) << seed;
    }
    // The motor of the leg that lands: what is conjugate to its angle.
    const double m = at.p.robot->leg_mass;
    const Momenta::Matrix standing = momenta.Standing(0), rigid = momenta.Rigid(0);
    Eigen::Vector3d over = momenta.Motion(0, z);
    const Eigen::Vector3d was = momenta.Motion(0, at.z);
    over.x() -= foot;
    const double base = after.motor[0] +
                        m * (standing.mass.row(2).dot(over) + foot * standing.mean(0, 2)) -
                        before.motor[0] -
                        m * (standing.mean(0, 2) * was.x() + standing.mean(1, 2) * was.y() +
                             standing.turn(2) * was.z() + standing.bending(2) * at.z[12]);
    worst = std::max(worst, std::abs(base));
    // The other leg's motor and its bending.
    const Momenta::Matrix second = momenta.Rigid(1);
    const Eigen::Vector3d moved = momenta.Motion(1, z) - momenta.Motion(1, at.z);
    const double rings = z[13] - at.z[13];
    const double other = after.motor[1] - before.motor[1] +
                         m * (second.mass.row(2).dot(moved) + second.bending(2) * rings);
    worst = std::max({worst, std::abs(other), std::abs(m * (second.bending.dot(moved) + rings))});
    const double lost = before.energy - after.energy;
    lost_least = std::min(lost_least, lost);
    lost_most = std::max(lost_most, lost);
    // Carnot's theorem: the energy of the velocities lost, and what friction takes.
    std::vector<double> change = z;
    for (std::size_t i : {2, 3, 5, 8, 9}) change[i] -= at.z[i];
    const double crossed = over.dot(standing.mean.row(0).transpose() * was.x() +
                                    standing.mean.row(1).transpose() * was.y() +
                                    standing.turn * was.z() + standing.bending * at.z[12]) +
                           foot * (rigid.mean.row(0).dot(was) + rigid.bending(0) * at.z[12]);
    const Carried off = momenta.Of(change, {{}, {false, rings}}, spot);
    const Eigen::Vector3d off_leg = momenta.Motion(0, change);
    const double landed = 0.5 * over.dot(standing.mass * over) +
                          foot * standing.mean.row(0).dot(over) + 0.5 * foot * foot;
    const double carnot = off.energy - 0.5 * m * off_leg.dot(rigid.mass * off_leg) +
                          m * (Momenta::EnergyInAir(rigid, was, at.z[12]) + landed - crossed);
    worst = std::max(worst, std::abs(lost - (carnot - along * foot)));
  }
  std::printf("blow: %d hold, %d slide, worst momentum %.1e, energy lost %.3g to %.3g J\n", holds,
              slides, worst, lost_least, lost_most);
  EXPECT_LT(worst, 1e-12);
  EXPECT_GT(lost_least, 0.0);
  EXPECT_GT(holds, 8);
  EXPECT_GT(slides, 8);
}

// No force from outside as a leg leaves: momentum and angular momentum of the whole stay.
TEST(RobotLegBlow, LeavingKeepsMomentum) {
  double worst = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Landing at(seed, std::numeric_limits<double>::infinity());
    at.z[1] -= 0.004;  // pressed
    at.z[12] = at.z[14] = 0.0;
    MechanismSetup<double> setup;
    setup.parameters = at.p;
    Robot<double> robot(setup);
    std::vector<double> z = at.z;
    const Mode mode = robot.Begin(Mode::kFlight, z.data());
    ASSERT_EQ(mode, Mode::kStance);
    std::vector<double> standing = z;
    standing[13] = z[13] = at.z[13];
    const int guard = GuardOf(robot, mode, EventKind::kLiftoff, 0);
    ASSERT_GE(guard, 0);
    robot.Reset(mode, guard, 0.0, z.data());
    const Momenta momenta(at.p, standing);
    const Carried before = momenta.Of(standing, {{true, 0.0}, {false, standing[13]}}, 0.1),
                  after = momenta.Of(z, {{false, z[12]}, {false, z[13]}}, 0.1);
    for (double change : {after.x - before.x, after.y - before.y, after.about - before.about})
      worst = std::max(worst, std::abs(change));
    // What its points have along the bending goes over into that.
    const Momenta::Matrix rigid = momenta.Rigid(0);
    const double bends = rigid.bending.dot(momenta.Motion(0, z)) + z[12];
    worst = std::max(
        worst, std::abs(bends - momenta.Standing(0).bending.dot(momenta.Motion(0, standing))));
    EXPECT_GT(std::abs(z[8] - standing[8]), 1e-3) << seed;  // the leg is heavy
    EXPECT_NE(z[14], 0.0);
  }
  EXPECT_LT(worst, 1e-11);
}

// A light leg changes little, and half the leg half of it.
TEST(RobotLegBlow, GoesWithTheMass) {
  const auto end = [](double mass) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->leg_mass = mass;
    p.robot->damping = 3e-4;
    return Simulate(RobotDrop(p, {0.0, 0.22, 0.1, 0.0, 0.03, 0.2}, 0.13)).final_state;
  };
  const std::vector<double> none = end(0.0), half = end(4e-4), whole = end(8e-4);
  for (int i : {0, 1, 2, 3, 4, 5}) {
    EXPECT_NEAR(half[i], none[i], 5e-3) << i;
    EXPECT_NEAR(whole[i] - none[i], 2 * (half[i] - none[i]),
                0.2 * std::abs(half[i] - none[i]) + 1e-5)
        << i;
  }
}

}  // namespace
}  // namespace hoplab
