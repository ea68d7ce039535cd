#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "model/hybrid/discrete_state.h"
#include "model/jet.h"
#include "model/laws/clamped/clamped_leg.h"

namespace hoplab {

/// A straight leg clamped at its hip (M97): a spring along the rod, and across it the stiffness
/// that carries the motor's torque. It stands on its toe, a point, which holds or slides.
template <class T>
class ClampedRod {
 public:
  static constexpr bool kRolls = false;

  ClampedRod() = default;
  /// `length` at rest [m], `along` and `across` the stiffness of either way [N/m], `tau` the
  /// retardation time of the material [s], `mu` the friction under the foot.
  ClampedRod(const T& length, const T& along, const T& across, const T& tau, const T& mu)
      : length_(length),
        made_along_(along),
        made_across_(across),
        along_(along),
        across_(across),
        tau_(tau),
        mu_(mu),
        damped_(!IsZero(tau)) {}

  /// From here on it is `share` times as stiff as it was made.
  void SetStiffness(const T& share) const {
    along_ = share * made_along_;
    across_ = share * made_across_;
  }

  /// Half of the unloaded leg [m], a size as the radius of an arc.
  double size() const { return 0.5 * Value(length_); }
  const T& length() const { return length_; }

  // A closed form searches no root.
  void StartAt(double) {}
  void Restart() {}
  void Save(DiscreteState&) const {}
  void Load(DiscreteState&) {}

  /// How far below its hip the unloaded leg reaches [m] (M74), its angle within (-pi, pi].
  T Reach(const T& angle) const {
    using std::cos;
    return length_ * cos(angle);
  }
  ClampedLanding<T> LandsAs(const T& angle) const {
    using std::sin;
    return {false, 0.0, std::numbers::pi - Value(angle), T(length_ * sin(angle)), T(0.0)};
  }
  /// What its lengths go with [m]; with that as the unit, the leg's centre of mass from its hip,
  /// unloaded, and its inertia about the hip by its mass (M82).
  const T& unit_length() const { return length_; }
  static Vector2<double> Centre(double angle) {
    return {0.5 * std::sin(angle), -0.5 * std::cos(angle)};
  }
  static constexpr double kInertia = 1.0 / 3.0;

  /// M97; the slip velocity (M70) where `with_slip`, of a sliding foot.
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
    const Bent at = BentAt(foot, place);
    const T pull = along_ * at.longer, bend = across_ * at.aside;
    load.fx = pull * at.sin_angle + bend * at.cos_angle;
    load.fy = bend * at.sin_angle - pull * at.cos_angle;
    load.moment = at.reach * bend - at.aside * pull;
    load.arc = T(std::numeric_limits<double>::quiet_NaN());
    load.tip = T(0.0);
    load.lead = at.lead;
    load.damped_x = load.damped_y = load.damped_moment = T(0.0);
    const bool dissipates = damping && damped_;
    if (foot.slides != 0.0) {
      if (dissipates || with_slip) Slide(foot, place, at, dissipates, load);
    } else if (dissipates) {
      Resist(place, at, load);
    }
  }

  /// Strain energy [J] at that place: U of M97.
  T StrainEnergy(const Footing& foot, const ClampedPlace<T>& place) const {
    const Bent at = BentAt(foot, place);
    return 0.5 * (along_ * at.longer * at.longer + across_ * at.aside * at.aside);
  }

  /// Whether a foot that holds at the edge of its cone goes on sliding that way, its load growing
  /// with the press; else it snaps away (M70).
  bool CanSlide(double way, const Footing&, const ClampedPlace<T>& place) const {
    return CanSlide(way, StiffnessAt(Value(place.base)));
  }
  /// Whether an unloaded foot that lands, its point of contact moving as (vx, vy) with the leg as a
  /// rigid body, holds (0), or in which direction it slides. M70.
  double SlidesAtLanding(double, double base, double vx, double vy) const {
    const double mu = Value(mu_);
    if (!(mu < std::numeric_limits<double>::infinity())) return 0.0;
    const Stiffness<double> k = StiffnessAt(base);
    const double x = -k.xx * vx - k.xy * vy, y = -k.xy * vx - k.yy * vy;
    if (std::abs(x) <= mu * y) return 0.0;
    const double way = x < 0.0 ? 1.0 : -1.0;
    return CanSlide(way, k) ? way : -way;
  }
  /// Whether that foot is pressed on the ground: one that holds may be pulled off as it lands.
  bool PressesAtLanding(double, double base, double vx, double vy) const {
    const Stiffness<double> k = StiffnessAt(base);
    return k.xy * vx + k.yy * vy < 0.0;
  }

 private:
  // dF/dd, d from the hip to the foot.
  template <class S>
  struct Stiffness {
    S xx, xy, yy;
  };
  template <class S>
  static Stiffness<S> StiffnessOf(const S& s, const S& c, const S& along, const S& across) {
    return {along * s * s + across * c * c, (across - along) * s * c,
            along * c * c + across * s * s};
  }
  Stiffness<double> StiffnessAt(double base) const {
    return StiffnessOf(std::sin(base), -std::cos(base), Value(along_), Value(across_));
  }
  bool CanSlide(double way, const Stiffness<double>& k) const {
    return k.xx + way * Value(mu_) * k.xy > kLeastYield * k.xx;
  }

  struct Bent {
    T sin_angle, cos_angle;  // of beta
    T lead;                  // of the foot over the hip [m]
    T reach, aside, longer;  // a, b, a - l0 [m]
  };
  // F_x = lean F_y under a foot that slides.
  T Lean(const Footing& foot) const { return -foot.slides * mu_; }
  Bent BentAt(const Footing& foot, const ClampedPlace<T>& place) const {
    using std::cos;
    using std::sin;
    Bent at;
    at.sin_angle = sin(place.base);
    at.cos_angle = -cos(place.base);
    const T &s = at.sin_angle, &c = at.cos_angle, &height = place.height;
    at.lead = place.lead;
    if (foot.slides != 0.0) {
      const Stiffness<T> k = StiffnessOf(s, c, along_, across_);
      const T lean = Lean(foot), give = k.xx - lean * k.xy;
      // No foot slides against what does not give way (M70).
      at.lead = Value(give) > 0.0
                    ? T((along_ * length_ * (s + lean * c) + (k.xy - lean * k.yy) * height) / give)
                    : T(std::numeric_limits<double>::quiet_NaN());
    }
    at.reach = at.lead * s + height * c;
    at.aside = at.lead * c - height * s;
    at.longer = at.reach - length_;
    return at;
  }

  // The damping of a foot that holds.
  void Resist(const ClampedPlace<T>& place, const Bent& at, ClampedLoad<T>& load) const {
    const T &s = at.sin_angle, &c = at.cos_angle, turn = -place.base_rate;
    const T pull = tau_ * along_ * (place.vy * c - place.vx * s + at.aside * turn);
    const T bend = tau_ * across_ * (-place.vx * c - place.vy * s - at.reach * turn);
    load.damped_x = pull * s + bend * c;
    load.damped_y = bend * s - pull * c;
    load.damped_moment = at.reach * bend - at.aside * pull;
  }

  // A foot that slides follows the height of its hip and the turn of its base: its velocity, and
  // the damping of the two.
  void Slide(const Footing& foot, const ClampedPlace<T>& place, const Bent& at, bool dissipates,
             ClampedLoad<T>& load) const {
    const T &s = at.sin_angle, &c = at.cos_angle, turn = -place.base_rate, lean = Lean(foot);
    const Stiffness<T> k = StiffnessOf(s, c, along_, across_);
    const T over = 1.0 / (k.xx - lean * k.xy);
    const T turned_e = (along_ - across_) * at.aside,
            turned_n = along_ * at.longer - across_ * at.reach;  // dF/dbeta along and across
    const T turned = turned_e * s + turned_n * c - lean * (turned_n * s - turned_e * c);
    const T by_rise = (k.xy - lean * k.yy) * over, by_turn = -turned * over;  // of the lead
    load.slip = by_rise * place.vy + by_turn * turn + place.vx;
    load.yield = 1.0 - lean * k.xy / k.xx;
    if (!dissipates) return;
    const T a_rise = by_rise * s + c, a_turn = by_turn * s + at.aside;
    const T b_rise = by_rise * c - s, b_turn = by_turn * c - at.reach;
    const T pull = tau_ * along_ * (a_rise * place.vy + a_turn * turn);
    const T bend = tau_ * across_ * (b_rise * place.vy + b_turn * turn);
    load.damped_y = -(pull * a_rise + bend * b_rise);
    load.damped_moment = -(pull * a_turn + bend * b_turn);
  }

  T length_{1.0}, made_along_{1.0}, made_across_{1.0};
  mutable T along_{1.0}, across_{1.0};  // now
  T tau_{0.0}, mu_{0.0};
  bool damped_ = false;
};

}  // namespace hoplab
