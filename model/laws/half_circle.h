#pragma once

#include <cmath>
#include <numbers>

#include "model/laws/leg_load.h"
#include "model/leg_compliance.h"

namespace hoplab {

/// Laws `thesis` (M5-M7) and `no_slip` (M5, M6, M8): the loaded leg stays a half circle of radius
/// r_d, its chord angle half the leg angle.
template <class T, bool kNoSlip>
class HalfCircle {
 public:
  static constexpr Law kLaw = kNoSlip ? Law::kNoSlip : Law::kThesis;
  static constexpr bool kIsExpansion = false;

  explicit HalfCircle(const Parameters<T>& p) : parameters_(p), r_(p.r) {}

  void StartRootAt(double) {}  // nothing is solved for
  template <class Other>
  void CopyRoot(const Other&) {}

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
    const T roll = (kNoSlip ? 2.0 * r_ : 2.0 * u) / (load.l * load.l);
    load.contact_rate = roll * (y * z[kVx] + u * z[kVy]) / (1.0 + roll * y);
    load.damping_rate = (u * (load.contact_rate - z[kVx]) + y * z[kVy]) / load.l;  // dl/dt
    return load;
  }

  /// Toe stance: x_c fixed, phi = pi, r_d = l/2.
  LegLoad<T> Toe(const T* z) const {
    using std::sqrt;
    LegLoad<T> load;
    load.u = z[kContact] - z[kX];
    load.y = z[kY];
    load.l = sqrt(load.u * load.u + z[kY] * z[kY]);
    load.phi = T(std::numbers::pi);
    load.elastic_force = (2.0 * r_ - load.l) / Compliance(load.phi, 0.5 * load.l);
    load.damping_rate = (z[kY] * z[kVy] - load.u * z[kVx]) / load.l;
    load.contact_rate = T(0.0);
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

  double Flexure(const LegLoad<T>&) const { return 0.0; }

 private:
  T RestChord(const LegLoad<T>& load) const {
    using std::cos;
    return 2.0 * r_ * cos(0.5 * (std::numbers::pi - load.phi));
  }
  // C(phi; r_d), M2.
  T Compliance(const T& phi, const T& radius) const {
    return LegCompliance<T>(parameters_, radius).ChordAt(phi);
  }

  Parameters<T> parameters_;
  T r_;
};

template <class T>
using ThesisLaw = HalfCircle<T, false>;
template <class T>
using NoSlipLaw = HalfCircle<T, true>;

}  // namespace hoplab
