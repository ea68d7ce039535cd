#pragma once

namespace hoplab {

// What all legs have in common that are clamped to a motor's hub: arcs (clamped_arc.h) and rods
// (clamped_rod.h).

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
  T arc;     // phi between hip and contact [rad]; NaN of a rod
  T tip;     // psi_0, angle of the tangent at the contact below the ground; 0 while rolling [rad]
  T lead;    // as of the place, but while sliding, too [m]
  T damped_x{0.0}, damped_y{0.0};  // force on the hip of the material's damping (M71) [N]
  T damped_moment{0.0};            // [N m]
  // Of a sliding foot, where it is asked for: its velocity [m/s], and how much it yields to a press
  // over how much it would without friction (M70); at 0 it snaps away.
  T slip{0.0}, yield{1.0};
};

/// How an unloaded leg first touches the ground, M74.
template <class T>
struct ClampedLanding {
  bool rolling;      // on its arc, else on its toe
  double tip, base;  // psi_0 and Psi [rad]
  T lead;            // of the contact over the hip [m]
  T laid;            // from the contact coordinate to the contact [m]
};

}  // namespace hoplab
