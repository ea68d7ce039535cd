// Writes the tables of the pressed arc (grid.h) as a C++ source: the arc is solved at the nodes by
// quadrature in long double, and splines are put through the values. Run by the build.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "model/laws/elastica/grid.h"
#include "model/laws/elastica/solved_strip.h"
#include "model/laws/elastica/splines.h"

namespace hoplab::elastica {
namespace {

using Values = std::array<Real, kTableCount>;
Values ValuesAt(Real phi, Real f, Shape& guess) {
  const Shape s = guess = Solve(phi, f, 0.0L, guess);
  const Real p2 = phi * phi, p3 = p2 * phi, p5 = p3 * p2;
  Values v{};
  v[kEnergy] = (2.0L * std::sin(0.5L * phi) - SizeOf(s).along[0] - StrainEnergy(s) / f) / (f * p5);
  const StripDissipation d = DissipationOf(s);
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
