#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "model/hybrid/discrete_state.h"
#include "model/laws/clamped/integrals.h"

namespace hoplab {

/// A sliding foot that yields to a press less than this, over what it would without friction, snaps
/// away: at 0 its load would turn back at an infinite rate (M70).
inline constexpr double kLeastYield = 0.02;

/// How a foot stands on the ground: on its arc, which rolls, or on its toe; held, or sliding in the
/// direction `slides` (1 forward, -1 backward).
struct Footing {
  bool rolling = true;
  double slides = 0.0;
};

/// Where a clamped leg is and how it moves. Ground frame: x forward along it, y up.
template <class T>
struct ClampedPlace {
  T lead;       // X0 - x of the hip while rolling, x_c - x on the toe [m]; unused while sliding
  T height;     // of the hip [m]
  T base;       // Psi = pi - beta, beta the hip's angle [rad]
  T vx, vy;     // of the hip [m/s]
  T base_rate;  // dPsi/dt [rad/s]
};

/// What a clamped leg does; all NaN beyond its domain.
template <class T>
struct ClampedLoad {
  T fx, fy;  // of the ground on the leg and of the leg on the hip, elastic part [N]
  T moment;  // of the leg on the hip, elastic part, positive turns it nose up [N m]
  T arc;     // phi between hip and contact [rad]
  T tip;     // psi_0, angle of the tangent at the contact below the ground; 0 while rolling [rad]
  T lead;    // as of the place, but while sliding, too [m]
  T damped_x{0.0}, damped_y{0.0};  // force on the hip of the material's damping (M71) [N]
  T damped_moment{0.0};            // [N m]
  // Of a sliding foot, where it is asked for: its velocity [m/s], and how much it yields to a press
  // over how much it would without friction (M70); at 0 it snaps away.
  T slip{0.0}, yield{1.0};
};

/// A leg clamped at its hip (M68 to M71, M80, M81): the exact inextensible elastic arc from hip to
/// contact under a force of any direction. Rolling, on its toe, or sliding on either.
template <class T>
class ClampedArc {
 public:
  ClampedArc() = default;
  /// `r` the rest radius [m], `EI` the bending stiffness [N m^2], `tau` the retardation time of the
  /// material [s], `mu` the friction under the foot.
  /// `clamp` the length the hub holds rigid [m]: what bends is the rest.
  ClampedArc(const T& r, const T& EI, const T& tau, const T& mu, const T& clamp = T(0.0))
      : r_(r),
        unit_(EI / (r * r)),
        tau_(tau),
        mu_(mu),
        length_(std::numbers::pi - clamp / r),
        damped_(!IsZero(tau)) {}

  /// What bends, in r.
  const T& length() const { return length_; }

  /// Where the search for a load starts: the leg as it lands, unloaded.
  void StartAt(double tip) {
    root_ = Root{};
    root_.tip = tip;
  }
  /// The same foot goes on in another way, under the load it has.
  void Restart() { root_.a = std::numeric_limits<double>::quiet_NaN(); }
  void Save(DiscreteState& to) const {
    root_.Each([&](double& v) { to.Put(v); });
  }
  void Load(DiscreteState& from) {
    root_.Each([&](double& v) { v = from.Take(); });
  }

  /// M81, M68 to M71; the slip velocity (M70) where `with_slip`, of a sliding foot.
  ClampedLoad<T> At(const Footing& foot, const ClampedPlace<T>& place, bool damping = true,
                    bool with_slip = false) const {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const T a = place.lead / r_, b = place.height / r_;
    const Solution e = Solve(foot, Value(a), Value(b), Value(place.base));
    const T mu_d = mu_ - Value(mu_), base_d = place.base - e.at.base;
    T miss_x = foot.slides != 0.0 ? T(0.0) : T(e.miss_x + (a - Value(a)) + e.h1 * base_d);
    T miss_y = e.miss_y - (b - Value(b)) + e.h2 * base_d;
    // How the length of the arc bears on what is missed, on the toe.
    const T length_d = length_ - Value(length_);
    if (!foot.rolling) {
      const double q = e.fx * e.at.sin_tip + e.fy * e.at.cos_tip;
      if (foot.slides == 0.0) miss_x += (q * e.kx * e.by_tip - e.at.cos_tip) * length_d;
      miss_y += (q * e.ky * e.by_tip + e.at.sin_tip) * length_d;
    }
    T dx, dy;  // of fx, fy
    if (foot.slides != 0.0) {
      const double lean = -foot.slides * Value(mu_);
      const T lean_d = -foot.slides * e.fy * mu_d;
      dy = (miss_y - e.c12 * lean_d) / (e.c22 + lean * e.c12);
      dx = lean * dy + lean_d;
    } else {
      dx = e.i11 * miss_x + e.i12 * miss_y;
      dy = e.i12 * miss_x + e.i22 * miss_y;
    }
    const T fx = e.fx + dx, fy = e.fy + dy;
    const T tip = foot.rolling ? T(0.0)
                               : T(e.at.tip + e.tip_miss + e.by_tip * length_d + e.turn_x * dx +
                                   e.turn_y * dy + e.turn_base * base_d);
    const T c0 = foot.rolling ? T(1.0) : T(cos(tip)), s0 = foot.rolling ? T(0.0) : T(sin(tip));
    const T cb = e.at.cos_base - e.at.sin_base * base_d,
            sb = e.at.sin_base + e.at.cos_base * base_d;
    const T kappa = sqrt(1.0 + 2.0 * (fx * (c0 - cb) + fy * (sb - s0)));
    ClampedLoad<T> load;
    load.fx = unit_ * fx;
    load.fy = unit_ * fy;
    load.moment = r_ * unit_ * (kappa - 1.0);
    load.tip = tip;
    load.arc = foot.rolling ? T(e.sum.one - e.kx * dx - e.ky * dy + base_d / e.kappa) : length_;
    load.lead =
        foot.slides != 0.0 ? T(r_ * (e.x + e.c11 * dx + e.c12 * dy - e.h1 * base_d)) : place.lead;
    if (foot.slides != 0.0 && !foot.rolling) {
      const double q = e.fx * e.at.sin_tip + e.fy * e.at.cos_tip;
      load.lead += r_ * (e.at.cos_tip - q * e.kx * e.by_tip) * length_d;
    }
    if ((damping && damped_) || with_slip) {
      const clamped::Tangents at =
          foot.rolling ? e.at : clamped::Tangents(Value(tip), Value(place.base));
      Move(foot, place, at, {tip, fx, fy}, damping && damped_, with_slip, load);
    }
    return load;
  }

  /// Strain energy [J] of what At gives at that place: U of M81.
  T StrainEnergy(const Footing& foot, const ClampedPlace<T>& place) const {
    const ClampedLoad<T> load = At(foot, place, false);
    const clamped::Tangents at(Value(load.tip), Value(place.base));
    const double fx = Value(load.fx) / Value(unit_), fy = Value(load.fy) / Value(unit_);
    const auto sum = clamped::IntegralsOf(at, fx, fy);
    const double value = sum.one - (at.base - at.tip) + fx * (at.cos_tip * sum.one - sum.c) +
                         fy * (sum.s - at.sin_tip * sum.one);
    const T a = load.lead / r_, b = place.height / r_;
    const T bent = value + fx * (a - Value(a)) - fy * (b - Value(b)) +
                   Value(load.moment / (r_ * unit_)) * (place.base - at.base);
    return r_ * unit_ * bent;
  }

  /// Whether a foot that holds at the edge of its cone goes on sliding forward, its load growing
  /// with the press; else it snaps away (M70).
  bool CanSlideForward(const Footing& foot, const ClampedPlace<T>& place) const {
    const Solution e =
        Solve(foot, Value(place.lead / r_), Value(place.height / r_), Value(place.base));
    return e.c22 - Value(mu_) * e.c12 > kLeastYield * e.c22;
  }
  /// Whether an unloaded foot that lands, its point of contact moving as (vx, vy) with the leg as a
  /// rigid body, holds (0), or in which direction it slides. M70.
  double SlidesAtLanding(double tip, double base, double vx, double vy) const {
    const double mu = Value(mu_);
    if (!(mu < std::numeric_limits<double>::infinity())) return 0.0;
    if (mu == 0.0) return 1.0;
    const auto c = clamped::ResponseOf({tip, base}, 0.0, 0.0, tip == 0.0, false);
    const double x = c.c22 * -vx + c.c12 * vy,
                 y = c.c12 * vx - c.c11 * vy;  // times the determinant
    if (std::abs(x) <= mu * y) return 0.0;
    return x < 0.0 ? 1.0 : -1.0;
  }
  /// Whether that foot is pressed on the ground: one that holds may be pulled off as it lands.
  bool PressesAtLanding(double tip, double base, double vx, double vy) const {
    const auto c = clamped::ResponseOf({tip, base}, 0.0, 0.0, tip == 0.0, false);
    return c.c12 * vx - c.c11 * vy > 0.0;
  }

 private:
  // The last solution and how it changes with the place.
  struct Root {
    double fx = 0.0, fy = 0.0, tip = 0.0;
    double a = std::numeric_limits<double>::quiet_NaN(), b = 0.0, base = 0.0;
    double i11 = 0.0, i12 = 0.0, i22 = 0.0, h1 = 0.0, h2 = 0.0;
    double turn_x = 0.0, turn_y = 0.0, turn_base = 0.0;

    template <class Do>
    void Each(const Do& act) {
      for (double* v : {&fx, &fy, &tip, &a, &b, &base, &i11, &i12, &i22, &h1, &h2, &turn_x, &turn_y,
                        &turn_base})
        act(*v);
    }
    template <class Do>
    void Each(const Do& act) const {
      const_cast<Root*>(this)->Each(act);
    }
  };
  // A root of M81 but for the last correction, and the answer of the leg there.
  struct Solution {
    clamped::Tangents at;
    double fx, fy;
    clamped::Integrals sum;
    double kx, ky, c11, c12, c22, h1, h2;  // M68, M69
    double i11, i12, i22;                  // inverse of the compliance
    double turn_x = 0.0, turn_y = 0.0, turn_base = 0.0, tip_miss = 0.0, by_tip = 0.0;
    double miss_x, miss_y, x, kappa;
  };

  static constexpr int kMaxRounds = 30;
  // A double's values are corrected once more by the caller, which squares the error; the
  // derivatives of a Jet are not, so they need the root itself.
  static constexpr double kStepTolerance = kJetWidth<T> == 0 ? 3e-7 : 1e-9;
  static constexpr double kMostStep = 0.2;

  static Solution Lost() {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    Solution e;
    e.at.tip = e.at.base = e.fx = e.fy = e.sum.one = kNaN;
    e.c11 = e.c12 = e.c22 = e.h1 = e.h2 = e.i11 = e.i12 = e.i22 = e.kx = e.ky = kNaN;
    e.miss_x = e.miss_y = e.x = e.kappa = kNaN;
    return e;
  }

  // Newton for the force, and on the toe for the turn of the tip, at the lead a (unless it slides)
  // and the height b of the hip over r.
  Solution Solve(const Footing& foot, double a, double b, double base) const {
    Solution e;
    double fx = root_.fx, fy = root_.fy, tip = root_.tip;
    const double lean = -foot.slides * Value(mu_);
    if (root_.a == root_.a) {
      const double dp = base - root_.base;
      const double x = a - root_.a + root_.h1 * dp, y = root_.b - b + root_.h2 * dp;
      const double dy = foot.slides != 0.0 ? y * root_.i22 : root_.i12 * x + root_.i22 * y;
      const double dx = foot.slides != 0.0 ? lean * dy : root_.i11 * x + root_.i12 * y;
      fx += dx;
      fy += dy;
      tip += root_.turn_x * dx + root_.turn_y * dy + root_.turn_base * dp;
    }
    if (foot.rolling) tip = 0.0;
    if (foot.slides != 0.0) fx = lean * fy;
    double halving = 1.0;
    for (int round = 0; round < kMaxRounds; ++round) {
      if (round == 0 || !foot.rolling) e.at = clamped::Tangents(tip, base);
      e.fx = fx;
      e.fy = fy;
      const double c0 = e.at.cos_tip, s0 = e.at.sin_tip;
      e.sum = clamped::IntegralsOf(e.at, fx, fy);
      if (!(e.sum.one == e.sum.one)) {
        // Beyond the domain: come back towards the unloaded leg.
        halving *= 0.5;
        if (!(halving > 1e-3)) return Lost();
        fx *= 0.5;
        fy *= 0.5;
        continue;
      }
      const auto& k = e.sum;
      const double kappa2 = 1.0 + 2.0 * (fx * (c0 - e.at.cos_base) + fy * (e.at.sin_base - s0));
      if (!(kappa2 > clamped::kLeastCurvature2)) return Lost();
      e.kappa = std::sqrt(kappa2);
      e.kx = c0 * k.k1 - k.kc;
      e.ky = k.ks - s0 * k.k1;
      e.c11 = c0 * (c0 * k.k1 - 2.0 * k.kc) + k.kcc;
      e.c12 = c0 * (k.ks - s0 * k.k1) - k.kcs + s0 * k.kc;
      e.c22 = k.kss - s0 * (2.0 * k.ks - s0 * k.k1);
      e.h1 = (c0 - e.at.cos_base) / e.kappa;
      e.h2 = (e.at.sin_base - s0) / e.kappa;
      if (foot.rolling) {
        e.x = k.c - k.one;
        e.miss_x = a - e.x;
        e.miss_y = k.s - b;
      } else {
        // The tip's turn follows from the length (M68).
        const double q = fx * s0 + fy * c0;
        const double by_tip = 1.0 / (q * k.k1 - 1.0), over = k.one - Value(length_);
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
        e.miss_x = a - e.x;
        e.miss_y = k.s - s0 * over - b + q * e.ky * e.tip_miss;
      }
      const double det = 1.0 / (e.c11 * e.c22 - e.c12 * e.c12);
      e.i11 = e.c22 * det;
      e.i12 = -e.c12 * det;
      e.i22 = e.c11 * det;
      double dx = e.i11 * e.miss_x + e.i12 * e.miss_y;
      double dy = e.i12 * e.miss_x + e.i22 * e.miss_y;
      if (foot.slides != 0.0) {
        dy = e.miss_y / (e.c22 + lean * e.c12);
        dx = lean * dy;
      }
      const double size = std::fmax(std::abs(dx), std::abs(dy));
      if (size < kStepTolerance && std::abs(e.tip_miss) < kStepTolerance) {
        root_ = {fx + dx,
                 fy + dy,
                 foot.rolling ? 0.0 : tip + e.tip_miss + e.turn_x * dx + e.turn_y * dy,
                 foot.slides != 0.0 ? 0.0 : a,
                 b,
                 base,
                 e.i11,
                 e.i12,
                 foot.slides != 0.0 ? 1.0 / (e.c22 + lean * e.c12) : e.i22,
                 e.h1,
                 e.h2,
                 e.turn_x,
                 e.turn_y,
                 e.turn_base};
        return e;
      }
      if (!std::isfinite(size)) return Lost();
      const double part = size > kMostStep ? kMostStep / size : 1.0;
      fx += part * dx;
      fy += part * dy;
      if (!foot.rolling) tip += part * (e.tip_miss + e.turn_x * dx + e.turn_y * dy);
    }
    return Lost();
  }

  // A number that depends on (tip, base, fx, fy), known with its slopes at their values.
  struct Moved {
    T tip, fx, fy;
  };
  static T Follow(double value, const T&, const Moved&) { return T(value); }
  static T Follow(const Jet<4>& value, const T& base, const Moved& m) {
    return value.a + value.v[0] * (m.tip - Value(m.tip)) + value.v[1] * (base - Value(base)) +
           value.v[2] * (m.fx - Value(m.fx)) + value.v[3] * (m.fy - Value(m.fy));
  }

  // The damping of the material, M71, and the slip velocity, M70: what rates do.
  void Move(const Footing& foot, const ClampedPlace<T>& place, const clamped::Tangents& at,
            const Moved& moved, bool dissipates, bool with_slip, ClampedLoad<T>& load) const {
    const double fx = Value(moved.fx), fy = Value(moved.fy);
    const auto answer = [&] {
      if constexpr (kJetWidth<T> == 0)
        return clamped::ResponseOf(at, fx, fy, foot.rolling, dissipates);
      else
        return clamped::ResponseTo1(at, fx, fy, foot.rolling, dissipates);
    }();
    const auto follow = [&](const auto& value) { return Follow(value, place.base, moved); };
    const T c11 = follow(answer.c11), c12 = follow(answer.c12), c22 = follow(answer.c22);
    const T h1 = follow(answer.h1), h2 = follow(answer.h2);
    const T x = -place.vx / r_ + h1 * place.base_rate, y = -place.vy / r_ + h2 * place.base_rate;
    T rate_x, rate_y;  // of fx, fy
    if (foot.slides != 0.0) {
      const T lean = -foot.slides * mu_, stiff = 1.0 / (c22 + lean * c12);
      rate_y = y * stiff;
      rate_x = lean * rate_y;
      if (with_slip) {
        load.slip = r_ * (c11 * rate_x + c12 * rate_y - h1 * place.base_rate) + place.vx;
        load.yield = 1.0 + lean * c12 / c22;
      }
      if (!dissipates) return;
      const auto [wx, wy, wb] = Resist(answer.D, follow, rate_x, rate_y, place.base_rate);
      const T along = (lean * wx + wy) * stiff;
      load.damped_y = tau_ * unit_ * along;
      load.damped_moment = tau_ * unit_ * r_ * (h2 * along + wb);
      return;
    }
    const T over = 1.0 / (c11 * c22 - c12 * c12);
    rate_x = (c22 * x - c12 * y) * over;
    rate_y = (c11 * y - c12 * x) * over;
    const auto [wx, wy, wb] = Resist(answer.D, follow, rate_x, rate_y, place.base_rate);
    const T ux = (c22 * wx - c12 * wy) * over, uy = (c11 * wy - c12 * wx) * over;
    load.damped_x = tau_ * unit_ * ux;
    load.damped_y = tau_ * unit_ * uy;
    load.damped_moment = tau_ * unit_ * r_ * (h1 * ux + h2 * uy + wb);
  }

  // D times the rates of (fx, fy, Psi).
  struct Resistance {
    T x, y, base;
  };
  template <class S, class F>
  static Resistance Resist(const std::array<S, 6>& D, const F& follow, const T& x, const T& y,
                           const T& base) {
    const T xx = follow(D[0]), xy = follow(D[1]), xb = follow(D[2]), yy = follow(D[3]),
            yb = follow(D[4]), bb = follow(D[5]);
    return {xx * x + xy * y + xb * base, xy * x + yy * y + yb * base, xb * x + yb * y + bb * base};
  }

  T r_{1.0}, unit_{1.0}, tau_{0.0}, mu_{0.0}, length_{std::numbers::pi};
  bool damped_ = false;
  mutable Root root_;
};

}  // namespace hoplab
