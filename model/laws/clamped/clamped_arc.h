#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "model/hybrid/discrete_state.h"
#include "model/laws/clamped/clamped_leg.h"
#include "model/laws/clamped/equilibrium.h"
#include "model/laws/clamped/integrals.h"

namespace hoplab {

/// A leg clamped at its hip (M68 to M71, M80, M81): the exact inextensible elastic arc from hip to
/// contact under a force of any direction. Rolling, on its toe, or sliding on either.
template <class T>
class ClampedArc {
 public:
  static constexpr bool kRolls = true;

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

  /// Half of the unloaded leg [m].
  double size() const { return Value(r_); }
  /// What bends, in r.
  const T& length() const { return length_; }

  /// How far below its hip the unloaded leg reaches [m] (M74), its angle within (-pi, pi].
  T Reach(const T& angle) const {
    using std::cos;
    return Value(angle) > 0.0 ? T(r_ * (1.0 + cos(angle))) : T(2.0 * r_ * cos(angle));
  }
  /// With the part of its arc that is lowest, or on its toe.
  ClampedLanding<T> LandsAs(const T& angle) const {
    using std::sin;
    const bool rolling = Value(angle) > 0.0;
    return {rolling, rolling ? 0.0 : -Value(angle), Value(length_ - angle),
            T((rolling ? 1.0 : 2.0) * r_ * sin(angle)),
            rolling ? T(r_ * (length_ - angle)) : T(0.0)};
  }
  /// What its lengths go with [m]; with that as the unit, the leg's centre of mass from its hip,
  /// unloaded, and its inertia about the hip by its mass (M82).
  const T& unit_length() const { return r_; }
  static Vector2<double> Centre(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    constexpr double kBehind = 2.0 / std::numbers::pi;
    return {s - kBehind * c, -c - kBehind * s};
  }
  static constexpr double kInertia = 2.0;

  /// Where the search for a load starts: the leg as it lands, unloaded.
  void StartAt(double tip) {
    root_ = clamped::Root{};
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
    const clamped::Solution e = Solve(foot, Value(a), Value(b), Value(place.base));
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

  /// Whether a foot that holds at the edge of its cone goes on sliding that way, its load growing
  /// with the press; else it snaps away (M70).
  bool CanSlide(double way, const Footing& foot, const ClampedPlace<T>& place) const {
    if (way < 0.0) return true;
    const clamped::Solution e =
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
  // A double's values are corrected once more by the caller, which squares the error; the
  // derivatives of a Jet are not, so they need the root itself.
  static constexpr double kStepTolerance = kJetWidth<T> == 0 ? 3e-7 : 1e-9;

  // At the lead a (unless it slides) and the height b of the hip over r.
  clamped::Solution Solve(const Footing& foot, double a, double b, double base) const {
    return clamped::SolveStand({foot, a, b, base, Value(mu_), Value(length_)}, kStepTolerance,
                               root_);
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
  mutable clamped::Root root_;
};

}  // namespace hoplab
