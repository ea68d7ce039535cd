#pragma once

#include <limits>
#include <optional>

#include "model/hybrid/automaton.h"
#include "model/hybrid/discrete_state.h"
#include "model/laws/leg_load.h"
#include "model/laws/local_statics.h"
#include "model/laws/tangent.h"
#include "model/parameters.h"

namespace hoplab {

// Of extended_search.h.
namespace extended {
template <class T>
struct Place;
}

/// The force along the chord at an arc and a chord, with its slopes: where the search for it begins
/// near by. F is NaN where none is known.
struct NearForce {
  double phi = 0.0, l = 0.0;
  double F = std::numeric_limits<double>::quiet_NaN(), F_phi = 0.0, F_l = 0.0;

  double At(double at_phi, double at_l) const {
    return F + F_phi * (at_phi - phi) + F_l * (at_l - l);
  }
};

/// A solution of the statics of an extended leg, with its slopes in u0 = z[contact] - z[x] and y:
/// where the next search starts. u0 is NaN when only phi (and nearly sink) is known.
struct ExtendedRoot {
  double phi = 0.0;
  double sink = 0.0;  // of the ground under the foot [m]
  double u0 = std::numeric_limits<double>::quiet_NaN(), y = 0.0;
  double phi_u0 = 0.0, phi_y = 0.0, sink_u0 = 0.0, sink_y = 0.0;
  NearForce force = {};

  void Save(DiscreteState& to) const {
    for (double value : {phi, sink, u0, y, phi_u0, phi_y, sink_u0, sink_y, force.phi, force.l,
                         force.F, force.F_phi, force.F_l})
      to.Put(value);
  }
  void Load(DiscreteState& from) {
    for (double* value : {&phi, &sink, &u0, &y, &phi_u0, &phi_y, &sink_u0, &sink_y, &force.phi,
                          &force.l, &force.F, &force.F_phi, &force.F_l})
      *value = from.Take();
  }
};

/// Any leg law with the terms effects bring into it (`LawTerms`; M24-M29 and the table of effects).
/// It knows all laws at once, so that what blends between two of them has one place, and it is
/// slower than the plain ones in `half_circle.h`, `elastic_arc.h` and `straight_leg.h`, which it
/// equals to rounding with all terms null.
///
/// Two unknowns, the contact arc phi and the height Y of the hip over the contact: the tangent at
/// the contact stays on the ground (M10), and the ground sinks under the load (M28). Newton in
/// doubles; derivatives by the implicit function theorem.
template <class T>
class ExtendedLeg {
 public:
  ExtendedLeg(const Parameters<T>& parameters, Law law)
      : p_(parameters),
        values_(active() ? ConvertParameters<double>(parameters) : Parameters<double>()),
        law_(law) {
    if (active()) statics_.emplace(p_, law_);
  }

  /// Whether any term is there: else this class is not asked.
  bool active() const { return p_.law_terms.active; }

  void StartRootAt(double phi) { root_ = ExtendedRoot{.phi = phi, .sink = root_.sink}; }
  void SaveRoot(DiscreteState& to) const { root_.Save(to); }
  void LoadRoot(DiscreteState& from) { root_.Load(from); }

  /// What the leg carries. All fields NaN where no equilibrium is found.
  LegLoad<T> Load(Mode mode, const T* z, const LegConditions<T>& at) const;

  /// What leg and ground hold at a load that came from here [J]: with F^2 C/2 + 2 F^3 A2/3 of M24
  /// (k delta^2/2 + k beta delta^3/(3 r) where the law is a spring), c_g F_y^2/2 of M28. What the
  /// hip torque's own bending holds is not in it.
  T StrainEnergy(Mode mode, const LegLoad<T>& load, const LegConditions<T>& at) const;

  /// Rest length of a straight leg from here on [m].
  void SetRestLength(const T& l0) {
    p_.l0 = l0;
    values_.l0 = Value(l0);
    if (active()) statics_.emplace(p_, law_);
  }

  const ExtendedRoot& root() const { return root_; }

 private:
  // Whether the strip's viscosity acts on its curvature, not on the chord.
  bool DampsAlongArc() const {
    return law_ == Law::kElastica && p_.law_terms.material_damping_active;
  }
  void TurnContact(const T* z, const LegConditions<T>& at, const extended::Place<T>& there,
                   const LegForceAlong<T>& along, LegLoad<T>& load) const;
  void TurnHub(bool rolling, const T* z, const LegForceAlong<T>& along, LegLoad<T>& load) const;
  void AddViscousForce(const T& softer, const T* z, const Tangent<T>& F, LegLoad<T>& load) const;

  Parameters<T> p_;
  Parameters<double> values_;
  Law law_;
  std::optional<LocalStatics<T>> statics_;
  mutable ExtendedRoot root_;
};

}  // namespace hoplab
