#pragma once

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>

#include "model/hybrid/automaton.h"
#include "model/integrators/integrator_options.h"
#include "model/jet.h"

namespace hoplab {

/// |guard|/scale below which a guard counts as at zero: rounding of a state of size one.
inline constexpr double kAtZero = 1e-11;
/// Two guards reach zero at the same instant if this close in time [s]: well above the accuracy of
/// an event time, well below anything a trace resolves.
inline constexpr double kSimultaneous = 1e-9;
/// |rate|/scale of a guard [1/s] below which a crossing counts as grazing: M16 would magnify
/// rounding to 1e-5 there.
inline constexpr double kGrazingRate = 1e-6;

/// Values of the guards of a mode in units of their scales, and their rates along the flow [1/s].
struct GuardRates {
  std::array<double, kMaxGuards> value, rate;
};
/// Where a guard reached zero; guard -1: none did.
struct Crossing {
  int guard = -1;
  double time = 0.0;
};
/// Which guards have been open since their mode began: only those can cross.
using ArmedGuards = std::array<bool, kMaxGuards>;

/// Watches the guards of a hybrid automaton along its flow and finds their zeros. It holds the
/// automaton twice: in double for values, in Jet<1> for rates along the flow.
template <template <class> class System>
class GuardWatch {
 public:
  static constexpr int kDim = System<double>::kDim;

  GuardWatch(const System<double>& value_system, const System<Jet<1>>& rate_system)
      : value_system_(value_system), rate_system_(rate_system) {}

  /// Takes over the discrete state of the automaton that runs.
  template <class Other>
  void Follow(const Other& running) {
    value_system_.CopyHidden(running);
    rate_system_.CopyHidden(running);
  }
  /// dz/dt of the values.
  void Flow(Mode mode, double t, const double* z, double* dz) const {
    value_system_.Derivative(mode, t, z, dz);
  }
  double Flexure(Mode mode, const double* z) const { return value_system_.Flexure(mode, z); }

  GuardRates RatesAt(Mode mode, double t, const double* z) const {
    std::array<double, kDim> f;
    Flow(mode, t, z, f.data());
    std::array<Jet<1>, kDim> zj;
    for (int i = 0; i < kDim; ++i) zj[i] = Seeded<Jet<1>>(z[i], 0, f[i]);
    std::array<Jet<1>, kMaxGuards> g;
    rate_system_.Guards(mode, Seeded<Jet<1>>(t, 0, 1.0), zj.data(), g.data());
    GuardRates out{};
    const int count = value_system_.GuardCount(mode);
    for (int i = 0; i < count; ++i) {
      const double scale = value_system_.Guard(mode, i).scale;
      out.value[i] = Value(g[i]) / scale;
      out.rate[i] = Slope(g[i], 0) / scale;
    }
    return out;
  }

  /// Guards that may fire from a state where they stand as `at`: open, or at zero and opening.
  ArmedGuards Arm(Mode mode, const GuardRates& at) const {
    ArmedGuards armed{};
    const int count = value_system_.GuardCount(mode);
    for (int i = 0; i < count; ++i)
      armed[i] = at.value[i] > kAtZero || (std::abs(at.value[i]) <= kAtZero && at.rate[i] > 0.0);
    return armed;
  }

  /// First crossing inside the stepper's last step, given the guards at both its ends. Guards that
  /// open in it are armed. `nearest_miss` falls to the lowest value of a guard that turned back.
  template <class Stepper>
  Crossing FirstCrossing(Mode mode, Stepper& stepper, const GuardRates& before,
                         const GuardRates& after, ArmedGuards& armed, double& nearest_miss) const {
    Crossing first;
    const int count = value_system_.GuardCount(mode);
    for (int i = 0; i < count; ++i) {
      if (!armed[i]) {
        armed[i] = after.value[i] > 0.0;
        continue;
      }
      Crossing found;
      if (after.value[i] < 0.0) {
        found = Locate(mode, stepper, i, before.value[i], stepper.t0(), stepper.t1());
      } else if (before.rate[i] < 0.0 && after.rate[i] > 0.0) {
        found = LookForDip(mode, stepper, i, before, after, nearest_miss);
      }
      if (found.guard >= 0 && (first.guard < 0 || found.time < first.time)) first = found;
    }
    return first;
  }

  /// Ends the stepper's last step on the guard: steps to the crossing and corrects by Newton until
  /// the time moves no more than a first-order correction can mend exactly. False: solver failed.
  template <class Stepper>
  bool Polish(Mode mode, Stepper& stepper, Crossing& crossing) const {
    constexpr int kMaxRounds = 8;
    for (int round = 0; round < kMaxRounds; ++round) {
      if (crossing.time <= stepper.t0()) return true;
      if (stepper.EndAt(crossing.time) == StepStatus::kFailed) return false;
      const GuardRates at = RatesAt(mode, crossing.time, stepper.y1());
      const double correction = -at.value[crossing.guard] / at.rate[crossing.guard];
      const double step = crossing.time - stepper.t0();
      if (!std::isfinite(correction) || std::abs(correction) > 0.5 * step) return true;
      if (std::abs(correction) < kSimultaneous) return true;
      crossing.time += correction;
    }
    return true;
  }

 private:
  // Guard i inside the stepper's last step, in units of its scale.
  template <class Stepper>
  auto GuardInside(Mode mode, Stepper& stepper, int i) const {
    return [this, mode, &stepper, i, scale = value_system_.Guard(mode, i).scale](double t) {
      std::array<double, kDim> z;
      std::array<double, kMaxGuards> g;
      stepper.ValueAt(t, z.data());
      value_system_.Guards(mode, t, z.data(), g.data());
      return g[i] / scale;
    };
  }

  // First zero of guard i between a and b, on the continuous extension.
  template <class Stepper>
  Crossing Locate(Mode mode, Stepper& stepper, int i, double value_before, double a,
                  double b) const {
    const auto g = GuardInside(mode, stepper, i);
    double ga = value_before;
    const double gb = g(b);
    if (!(gb < 0.0)) return {i, b};  // at zero within the extension's error: Polish decides
    if (ga <= kAtZero) {
      // The guard opened at the very start of the step: leave that zero behind.
      double ahead = 1e-3 * (b - a);
      ga = g(a + ahead);
      for (int doubling = 0; doubling < 9 && !(ga > 0.0); ++doubling) {
        ahead *= 2.0;  // up to half the step
        ga = g(a + ahead);
      }
      if (!(ga > 0.0)) return {i, a};
      a += ahead;
    }
    std::uintmax_t rounds = 60;
    const auto bracket = boost::math::tools::toms748_solve(
        g, a, b, ga, gb, boost::math::tools::eps_tolerance<double>(34), rounds);
    return {i, 0.5 * (bracket.first + bracket.second)};
  }

  // A guard that came down and turned back inside the step: did it cross in between?
  template <class Stepper>
  Crossing LookForDip(Mode mode, Stepper& stepper, int i, const GuardRates& before,
                      const GuardRates& after, double& nearest_miss) const {
    const double a = stepper.t0(), b = stepper.t1();
    // Both tangents stay above zero where they meet: cannot have crossed unless it wiggles.
    const double meet = (before.value[i] - after.value[i] + after.rate[i] * (b - a)) /
                        (after.rate[i] - before.rate[i]);
    if (before.value[i] + before.rate[i] * meet > 0.5 * std::min(before.value[i], after.value[i]))
      return {};
    const auto lowest =
        boost::math::tools::brent_find_minima(GuardInside(mode, stepper, i), a, b, 30);
    nearest_miss = std::min(nearest_miss, std::max(lowest.second, 0.0));
    if (lowest.second >= 0.0) return {};
    return Locate(mode, stepper, i, before.value[i], a, lowest.first);
  }

  System<double> value_system_;
  System<Jet<1>> rate_system_;
};

}  // namespace hoplab
