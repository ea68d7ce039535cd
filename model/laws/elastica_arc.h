#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "base/nan.h"
#include "model/hybrid/discrete_state.h"
#include "model/laws/elastica/energy.h"
#include "model/laws/leg_load.h"
#include "model/leg_compliance.h"

namespace hoplab {

/// A solution of M62 and its slopes with respect to u0 = X0 - x and y: where the next search
/// starts. u0 is NaN when only phi and f are known.
struct ElasticaRoot {
  double phi = 0.0, f = 0.0, u0 = std::numeric_limits<double>::quiet_NaN(), y = 0.0;
  double phi_u0 = 0.0, phi_y = 0.0, f_u0 = 0.0, f_y = 0.0;
  // Direction of the way to it from the last one, and how the slopes along it change with that way.
  double way_u0 = 0.0, way_y = 0.0, phi_bend = 0.0, f_bend = 0.0;

  /// From the root before; at first, or too near it to tell, there is none.
  void SetBend(const ElasticaRoot& last) {
    const double du = u0 - last.u0, dy = y - last.y, square = du * du + dy * dy;
    if (!(square > 1e-14)) return;
    const double over = 1.0 / std::sqrt(square);
    way_u0 = over * du;
    way_y = over * dy;
    phi_bend = over * ((phi_u0 - last.phi_u0) * way_u0 + (phi_y - last.phi_y) * way_y);
    f_bend = over * ((f_u0 - last.f_u0) * way_u0 + (f_y - last.f_y) * way_y);
  }
  void Save(DiscreteState& to) const {
    for (double value : {phi, f, u0, y, phi_u0, phi_y, f_u0, f_y, way_u0, way_y, phi_bend, f_bend})
      to.Put(value);
  }
  void Load(DiscreteState& from) {
    for (double* value :
         {&phi, &f, &u0, &y, &phi_u0, &phi_y, &f_u0, &f_y, &way_u0, &way_y, &phi_bend, &f_bend})
      *value = from.Take();
  }
};

/// Law `elastica` (M61, M62): the leg between hip and contact is an inextensible arc between two
/// pins, exact for any load; its normal and shear compliance to first order. It stores energy in
/// one potential. Beyond the domain of the tables all fields of a load are NaN.
template <class T>
class ElasticaArc {
 public:
  static constexpr bool kIsExpansion = false;
  static constexpr Law kLaw = Law::kElastica;

  explicit ElasticaArc(const Parameters<T>& p) : r_(p.r), load_unit_(p.E * p.I / (p.r * p.r)) {
    const LegCompliance<T> compliance(p);
    axial_ = compliance.axial * load_unit_ / r_;
    shear_ = compliance.shear * load_unit_ / r_;
  }

  /// Where the root search for phi starts next: the arc at touch-down, or another instance's.
  void StartRootAt(double phi) { root_ = ElasticaRoot{.phi = phi}; }
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
    const Equilibrium e = SolveRolling(Value(u0), Value(y));
    const Place& at = e.at;
    const T u = u0 + r_ * at.phi;
    using std::sqrt;
    const T l = sqrt(u * u + y * y);
    // Implicit function theorem: both residuals at the root, phi and f held.
    const T chord = ChordMiss(at, e.G, e.f, l / r_), tip = TipMiss(at, e.G, e.f, u / l);
    const T f = e.f - (e.inverse[1][0] * tip + e.inverse[1][1] * chord);
    LegLoad<T> load;
    load.phi = at.phi - (e.inverse[0][0] * tip + e.inverse[0][1] * chord);
    load.elastic_force = load_unit_ * f;
    load.u = u0 + r_ * load.phi;
    load.y = y;
    load.l = sqrt(load.u * load.u + y * y);
    load.damping_rate = (y * z[kVy] - load.u * z[kVx]) / load.l;  // w = v_hip . e, M12
    load.contact_rate = T(0.0);
    return load;
  }

  /// Toe stance: phi = pi, x_c fixed, the chord of M62 alone.
  LegLoad<T> Toe(const T* z) const {
    LegLoad<T> load = ToeChord(z);
    const Equilibrium e = SolveToe(Value(load.l) / Value(r_));
    load.elastic_force = load_unit_ * (e.f - e.inverse[1][1] * ChordMiss(Place(std::numbers::pi),
                                                                         e.G, e.f, load.l / r_));
    return load;
  }

  /// Guard rolling -> toe: pi - phi.
  T RollingToToe(const LegLoad<T>& load) const { return std::numbers::pi - load.phi; }
  /// Guard toe -> rolling: the lead of M62 at phi = pi, right side minus u/l.
  T ToeToRolling(const LegLoad<T>& load) const {
    const T f = load.elastic_force / load_unit_;
    const auto G = elastica::EnergyTo2(std::numbers::pi, Value(f));
    const T turn = TipMiss(Place(std::numbers::pi), G, Value(f), load.u / load.l);
    return -(turn + TipByLoad(Place(std::numbers::pi), G, Value(f)) * (f - Value(f)));
  }

  /// Strain energy [J] of M61: Psi - F l.
  T StrainEnergy(const LegLoad<T>& load) const {
    const T f = load.elastic_force / load_unit_;
    const double phi0 = Value(load.phi), f0 = Value(f);
    const auto G = elastica::EnergyTo2(phi0, f0);
    const Place at(phi0);
    const T dphi = load.phi - phi0, df = f - f0;
    const T bent = (G[0][0] + f0 * G[0][1]) + (G[1][0] + f0 * G[1][1]) * dphi +
                   (2.0 * G[0][1] + f0 * G[0][2]) * df;
    const T stretched = Stretch(at) + StretchD1(at) * dphi;
    return r_ * load_unit_ * f * f * (bent + 0.5 * stretched);
  }

  /// No expansion.
  double DeflectionRatio(const LegLoad<T>&) const { return 0.0; }

 private:
  // An arc, with sine and cosine of its half.
  struct Place {
    double phi, sin, cos;

    Place() = default;
    explicit Place(double arc) : phi(arc) {
      const HalfAngle h(arc);
      sin = h.sin;
      cos = h.cos;
    }
    // Near by: by the addition theorem, the small angle's series cut below rounding.
    void MoveTo(double arc) {
      constexpr double kNear = 2e-3;
      const double d = 0.5 * (arc - phi);
      if (!(std::abs(d) < 0.5 * kNear)) {
        *this = Place(arc);
        return;
      }
      const double s = d * (1.0 - d * d * (1.0 / 6.0));
      const double c = 1.0 - d * d * (0.5 - d * d * (1.0 / 24.0));
      const double turned = sin * c + cos * s;
      cos = cos * c - sin * s;
      sin = turned;
      phi = arc;
    }
    // Shape functions of M2 for normal and shear compliance, with two derivatives.
    double sin_phi() const { return 2.0 * sin * cos; }
    double cos_phi() const { return 1.0 - 2.0 * sin * sin; }
    ShapeValue axial() const {
      return {3.0 * sin_phi() - phi, 3.0 * cos_phi() - 1.0, -3.0 * sin_phi()};
    }
    ShapeValue shear() const { return {phi - sin_phi(), 1.0 - cos_phi(), sin_phi()}; }
  };
  struct Equilibrium {
    Place at;
    double f;
    elastica::Derivatives<2> G;
    double inverse[2][2];  // of the slopes of (tip, chord) by (phi, f)
  };

  // Normal and shear compliance over r^3/(E I), and its slope by the arc.
  T Stretch(const Place& at) const { return axial_ * at.axial().value + shear_ * at.shear().value; }
  T StretchD1(const Place& at) const { return axial_ * at.axial().d1 + shear_ * at.shear().d1; }

  // M62: what the chord, over r, and the lead of the contact miss.
  T ChordMiss(const Place& at, const elastica::Derivatives<2>& G, double f, const T& l) const {
    return 2.0 * at.sin - f * (2.0 * G[0][0] + f * G[0][1] + Stretch(at)) - l;
  }
  T TipMiss(const Place& at, const elastica::Derivatives<2>& G, double f, const T& lead) const {
    return lead - at.cos + f * (G[1][0] + 0.5 * StretchD1(at));
  }
  // Their slopes.
  double ChordByLoad(const Place& at, const elastica::Derivatives<2>& G, double f) const {
    return -(2.0 * G[0][0] + f * (4.0 * G[0][1] + f * G[0][2]) + Value(Stretch(at)));
  }
  double TipByLoad(const Place& at, const elastica::Derivatives<2>& G, double f) const {
    return G[1][0] + f * G[1][1] + 0.5 * Value(StretchD1(at));
  }

  static constexpr int kMaxRounds = 30;
  // A double's values are corrected once more by the caller, which squares the error; the
  // derivatives of a Jet are not, so they need the root itself.
  static constexpr double kStepTolerance = kJetWidth<T> == 0 ? 5e-6 : 1e-13;

  // From the last root alone, not carried on.
  static constexpr double kToeTolerance = kJetWidth<T> == 0 ? 1e-7 : 1e-13;

  static Equilibrium Lost() {
    Equilibrium e{};
    e.at.phi = e.f = e.inverse[0][0] = e.inverse[1][1] = kNaN;
    return e;
  }

  Equilibrium SolveRolling(double u0, double y) const {
    const double r = Value(r_);
    double phi = root_.phi, f = root_.f;
    if (root_.u0 == root_.u0) {
      const double du = u0 - root_.u0, dy = y - root_.y;
      const double way = du * root_.way_u0 + dy * root_.way_y;
      phi += root_.phi_u0 * du + root_.phi_y * dy + 0.5 * root_.phi_bend * way * way;
      f += root_.f_u0 * du + root_.f_y * dy + 0.5 * root_.f_bend * way * way;
    }
    Equilibrium e;
    for (int round = 0; round < kMaxRounds; ++round) {
      Confine(phi, f);
      if (round == 0)
        e.at = Place(phi);
      else
        e.at.MoveTo(phi);
      const Place& at = e.at;
      e.f = f;
      e.G = elastica::EnergyTo2(phi, f);
      const double stretch = Value(Stretch(at)), stretch1 = Value(StretchD1(at));
      const double u = u0 + r * phi, l = std::sqrt(u * u + y * y), lead = u / l;
      const double tip = lead - at.cos + f * (e.G[1][0] + 0.5 * stretch1);
      const double chord = 2.0 * at.sin - l / r - f * (2.0 * e.G[0][0] + f * e.G[0][1] + stretch);
      const double stretch2 = Value(axial_) * at.axial().d2 + Value(shear_) * at.shear().d2;
      const double tip_phi =
          r * y * y / (l * l * l) + 0.5 * at.sin + f * (e.G[2][0] + 0.5 * stretch2);
      const double tip_f = e.G[1][0] + f * e.G[1][1] + 0.5 * stretch1;
      const double chord_f = -(2.0 * e.G[0][0] + f * (4.0 * e.G[0][1] + f * e.G[0][2]) + stretch);
      const double chord_phi = at.cos - lead - f * (2.0 * e.G[1][0] + f * e.G[1][1] + stretch1);
      const double over = 1.0 / (tip_phi * chord_f - tip_f * chord_phi);
      e.inverse[0][0] = chord_f * over;
      e.inverse[0][1] = -tip_f * over;
      e.inverse[1][0] = -chord_phi * over;
      e.inverse[1][1] = tip_phi * over;
      const double turn = -(e.inverse[0][0] * tip + e.inverse[0][1] * chord);
      const double press = -(e.inverse[1][0] * tip + e.inverse[1][1] * chord);
      if (std::abs(turn) < kStepTolerance && std::abs(press) < kStepTolerance) {
        if (!elastica::InDomain(phi, f)) return Lost();
        const double cube = 1.0 / (l * l * l);
        const double tip_u = y * y * cube, tip_y = -u * y * cube;
        const double chord_u = -lead / r, chord_y = -y / (l * r);
        ElasticaRoot found = {phi + turn, f + press, u0, y};
        found.phi_u0 = -(e.inverse[0][0] * tip_u + e.inverse[0][1] * chord_u);
        found.phi_y = -(e.inverse[0][0] * tip_y + e.inverse[0][1] * chord_y);
        found.f_u0 = -(e.inverse[1][0] * tip_u + e.inverse[1][1] * chord_u);
        found.f_y = -(e.inverse[1][0] * tip_y + e.inverse[1][1] * chord_y);
        found.SetBend(root_);
        root_ = found;
        return e;
      }
      if (!std::isfinite(turn) || !std::isfinite(press)) return Lost();
      phi += std::abs(turn) < 0.3 ? turn : std::copysign(0.3, turn);
      f += std::abs(press) < 0.3 ? press : std::copysign(0.3, press);
    }
    return Lost();
  }

  Equilibrium SolveToe(double l) const {
    static const Place at(std::numbers::pi);
    Equilibrium e;
    e.at = at;
    double f = root_.f;
    for (int round = 0; round < kMaxRounds; ++round) {
      double phi = at.phi;
      Confine(phi, f);
      e.f = f;
      e.G = elastica::EnergyTo2(at.phi, f);
      e.inverse[1][1] = 1.0 / ChordByLoad(at, e.G, f);
      const double chord =
          2.0 * at.sin - f * (2.0 * e.G[0][0] + f * e.G[0][1] + Value(Stretch(at))) - l;
      const double press = -e.inverse[1][1] * chord;
      if (std::abs(press) < kToeTolerance) {
        root_.f = f + press;
        return elastica::InDomain(at.phi, f) ? e : Lost();
      }
      if (!std::isfinite(press)) return Lost();
      f += std::abs(press) < 0.3 ? press : std::copysign(0.3, press);
    }
    return Lost();
  }

  // Keeps a search where the tables are not far.
  static void Confine(double& phi, double& f) {
    phi = std::fmin(std::fmax(phi, elastica::kPhiBegin), elastica::kPhiEnd);
    const double scale = elastica::LoadScale(phi), z = f * scale;
    if (z < elastica::kLoadBegin) f = elastica::kLoadBegin / scale;
    if (z > elastica::kLoadEnd) f = elastica::kLoadEnd / scale;
  }

  T r_;
  T load_unit_;      // E I/r^2 [N]
  T axial_, shear_;  // factors of the shapes in M2 over r^3/(E I)
  mutable ElasticaRoot root_;
};

template <class T>
using ElasticaLaw = ElasticaArc<T>;

}  // namespace hoplab
