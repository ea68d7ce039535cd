#include "model/laws/elastica/solved_strip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hoplab::elastica {
namespace {

constexpr int kNodes = 48;

// Gauss-Legendre nodes and weights on (-1, 1); `up_to`[i][j]: weight of node j in the integral from
// -1 to node i.
struct Gauss {
  std::array<Real, kNodes> x, w;
  std::array<std::array<Real, kNodes>, kNodes> up_to;

  Gauss() {
    std::array<Real, kNodes> slope;
    for (int i = 0; i < kNodes; ++i) {
      Real z = std::cos(std::numbers::pi_v<Real> * (i + 0.75L) / (kNodes + 0.5L));
      for (int round = 0; round < 12; ++round) {
        const auto p = Legendre(z);
        slope[i] = kNodes * (z * p[kNodes] - p[kNodes - 1]) / (z * z - 1.0L);
        z -= p[kNodes] / slope[i];
      }
      x[i] = z;
      w[i] = 2.0L / ((1.0L - z * z) * slope[i] * slope[i]);
    }
    // By Legendre polynomials: int_-1^x P_n = (P_n+1 - P_n-1)/(2 n + 1).
    for (int i = 0; i < kNodes; ++i) {
      const auto at = Legendre(x[i]);
      for (int j = 0; j < kNodes; ++j) {
        const auto p = Legendre(x[j]);
        Real sum = 0.5L * (x[i] + 1.0L);
        for (int n = 1; n < kNodes; ++n) sum += 0.5L * p[n] * (at[n + 1] - at[n - 1]);
        up_to[i][j] = w[j] * sum;
      }
    }
  }
  static std::array<Real, kNodes + 2> Legendre(Real z) {
    std::array<Real, kNodes + 2> p{1.0L, z};
    for (int n = 1; n <= kNodes; ++n) p[n + 1] = ((2 * n + 1) * z * p[n] - n * p[n - 1]) / (n + 1);
    return p;
  }
};
const Gauss gauss;

// The shape where Gauss' nodes place the tangent, at the angles alpha to the chord:
// kappa^2 = 1 + 2 f (cos alpha - cos foot) - 2 n (sin alpha - sin foot).
struct Nodes {
  std::array<Real, kNodes> cos, sin, curvature, weight;

  explicit Nodes(const Shape& s) {
    const Real half = 0.5L * (s.foot + s.hip), middle = 0.5L * (s.foot - s.hip);
    for (int i = 0; i < kNodes; ++i) {
      const Real alpha = middle + half * gauss.x[i];
      cos[i] = std::cos(alpha);
      sin[i] = std::sin(alpha);
      // Differences of cosines and sines without cancellation.
      const Real a = 0.5L * (alpha + s.foot), d = std::sin(0.5L * (alpha - s.foot));
      curvature[i] = std::sqrt(1.0L - 4.0L * d * (s.f * std::sin(a) + s.n * std::cos(a)));
      weight[i] = half * gauss.w[i];
    }
  }
};

// Solves three linear equations, the right side as fourth column.
std::array<Real, 3> Solve3(std::array<std::array<Real, 4>, 3> J) {
  for (int c = 0; c < 3; ++c) {
    int pivot = c;
    for (int i = c + 1; i < 3; ++i) pivot = std::abs(J[i][c]) > std::abs(J[pivot][c]) ? i : pivot;
    std::swap(J[c], J[pivot]);
    for (int i = 0; i < 3; ++i) {
      if (i == c) continue;
      const Real factor = J[i][c] / J[c][c];
      for (int j = c; j < 4; ++j) J[i][j] -= factor * J[c][j];
    }
  }
  return {J[0][3] / J[0][0], J[1][3] / J[1][1], J[2][3] / J[2][2]};
}

}  // namespace

Size SizeOf(const Shape& s) {
  const Nodes at(s);
  Size size;
  const auto add = [](std::array<Real, 4>& to, Real factor, const std::array<Real, 4>& by) {
    for (int k = 0; k < 4; ++k) to[k] += factor * by[k];
  };
  const Real by_foot = s.f * std::sin(s.foot) + s.n * std::cos(s.foot);
  for (int i = 0; i < kNodes; ++i) {
    const Real k = at.curvature[i], cube = k * k * k;
    // 1/kappa and its slopes with alpha held.
    const std::array<Real, 4> line = {1.0L / k, -by_foot / cube, 0.0L,
                                      (at.sin[i] - std::sin(s.foot)) / cube};
    add(size.length, at.weight[i], line);
    add(size.along, at.weight[i] * at.cos[i], line);
    add(size.across, at.weight[i] * at.sin[i], line);
  }
  // What the ends bring in: kappa is 1 at the foot.
  const Real at_hip = 1.0L / std::sqrt(1.0L + 2.0L * s.f * (std::cos(s.hip) - std::cos(s.foot)) +
                                       2.0L * s.n * (std::sin(s.hip) + std::sin(s.foot)));
  add(size.length, 1.0L, {0.0L, 1.0L, at_hip, 0.0L});
  add(size.along, 1.0L, {0.0L, std::cos(s.foot), at_hip * std::cos(s.hip), 0.0L});
  add(size.across, 1.0L, {0.0L, std::sin(s.foot), -at_hip * std::sin(s.hip), 0.0L});
  return size;
}
Real StrainEnergy(const Shape& s) {
  const Nodes at(s);
  Real sum = 0.0L;
  for (int i = 0; i < kNodes; ++i) {
    const Real more = at.curvature[i] - 1.0L;
    sum += at.weight[i] * 0.5L * more * more / at.curvature[i];
  }
  return sum;
}

Shape Solve(Real phi, Real f, Real t, Shape s) {
  s.f = f;
  for (int round = 0; round < 60; ++round) {
    const Size at = SizeOf(s);
    const auto& a = at.along;
    const std::array<Real, 3> step =
        Solve3({{{at.length[1], at.length[2], at.length[3], phi - at.length[0]},
                 {at.across[1], at.across[2], at.across[3], -at.across[0]},
                 {s.n * a[1], s.n * a[2], a[0] + s.n * a[3], t - s.n * a[0]}}});
    const Real size = std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])});
    const Real keep = size > 0.1L ? 0.1L / size : 1.0L;
    s.foot += keep * step[0];
    s.hip += keep * step[1];
    s.n += keep * step[2];
    if (size < 1e-16L) break;
  }
  return s;
}

StripDissipation DissipationOf(const Shape& s) {
  const Nodes at(s);
  const Real f = s.f, foot = s.foot, turn = f * std::sin(foot);
  // Of the length from the hip to where the tangent is at alpha: slopes by f and by the end angle.
  std::array<Real, kNodes> by_f, by_foot;
  Real phi_f = 0.0L, phi_foot = 2.0L;
  for (int i = 0; i < kNodes; ++i) {
    const Real k = at.curvature[i], cube = k * k * k;
    by_f[i] = -(at.cos[i] - std::cos(foot)) / cube;
    by_foot[i] = -turn / cube;
    phi_f += at.weight[i] * by_f[i];
    phi_foot += at.weight[i] * by_foot[i];
  }
  StripDissipation d{0.0L, 0.0L, 0.0L};
  for (int i = 0; i < kNodes; ++i) {
    Real along_f = 0.0L, along_foot = 1.0L;
    for (int j = 0; j < kNodes; ++j) {
      along_f += foot * gauss.up_to[i][j] * by_f[j];
      along_foot += foot * gauss.up_to[i][j] * by_foot[j];
    }
    const Real k = at.curvature[i];
    const Real k_f = (at.cos[i] - std::cos(foot)) / k + f * at.sin[i] * along_f;
    const Real k_foot = turn / k + f * at.sin[i] * along_foot;
    const Real k_phi = k_foot / phi_foot, k_load = k_f - k_phi * phi_f;
    const Real weight = at.weight[i] / k;
    d.ff += weight * k_load * k_load;
    d.fphi += weight * k_load * k_phi;
    d.phiphi += weight * k_phi * k_phi;
  }
  return d;
}

ByTorque ByTorqueOf(Real phi, const Shape& rest) {
  constexpr Real h = 2e-3L;
  const auto at = [&](int steps) {
    const Shape s = Solve(phi, rest.f, steps * h, rest);
    return std::array<Real, 2>{SizeOf(s).along[0], std::cos(s.foot)};
  };
  const auto none = at(0), more = at(1), less = at(-1), most = at(2), least = at(-2);
  const auto first = [&](int k) {
    return (8.0L * (more[k] - less[k]) - (most[k] - least[k])) / (12.0L * h);
  };
  const auto second = [&](int k) {
    return (16.0L * (more[k] + less[k]) - (most[k] + least[k]) - 30.0L * none[k]) / (24.0L * h * h);
  };
  return {first(0), second(0), first(1), second(1)};
}

}  // namespace hoplab::elastica
