#pragma once

#include <cmath>
#include <numbers>

#include "model/hybrid/discrete_state.h"
#include "model/laws/leg_load.h"
#include "model/leg_compliance.h"

namespace hoplab {

/// Laws `thesis` (M5-M7) and `no_slip` (M5, M6, M8): the loaded leg stays a half circle of radius
/// r_d, its chord angle half the leg angle. `thesis` in the reading of M5-M7 that the parameters'
/// `reading` names (M31-M36).
template <class T, bool kNoSlip>
class HalfCircle {
 public:
  static constexpr bool kIsExpansion = false;
  static constexpr Law kLaw = kNoSlip ? Law::kNoSlip : Law::kThesis;

  explicit HalfCircle(const Parameters<T>& p)
      : parameters_(p),
        r_(p.r),
        reading_(kNoSlip ? ThesisReading() : p.reading),
        rolls_at_rest_radius_(reading_.rolling_radius == ThesisReading::RollingRadius::kRest),
        rolls_explicitly_(reading_.rolling == ThesisReading::Rolling::kExplicit),
        rate_factor_(reading_.angle_rate == ThesisReading::AngleRate::kTheta ? 2.0 : 1.0) {}

  void StartRootAt(double) {}  // nothing is solved for
  void SaveRoot(DiscreteState&) const {}
  void LoadRoot(DiscreteState&) {}

  T ContactCoordinate(const T& x_c, const T&) const { return x_c; }
  T ToePosition(const T& coordinate) const { return coordinate; }

  /// Rolling stance: M5, M6 without the damper's force, M7 or M8.
  LegLoad<T> Rolling(const T* z) const {
    using std::atan2;
    using std::sqrt;
    LegLoad<T> load;
    const T& y = z[kY];
    load.u = z[kContact] - z[kX];
    load.y = z[kY];
    const T& u = load.u;
    load.l = sqrt(u * u + y * y);
    const T cos_alpha = y / load.l;
    load.phi = std::numbers::pi - 2.0 * atan2(u, y);
    const T r_d = load.l / (2.0 * cos_alpha);
    load.elastic_force = (2.0 * r_ * cos_alpha - load.l) / Compliance(load.phi, r_d);
    // M7: dx_c/dt = -r_d sin(theta) dtheta/dt with r_d sin(theta) = u, M8: -r dtheta/dt, both with
    // dtheta/dt = 2 (du/dt y - u vy)/l^2 and du/dt = dx_c/dt - vx: linear in dx_c/dt.
    const T roll = rate_factor_ * RollingRadius(load) / (load.l * load.l);
    load.contact_rate = roll * (y * z[kVx] + u * z[kVy]);
    if (!rolls_explicitly_) load.contact_rate /= 1.0 + roll * y;  // M31
    load.damping_rate = DampingRate(load, z);
    return load;
  }

  /// Toe stance: x_c fixed, phi = pi, r_d = l/2.
  LegLoad<T> Toe(const T* z) const {
    LegLoad<T> load = ToeChord(z);
    load.elastic_force = (2.0 * r_ - load.l) / Compliance(load.phi, 0.5 * load.l);
    return load;
  }

  T RollingToToe(const LegLoad<T>& load) const { return std::numbers::pi - load.phi; }
  /// Guard toe -> rolling: -alpha, by its sine.
  T ToeToRolling(const LegLoad<T>& load) const { return -load.u / load.l; }

  /// Energy the chord spring holds at this arc and radius [J]; reported, not conserved by M6-M8.
  T StrainEnergy(const LegLoad<T>& load) const {
    const T deflection = RestChord(load) - load.l;
    return 0.5 * load.elastic_force * deflection;
  }

  double DeflectionRatio(const LegLoad<T>&) const { return 0.0; }

 private:
  T RestChord(const LegLoad<T>& load) const {
    using std::cos;
    return 2.0 * r_ * cos(0.5 * (std::numbers::pi - load.phi));
  }
  // -(dx_c/dt)/(dtheta/dt): r_d sin(theta) of M7, its r sin(theta) (M33), or the r of M8.
  T RollingRadius(const LegLoad<T>& load) const {
    if constexpr (kNoSlip) return r_;
    if (!rolls_at_rest_radius_) return load.u;
    return 2.0 * r_ * load.u * load.y / (load.l * load.l);
  }
  // M34: dl/dt, w, or dl/dt - dl0/dt with l0 = 2 r cos(alpha).
  T DampingRate(const LegLoad<T>& load, const T* z) const {
    const T du = reading_.damping_rate == ThesisReading::DampingRate::kHip
                     ? T(-z[kVx])
                     : T(load.contact_rate - z[kVx]);
    const T rate = (load.u * du + load.y * z[kVy]) / load.l;
    if (reading_.damping_rate != ThesisReading::DampingRate::kDeflection) return rate;
    const T turn = (du * load.y - load.u * z[kVy]) / (load.l * load.l);  // dalpha/dt
    return rate + 2.0 * r_ * load.u / load.l * turn;
  }
  // C(phi; r_d), M2, or what M35 and M36 make of it.
  T Compliance(const T& phi, const T& r_d) const {
    const T radius = reading_.stiffness_radius == ThesisReading::StiffnessRadius::kRest ? r_ : r_d;
    if (reading_.stiffness_angle == ThesisReading::StiffnessAngle::kTheta)
      return LegCompliance<T>(parameters_, radius).ChordAt(phi);
    return LegCompliance<T>(parameters_, radius).ChordAt(0.5 * (std::numbers::pi + phi));
  }

  Parameters<T> parameters_;
  T r_;
  ThesisReading reading_;
  bool rolls_at_rest_radius_, rolls_explicitly_;
  double rate_factor_;  // dtheta/dt of M7 over dalpha/dt: 2, or 1 (M32)
};

template <class T>
using ThesisLaw = HalfCircle<T, false>;
template <class T>
using NoSlipLaw = HalfCircle<T, true>;

}  // namespace hoplab
