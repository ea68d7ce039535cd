#pragma once

#include <array>

#include "model/mechanisms/legged_body.h"

namespace hoplab {

/// A body on a leg with a second point mass at its toe (M40-M46; thesis 4.7-4.14). In flight hip
/// and toe are two bodies joined by the chord spring and the placement torque; in stance the toe is
/// held, the leg is the massless one, and only what ends a stance differs.
/// State: ToeState. Modes: those of the massless leg.
template <class T>
class ToeMassBody final : public HybridSystem<T> {
 public:
  explicit ToeMassBody(const MechanismSetup<T>& setup);

  int size() const override { return kToeStateSize; }
  int BodyCount(Mode mode) const override { return mode == Mode::kFlight ? 2 : 1; }
  void SaveDiscreteState(DiscreteState& to) const override;
  void LoadDiscreteState(DiscreteState& from) override;
  void StartSearch(Mode mode, const double* z) override;
  Mode Begin(Mode mode, T* z) override;
  /// A run begins with the toe of a leg at rest against the hip, relaxed at the touch-down angle.
  void CompleteStart(T* z, int given) const override;

  void Derivative(Mode mode, const T& t, const T* z, T* dz) const override;

  int GuardCount(Mode mode) const override;
  GuardSpec Guard(Mode mode, int i) const override;
  void Guards(Mode mode, const T& t, const T* z, T* g) const override;

  ResetResult Reset(Mode mode, int i, const T& t, T* z) override;
  void Touch(Mode mode, int i) override { body_.TouchCorner(i - OwnGuardCount(mode)); }

  /// The first flight, of a relaxed leg, is in closed form.
  bool IsBallistic(Mode mode) const override;
  BallisticFlight<T> Ballistic(const T* z) const override;

  /// Free flight of hip and toe alike, for what comes after the end of a run.
  std::optional<BallisticFlight<T>> FreeFlight() const override {
    return BallisticFlight<T>{.ax = gravity_x_, .ay = gravity_y_, .is_pair = true};
  }

  /// In flight a tenth of a radian of the toe's oscillation on the leg, or of its decay.
  double FirstStep(Mode mode, const T* z) const override;

  /// While a relaxed leg falls the state does not feel how stiff it is, its sensitivities do: the
  /// time in which the toe answers to being moved or pushed off its place [s].
  double LongestStep(Mode mode, const T& t, const T* z) const override;

  /// What the sensors see, before the observation effects. The ground carries the toe's weight; in
  /// flight leg angle and length are the leg's own.
  Observation<T> Observe(Mode mode, const T& t, const T* z) const override;

  /// Kinetic, potential and strain energy of hip, toe and leg [J].
  T Energy(Mode mode, const T* z) const override;
  double DeflectionRatio(Mode mode, const double* z) const override {
    return body_.DeflectionRatio(mode, z);
  }

 private:
  // Which of its guards a flight watches.
  enum class Flight { kFirst, kRising, kFalling, kLost };

  // Hip and toe in flight, the hip over a toe at rest.
  struct Swing {
    LegLoad<T> load;
    T theta;           // leg angle [rad]
    T torque;          // on the hip, positive pushes it forward [N m]
    Vector2<T> force;  // of the leg on the hip; on the toe its opposite [N]
    HipMotion<T> hip;  // before what effects add
  };

  static Parameters<T> InTheAir(Parameters<T> p);

  EventKind FlightEvent(int i) const;

  // The hip over a toe that stands at (u, 0): a state for the law of a leg on its toe, which does
  // not know whether that is held.
  using HipOverToe = std::array<T, kLegStateSize>;
  HipOverToe Relative(const T* z) const;
  void TakeRoundingOut(const T* z, HipOverToe& hip) const;
  LegLoad<T> SwingLoad(const T& t, const HipOverToe& hip) const;
  LegLoad<T> SwingLoad(const T& t, const T* z) const { return SwingLoad(t, Relative(z)); }
  static T LegAngle(const T* z);
  Swing SwingAt(const T& t, const T* z) const;
  T ReachDown(const T* z) const;
  T LiftoffGuard(const LegLoad<T>& load, const T& t) const;

  int FlightGuardCount() const;
  int OwnGuardCount(Mode mode) const {
    return mode == Mode::kFlight ? FlightGuardCount()
                                 : body_.GuardCount(mode) - body_.corner_count();
  }
  ResetResult ResetOwn(Mode mode, int i, const T& t, T* z);
  template <class Act>
  void WithMotionsAt(Mode mode, const T& t, const T* z, const Act& act) const;
  void Seat(Mode mode, const T& t, const T* z);

  ResetResult TouchDown(const T& t, T* z);
  ResetResult LiftOff(Mode mode, const T& t, T* z);
  bool IsTooLow(const T* z) const { return Value(z[kY] - body_.TouchdownHeight(z)) < 0.0; }
  Vector2<T> HeldToe(Mode mode, const T& t, const T* z) const;

  Parameters<T> p_;
  LeggedBody<T, Leg<T>> body_;
  LegStorage<T> swing_;
  bool extended_, falls_freely_;
  T gravity_x_, gravity_y_;
  T length_;  // chord of the unloaded leg to its toe [m]
  Flight flight_ = Flight::kFirst;
  bool may_pull_ = true;
};

}  // namespace hoplab
