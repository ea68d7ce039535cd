#include "model/mechanisms/robot_leg_shape.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "model/jet.h"
#include "model/laws/clamped/rule.h"
#include "model/mechanisms/robot_leg_bending.h"

namespace hoplab {
namespace {

constexpr double kFirst = 0.2, kLast = 3.6;
constexpr int kPieces = 256;
constexpr double kWidth = (kLast - kFirst) / kPieces;

// How a point of the strip moves, at the angle s from the contact, that does not move: (0) as the
// strip turns about the contact, (1), (2) as a force there, forward or up, bends it.
template <class S>
std::array<Vector2<S>, 3> MotionsAt(const S& s) {
  const S c = cos(s), n = sin(s);
  return {{{1.0 - c, n},
           {n - s * c - 0.5 * (s - n * c), s * n + c - 1.0 - 0.5 * n * n},
           {1.0 - c - 0.5 * n * n, n - 0.5 * (s + n * c)}}};
}

// The motions that go with a unit velocity of the hip along and up and a unit rate of the base:
// column k holds the shares of the three above.
template <class S>
std::array<std::array<S, 3>, 3> SharesAt(const S& psi) {
  const auto at = MotionsAt(psi);
  const S c = cos(psi), n = sin(psi);
  // Rows: velocity along, up, rate of the base against which psi grows.
  const std::array<std::array<S, 3>, 3> a = {
      {{at[0].x, at[1].x, at[2].x}, {at[0].y, at[1].y, at[2].y}, {S(-1.0), n - psi, c - 1.0}}};
  const auto minor = [&](int i, int j) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return S(a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1]);
  };
  const S over = 1.0 / (a[0][0] * minor(0, 0) + a[0][1] * minor(0, 1) + a[0][2] * minor(0, 2));
  std::array<std::array<S, 3>, 3> shares;
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) shares[j][k] = minor(k, j) * over;
  return shares;
}

template <class S>
std::array<S, LegShape::kCount> Quadrature(const S& psi) {
  const auto shares = SharesAt(psi);
  const S hip_x = -sin(psi), hip_y = 1.0 - cos(psi);
  std::array<S, LegShape::kCount> sum;
  for (S& v : sum) v = S(0.0);
  // A point at the angle s; behind the contact nothing bends.
  const auto add = [&](const S& s, const S& weight, bool bends) {
    const auto motion = MotionsAt(s);
    std::array<Vector2<S>, 3> v;
    for (int k = 0; k < 3; ++k) {
      v[k] = {motion[0].x * shares[0][k], motion[0].y * shares[0][k]};
      for (int j = 1; j < 3 && bends; ++j) {
        v[k].x += motion[j].x * shares[j][k];
        v[k].y += motion[j].y * shares[j][k];
      }
    }
    const auto dot = [&](int i, int k) { return S(weight * (v[i].x * v[k].x + v[i].y * v[k].y)); };
    const Vector2<S> bending = BendingAt<S>(s + kPi - psi, kPi - psi);
    const S from_x = -sin(s) - hip_x, from_y = 1.0 - cos(s) - hip_y;
    sum[LegShape::kXX] += dot(0, 0);
    sum[LegShape::kXY] += dot(0, 1);
    sum[LegShape::kYY] += dot(1, 1);
    sum[LegShape::kXB] += dot(0, 2);
    sum[LegShape::kYB] += dot(1, 2);
    sum[LegShape::kBB] += dot(2, 2);
    for (int k = 0; k < 3; ++k) {
      sum[LegShape::kAlongX + k] += weight * v[k].x;
      sum[LegShape::kUpX + k] += weight * v[k].y;
      sum[LegShape::kTurnX + k] += weight * (v[k].y * from_x - v[k].x * from_y);
      sum[LegShape::kBendingX + k] += weight * (v[k].x * bending.x + v[k].y * bending.y);
    }
  };
  // Gauss's rule before the contact and behind it.
  for (int k = 0; k < clamped::kNodes; ++k) {
    const double along = 0.5 * (1.0 + clamped::kRule<clamped::kNodes>.node[k]),
                 share = 0.5 * clamped::kRule<clamped::kNodes>.weight[k] / kPi;
    add(psi * along, psi * share, true);
    add((psi - kPi) * along, (kPi - psi) * share, false);
  }
  const Vector2<S> contact = BendingAt<S>(kPi - psi, kPi - psi);
  sum[LegShape::kContactX] = contact.x;
  sum[LegShape::kContactY] = contact.y;
  return sum;
}

// Between two nodes the polynomial of fifth degree that has their values and two derivatives, in
// the part t of the piece that has passed: the slopes are those of the values to the last.
struct Table {
  using Row = std::array<double, LegShape::kCount>;
  std::array<std::array<Row, 6>, kPieces> of;

  Table() {
    LegShape a = NodeAt(0);
    for (int i = 0; i < kPieces; ++i) {
      const LegShape b = NodeAt(i + 1);
      for (int k = 0; k < LegShape::kCount; ++k) {
        const double a1 = a.slope[k] * kWidth, a2 = 0.5 * a.bend[k] * kWidth * kWidth;
        const double b1 = b.slope[k] * kWidth, b2 = 0.5 * b.bend[k] * kWidth * kWidth;
        const double rise = b.value[k] - a.value[k] - a1 - a2, tilt = b1 - a1 - 2.0 * a2,
                     curl = b2 - a2;
        const double c[] = {a.value[k],
                            a1,
                            a2,
                            10.0 * rise - 4.0 * tilt + curl,
                            -15.0 * rise + 7.0 * tilt - 2.0 * curl,
                            6.0 * rise - 3.0 * tilt + curl};
        for (int n = 0; n < 6; ++n) of[i][n][k] = c[n];
      }
      a = b;
    }
  }

 private:
  static LegShape NodeAt(int i) {
    constexpr double kStep = 1e-4;
    const double psi = kFirst + i * kWidth;
    const auto at = [](double x) { return Quadrature(Seeded<Jet<1>>(x, 0, 1.0)); };
    const auto here = at(psi), before = at(psi - kStep), after = at(psi + kStep);
    LegShape node;
    for (int k = 0; k < LegShape::kCount; ++k) {
      node.value[k] = here[k].a;
      node.slope[k] = here[k].v[0];
      node.bend[k] = (after[k].v[0] - before[k].v[0]) / (2.0 * kStep);
    }
    return node;
  }
};

}  // namespace

std::array<double, LegShape::kCount> LegShapeByQuadrature(double psi) { return Quadrature(psi); }

LegShape LegShapeAt(double psi) {
  static const Table table;
  const double x = (std::clamp(psi, kFirst, kLast) - kFirst) / kWidth;
  // Of no number: the last piece, whose polynomial is no number there either.
  const int i = x < kPieces ? static_cast<int>(x) : kPieces - 1;
  const double t = x - i, inside = psi > kFirst && psi < kLast ? 1.0 / kWidth : 0.0;
  const auto& c = table.of[i];
  LegShape shape;
  for (int k = 0; k < LegShape::kCount; ++k) {
    shape.value[k] =
        c[0][k] + t * (c[1][k] + t * (c[2][k] + t * (c[3][k] + t * (c[4][k] + t * c[5][k]))));
    shape.slope[k] =
        inside * (c[1][k] + t * (2.0 * c[2][k] +
                                 t * (3.0 * c[3][k] + t * (4.0 * c[4][k] + t * 5.0 * c[5][k]))));
    shape.bend[k] =
        inside * inside *
        (2.0 * c[2][k] + t * (6.0 * c[3][k] + t * (12.0 * c[4][k] + t * 20.0 * c[5][k])));
  }
  return shape;
}

}  // namespace hoplab
