#pragma once

#include "model/hybrid/automaton.h"
#include "model/hybrid/discrete_state.h"
#include "model/in_place.h"
#include "model/laws/extended_leg.h"
#include "model/laws/leg_load.h"
#include "model/mechanisms/mechanism.h"
#include "model/parameters.h"

namespace hoplab {

/// What carries a body in stance: a massless leg under one law. Its modes are those of stance; the
/// state it is given is LegState.
template <class T>
class Leg {
 public:
  virtual ~Leg() = default;

  /// Height of the hip when an unloaded leg at angle `theta` meets the ground [m].
  virtual T TouchdownHeight(const T& theta) const = 0;
  /// Chord angle from the vertical at touch-down [rad].
  virtual T ChordAngle(const T& theta) const = 0;
  /// Touch-down at leg angle `theta`: sets the contact coordinate, gives the mode of stance.
  virtual Mode Land(const T& theta, T* z) = 0;

  virtual LegLoad<T> Load(Mode mode, const T* z) const = 0;
  /// Chord length at which the leg carries nothing [m].
  virtual T RestChord(const LegLoad<T>& load) const = 0;
  /// Small-load chord stiffness there, M3 [N/m].
  virtual T Stiffness(const LegLoad<T>& load) const = 0;
  virtual T StrainEnergy(const LegLoad<T>& load) const = 0;
  /// Whether the law is an expansion in F C/l0, and that ratio; else 0.
  virtual bool IsExpansion() const { return false; }
  virtual double DeflectionRatio(const LegLoad<T>& /*load*/) const { return 0.0; }

  // Its own events between modes of stance.
  virtual int OwnGuardCount(Mode mode) const = 0;
  virtual GuardSpec OwnGuard(Mode mode, int i) const = 0;
  virtual void OwnGuards(Mode mode, const LegLoad<T>& load, T* g) const = 0;
  /// Reset of one of them.
  virtual Mode ResetStance(EventKind event, T* z) = 0;

  /// Leg angle in stance, leg length in flight, as channels show them.
  virtual T ShownAngle(Mode mode, const LegLoad<T>& load) const = 0;
  virtual T ShownLength(const T& theta) const = 0;
  /// Contact arc in stance; NaN of a leg that has none.
  virtual T ShownArc(const LegLoad<T>& load) const = 0;

  /// A length of it [m]; the default y_min [m]; an undamped period over 2 pi [s].
  virtual double Size() const = 0;
  virtual T LowestHip() const = 0;
  virtual double TimeScale(const LegLoad<T>& load) const = 0;

  /// Where it searches a root.
  virtual void StartSearch(Mode mode, const double* z) = 0;
  virtual void SaveDiscreteState(DiscreteState& to) const = 0;
  virtual void LoadDiscreteState(DiscreteState& from) = 0;

  /// The same leg where an effect adds to its law.
  virtual const ExtendedLeg<T>& extended() const = 0;
};

/// Room for any leg.
template <class T>
using LegStorage = InPlace<Leg<T>, 2048 + 128 * sizeof(T) + sizeof(LocalStatics<T>)>;

/// A law of a leg in every scalar type: what its file registers.
struct LegLaw {
  LawInfo info;
  Mechanism body;  // a point mass on one such leg
  void (*make0)(const Parameters<double>& p, LegStorage<double>& leg);
  void (*make1)(const Parameters<Jet<1>>& p, LegStorage<Jet<1>>& leg);
  void (*make_narrow)(const Parameters<Jet<kNarrowJet>>& p, LegStorage<Jet<kNarrowJet>>& leg);
  void (*make_wide)(const Parameters<Jet<kWideJet>>& p, LegStorage<Jet<kWideJet>>& leg);
  void (*make_widest)(const Parameters<Jet<kWidestJet>>& p, LegStorage<Jet<kWidestJet>>& leg);

  template <class T>
  void Make(const Parameters<T>& p, LegStorage<T>& leg) const {
    if constexpr (kJetWidth<T> == 0)
      make0(p, leg);
    else if constexpr (kJetWidth<T> == 1)
      make1(p, leg);
    else if constexpr (kJetWidth<T> == kNarrowJet)
      make_narrow(p, leg);
    else if constexpr (kJetWidth<T> == kWideJet)
      make_wide(p, leg);
    else
      make_widest(p, leg);
  }
};

/// The leg of a law; one entry per file in model/laws/legs (cmake writes the list). The law of no
/// leg is a bug.
const LegLaw& LegLawOf(Law law);
std::span<const LegLaw* const> AllLegLaws();

}  // namespace hoplab
