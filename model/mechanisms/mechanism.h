#pragma once

#include "model/hybrid/hybrid_system.h"
#include "model/in_place.h"
#include "model/mechanisms/mechanism_setup.h"

namespace hoplab {

/// Room for any mechanism.
template <class T>
using SystemStorage = InPlace<HybridSystem<T>, 16384 + 1024 * sizeof(T)>;

/// A mechanism in every scalar type: how to make one.
struct Mechanism {
  void (*make0)(const MechanismSetup<double>& setup, SystemStorage<double>& system);
  void (*make1)(const MechanismSetup<Jet<1>>& setup, SystemStorage<Jet<1>>& system);
  void (*make_narrow)(const MechanismSetup<Jet<kNarrowJet>>& setup,
                      SystemStorage<Jet<kNarrowJet>>& system);
  void (*make_wide)(const MechanismSetup<Jet<kWideJet>>& setup,
                    SystemStorage<Jet<kWideJet>>& system);
  void (*make_widest)(const MechanismSetup<Jet<kWidestJet>>& setup,
                      SystemStorage<Jet<kWidestJet>>& system);

  template <class T>
  void Make(const MechanismSetup<T>& setup, SystemStorage<T>& system) const {
    if constexpr (kJetWidth<T> == 0)
      make0(setup, system);
    else if constexpr (kJetWidth<T> == 1)
      make1(setup, system);
    else if constexpr (kJetWidth<T> == kNarrowJet)
      make_narrow(setup, system);
    else if constexpr (kJetWidth<T> == kWideJet)
      make_wide(setup, system);
    else
      make_widest(setup, system);
  }
};

template <template <class> class System>
constexpr Mechanism MakeMechanism() {
  return {[](const auto& setup, auto& to) { to.template Emplace<System<double>>(setup); },
          [](const auto& setup, auto& to) { to.template Emplace<System<Jet<1>>>(setup); },
          [](const auto& setup, auto& to) { to.template Emplace<System<Jet<kNarrowJet>>>(setup); },
          [](const auto& setup, auto& to) { to.template Emplace<System<Jet<kWideJet>>>(setup); },
          [](const auto& setup, auto& to) { to.template Emplace<System<Jet<kWidestJet>>>(setup); }};
}

}  // namespace hoplab
