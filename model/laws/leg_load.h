#pragma once

#include <cmath>
#include <numbers>

#include "model/jet.h"

namespace hoplab {

/// What a leg law says about one instant of stance. Chord quantities as in section 1 of the
/// equation sheet.
template <class T>
struct LegLoad {
  T u;              // contact lead x_c - x [m]
  T y;              // height of the hip over the contact [m]: y, unless the ground gives way
  T l;              // chord length [m]
  T phi;            // contact arc [rad]; pi in toe stance
  T elastic_force;  // F_el along the chord [N], positive pushes the hip away from the contact
  T damping_rate;   // rate the damper sees [m/s], positive while lengthening
  T contact_rate;   // rate of the contact coordinate (state 4) [m/s]
  // Of a leg with active law terms only.
  T slip_gain;  // d contact_rate/d slip, slip being the rate at which the foot creeps [-]
  T tip_miss;   // toe stance: u/l less the right side of M10 at phi = pi [-]
  // Where LawTerms::slopes_active.
  T angle_rate;            // of the leg at the hip (M38; M93 under elastica) [rad/s]
  T arc_x, arc_y;          // how the contact arc follows the hip [rad/m]
  T place_x, place_y;      // how the contact's place x_c follows the hip [-]
  T viscous_x, viscous_y;  // force on the hip of a strip that damps along its arc (M63) [N]
};

/// What besides the state decides the load of a leg with active law terms.
template <class T>
struct LegConditions {
  T time;    // since the start of the run [s]
  T torque;  // of the hip: what of it bends the leg [N m]
};

/// State of a legged body: hip position and velocity, and the contact coordinate. The contact
/// coordinate is x_c in toe stance and under `thesis` and `no_slip`; under `consistent` and
/// `large_deflection` it is X0 = x_c - r phi while rolling (M11). Not used in flight.
enum LegState { kX = 0, kY, kVx, kVy, kContact, kLegStateSize };
/// One state more where the hip torque lags: what the motor gives [N m].
inline constexpr int kMotorTorque = kLegStateSize, kLaggedLegStateSize = kLegStateSize + 1;
/// And one more, the last, where the foot of a leg with mass may slide: its speed [m/s].
inline constexpr int kMostLegStates = kLaggedLegStateSize + 1;
/// State of a body on a leg with a mass at its toe: in flight, position and velocity of the toe
/// stand where the contact coordinate is in stance, when the other three rest at zero.
enum ToeState { kToeX = kContact, kToeY, kToeVx, kToeVy, kToeStateSize };

/// Toe stance: phi = pi, x_c fixed. All of the load but what the law makes of the chord,
/// `elastic_force`.
template <class T>
LegLoad<T> ToeChord(const T* z) {
  using std::sqrt;
  LegLoad<T> load;
  load.u = z[kContact] - z[kX];
  load.y = z[kY];
  load.l = sqrt(load.u * load.u + z[kY] * z[kY]);
  load.phi = T(std::numbers::pi);
  load.damping_rate = (z[kY] * z[kVy] - load.u * z[kVx]) / load.l;
  load.contact_rate = T(0.0);
  return load;
}

}  // namespace hoplab
