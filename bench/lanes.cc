// Would several stances at once, each in a lane of a wide register, pay? (docs/decisions/0018.) The
// smooth part of a rolling stance of law `consistent` by DOP853, thousands of different ones: one
// at a time and two, four and eight at a time, each lane with its own step, a lane that is through
// taking the next stance. No events, no samples.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "model/integrators/dop853_tables.h"

namespace hoplab::bench {
namespace {

constexpr int kStates = 4;  // x, y, vx, vy
constexpr double kRadius = 0.1, kMass = 1.0, kDamping = 3.0, kGravity = 9.81;
constexpr double kBending = 1.26e-4, kAxial = 2.3e-8, kShear = 7.5e-8;  // M2 [m/N]

template <int W>
struct Lanes {
  typedef double Number __attribute__((vector_size(W * sizeof(double))));
  typedef long Mask __attribute__((vector_size(W * sizeof(long))));
};
template <int W>
using Number = typename Lanes<W>::Number;
template <int W>
using Mask = typename Lanes<W>::Mask;

template <int W>
Number<W> Root(Number<W> x) {
  for (int i = 0; i < W; ++i) x[i] = std::sqrt(x[i]);
  return x;
}
template <int W>
bool All(const Mask<W>& mask) {
  for (int i = 0; i < W; ++i)
    if (mask[i] == 0) return false;
  return true;
}

// M9 to M12: the arc by Newton from the last one, a lane that has it waiting for the others.
template <int W>
struct Leg {
  using S = Number<W>;
  S coordinate{}, phi{}, u0{}, y0{}, by_u0{}, by_y{}, force{};

  void Accelerate(const S* z, S* dz) {
    const S lead0 = coordinate - z[0], y = z[1];
    S arc = phi + by_u0 * (lead0 - u0) + by_y * (y - y0), F{};
    Mask<W> done{};
    for (int round = 0; round < 25 && !All<W>(done); ++round) {
      const S u = lead0 + kRadius * arc, l = Root<W>(u * u + y * y), lead = u / l;
      S s, c;
      for (int i = 0; i < W; ++i) {
        s[i] = std::sin(0.5 * arc[i]);
        c[i] = std::cos(0.5 * arc[i]);
      }
      const S sine = 2.0 * s * c, cosine = 1.0 - 2.0 * s * s;
      const S C = kBending * (2.0 * arc - 3.0 * sine + arc * cosine) + kAxial * (3.0 * sine - arc) +
                  kShear * (arc - sine);
      const S C1 = kBending * (2.0 - 2.0 * cosine - arc * sine) + kAxial * (3.0 * cosine - 1.0) +
                   kShear * (1.0 - cosine);
      const S C2 = kBending * (sine - arc * cosine) - 3.0 * kAxial * sine + kShear * sine;
      const S now = (2.0 * kRadius * s - l) / C;
      const S slope = (kRadius * (c - lead) - now * C1) / C, half = 0.5 * C1 / kRadius;
      const S cube = 1.0 / (l * l * l);
      const S by_arc = kRadius * y * y * cube + 0.5 * s + half * slope + 0.5 * now * C2 / kRadius;
      const S step = -(lead - c + now * half) / by_arc;
      const Mask<W> found = (step < 2e-8) & (step > -2e-8) & ~done;
      phi = found ? arc + step : phi;
      u0 = found ? lead0 : u0;
      y0 = found ? y : y0;
      by_u0 = found ? -(y * y * cube - half / C * lead) / by_arc : by_u0;
      by_y = found ? (u * y * cube + half / C * y / l) / by_arc : by_y;
      F = found ? now + slope * step : F;
      done |= found;
      arc = done ? arc : arc + step;
    }
    const S u = lead0 + kRadius * phi, l = Root<W>(u * u + y * y);
    force = F - kDamping * (y * z[3] - u * z[2]) / l;
    dz[0] = z[2];
    dz[1] = z[3];
    dz[2] = -force * u / l / kMass;
    dz[3] = force * y / l / kMass - kGravity;
  }
};

template <int W>
struct Stepper {
  using S = Number<W>;
  Leg<W> leg;
  S y[kStates], k[dop853::kStages][kStates], step, last_error;

  template <int kRow>
  void Combine(S* out) const {
    for (int i = 0; i < kStates; ++i) {
      S sum{};
      for (int j = 0; j < kRow; ++j)
        if (dop853::kA[kRow][j] != 0.0) sum += dop853::kA[kRow][j] * k[j][i];
      out[i] = y[i] + step * sum;
    }
  }
  template <int kRow>
  void Stage() {
    S at[kStates];
    Combine<kRow>(at);
    leg.Accelerate(at, k[kRow]);
  }
  S Error(const S* next) const {
    S of5{}, of3{};
    for (int i = 0; i < kStates; ++i) {
      S e5{}, e3{}, scale;
      for (int s = 0; s < dop853::kStages; ++s) {
        e5 += dop853::kE5[s] * k[s][i];
        e3 += dop853::kE3[s] * k[s][i];
      }
      for (int q = 0; q < W; ++q)
        scale[q] = 1e-10 + 1e-9 * std::max(std::abs(y[i][q]), std::abs(next[i][q]));
      of5 += e5 / scale * (e5 / scale);
      of3 += e3 / scale * (e3 / scale);
    }
    return step * of5 / Root<W>((of5 + 0.01 * of3) * double{kStates});
  }
  // One step tried in every lane; taken where its error allows.
  void Try() {
    [&]<int... kI>(std::integer_sequence<int, kI...>) { (Stage<kI + 1>(), ...); }
    (std::make_integer_sequence<int, dop853::kStages - 1>{});
    S next[kStates], rate[kStates];
    Combine<dop853::kStages>(next);
    const S error = Error(next);
    const Mask<W> taken = error <= 1.0;
    for (int q = 0; q < W; ++q) {
      const double e = std::max(error[q], 1e-10), from = last_error[q];
      const double grow = 0.9 * std::pow(e, -0.121) * std::pow(from, 0.02);
      step[q] *= e <= 1.0 ? std::clamp(grow, 0.2, 6.0) : std::max(0.1, 0.9 * std::pow(e, -0.125));
      if (e <= 1.0) last_error[q] = std::max(e, 1e-4);
    }
    for (S& state : y) state = taken ? next[&state - y] : state;
    leg.Accelerate(y, rate);
    for (int i = 0; i < kStates; ++i) k[0][i] = taken ? rate[i] : k[0][i];
  }
  // Lane q at touch-down number i.
  void Land(int q, int i) {
    const double theta = 0.35 + 0.2 * (i % 37) / 37.0, phi = std::numbers::pi - theta;
    const double start[] = {0.0, kRadius * (1.0 + std::cos(theta)), 1.0 + 0.5 * (i % 53) / 53.0,
                            -1.0 - 0.5 * (i % 101) / 101.0};
    for (int k_state = 0; k_state < kStates; ++k_state) y[k_state][q] = start[k_state];
    leg.coordinate[q] = leg.u0[q] = kRadius * (std::sin(theta) - phi);
    leg.phi[q] = phi;
    leg.y0[q] = start[1];
    leg.by_u0[q] = leg.by_y[q] = 0.0;
    step[q] = 2e-4;
    last_error[q] = 1e-4;
  }
};

// Microseconds a stance.
template <int W>
double TimeOf(int stances) {
  using Clock = std::chrono::steady_clock;
  Stepper<W> stepper;
  int begun = 0, ended = 0;
  for (int q = 0; q < W; ++q) stepper.Land(q, begun++);
  stepper.leg.Accelerate(stepper.y, stepper.k[0]);
  const auto begin = Clock::now();
  while (ended < stances) {
    stepper.Try();
    bool landed = false;
    for (int q = 0; q < W; ++q) {
      if (stepper.leg.force[q] > 0.0 || stepper.y[3][q] < 0.0) continue;
      ++ended;
      stepper.Land(q, begun++);
      landed = true;
    }
    if (landed) stepper.leg.Accelerate(stepper.y, stepper.k[0]);
  }
  return 1e6 * std::chrono::duration<double>(Clock::now() - begin).count() / ended;
}

int Measure() {
  constexpr int kStances = 4000, kRounds = 9;
  double best[4] = {1e9, 1e9, 1e9, 1e9};
  for (int round = 0; round < kRounds; ++round) {
    const double times[] = {TimeOf<1>(kStances), TimeOf<2>(kStances), TimeOf<4>(kStances),
                            TimeOf<8>(kStances)};
    for (int i = 0; i < 4; ++i) best[i] = std::min(best[i], times[i]);
  }
  fmt::print(
      "a stance: {:.2f} us one at a time, {:.2f} us by two, {:.2f} us by four, {:.2f} us by "
      "eight\n",
      best[0], best[1], best[2], best[3]);
  return 0;
}

}  // namespace
}  // namespace hoplab::bench

int main() { return hoplab::bench::Measure(); }
