#pragma once

#include <array>

#include "model/hybrid/hybrid_system.h"
#include "model/mechanisms/gear.h"
#include "model/mechanisms/inertia.h"
#include "model/mechanisms/leg_form.h"
#include "model/mechanisms/mechanism_setup.h"
#include "model/mechanisms/motion_equations.h"
#include "model/mechanisms/motor_clock.h"
#include "model/mechanisms/robot_leg.h"
#include "model/mechanisms/robot_leg_bending.h"
#include "model/mechanisms/robot_leg_shape.h"

namespace hoplab {

/// A rigid body with pitch on up to four legs, arcs or straight ones, each clamped to a motor at
/// its hip (section 8 of the equation sheet). State: x, y, vx, vy of the body's reference point,
/// pitch and its rate, the legs' angles, their rates, of each leg the contact coordinate (X0 while
/// it rolls, x_c on its toe), of each motor whose gear has play its twist and the rotor's rate,
/// where motors lag what each is giving, and where its legs have inertia the rate of each leg's own
/// motion (on the ground of its foot as it slides, in the air of its bending) and how far it is
/// bent in the air. Flight is when no leg is on the ground; which ones are and how is a discrete
/// state.
template <class T>
class Robot final : public HybridSystem<T> {
 public:
  explicit Robot(const MechanismSetup<T>& setup);

  int size() const override { return OwnRate(follows_legs_ ? 2 * legs_ : 0); }
  int ReportedSize() const override { return OwnRate(0); }
  void Derivative(Mode mode, const T& t, const T* z, T* dz) const override;
  int GuardCount(Mode mode) const override;
  GuardSpec Guard(Mode mode, int i) const override;
  void Guards(Mode mode, const T& t, const T* z, T* g) const override;
  ResetResult Reset(Mode mode, int i, const T& t, T* z) override;

  bool CompletesAnyStart() const override { return true; }
  void CompleteStart(T* z, int given) const override;
  Mode Begin(Mode mode, T* z) override;
  Mode Resume(std::span<const Foot> feet, T* z) override;
  void TellFeet(std::vector<Foot>& feet) const override;
  void SaveDiscreteState(DiscreteState& to) const override;
  void LoadDiscreteState(DiscreteState& from) override;
  void StartSearch(Mode mode, const double* z) override;
  double NextKnot(Mode mode) const override;
  std::optional<T> PassKnot(Mode mode, double t, T* z) override;
  std::optional<BallisticFlight<T>> FreeFlight() const override;
  double ErrorUnit(int i) const override;
  double FirstStep(Mode mode, const T* z) const override;
  double LongestStep(Mode mode, const T& t, const T* z) const override;
  Observation<T> Observe(Mode mode, const T& t, const T* z) const override;
  T Energy(Mode mode, const T* z) const override;

 private:
  template <class>
  friend class Robot;  // of values alone
  using Stance = Foot::Stance;
  struct Leg {
    Stance stance = Stance::kFlight;
    double slides = 0.0;  // direction of its foot
    double sunk = 0.0;    // how far above the ground its lowest point left it, if below [m]
    double floor = 0.0;   // height of what it stands on: below 0 where it sank before it landed [m]
    int turns = 0;        // whole turns taken off the hip's angle since it landed
    int limit = 0;        // side of the torque limit its motor is at
    int piece = 0;        // of its clock
    int teeth = 0;        // of its gear that are pressed, 0: none
    int gear_place = -1;  // of its gear among those with play; -1: it has none
    double turns_by = 0.0;  // way its hip turns against dry friction, 0: not
    bool is_held = false;   // its hip, by dry friction
    bool is_told = false;   // its motor, a torque that was recorded
    Gear<T> gear = {};
    RobotLeg<T> law = {};
    MotorClock<T> clock = {};
    bool geared() const { return gear_place >= 0; }
  };
  /// The guards there are, in the order they fire.
  struct GuardRef {
    EventKind event;
    int leg;
    double scale;
    double side =
        0.0;  // the direction the foot would slide at its cone; it slides as it snaps away
  };
  /// The hip of a leg: from the reference point, its velocity, the angle of the leg on the ground.
  struct Hip {
    T x, y;    // from the reference point, frame of the ground [m]
    T vx, vy;  // [m/s]
    T angle;   // beta [rad], whole turns included
    T rate;    // [rad/s]
  };

  int Pitch() const { return 4; }
  int Angle(int leg) const { return 6 + leg; }
  int Rate(int leg) const { return 6 + legs_ + leg; }
  int Contact(int leg) const { return 6 + 2 * legs_ + leg; }
  int Twist(const Leg& leg) const { return 6 + 3 * legs_ + 2 * leg.gear_place; }
  int RotorRate(const Leg& leg) const { return Twist(leg) + 1; }
  int Given(int leg) const { return 6 + 3 * legs_ + 2 * gears_ + leg; }
  int OwnRate(int leg) const { return Given(0) + (lags_ ? legs_ : 0) + leg; }
  int Bent(int leg) const { return OwnRate(legs_) + leg; }
  bool HasCone() const { return Value(robot_.friction) < std::numeric_limits<double>::infinity(); }
  bool IsDown(const Leg& leg) const { return leg.stance != Stance::kFlight; }
  /// Whether a leg bends in the air (M98).
  bool Bends(int leg) const { return follows_legs_ && !IsDown(leg_[leg]); }
  /// Whether a foot slides with a speed of its own (M89).
  bool FootMoves(int leg) const { return foot_has_inertia_ && leg_[leg].slides != 0.0; }
  Footing FootOf(const Leg& leg) const {
    return {leg.stance == Stance::kRolling, foot_has_inertia_ ? 0.0 : leg.slides};
  }

  /// The same of the end of the clamp, where the leg begins to bend.
  Hip ClampOf(const Hip& hip) const;
  /// Makes the legs as stiff as they are at that time of the run.
  void AgeLegs(const T& t) const;
  struct Frame;  // sine and cosine of the body's pitch over the ground
  Hip HipOf(const Frame& frame, int leg, const T* z) const;
  /// What legs and air do to body and motors.
  struct Push {
    Vector2<T> com;                             // from the reference point, frame of the ground [m]
    T force_x, force_y;                         // on the body [N]
    T moment;                                   // on the body about its centre of mass [N m]
    std::array<T, kMaxLegs> on_motor;           // on each leg's angle [N m]
    std::array<T, kMaxLegs> on_rotor;           // on each rotor whose gear has play [N m]
    std::array<ClampedLoad<T>, kMaxLegs> load;  // of each leg that is down
  };
  struct Forces;  // what feet and hips bear
  // Until it is called again.
  Push& PushOf(const Frame& frame, const T& t, const T* z) const;
  // `holding`, if asked for: what each hip that is held bears [N m].
  void Accelerate(const Frame& frame, const Push& push, const T* z, T* dz,
                  T* holding = nullptr) const;
  void AddFirstMass(const Frame& frame, const T* z, T* dz, T* holding) const;
  void AccelerateWithLegMass(const Frame& frame, const Push& push, const T* z, T* dz,
                             T* holding) const;
  void LagShortly(const Frame& frame, Push& push, const T* z, T* dz, T* holding = nullptr) const;
  void MissJump(int leg, const T& jump, const T* at, T* z) const;
  struct LegInertia;  // the mass of a leg in the way it is now
  struct LegLoad;     // forces on it
  struct MovingLegs;  // the masses of all of them
  struct Sides;       // forces or momenta of all motions
  LegInertia InertiaOf(int i, const Hip& hip) const;
  template <std::size_t kForms>
  static void SetRigidForms(Vector2<double> centre, double inertia,
                            std::array<LegForm, kForms>& forms);
  LegInertia RigidLeg(const T& angle) const;
  LegInertia LegInAir(const T& angle) const;
  Vector2<T> ContactBending(const T& angle) const;
  T HeldUp(int i, const T& angle, const T* z) const;
  void TakeBendAlong(int i, const T& angle, T* z);
  T DrawnOff(const Leg& leg, const Hip& hip, const T& press, const T* z) const;
  struct Seen;  // what guards ask about
  Seen LookAt(Mode mode, const T& t, const T* z) const;
  T MarginOf(const GuardRef& guard, const Seen& seen, const T& t, const T* z) const;
  T TouchdownMargin(const GuardRef& guard, const Hip& hip, const T* z) const;
  T LiftoffMargin(const GuardRef& guard, const Hip& hip, const ClampedLoad<T>& load, const T& press,
                  const T* z) const;
  void GoOnIfBrushed(int i, const T& t, T* z);
  T BendLeft(int i, const Hip& hip, const T* z) const;
  LegInertia StandingLeg(int i, const Hip& hip) const;
  void LetFootMove(const Hip& hip, double slides, LegInertia& leg) const;
  LegMotion<T> MotionUnder(int i, const Hip& hip, const T* rates) const;
  Vector2<T> GroundForce(const Frame& frame, int i, const Push& push, const T* z,
                         const T* dz) const;
  Forces ForcesOf(const Frame& frame, const T& t, const T* z) const;
  void SlideOutsideCone(int i, double went, const T& t, const T* z);
  std::optional<Outcome> Happens(const GuardRef& guard, const T& t, T* z,
                                 std::optional<EventKind>& turned_out);
  void TakeJump(const GuardRef& guard, const std::array<T, kMaxLegs>& told, const T& t, T* z);
  void Settle(int except, const T& t, T* z);
  void AskCones(int except, const T& t, T* z);
  LegMotion<T> MotionOf(int i, const Hip& hip, const T* z) const;
  Vector2<T> PressOf(int i, const Hip& hip, const T* z) const;
  template <class Inertia, class S>
  static LegMotion<S> UnitLoad(const Inertia& leg, const LegMotion<S>& u, const S& rate,
                               const S& gx, const S& gy, S& moment);
  LegLoad LoadOf(int i, const Hip& hip, const LegInertia& leg, const T* z) const;
  MotionEquations EquationsOf(const Vector2<T>& com, const MovingLegs& legs) const;
  Sides Left(const Vector2<T>& com, const MovingLegs& legs, const Sides& sides,
             const AllMotions<double>& a) const;
  void SolveMotion(const Vector2<T>& com, const MovingLegs& legs, const Sides& sides, T* dz,
                   T* holding = nullptr) const;
  struct Impact;  // an instant at which a leg lands, leaves or changes its way
  Impact MomentaOf(const T* z, int without) const;
  void GoOnWith(const Impact& now, T* z);
  void Blow(int i, T* z);
  void SpringOff(int i, T* z);
  void ChangeStance(int i, Stance to, T* z);
  /// Of its hip over what the leg stands on, or over the ground.
  T HeightOf(const Leg& leg, const Hip& hip, const T* z) const;
  ClampedPlace<T> PlaceOf(const Leg& leg, int i, const Hip& of, const T* z) const;
  /// The same from the end of the clamp.
  ClampedPlace<T> PlaceAt(const Leg& leg, int i, const Hip& hip, const T* z) const;
  static int TurnsOf(double angle);
  T Reach(const T& angle) const;
  /// Of the rotor, relative to the body: what an encoder on the motor reads.
  T MotorAngle(int leg, const T* z) const;
  T MotorRate(int leg, const T* z) const;
  struct Reference;  // what a motor's controller follows
  Reference ReferenceOf(int leg, const T& t) const;
  void SetUpMotor(int i);
  struct MotorSpeed {
    double swings, settles;  // undamped, and by its damping alone [1/s]
  };
  MotorSpeed SpeedOf(int i) const;
  static int TeethAt(const Leg& leg, double twist);
  void FindTeeth(const T* z);
  T GearTorque(const Leg& leg, int i, const T* z) const;
  bool IsDry(int leg) const;
  T HipFriction(int leg, const T* z) const;
  void LetHipsGo();
  void FindTurns(const T* z);
  void SettleHips(const T& t, T* z);
  bool HoldsHip() const;
  void TurnHip(int leg, const T& holding);
  T HipMargin(int leg, const T& holding, const T* z) const;
  T Command(int leg, const T& t, const T* z) const;
  T Torque(int leg, const T& t, const T* z) const;
  T ToldRate(int leg, const T* z, const T* dz) const;
  void FindLimit(int leg, double t, const T* z);
  void FindLimits(double t, const T* z);
  void MoveAlong(Mode mode, double t, const T& by, const T* z, T* to) const;
  void ListGuards(Mode mode);
  Mode ModeNow() const;
  /// The level at which a leg lands that has not risen above the ground it left [m].
  double SunkLevel(const Leg& leg) const;
  std::optional<Outcome> Land(int i, const T& t, T* z, bool comes_down = true);
  void Stick(int i, const T& t, T* z);
  void RollOnto(int i, Stance to, T* z);
  void SlideAway(const GuardRef& guard, T* z);
  void HoldFoot(int i, const T& t, T* z);
  T TorqueMargin(int i, const T& t, const T* z) const;
  T GearMargin(const Leg& leg, const T* z) const;
  void BeginOnFoot(int i, T* z);
  void LiftOff(int i, T* z);

  Parameters<T> p_;
  RobotParameters<T> robot_;
  ActiveEffects<T> effects_;
  InputSignals<T> inputs_;
  int legs_;
  int gears_ = 0;  // motors whose gear has play
  bool has_clamp_;
  T clamp_, cos_clamp_, sin_clamp_;  // the angle the clamp spans [rad]
  Inertia<T> body_;
  T gravity_x_, gravity_y_;  // of what no boom carries
  bool has_body_force_;
  bool has_leg_mass_;
  bool lags_, lags_shortly_;  // motors: with a state of their own, or to first order (M86)
  bool follows_legs_;         // these have enough mass for their shape to matter (M89, M98)
  bool foot_has_inertia_;     // and feet that may slide
  bool creeps_;               // feet that hold do, under a force along (M29)
  bool drifts_;               // the stiffness of all legs, with time
  mutable std::array<T, kMaxLegs> ahead_{};  // how far a foot stands ahead at the start, M119 [m]
  double size_;                              // of the legs, half of one unloaded [m]
  double fall_height_;
  std::array<Leg, kMaxLegs> leg_;
  mutable Push push_{};           // of the last evaluation: too many numbers to be cleared for each
  std::array<T, kMaxLegs> gain_;  // what each motor gives of what it is told [-]
  // A gain that is not 1; an encoder's zero or a motor's bias that is not 0.
  std::array<bool, kMaxLegs> has_gain_{}, has_zero_{}, has_bias_{};
  std::array<T, kMaxLegs> hub_;        // inertia that turns with each leg's base [kg m^2]
  std::array<bool, kMaxLegs> rubs_{};  // which hips have friction (M99)
  bool has_dry_hips_ = false;
  std::array<GuardRef, kMaxGuards> guards_;
  int guard_count_ = 0;
};

}  // namespace hoplab
