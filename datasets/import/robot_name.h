#pragma once

#include <optional>
#include <string>

#include "datasets/import/unit.h"

namespace hoplab {

/// What a column of a robot's log is by its title: "phi1_deg", "tau_left_front [Nm]", "pitch".
struct RobotName {
  enum class Quantity { kPitch, kAngle, kReference, kTorque, kToldTorque, kContact };
  enum class Place { kRear, kMiddle, kFront };
  Quantity quantity = Quantity::kPitch;
  std::optional<int> number;   // of the leg, as it stands there; 0 may be the first
  std::optional<Place> place;  // of the leg along the body
  bool has_side = false;       // left or right
};

/// Nothing where a word of the title is not known to belong to such a name, or where its unit, or
/// `unit` as the file states it beside, is of another kind.
std::optional<RobotName> ReadRobotName(const std::string& title, const std::string& unit);

/// What it is measured in.
Dimension DimensionOf(RobotName::Quantity quantity);

}  // namespace hoplab
