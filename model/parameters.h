#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "base/mechanism_kind.h"
#include "base/thesis_reading.h"
#include "model/inputs.h"
#include "model/robot_parameters.h"

namespace hoplab {

/// How a C-leg carries its load; section 3 of the equation sheet.
enum class Law {
  kThesis,
  kNoSlip,
  kConsistent,
  kLargeDeflection,
  kStraightLeg,
  kBall,
  kElastica,
  kRobot
};

/// Terms of a leg law that only effects bring in (section "Effects" of the equation sheet). Each
/// effect adds to its field and sets `active`: a flag, so that a run in double and in duals takes
/// one branch. Not active: the plain laws, bit for bit.
template <class T>
struct LawTerms {
  bool active = false;
  bool rolling_active = false;
  bool torque_active = false;
  bool second_order_active = false;
  bool slopes_active = false;  // something asks how arc and contact follow the hip
  bool leg_mass_active = false;
  bool foot_friction_active = false;
  bool higher_order_active = false;
  bool material_damping_active = false;
  bool sole_active = false;
  bool uneven_active = false;
  T hardening{0.0};          // beta [-]
  T rolling{0.0};            // share of the other rolling law [-]
  T tip{0.0};                // share of the tip's rotation [-]
  T torque_bending{0.0};     // share of M24, M25 [-]
  T stiffness_drift{0.0};    // gamma_E [1/s]
  T ground_compliance{0.0};  // c_g [m/N]
  T second_order{0.0};       // share of M2b under laws without it [-]
  T foot_slip{0.0};          // c_slip [m/(N s)]
  T leg_mass{0.0};           // of the mass m that is weighed, the leg's [kg]
  T foot_friction{0.0};      // 1/mu under the foot [-]
  T material_damping{0.0};   // tau of the strip's Kelvin-Voigt material [s]
  T higher_order{0.0};       // share of what large_deflection lacks of the elastica [-]
  T sole{0.0};               // from the line that bends to the ground under it [m]
  T uneven{0.0};             // chi, rest curvature at the hub over the mean, less one [-]

  /// Whether the leg is not a half circle that bends along its outside (M113, M124).
  bool HasOutline() const { return sole_active || uneven_active; }
};

/// Everything physical about one trial, in SI units and radians. Fields a mechanism does not use
/// stay at their defaults. Differentiable fields are of type T.
template <class T>
struct Parameters {
  // Every mechanism.
  T m{1.0};   // body mass [kg]
  T g{9.81};  // gravity [m/s^2]
  // Speed controller (M15), legs only.
  T kp{0.0};        // gain [N s]
  T v_des{0.0};     // desired speed [m/s]
  T theta_td{0.0};  // commanded touch-down leg angle [rad]
  // Legs.
  T d{0.0};  // leg damping [N s/m]
  // Legs with a mass at the toe (M40-M46); 0: a massless leg.
  T m_toe{0.0};     // toe mass [kg]
  T kp_place{0.0};  // placement gain [N m/rad]
  T kd_place{0.0};  // placement damping [N m s/rad]
  // C-leg.
  T r{0.1};      // rest radius [m]
  T E{1.0};      // Young's modulus [Pa]
  T G{1.0};      // shear modulus [Pa]
  T I{1.0};      // second moment of the section [m^4]
  T A{1.0};      // section area [m^2]
  T kappa{1.5};  // shear factor [-]
  // Straight legs, also those of a robot.
  T k{1.0};   // stiffness [N/m]
  T l0{1.0};  // rest length [m]
  // Ball.
  T radius{0.0};           // [m]
  T restitution{1.0};      // [-]
  T tangential_loss{0.0};  // [-]
  // Changed by effects alone.
  T slope{0.0};                       // of the ground, uphill forward [rad]
  T inertia_x{0.0}, inertia_y{0.0};   // mass without weight per axis, in units of m [-]
  T torque_lag{0.0};                  // time constant of the hip torque [s]
  T contact_time{0.0};                // that a ball spends on the ground at each bounce [s]
  T rest_length_step{0.0};            // growth of l0 at greatest compression [m]
  bool has_rest_length_step = false;  // greatest compression is an event
  // Added to those of the run's inputs, by their family (FamilyOf): delay [s], scale [-].
  std::array<T, kInputFamilies> input_delay{T(0.0), T(0.0), T(0.0), T(0.0)};
  std::array<T, kInputFamilies> input_scale{T(0.0), T(0.0), T(0.0), T(0.0)};
  LawTerms<T> law_terms;
  MaybeRobot<T> robot;  // of a robot alone
  // Settings without derivatives.
  ThesisReading reading;  // of the law `thesis`; its torque_sign of every leg
  double torque_limit = std::numeric_limits<double>::infinity();  // T_max [N m]
  double fall_height = std::numeric_limits<double>::quiet_NaN();  // y_min [m]; NaN: the default
  bool on_guide = false;                                          // a vertical guide holds x
  /// Leg angle of the first touch-down [rad], M47; NaN: theta_td.
  double start_angle = std::numeric_limits<double>::quiet_NaN();
  double air_density = 0.0;  // of the air that a ball displaces [kg/m^3]
  double time_origin = 0.0;  // time of the run's start since the trial's first row [s]
};

/// The differentiable fields of `Parameters`, in a fixed order.
enum class ParameterId {
  kE,
  kG,
  kD,
  kM,
  kR,
  kGravity,
  kKp,
  kVDes,
  kThetaTd,
  kSecondMoment,
  kArea,
  kShearFactor,
  kStiffness,
  kRestLength,
  kRestitution,
  kTangentialLoss,
  kRadius,
  kToeMass,
  kKpPlace,
  kKdPlace,
  // Of a robot alone.
  kPitchInertia,
  kComX,
  kComY,
  kRotorInertia,
  kMotorKp,
  kMotorKd,
  kFriction,
  kLegDamping,
  kE1,
  kE2,
  kE3,
  kE4,
  kClockPeriod,
  kClamp,
  kLegMass,
  kClockDuty,
  kClockSweep,
  kClockOffset,
  kClockPhase1,
  kClockPhase2,
  kClockPhase3,
  kClockPhase4,
  kLateralStiffness
};

/// Name, unit and physical range of a parameter.
struct ParameterInfo {
  ParameterId id;
  std::string_view name;  // as in `--free` and run.json
  std::string_view unit;
  double lower, upper;  // closed physical bounds
};

/// All parameters, in the order of ParameterId.
std::span<const ParameterInfo> AllParameters();
const ParameterInfo& InfoOf(ParameterId id);
/// Parameter of that name, if there is one.
std::optional<ParameterId> FindParameter(std::string_view name);
/// Parameters that mean something for a mechanism, the ones fitted by default first.
std::span<const ParameterId> ParametersOf(MechanismKind mechanism);
/// Whether a parameter means something of the legs a robot has, arcs or straight ones; true of any
/// other mechanism.
bool IsOfLegs(ParameterId id, const Parameters<double>& p);
/// What the clock of a robot's motors has; a fit takes it as it is told.
std::span<const ParameterId> ClockParameters();
/// What a leg with a mass at its toe has besides; never free unless asked for.
std::span<const ParameterId> ToeParameters();
/// Parameters that are free unless asked otherwise.
std::span<const ParameterId> FreeByDefault(MechanismKind mechanism);

/// The field `id` of a robot.
template <class T>
T& RobotField(RobotParameters<T>& robot, ParameterId id) {
  const auto place = [id](ParameterId first) {
    return static_cast<std::size_t>(id) - static_cast<std::size_t>(first);
  };
  switch (id) {
    case ParameterId::kPitchInertia:
      return robot.pitch_inertia;
    case ParameterId::kComX:
      return robot.com_x;
    case ParameterId::kComY:
      return robot.com_y;
    case ParameterId::kRotorInertia:
      return robot.rotor_inertia;
    case ParameterId::kMotorKp:
      return robot.motor_kp;
    case ParameterId::kMotorKd:
      return robot.motor_kd;
    case ParameterId::kFriction:
      return robot.friction;
    case ParameterId::kLegDamping:
      return robot.damping;
    case ParameterId::kE1:
    case ParameterId::kE2:
    case ParameterId::kE3:
    case ParameterId::kE4:
      return robot.E[place(ParameterId::kE1)];
    case ParameterId::kClockPeriod:
      return robot.period;
    case ParameterId::kClamp:
      return robot.clamp;
    case ParameterId::kLegMass:
      return robot.leg_mass;
    case ParameterId::kClockDuty:
      return robot.duty;
    case ParameterId::kClockSweep:
      return robot.sweep;
    case ParameterId::kClockOffset:
      return robot.offset;
    case ParameterId::kClockPhase1:
    case ParameterId::kClockPhase2:
    case ParameterId::kClockPhase3:
    case ParameterId::kClockPhase4:
      return robot.phase[place(ParameterId::kClockPhase1)];
    case ParameterId::kLateralStiffness:
      return robot.lateral_stiffness;
    default:
      return robot.pitch_inertia;  // unreachable: the others are not of a robot
  }
}

/// The field `id` of `p`; one of a robot only where `p` has one.
template <class T>
T& Field(Parameters<T>& p, ParameterId id) {
  switch (id) {
    case ParameterId::kE:
      return p.E;
    case ParameterId::kG:
      return p.G;
    case ParameterId::kD:
      return p.d;
    case ParameterId::kM:
      return p.m;
    case ParameterId::kR:
      return p.r;
    case ParameterId::kGravity:
      return p.g;
    case ParameterId::kKp:
      return p.kp;
    case ParameterId::kVDes:
      return p.v_des;
    case ParameterId::kThetaTd:
      return p.theta_td;
    case ParameterId::kSecondMoment:
      return p.I;
    case ParameterId::kArea:
      return p.A;
    case ParameterId::kShearFactor:
      return p.kappa;
    case ParameterId::kStiffness:
      return p.k;
    case ParameterId::kRestLength:
      return p.l0;
    case ParameterId::kRestitution:
      return p.restitution;
    case ParameterId::kTangentialLoss:
      return p.tangential_loss;
    case ParameterId::kRadius:
      return p.radius;
    case ParameterId::kToeMass:
      return p.m_toe;
    case ParameterId::kKpPlace:
      return p.kp_place;
    case ParameterId::kKdPlace:
      return p.kd_place;
    default:
      return RobotField(*p.robot, id);
  }
}
template <class T>
const T& Field(const Parameters<T>& p, ParameterId id) {
  return Field(const_cast<Parameters<T>&>(p), id);
}

/// The same parameters in another scalar type; directions are dropped.
template <class To, class From>
Parameters<To> ConvertParameters(const Parameters<From>& from);

/// What is said of a law once: of a leg's law in its file in model/laws/legs.
struct LawInfo {
  Law law;
  MechanismKind mechanism;
  int place;  // among the laws of its mechanism; the first is the default
  std::string_view name;
  std::string_view sentence;           // what it assumes, for `hoplab laws`
  std::string_view equation, meaning;  // what it computes, when to use it, for `hoplab explain`
  bool takes_terms = true;             // the leg knows the terms that effects bring in (LawTerms)
};
const LawInfo& InfoOf(Law law);

/// Laws a mechanism can use; the first is its default.
std::span<const Law> LawsOf(MechanismKind mechanism);
inline MechanismKind MechanismOf(Law law) { return InfoOf(law).mechanism; }
inline std::string_view NameOf(Law law) { return InfoOf(law).name; }
inline std::string_view SentenceOf(Law law) { return InfoOf(law).sentence; }
std::optional<Law> FindLaw(std::string_view name);

}  // namespace hoplab

#include "model/parameters_inl.h"
