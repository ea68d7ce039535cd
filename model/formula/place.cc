#include "model/formula/place.h"

#include <array>

namespace hoplab {
namespace {

using V = FormulaVariable;

constexpr std::array kBody = {
    VariableInfo{V::kTime, "t", "s", "time since the first row", 1.0, true},
    VariableInfo{V::kX, "x", "m", "place of the hip or ball, forward", 1.0},
    VariableInfo{V::kY, "y", "m", "its height", 1.0},
    VariableInfo{V::kVx, "vx", "m/s", "speed forward", 1.0},
    VariableInfo{V::kVy, "vy", "m/s", "speed upward", 1.0},
    VariableInfo{V::kSpeed, "speed", "m/s", "size of the velocity", 1.0, true},
    VariableInfo{V::kInStance, "in_stance", "-", "1 while the leg carries the body, else 0", 1.0,
                 true}};
constexpr std::array kChord = {
    VariableInfo{V::kCompression, "s", "-", "compression of the chord, (l0 - l)/l0", 0.1, true},
    VariableInfo{V::kChordRate, "rate", "m/s", "dl/dt, positive while lengthening", 1.0},
    VariableInfo{V::kElastic, "elastic", "N", "elastic force of the leg along the chord", 10.0,
                 true},
    VariableInfo{V::kStiffness, "stiffness", "N/m", "stiffness of the chord at small load", 1000.0,
                 true},
    VariableInfo{V::kLoading, "loading", "-", "1 while the chord shortens, else 0", 1.0, true},
    VariableInfo{V::kTime, "t", "s", "time since the first row", 1.0, true}};
constexpr std::array kHip = {
    VariableInfo{V::kAngle, "angle", "rad", "leg angle theta", 1.0},
    VariableInfo{V::kAngleRate, "rate", "rad/s", "d theta/dt, negative while rolling forward",
                 10.0},
    VariableInfo{V::kMotor, "motor", "N m", "torque of the motor", 1.0},
    VariableInfo{V::kVx, "vx", "m/s", "speed forward", 1.0},
    VariableInfo{V::kCompression, "s", "-", "compression of the chord, (l0 - l)/l0", 0.1, true},
    VariableInfo{V::kTime, "t", "s", "time since the first row", 1.0, true}};
constexpr std::array kLanding = {
    VariableInfo{V::kAlong, "along", "m/s", "velocity before, along the chord from contact to hip",
                 1.0},
    VariableInfo{V::kAcross, "across", "m/s", "velocity before, across the chord, forward", 1.0},
    VariableInfo{V::kVx, "vx", "m/s", "speed forward before", 1.0},
    VariableInfo{V::kVy, "vy", "m/s", "speed upward before", 1.0},
    VariableInfo{V::kTheta, "theta", "rad", "leg angle of the touch-down", 1.0}};
constexpr std::array kPlacement = {
    VariableInfo{V::kVx, "vx", "m/s", "speed forward", 1.0},
    VariableInfo{V::kVy, "vy", "m/s", "speed upward", 1.0},
    VariableInfo{V::kHop, "hop", "-", "which touch-down of the run comes, the first is 1", 1.0,
                 true}};
constexpr std::array kReading = {
    VariableInfo{V::kX, "x", "m", "place forward that is read", 1.0},
    VariableInfo{V::kY, "y", "m", "height that is read", 1.0},
    VariableInfo{V::kVx, "vx", "m/s", "speed forward", 1.0},
    VariableInfo{V::kVy, "vy", "m/s", "speed upward", 1.0},
    VariableInfo{V::kTime, "t", "s", "time since the first row", 1.0, true}};
constexpr std::array kImpact = {
    VariableInfo{V::kSpeed, "speed", "m/s", "speed of the impact", 1.0, true}};

using P = FormulaPlace;
// In the order of FormulaPlace.
constexpr std::array kPlaces = {
    PlaceInfo{P::kBodyForceX, "body_force_x", "N", "F_x", "force on the body, forward", kBody, true,
              true, true},
    PlaceInfo{P::kBodyForceY, "body_force_y", "N", "F_y", "force on the body, upward", kBody, true,
              true, true},
    PlaceInfo{P::kBodyForceAlong, "body_force_along", "N", "F_along",
              "force on the body, along its velocity", kBody, true, true, true},
    PlaceInfo{P::kBodyForceAcross, "body_force_across", "N", "F_across",
              "force on the body, across its velocity to the left", kBody, true, true, true},
    PlaceInfo{P::kChordForce, "chord_force", "N", "F_chord",
              "force along the chord of the loaded leg, positive pushes the hip away", kChord, true,
              false, true},
    PlaceInfo{P::kHipTorque, "hip_torque", "N m", "T",
              "torque on the hip in stance, positive pushes it forward", kHip, true, false, true},
    PlaceInfo{P::kLandingVelocityAlong, "landing_velocity_along", "m/s", "v_along",
              "velocity with which stance begins, along the chord from contact to hip", kLanding,
              true, false, false},
    PlaceInfo{P::kLandingVelocityAcross, "landing_velocity_across", "m/s", "v_across",
              "velocity with which stance begins, across the chord, forward", kLanding, true, false,
              false},
    PlaceInfo{P::kTouchdownAngle, "touchdown_angle", "rad", "theta_td",
              "leg angle that touches down", kPlacement, true, false, true},
    PlaceInfo{P::kReadingX, "reading_x", "m", "body_x", "what is read for the place forward",
              kReading, true, true, false},
    PlaceInfo{P::kReadingY, "reading_y", "m", "body_y", "what is read for the height", kReading,
              true, true, false},
    PlaceInfo{P::kRestitution, "restitution", "-", "restitution", "restitution of a ball", kImpact,
              false, true, false}};

}  // namespace

std::span<const PlaceInfo> AllPlaces() { return kPlaces; }
const PlaceInfo& InfoOf(FormulaPlace place) { return kPlaces[static_cast<std::size_t>(place)]; }
const PlaceInfo* FindPlace(std::string_view name) {
  for (const PlaceInfo& p : kPlaces)
    if (p.name == name) return &p;
  return nullptr;
}
const VariableInfo* FindVariable(const PlaceInfo& place, std::string_view name) {
  for (const VariableInfo& v : place.variables)
    if (v.name == name) return &v;
  return nullptr;
}

}  // namespace hoplab
