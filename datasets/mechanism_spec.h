#pragma once

#include <optional>
#include <vector>

#include "base/mechanism_kind.h"
#include "base/thesis_reading.h"

namespace hoplab {

// What a dataset or a scenario says about the hopper, in SI units and radians. Plain values: the
// simulator makes its own mechanism from them.

/// Half-circular compliant leg.
struct CLegSpec {
  double rest_radius_m = 0;
  double E_Pa = 0;
  double G_Pa = 0;
  double second_moment_m4 = 0;
  double area_m2 = 0;
  double shear_factor = 1.5;
  double damping_N_s_per_m = 0;
  /// The strip's section as the file gave it; second moment and area follow from it. Kept so that
  /// it is written back; reset both when second moment or area is changed.
  std::optional<double> width_m;
  std::optional<double> thickness_m;
  bool operator==(const CLegSpec&) const = default;
};

/// Straight prismatic leg on a linear spring.
struct StraightLegSpec {
  double rest_length_m = 0;
  double stiffness_N_per_m = 0;
  double damping_N_s_per_m = 0;
  bool operator==(const StraightLegSpec&) const = default;
};

/// Of air at 20 degrees and sea level [kg/m^3].
inline constexpr double kUsualAirDensity = 1.2;

/// Bouncing ball: vy+ = - restitution vy-, vx+ = (1 - tangential_loss) vx-.
struct BallSpec {
  double radius_m = 0;
  double restitution = 0;
  double tangential_loss = 0;
  /// Of the air it displaces (M114); absent: none, or the usual one where its source says that it
  /// was recorded.
  std::optional<double> air_density_kg_per_m3 = std::nullopt;
  bool operator==(const BallSpec&) const = default;
};

/// Gains of the controller that places the toe in flight, where the leg has a toe mass.
struct PlacementSpec {
  double kp_N_m_per_rad = 0;
  double kd_N_m_s_per_rad = 0;
  bool operator==(const PlacementSpec&) const = default;
};

/// One leg of a robot, hindmost first: where its hip is in the body frame, and its own modulus
/// where it has one; absent: that of `leg`.
struct RobotLegSpec {
  double hip_x_m = 0;
  double hip_y_m = 0;
  std::optional<double> E_Pa;
  bool operator==(const RobotLegSpec&) const = default;
};

/// Body, motors and legs of a robot; all legs are alike: half circles cut from one strip, or rods.
struct RobotSpec {
  double pitch_inertia_kg_m2 = 0;  // about the centre of mass
  double com_x_m = 0;              // centre of mass in the body frame
  double com_y_m = 0;
  std::optional<double> friction;  // under the feet; absent: they hold
  std::optional<double> pitch_limit_rad;
  double rotor_inertia_kg_m2 = 0;  // reflected to the hip, on the relative speed
  double kp_N_m_per_rad = 0;
  double kd_N_m_s_per_rad = 0;
  std::optional<double> torque_limit_N_m;
  bool straight_legs = false;            // else half circles
  double rest_length_m = 0;              // of a straight leg, and what follows
  double stiffness_N_per_m = 0;          // along it
  double lateral_stiffness_N_per_m = 0;  // across it
  double rest_radius_m = 0;              // of a half circle, and what follows
  double E_Pa = 0;
  double second_moment_m4 = 0;
  double material_damping_s = 0;  // retardation time
  double clamp_m = 0;             // length of each leg that its hub holds rigid
  double leg_mass_kg = 0;         // of each leg, beside the body's
  std::vector<RobotLegSpec> legs;
  bool operator==(const RobotSpec&) const = default;
};

/// One mechanism. Of `c_leg`, `straight_leg`, `ball` and `robot` only the one that `type` names
/// means anything; the others keep their defaults.
struct MechanismSpec {
  MechanismKind type = MechanismKind::kCLeg;
  double body_mass_kg = 0;
  double gravity_m_per_s2 = 0;
  LiftoffRule liftoff = LiftoffRule::kZeroForce;
  std::optional<double> fall_height_m;  // absent: the mechanism's own default
  std::optional<double> toe_mass_kg;    // absent: massless leg
  std::optional<PlacementSpec> placement;
  bool on_guide = false;  // a vertical guide holds it along the ground
  ThesisReading reading;  // under `leg` in the file; a straight leg has its torque_sign only
  CLegSpec c_leg;
  StraightLegSpec straight_leg;
  BallSpec ball;
  RobotSpec robot;
  bool operator==(const MechanismSpec&) const = default;
};

/// What the motors of a robot follow.
struct MotorsSpec {
  MotorControl kind = MotorControl::kHeld;
  std::vector<double> angles_rad;       // one a leg; of recorded motors where they begin
  std::vector<double> rates_rad_per_s;  // recorded: how fast; empty: at rest
  double period_s = 0;                  // clock
  double duty = 0;
  double sweep_rad = 0;
  double offset_rad = 0;
  std::vector<double> phases;  // one a leg
  bool operator==(const MotorsSpec&) const = default;
};

/// Hip torque in stance, kp (v_des - vx), clipped to +-torque_limit where there is one (M15).
struct ControllerSpec {
  double kp_N_s = 0;
  double v_des_m_per_s = 0;
  std::optional<double> torque_limit_N_m;
  std::optional<MotorsSpec> motors;  // of a robot, which has none of the others
  bool operator==(const ControllerSpec&) const = default;
};

/// How a record begins: in flight, or with the foot on the ground; kStance is whichever of rolling
/// and toe the leg is in.
enum class StartMode { kFlight, kRolling, kToe, kStance };

/// Position and velocity of the hip, or of the ball's centre, in the world: x forward, y up.
struct StateSpec {
  double x_m = 0;
  double y_m = 0;
  double vx_m_per_s = 0;
  double vy_m_per_s = 0;
  std::optional<double> contact_x_m;  // the ground that carries the leg; of a start in stance
  StartMode mode = StartMode::kFlight;
  std::optional<double> pitch_rad;  // of a robot's body, nose up positive
  std::optional<double> pitch_rate_rad_per_s;
  bool operator==(const StateSpec&) const = default;
};

/// Height of the hip, or of the ball's centre, at which an undeformed leg at the touch-down angle
/// meets flat ground [m]; the touch-down guards of the equation sheet.
double TouchdownHeight(const MechanismSpec& mechanism, double touchdown_angle_rad);

/// Acceleration of a body that falls freely; of a ball that of M114 [m/s^2].
double FreeFall(const MechanismSpec& mechanism);

}  // namespace hoplab
