#include "model/hybrid/event_location.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

namespace hoplab {

GuardRates GuardWatch::RatesAt(Mode mode, double t, const double* z, const double* flow) const {
  const int states = values_.size();
  double own_flow[kMaxStates];
  if (flow == nullptr) {
    Flow(mode, t, z, own_flow);
    flow = own_flow;
  }
  Jet<1> zj[kMaxStates], g[kMaxGuards];
  for (int i = 0; i < states; ++i) zj[i] = Seeded<Jet<1>>(z[i], 0, flow[i]);
  rates_.Guards(mode, Seeded<Jet<1>>(t, 0, 1.0), zj, g);
  GuardRates out{};
  const int count = values_.GuardCount(mode);
  for (int i = 0; i < count; ++i) {
    const double scale = values_.Guard(mode, i).scale;
    out.value[i] = Value(g[i]) / scale;
    out.rate[i] = Slope(g[i], 0) / scale;
  }
  return out;
}

ArmedGuards GuardWatch::Arm(Mode mode, const GuardRates& at) const {
  ArmedGuards armed{};
  const int count = values_.GuardCount(mode);
  for (int i = 0; i < count; ++i) {
    const bool slow = TraitsOf(values_.Guard(mode, i).event).opens_slowly;
    armed[i] = at.value[i] > kAtZero ||
               (std::abs(at.value[i]) <= kAtZero && at.rate[i] > (slow ? -kGrazingRate : 0.0));
  }
  return armed;
}

GuardCrossing GuardWatch::FirstCrossing(Mode mode, Stepper& stepper, const GuardRates& before,
                                        const GuardRates& after, ArmedGuards& armed,
                                        double& nearest_miss) const {
  GuardCrossing first;
  const int count = values_.GuardCount(mode);
  for (int i = 0; i < count; ++i) {
    if (!armed[i]) {
      armed[i] = after.value[i] > 0.0;
      continue;
    }
    GuardCrossing found;
    // One that opens with no rate, as the cone of a foot that comes to hold, is at zero by rounding
    // where it begins, on either side.
    if (after.value[i] < (before.value[i] > kAtZero ? 0.0 : -kAtZero)) {
      found = Locate(mode, stepper, i, before.value[i], stepper.t0(), stepper.t1());
    } else if (before.rate[i] < 0.0 && after.rate[i] > 0.0) {
      found = LookForDip(mode, stepper, i, before, after, nearest_miss);
    }
    if (found.guard >= 0 && (first.guard < 0 || found.time < first.time)) first = found;
  }
  return first;
}

bool GuardWatch::Polish(Mode mode, Stepper& stepper, GuardCrossing& crossing) const {
  constexpr int kMaxRounds = 8;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (crossing.time <= stepper.t0()) return true;
    if (stepper.EndAt(crossing.time) == StepStatus::kFailed) return false;
    const GuardRates at = RatesAt(mode, crossing.time, stepper.y1(), stepper.rate1());
    const double correction = -at.value[crossing.guard] / at.rate[crossing.guard];
    const double step = crossing.time - stepper.t0();
    if (!std::isfinite(correction) || std::abs(correction) > 0.5 * step) return true;
    if (std::abs(correction) < kSimultaneous) return true;
    crossing.time += correction;
  }
  return true;
}

// Guard i inside the stepper's last step, in units of its scale.
auto GuardWatch::GuardInside(Mode mode, Stepper& stepper, int i) const {
  return [this, mode, &stepper, i, scale = values_.Guard(mode, i).scale](double t) {
    double z[kMaxStates], g[kMaxGuards];
    stepper.ValueAt(t, z);
    values_.Guards(mode, t, z, g);
    return g[i] / scale;
  };
}

// First zero of guard i between a and b, on the continuous extension.
GuardCrossing GuardWatch::Locate(Mode mode, Stepper& stepper, int i, double value_before, double a,
                                 double b) const {
  const auto g = GuardInside(mode, stepper, i);
  double ga = value_before;
  const double gb = g(b);
  if (!(gb < 0.0)) return {i, b};  // at zero within the extension's error: Polish decides
  if (ga <= kAtZero) {
    // The guard opened at the very start of the step: leave that zero behind. One that does not
    // stay open closes there; the step ends a little later, since it cannot end where it began.
    const double least = 1e-3 * (b - a);
    double ahead = least;
    ga = g(a + ahead);
    for (int doubling = 0; doubling < 9 && !(ga > 0.0); ++doubling) {
      ahead *= 2.0;  // up to half the step
      ga = g(a + ahead);
    }
    if (!(ga > 0.0)) return {i, a + least};
    a += ahead;
  }
  if (!(a < b)) return {i, b};
  std::uintmax_t rounds = 60;
  const auto bracket = boost::math::tools::toms748_solve(
      g, a, b, ga, gb, boost::math::tools::eps_tolerance<double>(34), rounds);
  return {i, 0.5 * (bracket.first + bracket.second)};
}

// A guard that came down and turned back inside the step: did it cross in between?
GuardCrossing GuardWatch::LookForDip(Mode mode, Stepper& stepper, int i, const GuardRates& before,
                                     const GuardRates& after, double& nearest_miss) const {
  const double a = stepper.t0(), b = stepper.t1();
  // Both tangents stay above zero where they meet: cannot have crossed unless it wiggles.
  const double meet = (before.value[i] - after.value[i] + after.rate[i] * (b - a)) /
                      (after.rate[i] - before.rate[i]);
  if (before.value[i] + before.rate[i] * meet > 0.5 * std::min(before.value[i], after.value[i]))
    return {};
  const auto lowest =
      boost::math::tools::brent_find_minima(GuardInside(mode, stepper, i), a, b, 30);
  const bool begins_at_zero = before.value[i] <= kAtZero;
  if (!begins_at_zero) nearest_miss = std::min(nearest_miss, std::max(lowest.second, 0.0));
  if (lowest.second >= (begins_at_zero ? -kAtZero : 0.0)) return {};
  return Locate(mode, stepper, i, before.value[i], a, lowest.first);
}

}  // namespace hoplab
