#pragma once

#include <array>
#include <limits>
#include <optional>
#include <type_traits>

#include "model/laws/extended_statics.h"

namespace hoplab {

// The parameters that the statics of a leg read.
template <class T>
std::array<T*, 14> ReadByStatics(Parameters<T>& p) {
  LawTerms<T>& terms = p.law_terms;
  return {&p.E,
          &p.I,
          &p.G,
          &p.A,
          &p.r,
          &p.k,
          &p.l0,
          &p.kappa,
          &terms.hardening,
          &terms.second_order,
          &terms.higher_order,
          &terms.tip,
          &terms.sole,
          &terms.uneven};
}

// What else they know.
template <class T>
struct StaticsInputs {
  T phi, l, torque, softer;
  double F_near = std::numeric_limits<double>::quiet_NaN();
};

// What the equilibrium asks of the statics, with its rates along the arc and the chord, or without.
template <class T>
struct LegForce {
  T tip_turn, F;
};
template <class T>
struct LegForceAlong {
  T sin, cos;
  Tangent<T> tip_turn, F;
};

// The statics of a leg see few directions, however many T carries: those of the arc, the chord, the
// hip torque, how soft the strip has become, and those of its own parameters that are free. So they
// are evaluated in duals of these alone, and the chain rule brings T's directions in. In doubles
// they are just evaluated.
template <class T>
class LocalStatics {
  static constexpr bool kHasDirections = kJetWidth<T> > 0;
  enum { kPhi, kChord, kTorque, kSofter, kGiven };  // local directions; further ones: parameters
  static constexpr int kLocalWidth = kNarrowJet;
  static constexpr std::size_t kOwn = kLocalWidth - kGiven, kMostParts = 4;

 public:
  using Local = std::conditional_t<kHasDirections, Jet<kLocalWidth>, double>;
  // S: Local, or a tangent of it. A part has room for kOwn parameters.
  template <class S>
  struct Evaluated {
    StaticsInputs<double> at;
    std::array<std::optional<Statics<S>>, kMostParts> parts;
  };

  LocalStatics(const Parameters<T>& parameters, Law law)
      : p_(ConvertParameters<Local>(parameters)), law_(law) {
    Parameters<T> given = parameters;
    const auto inputs = ReadByStatics(given);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const T moved = *inputs[i] - Value(*inputs[i]);
      if (IsZero(moved)) continue;
      places_[count_] = i;
      moved_[count_++] = moved;
    }
  }

  Evaluated<Local> At(const StaticsInputs<double>& at) const {
    return Evaluate<Local>(at, Given(at.phi, kPhi), Given(at.l, kChord), Given(at.softer, kSofter));
  }
  // With rates along the arc and the chord.
  Evaluated<Tangent<Local>> Along(const StaticsInputs<double>& at) const {
    const Local one(1.0), zero(0.0);
    return Evaluate<Tangent<Local>>(at, {Given(at.phi, kPhi), one, zero},
                                    {Given(at.l, kChord), zero, one}, Given(at.softer, kSofter));
  }

  // At inputs whose values are those of the evaluation, but for rounding.
  template <class S>
  LegForce<T> Force(const Evaluated<S>& from, const StaticsInputs<T>& at) const {
    return {Brought(from, at, [](const auto& s) { return Plain(s.tip_turn); }),
            Brought(from, at, [](const auto& s) { return Plain(s.F); })};
  }
  LegForceAlong<T> ForceAlong(const Evaluated<Tangent<Local>>& from,
                              const StaticsInputs<T>& at) const {
    const auto tangent = [&](Tangent<Local> Statics<Tangent<Local>>::*of) {
      return Tangent<T>(Brought(from, at, [of](const auto& s) { return (s.*of).value; }),
                        Brought(from, at, [of](const auto& s) { return (s.*of).rate[0]; }),
                        Brought(from, at, [of](const auto& s) { return (s.*of).rate[1]; }));
    };
    using Of = Statics<Tangent<Local>>;
    return {Brought(from, at, [](const auto& s) { return s.sin.value; }),
            Brought(from, at, [](const auto& s) { return s.cos.value; }), tangent(&Of::tip_turn),
            tangent(&Of::F)};
  }
  // How both go with the softness.
  LegForce<T> ForceBySoftness(const StaticsInputs<T>& at) const {
    const StaticsInputs<double> values = ValuesOf(at);
    const Local one(1.0), zero(0.0);
    const auto from =
        Evaluate<Tangent<Local>>(values, Given(values.phi, kPhi), Given(values.l, kChord),
                                 {Given(values.softer, kSofter), one, zero});
    return {Brought(from, at, [](const auto& s) { return s.tip_turn.rate[0]; }),
            Brought(from, at, [](const auto& s) { return s.F.rate[0]; })};
  }
  Statics<T> Whole(const StaticsInputs<T>& at) const {
    const Evaluated<Local> from = At(ValuesOf(at));
    const auto brought = [&](Local Statics<Local>::*of) {
      return Brought(from, at, [of](const auto& s) { return s.*of; });
    };
    using Of = Statics<Local>;
    return {brought(&Of::sin),    brought(&Of::cos),      brought(&Of::delta),
            brought(&Of::C),      brought(&Of::A2),       brought(&Of::F),
            brought(&Of::soft_F), brought(&Of::tip_turn), brought(&Of::beyond)};
  }

 private:
  static StaticsInputs<double> ValuesOf(const StaticsInputs<T>& at) {
    return {Value(at.phi), Value(at.l), Value(at.torque), Value(at.softer), at.F_near};
  }
  static const Local& Plain(const Local& x) { return x; }
  static const Local& Plain(const Tangent<Local>& x) { return x.value; }

  static Local Given(double value, [[maybe_unused]] int k) {
    if constexpr (kHasDirections)
      return Local(value, k);
    else
      return value;
  }

  template <class S>
  Evaluated<S> Evaluate(const StaticsInputs<double>& at, const S& phi, const S& l,
                        const S& softer) const {
    Evaluated<S> out{at, {}};
    const Local torque = Given(at.torque, kTorque);
    const Situation<S> situation{phi, l, softer, at.F_near};
    std::size_t first = 0;
    for (std::optional<Statics<S>>& part : out.parts) {
      Seed(first);
      part = StaticsAt<S, Local>(p_, law_, torque, situation);
      first += kOwn;
      if (first >= count_) break;
    }
    return out;
  }

  T Brought(const auto& from, const StaticsInputs<T>& at, const auto& quantity) const {
    const Local first = quantity(*from.parts[0]);
    if constexpr (!kHasDirections) {
      return first;
    } else {
      T out = first.a + first.v[kPhi] * (at.phi - from.at.phi) +
              first.v[kChord] * (at.l - from.at.l) +
              first.v[kTorque] * (at.torque - from.at.torque) +
              first.v[kSofter] * (at.softer - from.at.softer);
      for (std::size_t i = 0; i < count_; ++i) {
        const Local part = quantity(*from.parts[i / kOwn]);
        out += part.v[kGiven + static_cast<int>(i % kOwn)] * moved_[i];
      }
      return out;
    }
  }

  void Seed([[maybe_unused]] std::size_t first) const {
    if constexpr (kHasDirections) {
      const auto inputs = ReadByStatics(p_);
      for (std::size_t i = 0; i < count_; ++i) {
        Local& x = *inputs[places_[i]];
        x.v.setZero();
        if (i >= first && i < first + kOwn) x.v[kGiven + static_cast<int>(i - first)] = 1.0;
      }
    }
  }

  mutable Parameters<Local> p_;
  Law law_;
  std::array<std::size_t, 14> places_{};
  std::array<T, 14> moved_{};
  std::size_t count_ = 0;
};

}  // namespace hoplab
