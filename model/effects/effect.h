#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "model/jet.h"
#include "model/observation.h"
#include "model/parameters.h"

namespace hoplab {

/// Where an effect acts.
enum class EffectKind { kForce, kParameter, kGuard, kObservation };
std::string_view NameOf(EffectKind kind);

/// A part that not every machine has; `kTwoAxes`: both coordinates are measured, and move.
enum class MachinePart { kNone, kGuideOfBall, kClock, kTorqueLimit, kTwoAxes };

/// A filter that a logged pose went through (M105, M117).
enum class RecordFilter {
  kNone,
  kTwoPass,        // Butterworth of order 2, run to and fro: no lag
  kOnePass,        // Butterworth of order 2, run forward as the samples come in
  kFirstOrder,     // exponential smoothing, an RC circuit
  kMovingAverage,  // about each sample
};

/// One parameter of an effect. At `null` the effect changes nothing, bit for bit.
struct EffectParameter {
  std::string_view name;
  std::string_view unit;
  double null, lower, upper;
  double typical;  // a size one would expect when it is present, on a body of 1 kg
  /// It shapes the effect and has no null: it stays at `null`, its given value, unless freed by
  /// name.
  bool is_shape = false;
  /// It adds to this stated value; a fit may take up to nine tenths of that away, below `lower`.
  std::optional<ParameterId> adds_to = std::nullopt;
  /// It says how the effect's first parameter acts, and moves nothing while that is at its null.
  bool is_of_first = false;
};

struct EffectInfo {
  std::string_view name;
  EffectKind kind;
  std::string_view equation;  // in the symbols of the equation sheet
  std::string_view sentence;  // for a reader who does not know the symbols
  bool for_legs, for_ball;    // mechanisms it applies to
  bool dissipative;           // never creates energy
  int order = 0;              // effects on one hook act in this order, then as they were given
  /// Its term turns over within a narrow band of speed. At null the state's steps do not see it, so
  /// the sensitivities must steer the step too.
  bool sharp = false;
  /// It has a threshold: small values change nothing, and neither does the derivative at null.
  bool has_threshold = false;
  /// Runs with it take many times as long: it is sought only where a misfit is seen without it.
  bool slow = false;
  /// Another effect without which it hardly shows: a search tries both at once, too.
  std::string_view shows_beside = {};
  /// Means nothing, or is not modelled, on a leg with a mass at its toe.
  bool massless_leg_only = false;
  std::span<const EffectParameter> parameters;
  std::span<const Law> only_laws = {};  // of those mechanisms' laws; empty: all of them
  /// Laws that have it in themselves: nothing is lacking there that it could be. Given, it says the
  /// share in the law's place.
  std::span<const Law> part_of = {};
  InputSet needs_inputs = 0;  // means nothing unless one of these drives the run; 0: always does
  bool for_robot = false;     // applies to a robot, too
  int least_legs = 1;         // that it must have
  bool arcs_only = false;     // of a robot whose legs are half circles
  bool rods_only = false;     // of a robot whose legs are straight
  int robot_leg = 0;  // it is of this leg of a robot alone, 1 the hindmost; 0: of no one leg
  /// What it is about: a search leaves it alone where no trial has such a part.
  MachinePart about = MachinePart::kNone;
  /// The inputs whose scale it stands for under another name.
  InputSet scales = 0;
  /// It filters the logged pose; its first parameter is the filter's time [s].
  RecordFilter filter = RecordFilter::kNone;
};

/// Motion of the body at one instant, for forces on it. Frame W.
template <class T>
struct BodyMotion {
  T t;             // time since the first row [s]
  T x, y, vx, vy;  // [m], [m/s]
  bool in_stance = false;
};

/// A loaded leg at one instant, for forces along its chord.
template <class T>
struct ChordMotion {
  T elastic_force;  // F_el [N]
  T stiffness;      // k = 1/C at small load (M3) [N/m]
  T rate;           // what the damper sees [m/s], positive while lengthening
  T compression;    // (l0 - l)/l0 [-]
  T t;              // time since the first row [s]
};

/// A driven hip in stance at one instant, for torques on it; a hip that places a toe with a mass is
/// driven in flight too.
template <class T>
struct HipMotion {
  T motor_torque;  // what the motor gives: M15, clipped and lagged [N m]
  T t;             // time since the first row [s]
  T vx;            // [m/s]
  T lead;          // sine of the chord angle, u/l [-]
  // Where a formula asks for them.
  T angle;        // leg angle theta [rad]
  T rate;         // dtheta/dt (M38, M93) [rad/s]
  T compression;  // (l0 - l)/l0 [-]
};

/// A leg on its way to touch-down, for the angle it is placed at.
template <class T>
struct PlacementMotion {
  T vx, vy;  // [m/s]
  T hop;     // which touch-down of the run comes, the first is 1
};

/// The hip joint at one instant, for its friction.
template <class T>
struct JointMotion {
  T rate;  // dtheta/dt of the leg angle (M38, M93) [rad/s], negative where it rolls forward
};

/// A touch-down or lift-off, for what it does to the body's velocity.
template <class T>
struct Landing {
  Vector2<T> chord;  // e, contact to hip, length 1
  T theta;           // leg angle of a touch-down [rad]
};

/// A bounce of a ball, for what it does to the speed along the ground.
template <class T>
struct Bounce {
  Vector2<T> arriving;  // the velocity before it, frame of the ground [m/s]
  T leaving_vy;         // after it [m/s], positive
};

inline constexpr int kMaxEffectParameters = 6;

class Formula;

/// The places an effect can plug into; null where it does not. `p` points at its parameters.
template <class T>
struct EffectHooks {
  /// Changes the physical parameters before the trial starts.
  void (*change_parameters)(const T* p, Parameters<T>& parameters) = nullptr;
  /// Adds a force on the body [N], in flight and stance.
  void (*add_body_force)(const T* p, const BodyMotion<T>& body, Vector2<T>& force) = nullptr;
  /// Adds a force along the chord of a loaded leg [N], positive pushes the hip away.
  void (*add_chord_force)(const T* p, const ChordMotion<T>& chord, T& force) = nullptr;
  /// Adds a torque on the hip in stance [N m], positive pushes it forward (M13).
  void (*add_hip_torque)(const T* p, const HipMotion<T>& hip, T& torque) = nullptr;
  /// Adds a torque that the joint of the hip answers with to its rate [N m], positive against a
  /// growing leg angle: the joint's power is -torque rate. It does not bend the leg. The effect
  /// also sets LawTerms::slopes_active.
  void (*add_joint_torque)(const T* p, const JointMotion<T>& joint, T& torque) = nullptr;
  /// Changes the velocity with which stance begins [m/s].
  void (*change_landing_velocity)(const T* p, const Landing<T>& landing,
                                  Vector2<T>& velocity) = nullptr;
  /// Changes the velocity with which flight begins [m/s].
  void (*change_liftoff_velocity)(const T* p, const Landing<T>& leaving,
                                  Vector2<T>& velocity) = nullptr;
  /// Changes the height of the hip at which the leg meets the ground [m]: the guard of touch-down
  /// alone, not its reset.
  void (*change_contact_height)(const T* p, T& height) = nullptr;
  /// Changes the restitution of a ball from the speed of the impact [m/s], positive.
  void (*change_restitution)(const T* p, const T& speed, T& restitution) = nullptr;
  /// Changes the speed along the ground with which a ball leaves a bounce [m/s].
  void (*change_bounce_speed)(const T* p, const Bounce<T>& bounce, T& vx) = nullptr;
  /// Changes the leg angle that touches down (guard and reset) from the speed at that moment.
  void (*change_touchdown_angle)(const T* p, const T& vx, T& theta_td) = nullptr;
  /// Changes the time at which the row stamped `t` was really read.
  void (*change_observation_time)(const T* p, T& t) = nullptr;
  /// Changes the time at which the pose of a row stamped `t` was read (IsPose), before that.
  void (*change_pose_time)(const T* p, T& t) = nullptr;
  /// Changes what the sensors report.
  void (*change_observation)(const T* p, Observation<T>& seen) = nullptr;
};

/// An effect as the registry holds it: what it is, and its hooks in every scalar type.
struct Effect {
  EffectInfo info;
  EffectHooks<double> hooks0;
  EffectHooks<Jet<1>> hooks1;
  EffectHooks<Jet<kNarrowJet>> hooks_narrow;
  EffectHooks<Jet<kWideJet>> hooks_wide;
  EffectHooks<Jet<kWidestJet>> hooks_widest;
  /// What acts in place of the hooks where the effect is a formula (model/formula).
  const Formula* formula = nullptr;

  template <class T>
  const EffectHooks<T>& Hooks() const {
    if constexpr (kJetWidth<T> == 0)
      return hooks0;
    else if constexpr (kJetWidth<T> == 1)
      return hooks1;
    else if constexpr (kJetWidth<T> == kNarrowJet)
      return hooks_narrow;
    else if constexpr (kJetWidth<T> == kWideJet)
      return hooks_wide;
    else
      return hooks_widest;
  }
  /// Index of a parameter by name.
  std::optional<int> FindParameter(std::string_view name) const;
};

/// Whether a leg has a mass at its toe.
enum class LegMass { kNone, kAtToe };

/// How many legs a robot has, none of a hopper, and of which kind.
struct RobotLegs {
  RobotLegs(int legs = kMaxLegs, bool are_straight = false)  // NOLINT: a number says it
      : count(legs), straight(are_straight) {}
  int count;
  bool straight;
};

/// Whether an effect means anything under a law, on such a leg, on a robot with those legs.
bool AppliesTo(const Effect& effect, Law law, LegMass mass = LegMass::kNone, InputSet inputs = 0,
               RobotLegs robot_legs = {});

/// Whether the law has it in itself (EffectInfo::part_of).
bool IsPartOf(Law law, const Effect& effect);

/// Every effect there is, by name. One entry per file in model/effects (cmake writes the list).
std::span<const Effect* const> AllEffects();
const Effect* FindEffect(std::string_view name);

/// An effect with the values it acts with; parameters it does not have are ignored.
struct EffectSetting {
  const Effect* effect = nullptr;
  std::array<double, kMaxEffectParameters> values{};
  /// At its null values, what has none at its given value.
  static EffectSetting Null(const Effect& effect);
  /// Every parameter that has a null is at it.
  bool IsNull() const;
};

namespace effect_detail {
template <class Physics, class T>
constexpr EffectHooks<T> HooksOf() {
  EffectHooks<T> hooks;
  if constexpr (requires(const T* p, Parameters<T>& q) { Physics::ChangeParameters(p, q); })
    hooks.change_parameters = &Physics::template ChangeParameters<T>;
  if constexpr (requires(const T* p, const BodyMotion<T>& b, Vector2<T>& f) {
                  Physics::AddBodyForce(p, b, f);
                })
    hooks.add_body_force = &Physics::template AddBodyForce<T>;
  if constexpr (requires(const T* p, const ChordMotion<T>& c, T& f) {
                  Physics::AddChordForce(p, c, f);
                })
    hooks.add_chord_force = &Physics::template AddChordForce<T>;
  if constexpr (requires(const T* p, const HipMotion<T>& h, T& t) {
                  Physics::AddHipTorque(p, h, t);
                })
    hooks.add_hip_torque = &Physics::template AddHipTorque<T>;
  if constexpr (requires(const T* p, const JointMotion<T>& j, T& t) {
                  Physics::AddJointTorque(p, j, t);
                })
    hooks.add_joint_torque = &Physics::template AddJointTorque<T>;
  if constexpr (requires(const T* p, const Landing<T>& l, Vector2<T>& v) {
                  Physics::ChangeLandingVelocity(p, l, v);
                })
    hooks.change_landing_velocity = &Physics::template ChangeLandingVelocity<T>;
  if constexpr (requires(const T* p, const Landing<T>& l, Vector2<T>& v) {
                  Physics::ChangeLiftoffVelocity(p, l, v);
                })
    hooks.change_liftoff_velocity = &Physics::template ChangeLiftoffVelocity<T>;
  if constexpr (requires(const T* p, T& h) { Physics::ChangeContactHeight(p, h); })
    hooks.change_contact_height = &Physics::template ChangeContactHeight<T>;
  if constexpr (requires(const T* p, const T& v, T& e) { Physics::ChangeRestitution(p, v, e); })
    hooks.change_restitution = &Physics::template ChangeRestitution<T>;
  if constexpr (requires(const T* p, const Bounce<T>& b, T& v) {
                  Physics::ChangeBounceSpeed(p, b, v);
                })
    hooks.change_bounce_speed = &Physics::template ChangeBounceSpeed<T>;
  if constexpr (requires(const T* p, const T& v, T& a) { Physics::ChangeTouchdownAngle(p, v, a); })
    hooks.change_touchdown_angle = &Physics::template ChangeTouchdownAngle<T>;
  if constexpr (requires(const T* p, T& t) { Physics::ChangeObservationTime(p, t); })
    hooks.change_observation_time = &Physics::template ChangeObservationTime<T>;
  if constexpr (requires(const T* p, T& t) { Physics::ChangePoseTime(p, t); })
    hooks.change_pose_time = &Physics::template ChangePoseTime<T>;
  if constexpr (requires(const T* p, Observation<T>& o) { Physics::ChangeObservation(p, o); })
    hooks.change_observation = &Physics::template ChangeObservation<T>;
  return hooks;
}
}  // namespace effect_detail

/// The registry entry of a physics: a struct with `kInfo` and templated static hooks of the names
/// above (ChangeParameters, AddBodyForce, ...).
template <class Physics>
constexpr Effect MakeEffect() {
  using namespace effect_detail;
  return {Physics::kInfo,
          HooksOf<Physics, double>(),
          HooksOf<Physics, Jet<1>>(),
          HooksOf<Physics, Jet<kNarrowJet>>(),
          HooksOf<Physics, Jet<kWideJet>>(),
          HooksOf<Physics, Jet<kWidestJet>>()};
}

}  // namespace hoplab
