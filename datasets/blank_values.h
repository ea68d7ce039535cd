#pragma once

#include <string>
#include <vector>

#include "datasets/mechanism_spec.h"
#include "datasets/yaml_tree.h"

namespace hoplab {

/// A value that a fit needs and that has to be measured or looked up.
struct NeededValue {
  std::string key;        // "leg.rest_radius_m", below `mechanism`
  std::string hint;       // what it is and where to get it
  bool optional = false;  // a fit goes without; the hint says what then is
};

/// The needed values of a mechanism, in the order of the format.
const std::vector<NeededValue>& NeededValues(MechanismKind type);
/// What `touchdown_angle_deg` of a trial is.
extern const char* const kTouchdownAngleHint;
/// What of a robot are `hip_m` of a leg, `controller`, its `angles_rad` and `initial` of a trial.
extern const char* const kHipHint;
extern const char* const kMotorsHint;
extern const char* const kMotorAnglesHint;
extern const char* const kRobotStartHint;

/// A needed value whose key stands in a dataset.yaml with nothing behind it.
struct BlankValue {
  std::string place;  // "mine/dataset.yaml:8"
  std::string key;    // "mechanism.leg.rest_radius_m", "trials[0].touchdown_angle_deg"
  std::string hint;
};

/// All of them, in the order of the file; none for a tree that is no dataset.
std::vector<BlankValue> FindBlankValues(const YamlNode& dataset);

/// Throws one InputError that lists all blank values of `dataset`, if there are any.
void CheckNothingIsBlank(const YamlNode& dataset);

}  // namespace hoplab
