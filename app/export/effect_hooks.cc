#include "app/export/effect_hooks.h"

#include <utility>

namespace hoplab {
namespace {

using P = FormulaPlace;
using V = FormulaVariable;

constexpr std::string_view kBodyForce =
    "AddBodyForce(const T* p, const BodyMotion<T>& body, Vector2<T>& force)";
constexpr std::string_view kLanding =
    "ChangeLandingVelocity(const T* p, const Landing<T>& landing,\n"
    "                                    Vector2<T>& velocity)";
constexpr std::string_view kReading = "ChangeObservation(const T* p, Observation<T>& seen)";
constexpr std::string_view kSpeed =
    "    const T speed = Root(T(body.vx * body.vx + body.vy * body.vy));\n";
constexpr const char* kNoDirection = "    if (Value(speed) == 0.0) return;  // no direction\n";
constexpr const char* kChordFrame = "    const Vector2<T>& e = landing.chord;\n";
constexpr std::string_view kAlong = "    const T along = velocity.x * e.x + velocity.y * e.y;\n";
constexpr std::string_view kAcross = "    const T across = velocity.x * e.y - velocity.y * e.x;\n";

EffectHook HookOf(FormulaPlace place) {
  switch (place) {
    case P::kBodyForceX:
      return {kBodyForce, "", "    force.x += $;\n"};
    case P::kBodyForceY:
      return {kBodyForce, "", "    force.y += $;\n"};
    case P::kBodyForceAlong:
      return {kBodyForce, kNoDirection,
              "    const T share = T($) / speed;\n"
              "    force.x += share * body.vx;\n    force.y += share * body.vy;\n"};
    case P::kBodyForceAcross:
      return {kBodyForce, kNoDirection,
              "    const T share = T($) / speed;\n"
              "    force.x -= share * body.vy;\n    force.y += share * body.vx;\n"};
    case P::kChordForce:
      return {"AddChordForce(const T* p, const ChordMotion<T>& chord, T& force)", "",
              "    force += $;\n"};
    case P::kHipTorque:
      return {"AddHipTorque(const T* p, const HipMotion<T>& hip, T& torque)", "",
              "    torque += $;\n"};
    case P::kLandingVelocityAlong:
      return {kLanding, kChordFrame,
              "    const T change = T($);\n"
              "    velocity.x += change * e.x;\n    velocity.y += change * e.y;\n"};
    case P::kLandingVelocityAcross:
      return {kLanding, kChordFrame,
              "    const T change = T($);\n"
              "    velocity.x += change * e.y;\n    velocity.y -= change * e.x;\n"};
    case P::kTouchdownAngle:
      return {"ChangeTouchdownAngle(const T* p, const T& vx, T& theta_td)", "",
              "    theta_td += $;\n"};
    case P::kReadingX:
      return {kReading, "", "    seen[Channel::kBodyX] += $;\n"};
    case P::kReadingY:
      return {kReading, "", "    seen[Channel::kBodyY] += $;\n"};
    case P::kRestitution:
      return {"ChangeRestitution(const T* p, const T& speed, T& restitution)", "",
              "    restitution += $;\n"};
  }
  return {};
}

// The object of the hook that holds the variables of a place.
std::string_view HolderOf(FormulaPlace place) {
  switch (place) {
    case P::kBodyForceX:
    case P::kBodyForceY:
    case P::kBodyForceAlong:
    case P::kBodyForceAcross:
      return "body";
    case P::kChordForce:
      return "chord";
    case P::kHipTorque:
      return "hip";
    case P::kReadingX:
    case P::kReadingY:
      return "seen";
    default:
      return "velocity";
  }
}

}  // namespace

std::string CodeOf(FormulaVariable variable, FormulaPlace place) {
  const std::string of = std::string(HolderOf(place)) + ".";
  const bool reads = place == P::kReadingX || place == P::kReadingY;
  const bool lands = place == P::kLandingVelocityAlong || place == P::kLandingVelocityAcross;
  switch (variable) {
    case V::kTime:
      return reads ? "" : of + "t";
    case V::kX:
      return reads ? "seen[Channel::kBodyX]" : of + "x";
    case V::kY:
      return reads ? "seen[Channel::kBodyY]" : of + "y";
    case V::kVx:
      if (place == P::kTouchdownAngle) return "vx";
      return reads ? "seen[Channel::kBodyVx]" : of + (lands ? "x" : "vx");
    case V::kVy:
      if (place == P::kTouchdownAngle) return "";
      return reads ? "seen[Channel::kBodyVy]" : of + (lands ? "y" : "vy");
    case V::kSpeed:
      return "speed";
    case V::kInStance:
      return "(body.in_stance ? 1.0 : 0.0)";
    case V::kCompression:
      return place == P::kHipTorque ? "" : "chord.compression";
    case V::kChordRate:
      return "chord.rate";
    case V::kElastic:
      return "chord.elastic_force";
    case V::kStiffness:
      return "chord.stiffness";
    case V::kLoading:
      return "Step(T(-chord.rate))";
    case V::kMotor:
      return "hip.motor_torque";
    case V::kAlong:
      return "along";
    case V::kAcross:
      return "across";
    case V::kTheta:
      return "landing.theta";
    case V::kAngle:
    case V::kAngleRate:
    case V::kHop:
      return "";
  }
  return "";
}

EffectHook HookFor(const Formula& formula) {
  EffectHook hook = HookOf(formula.place());
  std::string before;
  if (HolderOf(formula.place()) == "body" && (!hook.before.empty() || formula.Uses(V::kSpeed)))
    before += kSpeed;
  before += hook.before;
  if (formula.Uses(V::kAlong)) before += kAlong;
  if (formula.Uses(V::kAcross)) before += kAcross;
  hook.before = std::move(before);
  return hook;
}

}  // namespace hoplab
