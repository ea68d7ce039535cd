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

// From one place of the hip to another; the lead of a foot that slides is not one.
struct Way {
  double a, b, base;
};
Way Between(const Root& from, const Root& to) {
  return {to.a - from.a, to.b - from.b, to.base - from.base};
}
double Product(const Way& v, const Way& w) { return v.a * w.a + v.b * w.b + v.base * w.base; }

// What the slopes of a root make of a way; `lean` is fx/fy of a foot that slides.
Guess Along(const Root& root, const Way& way, bool slides, double lean) {
  const double x = way.a + root.h1 * way.base, y = root.h2 * way.base - way.b;
  const double dy = slides ? y * root.i22 : root.i12 * x + root.i22 * y;
  const double dx = slides ? lean * dy : root.i11 * x + root.i12 * y;
  return {dx, dy, root.turn_x * dx + root.turn_y * dy + root.turn_base * way.base};
}

// Beyond so many of the way between the last two roots nothing but slopes is carried on.
constexpr double kFarthest = 6.0;

// From the last root along its slopes, and by how these and the root changed since the one before:
// the cubic of both roots and both slopes where the hip goes straight on.
Guess GuessFrom(const Roots& roots, const Stand& s, double lean) {
  const Root &last = roots.last, &before = roots.before;
  const bool slides = s.foot.slides != 0.0;
  Guess g{last.fx, last.fy, last.tip};
  const auto add = [&g](double by, const Guess& x) {
    g.fx += by * x.fx;
    g.fy += by * x.fy;
    g.tip += by * x.tip;
  };
  if (last.a == last.a) {
    const Way way{slides ? 0.0 : s.a - last.a, s.b - last.b, s.base - last.base};
    add(1.0, Along(last, way, slides, lean));
    const Way came = Between(before, last);
    const double ways = Product(way, came) / Product(came, came);
    if (std::abs(ways) <= kFarthest) {  // not NaN either: there is one before
      add(0.5 * ways, Along(last, way, slides, lean));
      add(-0.5 * ways, Along(before, way, slides, lean));
      const double cubic = ways * ways * (ways + 1.5);
      add(cubic, Along(last, came, slides, lean));
      add(cubic, Along(before, came, slides, lean));
      add(-2.0 * cubic, {last.fx - before.fx, last.fy - before.fy, last.tip - before.tip});
    }
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
  // The hip is higher over a contact that sinks.
  e.miss_y -= s.give * fy;
  e.c22 += s.give;
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

// Of two that nearly coincide the older one is no help: the stages of a step lie close together
// where it ends.
void Roots::Add(const Root& root) {
  constexpr double kNear = 0.1;
  const Way came = Between(before, last), goes = Between(last, root);
  if (!(Product(goes, goes) < kNear * kNear * Product(came, came))) before = last;
  last = root;
}

namespace {

// By Newton from a guess; false where it leads out of the leg's domain.
bool SolveFrom(Guess g, const Stand& stand, double lean, double tolerance, Roots& roots,
               Solution& e) {
  const Footing& foot = stand.foot;
  double halving = 1.0;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (round == 0 || !foot.rolling) e.at = Tangents(g.tip, stand.base);
    e.fx = g.fx;
    e.fy = g.fy;
    e.sum = IntegralsOf(e.at, g.fx, g.fy);
    if (!(e.sum.one == e.sum.one)) {
      // Beyond the domain: come back towards the unloaded leg.
      halving *= 0.5;
      if (!(halving > 1e-3)) return false;
      g.fx *= 0.5;
      g.fy *= 0.5;
      continue;
    }
    if (!Respond(stand, e)) return false;
    double dx = e.i11 * e.miss_x + e.i12 * e.miss_y;
    double dy = e.i12 * e.miss_x + e.i22 * e.miss_y;
    if (foot.slides != 0.0) {
      dy = e.miss_y / (e.c22 + lean * e.c12);
      dx = lean * dy;
    }
    const double size = std::fmax(std::abs(dx), std::abs(dy));
    if (size < tolerance && std::abs(e.tip_miss) < tolerance) {
      roots.Add(RootAfter(stand, e, lean, dx, dy));
      return true;
    }
    if (!std::isfinite(size)) return false;
    const double part = size > kMostStep ? kMostStep / size : 1.0;
    g.fx += part * dx;
    g.fy += part * dy;
    if (!foot.rolling) g.tip += part * (e.tip_miss + e.turn_x * dx + e.turn_y * dy);
  }
  return false;
}

}  // namespace

Solution SolveStand(const Stand& stand, double tolerance, Roots& roots) {
  const double lean = -stand.foot.slides * stand.mu;
  Solution e;
  if (SolveFrom(GuessFrom(roots, stand, lean), stand, lean, tolerance, roots, e)) return e;
  // The last root is too far away, or there is none: begin with the unloaded leg.
  const double tip = stand.foot.rolling ? 0.0 : stand.base - stand.length;
  if (!SolveFrom({0.0, 0.0, tip}, stand, lean, tolerance, roots, e)) e = Lost();
  return e;
}

}  // namespace hoplab::clamped
