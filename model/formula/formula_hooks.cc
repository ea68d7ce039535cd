#include <cmath>

#include "model/formula/formula.h"

namespace hoplab {
namespace {

using V = FormulaVariable;

template <class T>
const T*& At(FormulaView<T>& view, FormulaVariable v) {
  return view[static_cast<std::size_t>(v)];
}

template <class T>
T SpeedOf(const T& vx, const T& vy) {
  using std::sqrt;
  const T square = vx * vx + vy * vy;
  return Value(square) == 0.0 ? T(0.0) : T(sqrt(square));
}

constexpr CornerSides kNoEvents = {kFreeSide, kFreeSide, kFreeSide, kFreeSide};

// What the body's motion shows a formula; `own` keeps what has to be computed.
template <class T>
struct BodyView {
  FormulaView<T> at{};
  T speed{0.0}, in_stance;
  BodyView(const BodyMotion<T>& body, bool with_speed) : in_stance(body.in_stance ? 1.0 : 0.0) {
    if (with_speed) speed = SpeedOf(body.vx, body.vy);
    At(at, V::kTime) = &body.t;
    At(at, V::kX) = &body.x;
    At(at, V::kY) = &body.y;
    At(at, V::kVx) = &body.vx;
    At(at, V::kVy) = &body.vy;
    At(at, V::kSpeed) = &speed;
    At(at, V::kInStance) = &in_stance;
  }
};

template <class T>
FormulaView<T> ViewOf(const ChordMotion<T>& chord) {
  FormulaView<T> at{};
  At(at, V::kCompression) = &chord.compression;
  At(at, V::kChordRate) = &chord.rate;
  At(at, V::kElastic) = &chord.elastic_force;
  At(at, V::kStiffness) = &chord.stiffness;
  At(at, V::kTime) = &chord.t;
  return at;
}
template <class T>
FormulaView<T> ViewOf(const HipMotion<T>& hip) {
  FormulaView<T> at{};
  At(at, V::kAngle) = &hip.angle;
  At(at, V::kAngleRate) = &hip.rate;
  At(at, V::kMotor) = &hip.motor_torque;
  At(at, V::kVx) = &hip.vx;
  At(at, V::kCompression) = &hip.compression;
  At(at, V::kTime) = &hip.t;
  return at;
}
template <class T>
FormulaView<T> ViewOf(const PlacementMotion<T>& leg) {
  FormulaView<T> at{};
  At(at, V::kVx) = &leg.vx;
  At(at, V::kVy) = &leg.vy;
  At(at, V::kHop) = &leg.hop;
  return at;
}

}  // namespace

bool Formula::needs_load() const {
  return place_ == FormulaPlace::kHipTorque &&
         (Uses(V::kAngle) || Uses(V::kAngleRate) || Uses(V::kCompression));
}

template <class T>
void Formula::ChangeParameters(Parameters<T>& parameters) const {
  if (place_ == FormulaPlace::kHipTorque && Uses(V::kAngleRate))
    parameters.law_terms.active = parameters.law_terms.slopes_active = true;
}

template <class T>
void Formula::AddBodyForce(const T* p, const CornerSides& sides, const BodyMotion<T>& body,
                           Vector2<T>& force) const {
  const bool along = place_ == FormulaPlace::kBodyForceAlong;
  const bool across = place_ == FormulaPlace::kBodyForceAcross;
  const bool forward = place_ == FormulaPlace::kBodyForceX;
  if (!along && !across && !forward && place_ != FormulaPlace::kBodyForceY) return;
  const BodyView<T> view(body, along || across || Uses(V::kSpeed));
  if (forward || place_ == FormulaPlace::kBodyForceY) {
    (forward ? force.x : force.y) += Evaluate(p, view.at, sides);
    return;
  }
  if (Value(view.speed) == 0.0) return;  // no direction
  const T share = Evaluate(p, view.at, sides) / view.speed;
  if (along) {
    force.x += share * body.vx;
    force.y += share * body.vy;
  } else {
    force.x -= share * body.vy;
    force.y += share * body.vx;
  }
}

template <class T>
void Formula::AddChordForce(const T* p, const CornerSides& sides, const ChordMotion<T>& chord,
                            T& force) const {
  if (place_ == FormulaPlace::kChordForce) force += Evaluate(p, ViewOf(chord), sides);
}

template <class T>
void Formula::AddHipTorque(const T* p, const CornerSides& sides, const HipMotion<T>& hip,
                           T& torque) const {
  if (place_ == FormulaPlace::kHipTorque) torque += Evaluate(p, ViewOf(hip), sides);
}

template <class T>
void Formula::ChangeLandingVelocity(const T* p, const Landing<T>& landing,
                                    Vector2<T>& velocity) const {
  const bool along = place_ == FormulaPlace::kLandingVelocityAlong;
  if (!along && place_ != FormulaPlace::kLandingVelocityAcross) return;
  const Vector2<T>& e = landing.chord;
  const T v_along = velocity.x * e.x + velocity.y * e.y;
  const T v_across = velocity.x * e.y - velocity.y * e.x;
  FormulaView<T> at{};
  At(at, V::kAlong) = &v_along;
  At(at, V::kAcross) = &v_across;
  At(at, V::kVx) = &velocity.x;
  At(at, V::kVy) = &velocity.y;
  At(at, V::kTheta) = &landing.theta;
  const T change = Evaluate(p, at, kNoEvents);
  velocity.x += change * (along ? e.x : e.y);
  velocity.y += change * (along ? e.y : T(-e.x));
}

template <class T>
void Formula::ChangeTouchdownAngle(const T* p, const CornerSides& sides,
                                   const PlacementMotion<T>& leg, T& theta) const {
  if (place_ == FormulaPlace::kTouchdownAngle) theta += Evaluate(p, ViewOf(leg), sides);
}

template <class T>
void Formula::ChangeRestitution(const T* p, const T& speed, T& restitution) const {
  if (place_ != FormulaPlace::kRestitution) return;
  FormulaView<T> at{};
  At(at, V::kSpeed) = &speed;
  restitution += Evaluate(p, at, kNoEvents);
}

template <class T>
void Formula::ChangeObservation(const T* p, const T& t, Observation<T>& seen) const {
  const bool forward = place_ == FormulaPlace::kReadingX;
  if (!forward && place_ != FormulaPlace::kReadingY) return;
  FormulaView<T> at{};
  At(at, V::kX) = &seen[Channel::kBodyX];
  At(at, V::kY) = &seen[Channel::kBodyY];
  At(at, V::kVx) = &seen[Channel::kBodyVx];
  At(at, V::kVy) = &seen[Channel::kBodyVy];
  At(at, V::kTime) = &t;
  seen[forward ? Channel::kBodyX : Channel::kBodyY] += Evaluate(p, at, kNoEvents);
}

template <class T>
bool CornerArgumentAt(const Formula& formula, int corner, const T* p, const CornerSides& sides,
                      const Motions<T>& motions, T& argument) {
  switch (formula.place()) {
    case FormulaPlace::kChordForce:
      if (!motions.chord) return false;
      argument = formula.CornerArgument(corner, p, ViewOf(*motions.chord), sides);
      return true;
    case FormulaPlace::kHipTorque:
      if (!motions.hip) return false;
      argument = formula.CornerArgument(corner, p, ViewOf(*motions.hip), sides);
      return true;
    case FormulaPlace::kTouchdownAngle:
      if (!motions.placement) return false;
      argument = formula.CornerArgument(corner, p, ViewOf(*motions.placement), sides);
      return true;
    default:
      if (!motions.body) return false;
      argument = formula.CornerArgument(
          corner, p, BodyView<T>(*motions.body, formula.Uses(V::kSpeed)).at, sides);
      return true;
  }
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type.
#define HOPLAB_FORMULA_IN(T)                                                                    \
  template void Formula::ChangeParameters(Parameters<T>&) const;                                \
  template void Formula::AddBodyForce(const T*, const CornerSides&, const BodyMotion<T>&,       \
                                      Vector2<T>&) const;                                       \
  template void Formula::AddChordForce(const T*, const CornerSides&, const ChordMotion<T>&, T&) \
      const;                                                                                    \
  template void Formula::AddHipTorque(const T*, const CornerSides&, const HipMotion<T>&, T&)    \
      const;                                                                                    \
  template void Formula::ChangeLandingVelocity(const T*, const Landing<T>&, Vector2<T>&) const; \
  template void Formula::ChangeTouchdownAngle(const T*, const CornerSides&,                     \
                                              const PlacementMotion<T>&, T&) const;             \
  template void Formula::ChangeRestitution(const T*, const T&, T&) const;                       \
  template void Formula::ChangeObservation(const T*, const T&, Observation<T>&) const;          \
  template bool CornerArgumentAt(const Formula&, int, const T*, const CornerSides&,             \
                                 const Motions<T>&, T&);
HOPLAB_FORMULA_IN(double)
HOPLAB_FORMULA_IN(Jet<1>)
HOPLAB_FORMULA_IN(Jet<kNarrowJet>)
HOPLAB_FORMULA_IN(Jet<kWideJet>)
HOPLAB_FORMULA_IN(Jet<kWidestJet>)
#undef HOPLAB_FORMULA_IN
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace hoplab
