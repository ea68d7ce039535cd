#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

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
  /// `clamp` the length the hub holds rigid [m]: what bends is the rest. `compliance` the ground's
  /// under the foot [m/N] (M28).
  ClampedArc(const T& r, const T& EI, const T& tau, const T& mu, const T& clamp = T(0.0),
             const T& compliance = T(0.0))
      : r_(r),
        made_unit_(EI / (r * r)),
        unit_(made_unit_),
        tau_(tau),
        mu_(mu),
        length_(std::numbers::pi - clamp / r),
        compliance_(compliance),
        give_(compliance * unit_ / r),
        damped_(!IsZero(tau)),
        gives_(!IsZero(compliance)) {}

  /// From here on it is `share` times as stiff as it was made.
  void SetStiffness(const T& share) const {
    unit_ = share * made_unit_;
    if (gives_) give_ = compliance_ * unit_ / r_;
  }

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
  void StartAt(double tip) { roots_.StartAt(tip); }
  /// The same foot goes on in another way, under the load it has.
  void Restart() { roots_.Forget(); }
  void Save(DiscreteState& to) const {
    roots_.last.Each([&](double& v) { to.Put(v); });
  }
  void Load(DiscreteState& from) {
    roots_.Forget();
    roots_.last.Each([&](double& v) { v = from.Take(); });
  }

  /// M81, M68 to M71; the slip velocity (M70) where `with_slip`, of a sliding foot.
  ClampedLoad<T> At(const Footing& foot, const ClampedPlace<T>& place, bool damping = true,
                    bool with_slip = false) const {
    ClampedLoad<T> load;
    FillLoad(foot, place, damping, with_slip, load);
    return load;
  }
  /// The same in place, since a load has many numbers. Slip and yield stay as they are where they
  /// are not asked for.
  void FillLoad(const Footing& foot, const ClampedPlace<T>& place, bool damping, bool with_slip,
                ClampedLoad<T>& load) const {
    using std::sqrt;
    const T a = place.lead / r_, b = place.height / r_;
    const clamped::Solution e = Solve(foot, Value(a), Value(b), Value(place.base));
    const T mu_d = mu_ - Value(mu_), base_d = place.base - e.at.base;
    T miss_x = foot.slides != 0.0 ? T(0.0) : T(e.miss_x + (a - Value(a)) + e.h1 * base_d);
    T miss_y = e.miss_y - (b - Value(b)) + e.h2 * base_d;
    if (gives_) miss_y -= e.fy * (give_ - Value(give_));
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
    std::optional<clamped::Tangents> turned;
    if (!foot.rolling) turned.emplace(Value(tip), Value(place.base));
    const clamped::Tangents& at = turned ? *turned : e.at;
    const double c0 = at.cos_tip, s0 = at.sin_tip;
    const double cb = e.at.cos_base, sb = e.at.sin_base, x = Value(fx), y = Value(fy);
    const double root = sqrt(1.0 + 2.0 * (x * (c0 - cb) + y * (sb - s0))), by = 1.0 / root;
    T kappa(root);
    Follow(fx, by * (c0 - cb), kappa);
    Follow(fy, by * (sb - s0), kappa);
    Follow(place.base, by * (x * sb + y * cb), kappa);
    if (!foot.rolling) Follow(tip, -by * (x * s0 + y * c0), kappa);
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
    load.damped_x = load.damped_y = load.damped_moment = T(0.0);
    if ((damping && damped_) || with_slip)
      Move(foot, place, at, {&tip, &place.base, &fx, &fy}, damping && damped_, with_slip, load);
  }

  /// Strain energy [J] of what At gives at that place, U of M81, the ground's included.
  T StrainEnergy(const Footing& foot, const ClampedPlace<T>& place) const {
    const ClampedLoad<T> load = At(foot, place, false);
    const clamped::Tangents at(Value(load.tip), Value(place.base));
    const double fx = Value(load.fx) / Value(unit_), fy = Value(load.fy) / Value(unit_);
    const auto sum = clamped::IntegralsOf(at, fx, fy);
    const double value = sum.one - (at.base - at.tip) + fx * (at.cos_tip * sum.one - sum.c) +
                         fy * (sum.s - at.sin_tip * sum.one);
    const T a = load.lead / r_, b = place.height / r_;
    const T bent = value + fx * (a - Value(a)) - fy * (b - Value(b)) +
                   Value(load.moment / (r_ * unit_)) * (place.base - at.base) +
                   0.5 * fy * fy * (2.0 * Value(give_) - give_);
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
    const double x = (c.c22 + Value(give_)) * -vx + c.c12 * vy,
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
  static constexpr double kStepTolerance = kJetWidth<T> == 0 ? 3e-7 : 1e-10;

  // At the lead a (unless it slides) and the height b of the hip over r.
  clamped::Solution Solve(const Footing& foot, double a, double b, double base) const {
    return clamped::SolveStand({foot, a, b, base, Value(mu_), Value(length_), Value(give_)},
                               kStepTolerance, roots_);
  }

  // `of` changes with x by `slope`.
  static void Follow(const T& x, double slope, T& of) {
    if constexpr (kJetWidth < T >> 0) of.v += slope * x.v;
  }

  // What the hip's motion q = (-vx/r, -vy/r, dPsi/dt) does, linear in it: the dissipation's force
  // and moment in units, and the foot's slip velocity over r without the hip's. The yield is one of
  // C.
  enum { kX, kY, kMoment, kSlip, kYield, kAnswers };
  template <class S>
  using Answers = std::array<S, kAnswers>;
  template <class C, class L>
  static auto AnswersTo(const std::array<double, 3>& q, const clamped::Response<C>& c, bool slides,
                        const L& lean, bool dissipates) {
    using S = decltype(C(0.0) * L(0.0));
    Answers<S> out{S(0.0), S(0.0), S(0.0), S(0.0), S(1.0)};
    const C x = q[0] + c.h1 * q[2], y = q[1] + c.h2 * q[2];
    const auto resist = [&](const S& rate_x, const S& rate_y) {
      return std::array<S, 3>{S(c.D[0] * rate_x + c.D[1] * rate_y + c.D[2] * q[2]),
                              S(c.D[1] * rate_x + c.D[3] * rate_y + c.D[4] * q[2]),
                              S(c.D[2] * rate_x + c.D[4] * rate_y + c.D[5] * q[2])};
    };
    if (slides) {
      const S stiff = 1.0 / (c.c22 + lean * c.c12), rate_y = y * stiff, rate_x = lean * rate_y;
      out[kSlip] = c.c11 * rate_x + c.c12 * rate_y - c.h1 * q[2];
      out[kYield] = 1.0 + lean * c.c12 / c.c22;
      if (!dissipates) return out;
      const auto [wx, wy, wb] = resist(rate_x, rate_y);
      out[kY] = (lean * wx + wy) * stiff;
      out[kMoment] = c.h2 * out[kY] + wb;
      return out;
    }
    const C over = 1.0 / (c.c11 * c.c22 - c.c12 * c.c12);
    const auto [wx, wy, wb] =
        resist(S((c.c22 * x - c.c12 * y) * over), S((c.c11 * y - c.c12 * x) * over));
    out[kX] = (c.c22 * wx - c.c12 * wy) * over;
    out[kY] = (c.c11 * wy - c.c12 * wx) * over;
    out[kMoment] = c.h1 * out[kX] + c.h2 * out[kY] + wb;
    return out;
  }

  // The same with the slopes of all it depends on: of the response by `moved`, tip, base, fx and
  // fy; of the friction under a foot that slides; of the hip's motion.
  Answers<T> AnswersAt(const Footing& foot, const clamped::Tangents& at,
                       const std::array<const T*, 4>& moved, const std::array<T, 3>& q,
                       bool dissipates) const {
    const std::array<double, 3> motion = {Value(q[0]), Value(q[1]), Value(q[2])};
    const double fx = Value(*moved[2]), fy = Value(*moved[3]);
    const bool slides = foot.slides != 0.0;
    const T lean = -foot.slides * mu_;
    if constexpr (kJetWidth<T> == 0) {
      clamped::Response<double> c = clamped::ResponseOf(at, fx, fy, foot.rolling, dissipates);
      c.c22 += give_;
      return AnswersTo(motion, c, slides, lean, dissipates);
    } else {
      clamped::Response<Jet<4>> c = clamped::ResponseTo1(at, fx, fy, foot.rolling, dissipates);
      c.c22 += Value(give_);
      const clamped::Response<double> still = c.Values();
      const double leans = Value(lean);
      const Answers<Jet<4>> here = AnswersTo(motion, c, slides, leans, dissipates);
      Answers<double> by_motion[3];
      for (int j = 0; j < 3; ++j)
        by_motion[j] = AnswersTo({j == 0 ? 1.0 : 0.0, j == 1 ? 1.0 : 0.0, j == 2 ? 1.0 : 0.0},
                                 still, slides, leans, dissipates);
      Answers<Jet<1>> by_lean;
      if (slides)
        by_lean = AnswersTo(motion, still, true, Seeded<Jet<1>>(leans, 0, 1.0), dissipates);
      Answers<Jet<1>> by_give;
      if (gives_) {
        auto sinking = still.template Values<Jet<1>>();
        sinking.c22 = Seeded<Jet<1>>(still.c22, 0, 1.0);
        by_give = AnswersTo(motion, sinking, slides, leans, dissipates);
      }
      Answers<T> out;
      // A foot that holds has no slip.
      for (int k = 0; k < (slides ? kAnswers : kSlip); ++k) {
        out[k] = T(Value(here[k]));
        for (int j = foot.rolling ? 1 : 0; j < 4; ++j) Follow(*moved[j], Slope(here[k], j), out[k]);
        for (int j = 0; j < 3 && k != kYield; ++j) Follow(q[j], by_motion[j][k], out[k]);
        if (slides) Follow(lean, Slope(by_lean[k], 0), out[k]);
        if (gives_) Follow(give_, Slope(by_give[k], 0), out[k]);
      }
      return out;
    }
  }

  // The damping of the material, M71, and the slip velocity, M70: what rates do.
  void Move(const Footing& foot, const ClampedPlace<T>& place, const clamped::Tangents& at,
            const std::array<const T*, 4>& moved, bool dissipates, bool with_slip,
            ClampedLoad<T>& load) const {
    const Answers<T> out = AnswersAt(
        foot, at, moved, {T(-place.vx / r_), T(-place.vy / r_), place.base_rate}, dissipates);
    if (with_slip && foot.slides != 0.0) {
      load.slip = r_ * out[kSlip] + place.vx;
      load.yield = out[kYield];
    }
    if (!dissipates) return;
    const T damping = tau_ * unit_;
    if (foot.slides == 0.0) load.damped_x = damping * out[kX];
    load.damped_y = damping * out[kY];
    load.damped_moment = damping * r_ * out[kMoment];
  }

  T r_{1.0}, made_unit_{1.0};
  mutable T unit_{1.0};  // of load, E I/r² now [N]
  T tau_{0.0}, mu_{0.0}, length_{std::numbers::pi}, compliance_{0.0};
  mutable T give_{0.0};  // how far the ground sinks, over r, under a unit of load
  bool damped_ = false, gives_ = false;
  mutable clamped::Roots roots_;
};

}  // namespace hoplab
