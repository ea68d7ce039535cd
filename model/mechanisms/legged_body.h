#pragma once

#include "model/hybrid/hybrid_system.h"
#include "model/mechanisms/inertia.h"
#include "model/mechanisms/leg.h"
#include "model/mechanisms/leg_inertia.h"
#include "model/mechanisms/mechanism_setup.h"
#include "model/mechanisms/speed_controller.h"
#include "model/observation.h"
#include "model/parameters.h"

namespace hoplab {

/// Cosine of the chord angle at which a leg counts as fallen (80 deg).
inline constexpr double kFallCosine = 0.17364817766693041;

/// The leg of a body, known to the compiler: what it costs to ask is what the law costs.
template <class T, class LegT>
class LegHolder {
 public:
  LegHolder(Law, const Parameters<T>& p) : leg_(p) {}
  LegT* operator->() { return &leg_; }
  const LegT* operator->() const { return &leg_; }
  const LegT& operator*() const { return leg_; }

 private:
  LegT leg_;
};
/// Any leg, chosen while the program runs.
template <class T>
class LegHolder<T, Leg<T>> {
 public:
  LegHolder(Law law, const Parameters<T>& p) { LegLawOf(law).Make(p, leg_); }
  Leg<T>* operator->() { return &*leg_; }
  const Leg<T>* operator->() const { return &*leg_; }
  const Leg<T>& operator*() const { return *leg_; }

 private:
  LegStorage<T> leg_;
};

/// A point mass on one leg (sections 3 and 4 of the equation sheet), massless but for the effect
/// leg_mass: flight, touch-down, lift-off, apex, falls, hip torque and body forces. What carries
/// the body in stance is a Leg. Defined in legged_body_inl.h and compiled with each law. State:
/// LegState, of a motor that lags what it gives, of a foot that may slide its speed (M87). Modes:
/// flight and those of the leg. On a slope everything is in the frame of the ground (GroundFrame).
template <class T, class LegT>
class LeggedBody final : public HybridSystem<T> {
 public:
  /// A shorter lag is taken to its first order [s].
  static constexpr double kShortestLag = 1e-5;
  /// A foot with less of the body's mass, or with less of 1/mu, slides as one without mass.
  static constexpr double kLeastFootShare = 1e-4, kLeastFriction = 1e-6;

  explicit LeggedBody(const MechanismSetup<T>& setup);

  int size() const override { return FootSpeed() + (foot_has_inertia_ ? 1 : 0); }
  int ReportedSize() const override { return kLegStateSize; }
  void Derivative(Mode mode, const T& t, const T* z, T* dz) const override;
  int GuardCount(Mode mode) const override;
  GuardSpec Guard(Mode mode, int i) const override;
  void Guards(Mode mode, const T& t, const T* z, T* g) const override;
  ResetResult Reset(Mode mode, int i, const T& t, T* z) override;
  void Touch(Mode mode, int i) override { effects_.TouchCorner(i - OwnGuardCount(mode)); }
  /// A start in stance: `z` has the place of its contact and leaves with the leg's coordinate of
  /// it.
  Mode Begin(Mode mode, T* z) override;
  double NextKnot(Mode mode) const override {
    return driven_ ? inputs_.NextKnot(mode == Mode::kFlight)
                   : std::numeric_limits<double>::infinity();
  }
  std::optional<T> PassKnot(Mode mode, double t, T* z) override;
  void SaveDiscreteState(DiscreteState& to) const override;
  void LoadDiscreteState(DiscreteState& from) override;
  void StartSearch(Mode mode, const double* z) override { leg_->StartSearch(mode, z); }
  bool IsBallistic(Mode mode) const override { return mode == Mode::kFlight && flies_freely_; }
  BallisticFlight<T> Ballistic(const T* z) const override;
  std::optional<BallisticFlight<T>> FreeFlight() const override;
  double FirstStep(Mode mode, const T* z) const override;
  Observation<T> Observe(Mode mode, const T& t, const T* z) const override;
  /// Kinetic, potential and strain energy [J]; the leg as stiff as at the start of the run.
  T Energy(Mode mode, const T* z) const override;
  double DeflectionRatio(Mode mode, const double* values) const override;

  const LegT& leg() const { return *leg_; }
  const Inertia<T>& inertia() const { return inertia_; }
  const ActiveEffects<T>& effects() const { return effects_; }
  const T& lowest_hip() const { return y_min_; }

  // What a body on a leg with a toe mass asks, and does otherwise.

  /// Guards of stance but for lift-off, g[0].
  void StanceGuards(Mode mode, const LegLoad<T>& load, const T& t, const T* z, T* g) const;
  /// Stance begins at leg angle `theta`, the contact `ahead` of where an unloaded leg would have
  /// it.
  ResetResult Land(const T& theta, const T& t, T* z, const T& ahead);
  LegLoad<T> Load(Mode mode, const T& t, const T* z) const;
  /// Force along the chord [N], positive pushes the hip away.
  T ChordForce(const LegLoad<T>& load, const T& t) const;
  /// What formulas on the chord see.
  ChordMotion<T> ChordMotionAt(const LegLoad<T>& load, const T& t) const;
  /// Leg angle the touch-down is commanded at.
  T TouchdownAngle(const T& t, const T* z) const;
  T TouchdownAngle(const T* z) const { return TouchdownAngle(T(0.0), z); }
  /// Height of the hip at which a leg at that angle meets the ground [m].
  T TouchdownHeight(const T& t, const T* z) const;
  T TouchdownHeight(const T* z) const { return TouchdownHeight(T(0.0), z); }
  Vector2<T> BodyForce(Mode mode, const T& t, const T* z) const;
  BodyMotion<T> BodyMotionAt(Mode mode, const T& t, const T* z) const {
    return {SinceFirstRow(t), z[kX], z[kY], z[kVx], z[kVy], mode != Mode::kFlight};
  }
  PlacementMotion<T> PlacementAt(const T* z) const { return {z[kVx], z[kVy], T(landings_ + 1.0)}; }
  T SinceFirstRow(const T& t) const { return t + p_.time_origin; }

  // Corners of formulas; `chord` and `hip` where the leg pushes, else null.

  int corner_count() const { return effects_.corner_count(); }
  GuardSpec CornerSpec(int i) const { return effects_.CornerSpec(i); }
  /// Calls `act` with what the body and the leg do.
  template <class Act>
  void WithMotions(Mode mode, const T& t, const T* z, const ChordMotion<T>* chord,
                   const HipMotion<T>* hip, const Act& act) const {
    const BodyMotion<T> body = BodyMotionAt(mode, t, z);
    const PlacementMotion<T> placement = PlacementAt(z);
    act(Motions<T>{&body, chord, hip, mode == Mode::kFlight ? &placement : nullptr});
  }
  /// The same for a body in flight or on a massless leg.
  template <class Act>
  void WithMotionsAt(Mode mode, const T& t, const T* z, const Act& act) const;
  void CornerGuards(const Motions<T>& motions, T* g) const { effects_.CornerGuards(motions, g); }
  void SeatCorners(const Motions<T>& motions) { effects_.SeatCorners(motions); }
  void TouchCorner(int i) { effects_.TouchCorner(i); }
  void CrossCorner(int i, const Motions<T>& motions) { effects_.CrossCorner(i, motions); }
  /// What a lift-off does to the velocity.
  void ApplyLiftoff(const LegLoad<T>& load, T* z) const;

 private:
  static bool DampsAlongArc(const MechanismSetup<T>& setup);
  static bool BendsByLoad(const MechanismSetup<T>& setup);
  static bool BendsByItsLaw(const MechanismSetup<T>& setup);
  static Parameters<T> ParametersOf(const MechanismSetup<T>& setup);
  bool FallsBelow(const T& touchdown) const;
  LegConditions<T> Conditions(Mode mode, const T& t, const T* z, const T* over) const;
  LegConditions<T> BentBy(const T& torque, const T& t) const;
  T WithUnloadedEffects(T torque, const T& t, const T* z) const;
  T QuickLagged(Mode mode, const T& motor, const LegLoad<T>& load, const T& t, const T* z) const;
  T CommandedTorque(const T& t, const T* z) const;
  T MotorTorque(const T& t, const T* z) const;
  T SweptAngle(const T& t, const T* z) const;
  /// How far ahead of the hip an unloaded leg at that angle meets the ground [m].
  T Lead(const T& theta) const;
  Mode PlaceContact(Mode mode, T* z);
  T HipTorque(Mode mode, const LegLoad<T>& load, const T& t, const T* z) const;
  T WithTorqueEffects(Mode mode, T torque, const LegLoad<T>& load, const T& t, const T* z) const;
  HipMotion<T> HipMotionAt(Mode mode, const T& torque, const LegLoad<T>& load, const T& t,
                           const T* z) const;
  ResetResult ResetOwn(Mode mode, int i, const T& t, T* z);
  int OwnGuardCount(Mode mode) const;
  void Seat(Mode mode, const T& t, const T* z);
  void ApplyLanding(const T& theta, T* z) const;
  LegInertia<T> InertiaOfLeg(const LegLoad<T>& load) const;
  LegLoad<T> Placed(const T& theta) const;
  LegMomentum<T> MomentumOfLeg(const LegLoad<T>& load) const;
  T KineticEnergyOfLeg(const LegLoad<T>& load, const T* z) const;
  Vector2<T> HeavyForce(const LegInertia<T>& leg, const Vector2<T>& force, const T& vx,
                        const T& vy) const;
  Vector2<T> HeavyAcceleration(const LegLoad<T>& load, const Vector2<T>& force, const T* z) const;
  // A leg with mass whose foot slides, M87.
  /// Index of the foot's speed over the ground [m/s].
  int FootSpeed() const { return lagged_ ? kLaggedLegStateSize : kLegStateSize; }
  void SlidingAcceleration(const LegLoad<T>& load, const Vector2<T>& force, Mode mode, const T& t,
                           const T* z, T* dz) const;
  SlidingFoot<T> SlidingFootOf(const LegLoad<T>& load, const Vector2<T>& force, Mode mode,
                               const T& t, const T* z) const;
  // One that a torque lifts, M122.
  bool CanLift() const { return foot_has_inertia_ && may_pull_; }
  void LiftFoot(const SlidingFoot<T>& foot, T* dz) const;
  T PullOfGround(Mode mode, const LegLoad<T>& load, const T& t, const T* z) const;
  void MayLift(Mode mode, const T& t, const T* z);
  std::array<T, 3> SolveSliding(const LegInertia<T>& leg, const LegMomentum<T>& momentum,
                                double side, std::array<T, 3> right) const;
  Vector2<T> GroundForce(Mode mode, const LegLoad<T>& load, const T& t, const T* z) const;
  T ConeMargin(Mode mode, const LegLoad<T>& load, const T& t, const T* z) const;
  bool Pushes(Mode mode, const T& t, const T* z) const;
  bool HoldsWithin(Mode mode, const T& t, const T* z) const;
  void BeginSlide(Mode mode, const T& t, T* z);
  void ResetFoot(EventKind event, Mode mode, const T& t, T* z);
  void LetFootGo(T* z);
  void TakeLegAlong(const LegLoad<T>& load, T* z);
  void LeaveWithLeg(const LegLoad<T>& load, const T& t, T* z);
  void AddSwing(const T& t, Observation<T>& seen) const;
  Vector2<T> HipForce(const LegLoad<T>& load, const T& torque, const T& t) const;

  Parameters<T> p_;
  ActiveEffects<T> effects_;
  LiftoffRule liftoff_;
  bool lagged_, has_body_force_, has_chord_force_, has_hip_torque_, has_hip_formula_,
      has_joint_torque_, is_driven_, has_quick_lag_, flies_freely_, extended_;
  bool bends_by_load_;  // a torque of the hip that needs the load, M94
  bool is_bar_, has_leg_mass_, has_foot_friction_;
  bool foot_has_inertia_;  // it slides as M87 says; else it slips away at once, M64
  bool damps_along_arc_;
  bool may_pull_;       // for a moment after touch-down, bent by the hip torque
  double torque_lift_;  // sign of the torque's vertical force: 1, or -1 (M37)
  Inertia<T> inertia_;
  LegHolder<T, LegT> leg_;
  SpeedController<T> controller_;
  T y_min_;
  T start_angle_;  // M47
  InputSignals<T> inputs_;
  std::vector<T> angles_;  // of the touch-downs; empty: theta_td, the first at start_angle_
  bool driven_;            // by an input
  int landings_ = 0;
  bool sinks_ = true;  // in flight, of a leg whose angle an input moves: it has passed its apex
  T swing_begin_{0.0}, swing_time_{0.0}, swing_x_{0.0}, swing_y_{0.0};  // after lift-off, M88
  double slides_ = 0.0;     // direction in which the foot slides; 0: it holds
  bool is_lifted_ = false;  // after touch-down, by the hip torque
};

}  // namespace hoplab
