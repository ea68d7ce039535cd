#pragma once

#include <optional>
#include <string>
#include <vector>

#include "datasets/origin.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {

/// What the set-up says of a cause: that it is not there, or how large it can be at most. Names are
/// those of the catalogue of effects and are not checked here.
struct KnownSpec {
  std::string effect;
  std::string parameter;          // empty: said of the effect as a whole
  std::optional<double> at_most;  // away from its null, in its own unit; absent: it is not there
  Origin origin = {};
  bool operator==(const KnownSpec&) const = default;
};

/// The block `known`: {gravity_scale: none, camera_roll: {at_most: 0.002},
/// boom_inertia: {mu_x: none, mu_y: {at_most: 0.1}}}.
std::vector<KnownSpec> ReadKnown(const YamlCursor& cursor);

}  // namespace hoplab
