// The two-legged kinematics against closed forms, the loop equations solved another way, and two
// rigid circles that roll.
#include "experiments/kinematics/two_legs.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/NonLinearOptimization>

#include "base/units.h"

namespace hoplab::testing {
namespace {

constexpr double kRootAccuracy = 1e-12;  // TOMS 748 at 52 bits, times the conditioning of a pose
constexpr double kOdeAccuracy = 1e-9;    // a controlled Runge-Kutta path at 1e-12 a step

LegAngles Degrees(double rear, double front) { return {DegToRad(rear), DegToRad(front)}; }

// M19 and M20 less M21, in (psi_f, alpha_b), over d_leg.
struct LoopEquations {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  TwoLegs legs;
  LegAngles start;
  double psi_rear;

  double Distance(double rear, double front, double pitch) const {  // M20 with M18
    const double d = legs.leg_diameter;
    return -d * std::sin(rear) * std::cos(rear) + legs.hip_distance * std::cos(pitch) +
           d * std::sin(front) * std::cos(front);
  }
  double Climb(double rear, double front, double pitch) const {  // M19 with M18
    const double d = legs.leg_diameter;
    return d * std::sin(rear) * std::sin(rear) + legs.hip_distance * std::sin(pitch) -
           d * std::sin(front) * std::sin(front);
  }
  int operator()(const Eigen::VectorXd& z, Eigen::VectorXd& residual) const {
    const double d = legs.leg_diameter;
    const double start_pitch = std::asin(-Climb(start.rear, start.front, 0.0) / legs.hip_distance);
    const double rolled = Distance(start.rear, start.front, start_pitch) -
                          d * (psi_rear - start.rear) + d * (z[0] - start.front);
    residual.resize(2);
    residual << Climb(psi_rear, z[0], z[1]) / d, (Distance(psi_rear, z[0], z[1]) - rolled) / d;
    return 0;
  }
  int inputs() const { return 2; }
  int values() const { return 2; }
};

// Two rigid circles that roll, joined by a bar between points fixed on them: position of each
// contact, angle of each circle from its hip to its contact, angle of the bar. Velocities by
// rotation about the contacts.
using Rolling = std::array<double, 5>;  // x_r, phi_r, x_f, phi_f, alpha_b
class RollingCircles {
 public:
  explicit RollingCircles(const TwoLegs& legs) : legs_(legs) {}

  Rolling Start(LegAngles start, double pitch) const {
    Rolling s = {0.0, 2.0 * start.rear, 0.0, 2.0 * start.front, pitch};
    const auto rear = Hip(s[0], s[1]);
    s[2] = rear[0] + legs_.hip_distance * std::cos(pitch) - Hip(0.0, s[3])[0];
    return s;
  }
  std::array<double, 2> Hip(double contact, double phi) const {
    const double r = 0.5 * legs_.leg_diameter;
    return {contact - r * std::sin(phi), r - r * std::cos(phi)};
  }
  // By the rear virtual link's angle.
  void operator()(const Rolling& s, Rolling& rate, double) const {
    const double r = 0.5 * legs_.leg_diameter, b = legs_.hip_distance;
    const auto rear = Hip(s[0], s[1]), front = Hip(s[2], s[3]);
    const double spin = 2.0;  // of the rear circle
    // Turning clockwise about a contact moves its hip by (height, -lead).
    Eigen::Matrix2d a;
    a << front[1], b * std::sin(s[4]), -(front[0] - s[2]), -b * std::cos(s[4]);
    const Eigen::Vector2d v(spin * rear[1], -spin * (rear[0] - s[0]));
    const Eigen::Vector2d rates = a.partialPivLu().solve(v);
    rate = {r * spin, spin, r * rates[0], rates[0], rates[1]};
  }

 private:
  TwoLegs legs_;
};

Rolling RollTo(const TwoLegs& legs, LegAngles start, double pitch, double psi_rear) {
  namespace odeint = boost::numeric::odeint;
  const RollingCircles circles(legs);
  Rolling state = circles.Start(start, pitch);
  const double way = psi_rear - start.rear;
  odeint::integrate_adaptive(
      odeint::make_controlled<odeint::runge_kutta_dopri5<Rolling>>(1e-13, 1e-12), circles, state,
      0.0, way, 0.01 * way);
  return state;
}

TEST(TwoLegs, EqualStartAnglesKeepTheBodyLevel) {
  for (const double angle : {30.0, 45.0, 72.0}) {
    const RollingPair pair(TwoLegs{}, Degrees(angle, angle));
    ASSERT_EQ(pair.start().outcome, PoseOutcome::kReached);
    for (const double psi : {2.0, 20.0, 60.0, 90.0}) {
      const PoseResult at = pair.At(DegToRad(psi));
      ASSERT_EQ(at.outcome, PoseOutcome::kReached) << psi;
      EXPECT_NEAR(at.pose.psi_front, DegToRad(psi), kRootAccuracy / DegToRad(psi));
      EXPECT_NEAR(at.pose.pitch, 0.0, kRootAccuracy);
      EXPECT_NEAR(at.pose.contact_distance, TwoLegs{}.hip_distance, kRootAccuracy);
    }
  }
}

TEST(TwoLegs, ANonlinearSolverOfBothLoopEquationsFindsTheSamePoses) {
  for (const LegAngles start : {Degrees(45, 75), Degrees(70, 50), Degrees(30, 60)}) {
    const RollingPair pair(TwoLegs{}, start);
    for (const double step : {-8.0, 5.0, 14.0}) {
      const double psi = start.rear + DegToRad(step);
      const PoseResult at = pair.At(psi);
      ASSERT_EQ(at.outcome, PoseOutcome::kReached);
      LoopEquations equations{TwoLegs{}, start, psi};
      Eigen::HybridNonLinearSolver<LoopEquations> solver(equations);
      solver.parameters.xtol = 1e-14;
      Eigen::VectorXd z(2), residual(2);
      z << start.front, pair.start().pose.pitch;
      solver.solveNumericalDiff(z);
      equations(z, residual);
      ASSERT_LT(residual.norm(), kRootAccuracy);
      EXPECT_NEAR(at.pose.psi_front, z[0], kRootAccuracy);
      EXPECT_NEAR(at.pose.pitch, z[1], kRootAccuracy);
      EXPECT_NEAR(at.pose.contact_distance, equations.Distance(psi, z[0], z[1]), kRootAccuracy);
      EXPECT_NEAR(at.pose.motor_rear, 2.0 * psi + z[1], kRootAccuracy);
      EXPECT_NEAR(at.pose.motor_front, 2.0 * z[0] + z[1], kRootAccuracy);
    }
  }
}

TEST(TwoLegs, RigidCirclesThatRollEndInTheSamePose) {
  for (const bool stops : {true, false}) {
    TwoLegs legs;
    legs.front_stops_upright = stops;
    for (const LegAngles start : {Degrees(45, 75), Degrees(60, 35), Degrees(80, 80)}) {
      const RollingPair pair(legs, start);
      const Travel travel = TravelOf(pair);
      for (const double part : {0.02, 0.3, 0.7, 0.98}) {
        const double psi = travel.low + part * (travel.high - travel.low);
        const PoseResult at = pair.At(psi);
        ASSERT_EQ(at.outcome, PoseOutcome::kReached);
        const Rolling rolled = RollTo(legs, start, pair.start().pose.pitch, psi);
        EXPECT_NEAR(at.pose.psi_front, 0.5 * rolled[3], kOdeAccuracy);
        EXPECT_NEAR(at.pose.pitch, rolled[4], kOdeAccuracy);
        EXPECT_NEAR(at.pose.contact_distance, rolled[2] - rolled[0], kOdeAccuracy);
      }
    }
  }
}

TEST(TwoLegs, APoseOnTheWayIsAStartOfTheSameMotion) {
  const LegAngles start = Degrees(45, 75);
  const RollingPair there(TwoLegs{}, start);
  const Pose middle = there.At(DegToRad(58)).pose;
  const RollingPair back(TwoLegs{}, {middle.psi_rear, middle.psi_front});
  const PoseResult again = back.At(start.rear);
  ASSERT_EQ(again.outcome, PoseOutcome::kReached);
  EXPECT_NEAR(again.pose.psi_front, start.front, kRootAccuracy);
  EXPECT_NEAR(again.pose.pitch, there.start().pose.pitch, kRootAccuracy);
}

TEST(TwoLegs, DeterminantIsThatOfTheLoopEquations) {
  const LegAngles start = Degrees(40, 70);
  const TwoLegs legs;
  const Pose pose = RollingPair(legs, start).At(DegToRad(52)).pose;
  const LoopEquations equations{legs, start, pose.psi_rear};
  Eigen::Matrix2d jacobian;
  for (int column = 0; column < 2; ++column) {
    constexpr double kStep = 1e-5;
    Eigen::VectorXd up(2), down(2), at_up, at_down;
    up << pose.psi_front, pose.pitch;
    down = up;
    up[column] += kStep;
    down[column] -= kStep;
    equations(up, at_up);
    equations(down, at_down);
    jacobian.col(column) = (at_up - at_down) / (2.0 * kStep);
  }
  // The residuals are over d_leg: the determinant over 2 b d_leg is the one over 2 b/d_leg.
  EXPECT_NEAR(pose.determinant,
              std::abs(jacobian.determinant()) * legs.leg_diameter / (2.0 * legs.hip_distance),
              1e-9);
}

TEST(TwoLegs, PitchRateIsTheSlopeOfThePitch) {
  const RollingPair pair(TwoLegs{}, Degrees(70, 45));
  const double psi = DegToRad(66), step = 1e-4;
  const auto slope = [&](double h) {
    return (pair.At(psi + h).pose.pitch - pair.At(psi - h).pose.pitch) / (2.0 * h);
  };
  EXPECT_NEAR(pair.At(psi).pose.pitch_rate, (4.0 * slope(step) - slope(2.0 * step)) / 3.0, 1e-9);
}

TEST(TwoLegs, TheFrontLegStopsTheOneThatStartsAheadOfTheRearOne) {
  const RollingPair pair(TwoLegs{}, Degrees(45, 75));
  const Travel travel = TravelOf(pair);
  EXPECT_EQ(travel.high_stop, PoseOutcome::kFrontUpright);
  EXPECT_NEAR(pair.At(travel.high).pose.psi_front, DegToRad(90), 1e-9);
  EXPECT_EQ(travel.low_stop, PoseOutcome::kBodyOnGround);
  EXPECT_NEAR(travel.low, 0.0, 2e-3);  // a millionth of the leg above the ground
}

TEST(TwoLegs, TheRearLegStopsUprightWhereItIsAhead) {
  const RollingPair pair(TwoLegs{}, Degrees(70, 45));
  const Travel travel = TravelOf(pair);
  EXPECT_EQ(travel.high_stop, PoseOutcome::kRearUpright);
  EXPECT_NEAR(travel.high, DegToRad(90), 1e-9);
  EXPECT_EQ(pair.At(DegToRad(90.1)).outcome, PoseOutcome::kRearUpright);
}

TEST(TwoLegs, ASingularPoseIsNamedNotPassed) {
  // Front hip lower: on the way down the front virtual link comes in line with the body.
  const RollingPair pair(TwoLegs{}, Degrees(70, 30));
  const Travel travel = TravelOf(pair);
  EXPECT_EQ(travel.low_stop, PoseOutcome::kSingular);
  const Pose last = pair.At(travel.low).pose;
  EXPECT_NEAR(last.psi_front + last.pitch, 0.0, 1e-5);
  EXPECT_GT(last.psi_front, DegToRad(10)) << "no hip is on the ground there";
  EXPECT_EQ(pair.At(travel.low - 1e-3).outcome, PoseOutcome::kSingular);
  // Rigid circles get no further either: their speeds grow without bound towards it.
  const RollingCircles circles{TwoLegs{}};
  const auto front_rate = [&](double before) {
    const Rolling s =
        RollTo(TwoLegs{}, Degrees(70, 30), pair.start().pose.pitch, travel.low + before);
    Rolling rate{};
    circles(s, rate, 0.0);
    return std::abs(rate[3]);
  };
  EXPECT_GT(front_rate(1e-6), 20.0 * front_rate(1e-3));
}

TEST(TwoLegs, ABodyTooShortForTheDifferenceOfHeightCannotBePutDown) {
  TwoLegs legs;
  legs.hip_distance = 0.05;
  const RollingPair pair(legs, Degrees(30, 90));  // hips at 0.045 and 0.18 m
  EXPECT_EQ(pair.start().outcome, PoseOutcome::kCannotClose);
  EXPECT_EQ(pair.At(DegToRad(40)).outcome, PoseOutcome::kCannotClose);
  const Travel travel = TravelOf(pair);
  EXPECT_EQ(travel.high_stop, PoseOutcome::kCannotClose);
  EXPECT_TRUE(std::isnan(PitchRangeOf(pair, travel).highest));
}

TEST(TwoLegs, InitialStatesBeyondALimitAreNamed) {
  EXPECT_EQ(RollingPair(TwoLegs{}, Degrees(95, 60)).start().outcome, PoseOutcome::kRearUpright);
  EXPECT_EQ(RollingPair(TwoLegs{}, Degrees(60, 95)).start().outcome, PoseOutcome::kFrontUpright);
  TwoLegs deep;
  deep.body_depth = 0.06;
  EXPECT_EQ(RollingPair(deep, Degrees(30, 60)).start().outcome, PoseOutcome::kBodyOnGround);
}

TEST(TwoLegs, ADeeperBodyTouchesTheGroundAtItsDepth) {
  TwoLegs deep;
  deep.body_depth = 0.03;
  const RollingPair pair(deep, Degrees(45, 75));
  const Travel travel = TravelOf(pair);
  EXPECT_EQ(travel.low_stop, PoseOutcome::kBodyOnGround);
  const Pose last = pair.At(travel.low).pose;
  const double hip = deep.leg_diameter * std::pow(std::sin(last.psi_rear), 2);
  EXPECT_NEAR(hip, deep.body_depth * std::cos(last.pitch), 1e-6);
}

TEST(TwoLegs, TheMotorCannotDriveThroughItsOwnExtreme) {
  TwoLegs legs;
  legs.hip_distance = 0.09;  // the body pitches faster than the legs turn
  const LegAngles start = Degrees(50, 80);
  const RollingPair pair(legs, start);
  ASSERT_EQ(pair.start().outcome, PoseOutcome::kReached);
  const Travel travel = TravelOf(pair);
  ASSERT_EQ(travel.high_stop, PoseOutcome::kMotorTurns);
  EXPECT_NEAR(pair.At(travel.high).pose.pitch_rate, -2.0, 1e-6);
  // Rigid circles: at that pose the motor's angle has no slope by the rear link's.
  const auto motor = [&](double psi) {
    const Rolling s = RollTo(legs, start, pair.start().pose.pitch, psi);
    return s[1] + s[4];
  };
  const auto slope = [&](double h) {
    return (motor(travel.high + h) - motor(travel.high - h)) / (2.0 * h);
  };
  EXPECT_NEAR((4.0 * slope(1e-3) - slope(2e-3)) / 3.0, 0.0, 1e-6);
}

TEST(TwoLegs, ABodyThatComesToStandOnEndIsStopped) {
  TwoLegs legs;
  legs.hip_distance = 0.07;
  const RollingPair pair(legs, Degrees(50, 80));
  const Travel travel = TravelOf(pair);
  EXPECT_EQ(travel.low_stop, PoseOutcome::kCannotClose);
  EXPECT_NEAR(RadToDeg(pair.At(travel.low).pose.pitch), 90.0, 0.01);
}

TEST(TwoLegs, AnglesDependOnTheRatioOfLengthsAlone) {
  TwoLegs large;
  large.hip_distance *= 10.0;
  large.leg_diameter *= 10.0;
  const RollingPair small_pair(TwoLegs{}, Degrees(45, 75)), large_pair(large, Degrees(45, 75));
  const Pose a = small_pair.At(DegToRad(55)).pose, b = large_pair.At(DegToRad(55)).pose;
  EXPECT_NEAR(a.pitch, b.pitch, kRootAccuracy);
  EXPECT_NEAR(10.0 * a.contact_distance, b.contact_distance, 10.0 * kRootAccuracy);
}

TEST(TwoLegs, PitchRangeIsThatOfTheRollingCircles) {
  TwoLegs circle;
  circle.front_stops_upright = false;  // the pitch has its extremes at ends and in between
  for (const LegAngles start : {Degrees(45, 75), Degrees(80, 40)}) {
    const RollingPair pair(circle, start);
    const Travel travel = TravelOf(pair);
    const PitchRange range = PitchRangeOf(pair, travel);
    double lowest = pair.start().pose.pitch, highest = lowest;
    for (int i = 1; i <= 60; ++i) {
      // Denser towards the lower end, where a singular pose makes the pitch steep; the ends
      // themselves, where the circles' equations lose their rank, are left out.
      const double part = 1e-4 + 0.9998 * i * i / 3600.0;
      const double psi = travel.low + part * (travel.high - travel.low);
      const double pitch = RollTo(circle, start, pair.start().pose.pitch, psi)[4];
      lowest = std::min(lowest, pitch);
      highest = std::max(highest, pitch);
    }
    EXPECT_LE(range.lowest, lowest + kOdeAccuracy);
    EXPECT_GE(range.highest, highest - kOdeAccuracy);
    EXPECT_NEAR(range.lowest, lowest, DegToRad(0.7));
    EXPECT_NEAR(range.highest, highest, DegToRad(0.7));
  }
}

}  // namespace
}  // namespace hoplab::testing
