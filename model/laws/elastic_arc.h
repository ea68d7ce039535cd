#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "model/hybrid/discrete_state.h"
#include "model/laws/leg_load.h"
#include "model/leg_compliance.h"

namespace hoplab {

/// A solution of M10 and its slopes with respect to u0 = X0 - x and y: where the next search
/// starts. u0 is NaN when only phi is known.
struct ArcRoot {
  double phi = 0.0, u0 = std::numeric_limits<double>::quiet_NaN(), y = 0.0;
  double d_u0 = 0.0, d_y = 0.0;

  void Save(DiscreteState& to) const {
    for (double value : {phi, u0, y, d_u0, d_y}) to.Put(value);
  }
  void Load(DiscreteState& from) {
    for (double* value : {&phi, &u0, &y, &d_u0, &d_y}) *value = from.Take();
  }
};

/// Laws `consistent` (M9-M12) and `large_deflection` (M9b, M10b, M2b): the contact arc is what
/// static equilibrium of the massless leg makes it, so the leg stores energy in one potential.
template <class T, bool kSecondOrder>
class ElasticArc {
 public:
  static constexpr bool kIsExpansion = kSecondOrder;
  static constexpr Law kLaw = kSecondOrder ? Law::kLargeDeflection : Law::kConsistent;

  explicit ElasticArc(const Parameters<T>& p) : r_(p.r), compliance_(p) {
    const HalfAngle toe(std::numbers::pi);
    const ShapeValue b = BendingShape(toe), a = AxialShape(toe), s = ShearShape(toe);
    toe_C_ = compliance_.Chord(b, a, s);
    toe_dC_ = compliance_.ChordD1(b, a, s) / r_;
    if constexpr (kSecondOrder) {
      const ShapeValue g = SecondOrderShape(toe);
      toe_C2_ = compliance_.second_order * g.value;
      toe_dC2_ = compliance_.second_order * g.d1 / r_;
    }
  }

  /// Where the root search for phi starts next: the arc at touch-down, or another instance's.
  void StartRootAt(double phi) { root_ = ArcRoot{.phi = phi}; }
  void SaveRoot(DiscreteState& to) const { root_.Save(to); }
  void LoadRoot(DiscreteState& from) { root_.Load(from); }

  /// Contact coordinate (X0) of a contact at `x_c` with arc `phi`; M11.
  T ContactCoordinate(const T& x_c, const T& phi) const { return x_c - r_ * phi; }
  /// Contact position x_c of the toe when a leg rolls onto it (phi = pi); M11.
  T ToePosition(const T& coordinate) const { return coordinate + r_ * std::numbers::pi; }

  /// Rolling stance. All fields NaN where no equilibrium is found.
  LegLoad<T> Rolling(const T* z) const {
    const T u0 = z[kContact] - z[kX];
    const T& y = z[kY];
    Equilibrium e = Solve(Value(u0), Value(y));
    LegLoad<T> load;
    if constexpr (kJetWidth<T> == 0) {
      load.phi = e.phi - e.R / e.R_phi;
      load.elastic_force = e.F - e.F_phi * e.R / e.R_phi;
    } else {
      // Implicit function theorem: the residual at the root, in duals with phi held, over R_phi.
      const T u = u0 + r_ * e.phi;
      const T l = sqrt(u * u + y * y);
      const T C = compliance_.Chord(e.b, e.a, e.s);
      const T dC = compliance_.ChordD1(e.b, e.a, e.s) / r_;
      const T delta = 2.0 * r_ * e.sin - l;
      T F, R;
      if constexpr (kSecondOrder) {
        const T C2 = compliance_.second_order * e.g.value;
        const T dC2 = compliance_.second_order * e.g.d1 / r_;
        F = 2.0 * delta / (C + sqrt(C * C + 4.0 * C2 * delta));
        R = u / l - e.cos + F * (0.5 * dC + F * dC2 * (1.0 / 3.0));
      } else {
        F = delta / C;
        R = u / l - e.cos + 0.5 * F * dC;
      }
      const T shift = -R / e.R_phi;
      load.phi = e.phi + shift;
      load.elastic_force = F + e.F_phi * shift;
    }
    load.u = u0 + r_ * load.phi;
    load.y = y;
    using std::sqrt;
    load.l = sqrt(load.u * load.u + y * y);
    load.damping_rate = (y * z[kVy] - load.u * z[kVx]) / load.l;  // w = v_hip . e, M12
    load.contact_rate = T(0.0);
    return load;
  }

  /// Toe stance: phi = pi, x_c fixed, M9 (M9b) alone.
  LegLoad<T> Toe(const T* z) const {
    using std::sqrt;
    LegLoad<T> load = ToeChord(z);
    const T delta = 2.0 * r_ - load.l;
    if constexpr (kSecondOrder) {
      load.elastic_force = 2.0 * delta / (toe_C_ + sqrt(toe_C_ * toe_C_ + 4.0 * toe_C2_ * delta));
    } else {
      load.elastic_force = delta / toe_C_;
    }
    return load;
  }

  /// Guard rolling -> toe: pi - phi.
  T RollingToToe(const LegLoad<T>& load) const { return std::numbers::pi - load.phi; }
  /// Guard toe -> rolling: M10 (M10b) at phi = pi, right side minus u/l.
  T ToeToRolling(const LegLoad<T>& load) const {
    const T& F = load.elastic_force;
    T right = -0.5 * F * toe_dC_;
    if constexpr (kSecondOrder) right -= F * F * toe_dC2_ / 3.0;
    return right - load.u / load.l;
  }

  /// Strain energy [J]: F^2 C/2, with 2 F^3 C2/3 more under `large_deflection`.
  T StrainEnergy(const LegLoad<T>& load) const {
    const T& F = load.elastic_force;
    T energy = 0.5 * F * F * compliance_.ChordAt(load.phi);
    if constexpr (kSecondOrder) {
      const ShapeValue g = SecondOrderShape(HalfAngle(Value(load.phi)));
      const T C2 = compliance_.second_order * Chain(load.phi, g.value, g.d1);
      energy += 2.0 / 3.0 * F * F * F * C2;
    }
    return energy;
  }

  /// F C/l0: the expansion behind M2b is good to about 0.2; 0 for a law that is not an expansion.
  double DeflectionRatio(const LegLoad<T>& load) const {
    if constexpr (!kSecondOrder) return 0.0;
    const double phi = Value(load.phi);
    const double rest = 2.0 * Value(r_) * std::sin(0.5 * phi);
    return Value(load.elastic_force) * Value(compliance_.Chord(phi)) / rest;
  }

  const ArcRoot& root() const { return root_; }

 private:
  struct Equilibrium {
    double phi, sin, cos;       // the arc; sine and cosine of its half
    ShapeValue b, a, s, g;      // shape functions there
    double F, F_phi;            // elastic force and its slope at fixed (u0, y)
    double R, R_phi;            // residual of M10 and its slope
    double slope_F, dF_ddelta;  // dR/dF, dF/d(delta)
  };
  // The contact from the hip at an arc, the chord between them and the lead over it.
  struct Chord {
    double u, l, lead;
  };

  // Fills in all of `e` at the arc e.phi.
  void At(const Chord& c, double y, Equilibrium& e) const {
    const double r = Value(r_);
    const HalfAngle h(e.phi);
    e.sin = h.sin;
    e.cos = h.cos;
    e.b = BendingShape(h);
    e.a = AxialShape(h);
    e.s = ShearShape(h);
    const double l = c.l, lead = c.lead;
    const double delta = 2.0 * r * h.sin - l;
    const double delta_phi = r * (h.cos - lead);
    const double C = Value(compliance_.bending) * e.b.value + Value(compliance_.axial) * e.a.value +
                     Value(compliance_.shear) * e.s.value;
    const double C1 = Value(compliance_.bending) * e.b.d1 + Value(compliance_.axial) * e.a.d1 +
                      Value(compliance_.shear) * e.s.d1;
    const double C2nd = Value(compliance_.bending) * e.b.d2 + Value(compliance_.axial) * e.a.d2 +
                        Value(compliance_.shear) * e.s.d2;
    if constexpr (kSecondOrder) {
      e.g = SecondOrderShape(h);
      const double c2 = Value(compliance_.second_order);
      const double root = std::sqrt(C * C + 4.0 * c2 * e.g.value * delta);
      e.F = 2.0 * delta / (C + root);
      e.dF_ddelta = 1.0 / root;
      e.F_phi = (delta_phi - e.F * C1 - e.F * e.F * c2 * e.g.d1) / root;
      e.R = lead - h.cos + e.F * (0.5 * C1 + e.F * c2 * e.g.d1 / 3.0) / r;
      e.slope_F = (0.5 * C1 + 2.0 / 3.0 * e.F * c2 * e.g.d1) / r;
      e.R_phi = r * y * y / (l * l * l) + 0.5 * h.sin + e.slope_F * e.F_phi +
                e.F * (0.5 * C2nd + e.F * c2 * e.g.d2 / 3.0) / r;
    } else {
      e.F = delta / C;
      e.dF_ddelta = 1.0 / C;
      e.F_phi = (delta_phi - e.F * C1) / C;
      e.R = lead - h.cos + 0.5 * e.F * C1 / r;
      e.slope_F = 0.5 * C1 / r;
      e.R_phi = r * y * y / (l * l * l) + 0.5 * h.sin + e.slope_F * e.F_phi + 0.5 * e.F * C2nd / r;
    }
  }

  // Newton on M10 for phi, F eliminated by M9. R is close to linear in phi with slope about
  // sin(phi/2), so it needs two or three rounds from a first-order prediction.
  Equilibrium Solve(double u0, double y) const {
    constexpr int kMaxRounds = 25;
    // A double's F and phi are corrected once more by the caller, which squares the error; the
    // derivatives of a Jet are not, so they need the root itself.
    constexpr double kStepTolerance = kJetWidth<T> == 0 ? 2e-8 : 1e-13;
    const double r = Value(r_);
    Equilibrium e{};
    double phi = root_.phi;
    if (root_.u0 == root_.u0) phi += root_.d_u0 * (u0 - root_.u0) + root_.d_y * (y - root_.y);
    phi = std::fmin(std::fmax(phi, 0.05), 2.0 * std::numbers::pi - 0.05);
    for (int round = 0; round < kMaxRounds; ++round) {
      e.phi = phi;
      const double u = u0 + r * phi;
      const double l = std::sqrt(u * u + y * y);
      const Chord chord{u, l, u / l};
      At(chord, y, e);
      double step = -e.R / e.R_phi;
      if (std::abs(step) < kStepTolerance) {
        const double cube = 1.0 / (l * l * l);
        root_.phi = phi + step;
        root_.u0 = u0;
        root_.y = y;
        root_.d_u0 = -(y * y * cube - e.slope_F * e.dF_ddelta * chord.lead) / e.R_phi;
        root_.d_y = (u * y * cube + e.slope_F * e.dF_ddelta * y / l) / e.R_phi;
        return e;
      }
      if (!(std::abs(step) < 0.5)) step = std::copysign(0.5, step);  // also catches NaN
      phi += step;
    }
    e.F = e.R = std::numeric_limits<double>::quiet_NaN();
    return e;
  }

  T r_;
  LegCompliance<T> compliance_;
  T toe_C_{}, toe_dC_{}, toe_C2_{}, toe_dC2_{};
  mutable ArcRoot root_;
};

template <class T>
using ConsistentLaw = ElasticArc<T, false>;
template <class T>
using LargeDeflectionLaw = ElasticArc<T, true>;

}  // namespace hoplab
