#include "model/mechanisms/robot_leg_shape.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "base/units.h"
#include "model/mechanisms/robot_leg_bending.h"

// The quasi-static shape of a robot's leg that stands: M89.

namespace hoplab {
namespace {

// A half circle of hinges, pinned at the contact at the angle psi below the hip and clamped there:
// of all ways to move hip and base the one of least bending, by linear algebra. Points as rows of
// velocities by (hip along, hip up, base).
struct Hinges {
  std::vector<Eigen::Vector2d> place;  // from the contact
  std::vector<Eigen::Matrix<double, 2, 3>> moves;

  explicit Hinges(double psi, int count) {
    const double step = kPi / count;
    const int bending = static_cast<int>(std::lround(psi / step));
    const double width = psi / bending;
    const auto at = [](double s) { return Eigen::Vector2d(-std::sin(s), 1 - std::cos(s)); };
    // A turn by 1 of what lies beyond `from`, psi growing, moves a point so.
    const auto turned = [](const Eigen::Vector2d& point, const Eigen::Vector2d& from) {
      const Eigen::Vector2d d = point - from;
      return Eigen::Vector2d(d.y(), -d.x());
    };
    // Unknown: the turn at the contact, that bends nothing, and of each hinge.
    Eigen::MatrixXd ends(3, bending + 1);
    for (int j = 0; j <= bending; ++j) {
      const Eigen::Vector2d from = j == 0 ? at(0) : at((j - 0.5) * width);
      ends.block<2, 1>(0, j) = turned(at(psi), from);
      ends(2, j) = -1.0;
    }
    // Least squares of the hinges alone: the normal equations with the turn beside them.
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(bending + 4, bending + 4);
    for (int j = 1; j <= bending; ++j) system(j, j) = 1.0;
    system.block(0, bending + 1, bending + 1, 3) = ends.transpose();
    system.block(bending + 1, 0, 3, bending + 1) = ends;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(bending + 4, 3);
    right.bottomRows(3).setIdentity();
    const Eigen::MatrixXd turns = system.fullPivLu().solve(right).topRows(bending + 1);
    for (int k = 0; k < count; ++k) {
      const double s = psi - kPi + (k + 0.5) * step;
      const Eigen::Vector2d point = at(s);
      Eigen::Matrix<double, 2, 3> moved = turned(point, at(0)) * turns.row(0);
      for (int j = 1; j <= bending && (j - 0.5) * width < s; ++j)
        moved += turned(point, at((j - 0.5) * width)) * turns.row(j);
      place.push_back(point - at(psi));
      moves.push_back(moved);
    }
  }
};

TEST(RobotLegShape, IsTheOneOfLeastBending) {
  double worst = 0.0;
  for (double psi : {1.2, 2.0, 2.6, 3.0, kPi}) {
    const Hinges hinges(psi, 800);
    std::array<double, LegShape::kCount> sum{};
    const double share = 1.0 / static_cast<double>(hinges.place.size());
    for (std::size_t i = 0; i < hinges.place.size(); ++i) {
      const auto& v = hinges.moves[i];
      const Eigen::Matrix3d square = v.transpose() * v;
      const Eigen::Vector3d turn =
          v.transpose() * Eigen::Vector2d(-hinges.place[i].y(), hinges.place[i].x());
      int k = 0;
      for (auto [a, b] : {std::pair{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}})
        sum[k++] += share * square(a, b);
      for (int row = 0; row < 2; ++row)
        for (int a = 0; a < 3; ++a) sum[k++] += share * v(row, a);
      for (int a = 0; a < 3; ++a) sum[k++] += share * turn(a);
      const double along = psi - kPi + (static_cast<double>(i) + 0.5) * share * kPi;
      const Vector2<double> mode = BendingAt(along + kPi - psi, kPi - psi);
      const Eigen::Vector3d taken = v.transpose() * Eigen::Vector2d(mode.x, mode.y);
      for (int a = 0; a < 3; ++a) sum[k++] += share * taken(a);
    }
    const auto shape = LegShapeByQuadrature(psi);
    const Vector2<double> contact = BendingAt(kPi - psi, kPi - psi);
    sum[LegShape::kContactX] = contact.x;
    sum[LegShape::kContactY] = contact.y;
    for (int k = 0; k < LegShape::kCount; ++k)
      worst = std::max(worst, std::abs(sum[k] - shape[k]) / (1.0 + std::abs(shape[k])));
  }
  std::printf("shape against 800 hinges, worst %.1e\n", worst);
  EXPECT_LT(worst, 2e-4);
}

// ---- a leg in the air, M98 -------------------------------------------------------------------

// The lowest mode of a half circle of hinges that is clamped at its hip, at angle 0; the first part
// of it may be rigid.
struct HingeMode {
  double stiffness;  // square of its frequency
  Eigen::Vector2d mean = Eigen::Vector2d::Zero(), toe;
  double about = 0.0;

  HingeMode(Eigen::Index count, Eigen::Index rigid) {
    const double step = kPi / static_cast<double>(count);
    const auto at = [](double s) { return Eigen::Vector2d(-std::sin(s), std::cos(s) - 1.0); };
    const Eigen::Index free = count - rigid;
    // Columns: what hinge j moves of point i, in the middle of its piece.
    Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(2 * count, free);
    Eigen::MatrixXd end(2, free);
    const auto turned = [](const Eigen::Vector2d& d) { return Eigen::Vector2d(-d.y(), d.x()); };
    const auto middle = [&](Eigen::Index i) { return at((static_cast<double>(i) + 0.5) * step); };
    for (Eigen::Index j = 0; j < free; ++j) {
      const Eigen::Vector2d hinge = at(static_cast<double>(rigid + j) * step);
      end.col(j) = turned(at(kPi) - hinge);
      for (Eigen::Index i = rigid + j; i < count; ++i)
        moves.block<2, 1>(2 * i, j) = turned(middle(i) - hinge);
    }
    Eigen::VectorXd springs = Eigen::VectorXd::Constant(free, 1.0 / step);
    springs(0) *= 2.0;  // half a piece lies before the first
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
        moves.transpose() * moves / static_cast<double>(count),
        springs.asDiagonal().toDenseMatrix());
    stiffness = 1.0 / modes.eigenvalues()(free - 1);
    Eigen::VectorXd shape = modes.eigenvectors().col(free - 1) * std::sqrt(stiffness);
    toe = end * shape;
    if (toe.x() < 0.0) shape = -shape, toe = -toe;
    const Eigen::VectorXd points = moves * shape;
    const double share = 1.0 / static_cast<double>(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Vector2d moved = points.segment<2>(2 * i), from = middle(i);
      mean += share * moved;
      about += share * (from.x() * moved.y() - from.y() * moved.x());
    }
  }
};

TEST(RobotLegBending, IsTheFirstModeOfAHalfCircle) {
  const HingeMode hinges(400, 0);
  const LegBending& mode = FirstBending();
  const Vector2<double> toe = BendingAt(0.0, 0.0), hip = BendingAt(kPi, 0.0);
  EXPECT_NEAR(mode.stiffness, hinges.stiffness, 1e-4);
  EXPECT_NEAR(mode.along, hinges.mean.x(), 1e-4);
  EXPECT_NEAR(mode.up, hinges.mean.y(), 1e-4);
  EXPECT_NEAR(mode.about, hinges.about, 1e-4);
  EXPECT_NEAR(toe.x, hinges.toe.x(), 1e-3);
  EXPECT_NEAR(toe.y, hinges.toe.y(), 1e-3);
  EXPECT_NEAR(std::hypot(hip.x, hip.y), 0.0, 1e-14);
}

// Of what gives way at the contact under a force along the ground it is nearly all, upward less:
// the rest is of higher modes. C of M68 without load, in closed form.
TEST(RobotLegBending, IsMostOfTheComplianceAtTheContact) {
  const auto shares = [](double beta) {
    const double psi = kPi - beta, s = std::sin(psi), c = std::cos(psi);
    const Vector2<double> at = BendingAt(beta, beta);
    const double k = FirstBending().stiffness;
    return std::array{at.x * at.x / k / (1.5 * psi - 2.0 * s + 0.5 * s * c),
                      at.y * at.y / k / (0.5 * (psi - s * c))};
  };
  for (double beta : {0.0, 0.3, 0.6, 1.0}) {
    const auto [along, up] = shares(beta);
    std::printf("beta %.1f: %.3f of the compliance along the ground, %.3f upward\n", beta, along,
                up);
    EXPECT_LT(along, 1.0);
    EXPECT_LT(up, 1.0);
    if (beta <= 0.6) {
      EXPECT_GT(along, 0.97);
    }
  }
  EXPECT_NEAR(shares(0.0)[1], 0.45, 0.01);
  EXPECT_NEAR(shares(1.0)[1], 0.97, 0.01);
}

// A clamp stiffens it; its shape is taken as that without.
TEST(RobotLegBending, IsStifferWithAClamp) {
  for (int rigid : {8, 16, 32}) {
    const HingeMode hinges(400, rigid);
    const double told =
        FirstBending().stiffness * std::pow(1.0 - rigid / 400.0, -LegBending::kByClamp);
    EXPECT_NEAR(told / hinges.stiffness, 1.0, 5e-3) << rigid;
    EXPECT_NEAR(FirstBending().about / hinges.about, 1.0, 0.06) << rigid;
  }
}

// The hinge's error is of the first order where a piece lies across the contact: the half circle on
// its toe, where none does, comes out of the second.
TEST(RobotLegShape, OnItsToeAThirtiethOfTheInertiaFollowsTheMotor) {
  const auto shape = LegShapeByQuadrature(kPi);
  EXPECT_NEAR(shape[LegShape::kBB] / 2.0, 1.0 / 31.5, 5e-4);
  EXPECT_NEAR(shape[LegShape::kYY], 0.52, 0.01);
}

TEST(RobotLegShape, TableIsTheQuadrature) {
  double value = 0.0, slope = 0.0, bend = 0.0;
  constexpr double kStep = 1e-5;
  for (double psi = 1.0; psi < 3.5; psi += 0.0137) {
    const LegShape at = LegShapeAt(psi), up = LegShapeAt(psi + kStep),
                   down = LegShapeAt(psi - kStep);
    const auto exact = LegShapeByQuadrature(psi);
    for (int k = 0; k < LegShape::kCount; ++k) {
      const double size = 1.0 + std::abs(exact[k]);
      value = std::max(value, std::abs(at.value[k] - exact[k]) / size);
      slope = std::max(slope,
                       std::abs((up.value[k] - down.value[k]) / (2 * kStep) - at.slope[k]) / size);
      bend =
          std::max(bend, std::abs((up.slope[k] - down.slope[k]) / (2 * kStep) - at.bend[k]) / size);
    }
  }
  EXPECT_LT(value, 1e-9);
  EXPECT_LT(slope, 1e-7);
  EXPECT_LT(bend, 1e-5);
}

// A step of the integrator that went astray asks for it; a search must live on.
TEST(RobotLegShape, OfNoNumberIsNoNumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(LegShapeAt(none).value[LegShape::kXX]));
  const double far = std::numeric_limits<double>::infinity();
  EXPECT_EQ(LegShapeAt(far).value, LegShapeAt(4.0).value);
}

}  // namespace
}  // namespace hoplab
