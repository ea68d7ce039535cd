// Writes the tables of the pressed arc (grid.h) as a C++ source: the arc is solved at the nodes by
// quadrature in long double, and splines are put through the values. Run by the build.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "model/laws/elastica/grid.h"
#include "model/laws/elastica/splines.h"

namespace hoplab::elastica {
namespace {

using Real = long double;
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

// An arc of radius 1 and E I = 1 pressed by f along its chord and across it by n at its free end,
// where the tangent makes the angle `foot` with the chord; `hip` at the other end.
struct Shape {
  Real f, n, foot, hip;
};

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

// Length, chord and height of the hip over it, with their slopes in foot, hip and n.
struct Size {
  std::array<Real, 4> length{}, along{}, across{};
};
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

// The arc of length phi under f and the torque t at the hip, which is n times the chord. Newton
// from a guess.
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

// D_ij = int kappa_i kappa_j ds over the loaded arc, the place in the material, counted from the
// hip, held: i, j are f and phi. Without torque.
struct Dissipation {
  Real ff, fphi, phiphi;
};
Dissipation DissipationOf(const Shape& s) {
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
  Dissipation d{0.0L, 0.0L, 0.0L};
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

// Chord and cosine of the tip's angle to it, by the torque at the hip: slope and half the second
// derivative, by differences of fourth order.
struct ByTorque {
  Real chord1, chord2, lead1, lead2;
};
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

using Values = std::array<Real, kTableCount>;
Values ValuesAt(Real phi, Real f, Shape& guess) {
  const Shape s = guess = Solve(phi, f, 0.0L, guess);
  const Real p2 = phi * phi, p3 = p2 * phi, p5 = p3 * p2;
  Values v{};
  v[kEnergy] = (2.0L * std::sin(0.5L * phi) - SizeOf(s).along[0] - StrainEnergy(s) / f) / (f * p5);
  const Dissipation d = DissipationOf(s);
  v[kDissipationFF] = d.ff / p5;
  v[kDissipationFPhi] = d.fphi / (f * p2 * p2);
  v[kDissipationPhiPhi] = d.phiphi / (f * f * p3);
  const ByTorque t = ByTorqueOf(phi, s);
  v[kTorqueChord] = t.chord1 / p3;
  v[kTorqueChord2] = t.chord2 / p3;
  v[kTorqueLead] = t.lead1 / p2;
  v[kTorqueLead2] = t.lead2 / p2;
  return v;
}

// The uniform B-spline of degree 5 whose support begins `x` cells ago.
Real Basis(Real x) {
  if (x <= 0.0L || x >= kDegree + 1.0L) return 0.0L;
  std::array<Real, kDegree + 1> b{};
  b[static_cast<std::size_t>(x)] = 1.0L;
  for (int degree = 1; degree <= kDegree; ++degree) {
    for (int i = 0; i + degree <= kDegree; ++i)
      b[i] = ((x - i) * b[i] + (i + degree + 1 - x) * b[i + 1]) / degree;
  }
  return b[0];
}

// Where a spline over `cells` cells is tied down: at the knots, and in the middle of the outer two
// cells of either end [cells].
std::vector<Real> Ties(int cells) {
  std::vector<Real> x;
  for (int i = 0; i <= cells; ++i) {
    x.push_back(i);
    if (i < 2 || (i >= cells - 2 && i < cells)) x.push_back(i + 0.5L);
  }
  return x;
}

// Solves A X = B in place, rows of B being right-hand sides of many columns.
void SolveDense(std::vector<std::vector<Real>> A, std::vector<std::vector<Real>>& B) {
  const int n = static_cast<int>(A.size());
  for (int c = 0; c < n; ++c) {
    int pivot = c;
    for (int i = c + 1; i < n; ++i) pivot = std::abs(A[i][c]) > std::abs(A[pivot][c]) ? i : pivot;
    std::swap(A[c], A[pivot]);
    std::swap(B[c], B[pivot]);
    for (int i = 0; i < n; ++i) {
      const Real factor = i == c ? 0.0L : A[i][c] / A[c][c];
      if (factor == 0.0L) continue;
      for (int j = c; j < n; ++j) A[i][j] -= factor * A[c][j];
      for (std::size_t j = 0; j < B[i].size(); ++j) B[i][j] -= factor * B[c][j];
    }
  }
  for (int i = 0; i < n; ++i) {
    for (Real& value : B[i]) value /= A[i][i];
  }
}
std::vector<std::vector<Real>> Collocation(int cells) {
  const std::vector<Real> ties = Ties(cells);
  std::vector<std::vector<Real>> A(ties.size(), std::vector<Real>(ties.size()));
  for (std::size_t i = 0; i < ties.size(); ++i) {
    for (std::size_t j = 0; j < ties.size(); ++j) {
      // At the very ends the outermost functions meet a closed support.
      const Real x = ties[i] == cells ? ties[i] - 1e-17L : ties[i];
      A[i][j] = Basis(x - (static_cast<Real>(j) - kDegree));
    }
  }
  return A;
}

using Grid = std::vector<std::vector<Real>>;

// All tables' values on the ties, from the least load outward, each the guess of the next.
std::vector<std::vector<Values>> ValuesOnTies(const std::vector<Real>& phis,
                                              const std::vector<Real>& loads) {
  std::vector<std::vector<Values>> values(phis.size(), std::vector<Values>(loads.size()));
  for (std::size_t i = 0; i < phis.size(); ++i) {
    const Real phi = kPhiBegin + (static_cast<Real>(kPhiEnd) - kPhiBegin) * phis[i] / kPhiCells;
    const auto load_at = [&](Real tie) {
      return (kLoadBegin + (static_cast<Real>(kLoadEnd) - kLoadBegin) * tie / kLoadCells) /
             LoadScale<Real>(phi);
    };
    std::size_t least = 0;
    while (load_at(loads[least]) < 0.0L) ++least;
    const Shape rest{0.0L, 0.0L, 0.5L * phi, 0.5L * phi};
    Shape guess = rest;
    for (std::size_t j = least; j < loads.size(); ++j)
      values[i][j] = ValuesAt(phi, load_at(loads[j]), guess);
    guess = rest;
    for (std::size_t j = least; j-- > 0;) values[i][j] = ValuesAt(phi, load_at(loads[j]), guess);
  }
  return values;
}

void PrintCoefficients(const Grid& c) {
  std::printf("{");
  for (const std::vector<Real>& row : c) {
    for (std::size_t j = 0; j < row.size(); ++j)
      std::printf("%.17Lg,%s", row[j], j % 6 == 5 ? "\n" : "");
  }
  std::printf("},\n");
}

// The polynomial of one cell.
void PrintCell(const Grid& c, int i, int j) {
  std::printf("{");
  for (int k = 0; k < kSpan; ++k) {
    for (int m = 0; m < kSpan; ++m) {
      Real sum = 0.0L;
      for (int a = 0; a < kSpan; ++a) {
        for (int b = 0; b < kSpan; ++b) {
          sum += static_cast<Real>(kPolynomials.of[0][k][a]) * kPolynomials.of[0][m][b] *
                 c[i + a][j + b];
        }
      }
      std::printf("%.17Lg,", sum);
    }
    std::printf("\n");
  }
  std::printf("},\n");
}

int Main() {
  const std::vector<Real> phis = Ties(kPhiCells), loads = Ties(kLoadCells);
  const std::vector<std::vector<Values>> values = ValuesOnTies(phis, loads);
  const auto by_phi = Collocation(kPhiCells), by_load = Collocation(kLoadCells);
  const auto splines_of = [&](int table) {
    Grid c(loads.size(), std::vector<Real>(phis.size()));
    for (std::size_t i = 0; i < phis.size(); ++i) {
      for (std::size_t j = 0; j < loads.size(); ++j) c[j][i] = values[i][j][table];
    }
    SolveDense(by_load, c);
    Grid turned(phis.size(), std::vector<Real>(loads.size()));
    for (std::size_t i = 0; i < phis.size(); ++i) {
      for (std::size_t j = 0; j < loads.size(); ++j) turned[i][j] = c[j][i];
    }
    SolveDense(by_phi, turned);
    return turned;
  };
  std::printf("// Written by make_tables.cc; do not edit.\n");
  std::printf("#include \"model/laws/elastica/tables.h\"\n\nnamespace hoplab::elastica {\n");
  std::printf("const double kCoefficients[kTableCount][kPhiCount * kLoadCount] = {\n");
  for (int table = 0; table < kTableCount; ++table) PrintCoefficients(splines_of(table));
  std::printf("};\n");
  std::printf("const double kCells[kPhiCells * kLoadCells][(kDegree + 1) * (kDegree + 1)] = {\n");
  const Grid c = splines_of(kEnergy);
  for (int i = 0; i < kPhiCells; ++i) {
    for (int j = 0; j < kLoadCells; ++j) PrintCell(c, i, j);
  }
  std::printf("};\n}  // namespace hoplab::elastica\n");
  return 0;
}

}  // namespace
}  // namespace hoplab::elastica

int main() { return hoplab::elastica::Main(); }
