#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "model/formula/unit.h"

namespace hoplab {

/// Where a formula acts.
enum class FormulaPlace {
  kBodyForceX,
  kBodyForceY,
  kBodyForceAlong,   // the velocity
  kBodyForceAcross,  // to its left: (-vy, vx)/|v|
  kChordForce,
  kHipTorque,
  kLandingVelocityAlong,   // the chord, away from the contact
  kLandingVelocityAcross,  // forward of it
  kTouchdownAngle,
  kReadingX,
  kReadingY,
  kRestitution
};

/// What a formula may know, one word for each place it is known in.
enum class FormulaVariable {
  kTime,
  kX,
  kY,
  kVx,
  kVy,
  kSpeed,
  kInStance,
  kCompression,
  kChordRate,
  kElastic,
  kStiffness,
  kLoading,
  kAngle,
  kAngleRate,
  kMotor,
  kAlong,
  kAcross,
  kTheta,
  kHop
};
inline constexpr int kFormulaVariables = static_cast<int>(FormulaVariable::kHop) + 1;

/// A variable at a place.
struct VariableInfo {
  FormulaVariable variable;
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  double usual;                 // a size it has in a hop, in its unit
  bool never_negative = false;  // but for what a step may reach beyond an event
};

/// A place: its word in files, the unit of what it adds, and what a formula there may use.
struct PlaceInfo {
  FormulaPlace place;
  std::string_view name;
  std::string_view unit;
  std::string_view symbol;   // what it adds to, as "F_x"
  std::string_view meaning;  // "the force on the body, forward"
  std::span<const VariableInfo> variables;
  bool for_legs, for_ball;
  bool in_flow;  // it is integrated, so that the solver stops at its corners
};

std::span<const PlaceInfo> AllPlaces();
const PlaceInfo& InfoOf(FormulaPlace place);
const PlaceInfo* FindPlace(std::string_view name);
/// Null if a formula there does not know it.
const VariableInfo* FindVariable(const PlaceInfo& place, std::string_view name);

}  // namespace hoplab
