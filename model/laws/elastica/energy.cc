#include "model/laws/elastica/energy.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "model/laws/elastica/splines.h"
#include "model/laws/elastica/tables.h"

namespace hoplab::elastica {
namespace {

// What the splines of a cell are at x, with the derivatives by x.
template <int kOrder>
struct Basis {
  double at[kOrder + 1][kSpan];

  explicit Basis(double x) {
    for (int order = 0; order <= kOrder; ++order) {
      const auto& power = kPolynomials.of[order];
      for (int i = 0; i < kSpan; ++i) at[order][i] = power[kDegree - order][i];
      for (int m = kDegree - order; m-- > 0;) {
        for (int i = 0; i < kSpan; ++i) at[order][i] = at[order][i] * x + power[m][i];
      }
    }
  }
};

constexpr double kPhiRate = kPhiCells / (kPhiEnd - kPhiBegin);
constexpr double kLoadRate = kLoadCells / (kLoadEnd - kLoadBegin);

// Where an arc and a load z, in the units of LoadScale, lie in the grid.
struct Spot {
  int i, j;     // cell
  double x, y;  // place in it, 0 to 1

  Spot(double phi, double z)
      : i(CellOf((phi - kPhiBegin) * kPhiRate, kPhiCells)),
        j(CellOf((z - kLoadBegin) * kLoadRate, kLoadCells)),
        x((phi - kPhiBegin) * kPhiRate - i),
        y((z - kLoadBegin) * kLoadRate - j) {}

  // Of what is no number, the first: the place in it is no number either.
  static int CellOf(double x, int cells) {
    if (!(x > 0.0)) return 0;
    return x < cells ? static_cast<int>(x) : cells - 1;
  }
};

// From derivatives by the place in a cell to those by (phi, z).
template <int kOrder>
void Scale(Derivatives<kOrder>& d) {
  double by_phi = 1.0;
  for (int p = 0; p <= kOrder; ++p, by_phi *= kPhiRate) {
    double by_z = by_phi;
    for (int q = 0; p + q <= kOrder; ++q, by_z *= kLoadRate) d[p][q] *= by_z;
  }
}

// b of M61, by the polynomials of its cell: Horner's scheme with derivatives.
template <int kOrder>
Derivatives<kOrder> OfCell(const Spot& at) {
  const double* c = kCells[at.i * kLoadCells + at.j];
  // At x, by powers of y: value, slope, half the second derivative, ...
  double row[kOrder + 1][kSpan] = {};
  for (int m = 0; m < kSpan; ++m) row[0][m] = c[kDegree * kSpan + m];
  for (int k = kDegree; k-- > 0;) {
    for (int p = kOrder; p > 0; --p) {
      for (int m = 0; m < kSpan; ++m) row[p][m] = row[p][m] * at.x + row[p - 1][m];
    }
    for (int m = 0; m < kSpan; ++m) row[0][m] = row[0][m] * at.x + c[k * kSpan + m];
  }
  constexpr double kFactorial[] = {1.0, 1.0, 2.0, 6.0};
  Derivatives<kOrder> d{};
  for (int p = 0; p <= kOrder; ++p) {
    double value[kOrder + 1] = {};
    for (int m = kDegree; m >= 0; --m) {
      for (int q = kOrder - p; q > 0; --q) value[q] = value[q] * at.y + value[q - 1];
      value[0] = value[0] * at.y + row[p][m];
    }
    for (int q = 0; p + q <= kOrder; ++q) d[p][q] = kFactorial[p] * kFactorial[q] * value[q];
  }
  Scale<kOrder>(d);
  return d;
}

// The other tables, by their splines.
template <int kOrder>
class Cell {
 public:
  Cell(double phi, double z) : spot_(phi, z), phi_(spot_.x), z_(spot_.y) {}

  Derivatives<kOrder> Of(Table table) const {
    const double* c = Coefficients(table);
    return Sum([c](int place) { return c[place]; });
  }
  // a times one table and b times another.
  Derivatives<kOrder> Of(Table one, double a, Table other, double b) const {
    const double *c = Coefficients(one), *d = Coefficients(other);
    return Sum([=](int place) { return a * c[place] + b * d[place]; });
  }

 private:
  const double* Coefficients(Table table) const {
    return kCoefficients[table] + static_cast<std::ptrdiff_t>(spot_.i) * kLoadCount + spot_.j;
  }
  Derivatives<kOrder> Sum(const auto& coefficient) const {
    double along[kOrder + 1][kSpan] = {};
    for (int k = 0; k < kSpan; ++k) {
      for (int m = 0; m < kSpan; ++m) {
        const double c = coefficient(k * kLoadCount + m);
        for (int p = 0; p <= kOrder; ++p) along[p][m] += phi_.at[p][k] * c;
      }
    }
    Derivatives<kOrder> d{};
    for (int p = 0; p <= kOrder; ++p) {
      for (int q = 0; p + q <= kOrder; ++q) {
        for (int m = 0; m < kSpan; ++m) d[p][q] += along[p][m] * z_.at[q][m];
      }
    }
    Scale<kOrder>(d);
    return d;
  }

  Spot spot_;
  Basis<kOrder> phi_, z_;
};

// w of LoadScale with three derivatives.
std::array<double, 4> ScaleAt(double phi) {
  constexpr double kUnit = 1.0 / (std::numbers::pi * std::numbers::pi);
  constexpr double a = 3.0 * kUnit, b = -1.9 * kUnit, c = 0.57 * kUnit, d = -0.055 * kUnit;
  return {phi * phi * (a + phi * (b + phi * (c + phi * d))),
          phi * (2.0 * a + phi * (3.0 * b + phi * (4.0 * c + phi * 5.0 * d))),
          2.0 * a + phi * (6.0 * b + phi * (12.0 * c + phi * 20.0 * d)),
          6.0 * b + phi * (24.0 * c + phi * 60.0 * d)};
}

// From derivatives by (phi, z), z = f w(phi), to those by (phi, f).
template <int kOrder>
Derivatives<kOrder> ByLoad(const Derivatives<kOrder>& B, const std::array<double, 4>& w, double f) {
  const double z1 = f * w[1];
  Derivatives<kOrder> b{};
  b[0][0] = B[0][0];
  b[0][1] = B[0][1] * w[0];
  b[1][0] = B[1][0] + B[0][1] * z1;
  if constexpr (kOrder >= 2) {
    const double z2 = f * w[2];
    b[0][2] = B[0][2] * w[0] * w[0];
    b[1][1] = w[0] * (B[1][1] + B[0][2] * z1) + B[0][1] * w[1];
    b[2][0] = B[2][0] + z1 * (2.0 * B[1][1] + B[0][2] * z1) + B[0][1] * z2;
    if constexpr (kOrder >= 3) {
      const double z3 = f * w[3];
      b[0][3] = B[0][3] * w[0] * w[0] * w[0];
      b[1][2] = w[0] * (w[0] * (B[1][2] + B[0][3] * z1) + 2.0 * B[0][2] * w[1]);
      b[2][1] = w[0] * (B[2][1] + z1 * (2.0 * B[1][2] + B[0][3] * z1) + B[0][2] * z2) +
                2.0 * w[1] * (B[1][1] + B[0][2] * z1) + B[0][1] * w[2];
      b[3][0] = B[3][0] + z1 * (3.0 * B[2][1] + z1 * (3.0 * B[1][2] + B[0][3] * z1)) +
                3.0 * z2 * (B[1][1] + B[0][2] * z1) + B[0][1] * z3;
    }
  }
  return b;
}

// The derivatives of phi^kPower b from those of b.
template <int kPower, int kOrder>
Derivatives<kOrder> TimesPower(double phi, const Derivatives<kOrder>& b) {
  double power[kOrder + 1];  // derivatives of phi^kPower
  for (int k = 0; k <= kOrder; ++k) {
    double factor = 1.0;
    for (int m = 0; m < k; ++m) factor *= kPower - m;
    power[k] = factor;
    for (int m = 0; m < kPower - k; ++m) power[k] *= phi;
  }
  Derivatives<kOrder> d{};
  for (int p = 0; p <= kOrder; ++p) {
    for (int q = 0; p + q <= kOrder; ++q) {
      double choose = 1.0;
      for (int k = 0; k <= p; ++k) {
        d[p][q] += choose * power[k] * b[p - k][q];
        choose *= static_cast<double>(p - k) / (k + 1);
      }
    }
  }
  return d;
}

template <int kOrder>
Derivatives<kOrder> EnergyAt(double phi, double f) {
  const std::array<double, 4> w = ScaleAt(phi);
  return TimesPower<5, kOrder>(phi, ByLoad<kOrder>(OfCell<kOrder>(Spot(phi, f * w[0])), w, f));
}

}  // namespace

bool InDomain(double phi, double f) {
  const double z = f * LoadScale(phi);
  return phi > kPhiBegin && phi < kPhiEnd && z > kLoadBegin && z < kLoadEnd;
}

Derivatives<2> EnergyTo2(double phi, double f) { return EnergyAt<2>(phi, f); }
Derivatives<3> EnergyTo3(double phi, double f) { return EnergyAt<3>(phi, f); }

Dissipation DissipationAt(double phi, double f) {
  const std::array<double, 4> w = ScaleAt(phi);
  const Cell<1> cell(phi, f * w[0]);
  Dissipation d;
  d.ff = TimesPower<5, 1>(phi, ByLoad<1>(cell.Of(kDissipationFF), w, f));
  d.fphi = TimesPower<4, 1>(phi, ByLoad<1>(cell.Of(kDissipationFPhi), w, f));
  d.phiphi = TimesPower<3, 1>(phi, ByLoad<1>(cell.Of(kDissipationPhiPhi), w, f));
  for (int k = 1; k <= 2; ++k) {
    // Times f: the derivative by f of f b is b + f b_f.
    d.phiphi = {
        {{f * d.phiphi[0][0], d.phiphi[0][0] + f * d.phiphi[0][1]}, {f * d.phiphi[1][0], 0.0}}};
  }
  d.fphi = {{{f * d.fphi[0][0], d.fphi[0][0] + f * d.fphi[0][1]}, {f * d.fphi[1][0], 0.0}}};
  return d;
}

TorqueBending TorqueBendingOf(double phi, double f, double t) {
  const std::array<double, 4> w = ScaleAt(phi);
  const Cell<2> cell(phi, f * w[0]);
  const auto at_torque = [&](Table first, Table second) {
    return ByLoad<2>(cell.Of(first, t, second, t * t), w, f);
  };
  return {TimesPower<3, 2>(phi, at_torque(kTorqueChord, kTorqueChord2)),
          TimesPower<2, 2>(phi, at_torque(kTorqueLead, kTorqueLead2)),
          {},
          {}};
}

TorqueBending TorqueBendingAt(double phi, double f, double t) {
  TorqueBending out = TorqueBendingOf(phi, f, t);
  const std::array<double, 4> w = ScaleAt(phi);
  const Cell<1> cell(phi, f * w[0]);
  const auto slope = [&](Table first, Table second) {
    return ByLoad<1>(cell.Of(first, 1.0, second, 2.0 * t), w, f);
  };
  out.chord_t = TimesPower<3, 1>(phi, slope(kTorqueChord, kTorqueChord2));
  out.lead_t = TimesPower<2, 1>(phi, slope(kTorqueLead, kTorqueLead2));
  return out;
}

}  // namespace hoplab::elastica
