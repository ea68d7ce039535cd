#include "model/laws/clamped/equilibrium.h"

#include <cmath>

#include "base/nan.h"

namespace hoplab::clamped {
namespace {

constexpr int kMaxRounds = 30;
constexpr double kMostStep = 0.2;

Solution Lost() {
  Solution e;
  e.at.tip = e.at.base = e.fx = e.fy = e.sum.one = kNaN;
  e.c11 = e.c12 = e.c22 = e.h1 = e.h2 = e.i11 = e.i12 = e.i22 = e.kx = e.ky = kNaN;
  e.miss_x = e.miss_y = e.x = e.kappa = kNaN;
  return e;
}

// The unknowns.
struct Guess {
  double fx, fy, tip;
};

// From the last solution along its slopes; `lean` is fx/fy of a foot that slides.
Guess GuessFrom(const Root& root, const Stand& s, double lean) {
  Guess g{root.fx, root.fy, root.tip};
  if (root.a == root.a) {
    const double dp = s.base - root.base;
    const double x = s.a - root.a + root.h1 * dp, y = root.b - s.b + root.h2 * dp;
    const double dy = s.foot.slides != 0.0 ? y * root.i22 : root.i12 * x + root.i22 * y;
    const double dx = s.foot.slides != 0.0 ? lean * dy : root.i11 * x + root.i12 * y;
    g.fx += dx;
    g.fy += dy;
    g.tip += root.turn_x * dx + root.turn_y * dy + root.turn_base * dp;
  }
  if (s.foot.rolling) g.tip = 0.0;
  if (s.foot.slides != 0.0) g.fx = lean * g.fy;
  return g;
}

// Fills in what the leg answers at e.at under e.fx, e.fy, from e.sum; false beyond its domain.
bool Respond(const Stand& s, Solution& e) {
  const double c0 = e.at.cos_tip, s0 = e.at.sin_tip, fx = e.fx, fy = e.fy;
  const auto& k = e.sum;
  const double kappa2 = 1.0 + 2.0 * (fx * (c0 - e.at.cos_base) + fy * (e.at.sin_base - s0));
  if (!(kappa2 > kLeastCurvature2)) return false;
  e.kappa = std::sqrt(kappa2);
  e.kx = c0 * k.k1 - k.kc;
  e.ky = k.ks - s0 * k.k1;
  e.c11 = c0 * (c0 * k.k1 - 2.0 * k.kc) + k.kcc;
  e.c12 = c0 * (k.ks - s0 * k.k1) - k.kcs + s0 * k.kc;
  e.c22 = k.kss - s0 * (2.0 * k.ks - s0 * k.k1);
  e.h1 = (c0 - e.at.cos_base) / e.kappa;
  e.h2 = (e.at.sin_base - s0) / e.kappa;
  if (s.foot.rolling) {
    e.x = k.c - k.one;
    e.miss_x = s.a - e.x;
    e.miss_y = k.s - s.b;
  } else {
    // The tip's turn follows from the length (M68).
    const double q = fx * s0 + fy * c0;
    const double by_tip = 1.0 / (q * k.k1 - 1.0), over = k.one - s.length;
    e.by_tip = by_tip;
    e.turn_x = e.kx * by_tip;
    e.turn_y = e.ky * by_tip;
    e.turn_base = -by_tip / e.kappa;
    e.tip_miss = -by_tip * over;
    e.c11 -= q * e.kx * e.turn_x;
    e.c12 -= q * e.kx * e.turn_y;
    e.c22 -= q * e.ky * e.turn_y;
    e.h1 += q * e.kx * e.turn_base;
    e.h2 += q * e.ky * e.turn_base;
    e.x = k.c - c0 * over - q * e.kx * e.tip_miss;
    e.miss_x = s.a - e.x;
    e.miss_y = k.s - s0 * over - s.b + q * e.ky * e.tip_miss;
  }
  const double det = 1.0 / (e.c11 * e.c22 - e.c12 * e.c12);
  e.i11 = e.c22 * det;
  e.i12 = -e.c12 * det;
  e.i22 = e.c11 * det;
  return true;
}

// The root a last step (dx, dy) away from `e`.
Root RootAfter(const Stand& s, const Solution& e, double lean, double dx, double dy) {
  const bool slides = s.foot.slides != 0.0;
  return {e.fx + dx,
          e.fy + dy,
          s.foot.rolling ? 0.0 : e.at.tip + e.tip_miss + e.turn_x * dx + e.turn_y * dy,
          slides ? 0.0 : s.a,
          s.b,
          s.base,
          e.i11,
          e.i12,
          slides ? 1.0 / (e.c22 + lean * e.c12) : e.i22,
          e.h1,
          e.h2,
          e.turn_x,
          e.turn_y,
          e.turn_base};
}

}  // namespace

Solution SolveStand(const Stand& stand, double tolerance, Root& root) {
  const Footing& foot = stand.foot;
  const double lean = -foot.slides * stand.mu;
  Guess g = GuessFrom(root, stand, lean);
  Solution e;
  double halving = 1.0;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (round == 0 || !foot.rolling) e.at = Tangents(g.tip, stand.base);
    e.fx = g.fx;
    e.fy = g.fy;
    e.sum = IntegralsOf(e.at, g.fx, g.fy);
    if (!(e.sum.one == e.sum.one)) {
      // Beyond the domain: come back towards the unloaded leg.
      halving *= 0.5;
      if (!(halving > 1e-3)) return Lost();
      g.fx *= 0.5;
      g.fy *= 0.5;
      continue;
    }
    if (!Respond(stand, e)) return Lost();
    double dx = e.i11 * e.miss_x + e.i12 * e.miss_y;
    double dy = e.i12 * e.miss_x + e.i22 * e.miss_y;
    if (foot.slides != 0.0) {
      dy = e.miss_y / (e.c22 + lean * e.c12);
      dx = lean * dy;
    }
    const double size = std::fmax(std::abs(dx), std::abs(dy));
    if (size < tolerance && std::abs(e.tip_miss) < tolerance) {
      root = RootAfter(stand, e, lean, dx, dy);
      return e;
    }
    if (!std::isfinite(size)) return Lost();
    const double part = size > kMostStep ? kMostStep / size : 1.0;
    g.fx += part * dx;
    g.fy += part * dy;
    if (!foot.rolling) g.tip += part * (e.tip_miss + e.turn_x * dx + e.turn_y * dy);
  }
  return Lost();
}

}  // namespace hoplab::clamped
