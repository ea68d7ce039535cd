#pragma once

#include <vector>

#include "datasets/mechanism_spec.h"
#include "datasets/scenario.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {

// What a scenario says of a single run.

/// Throws InputError for another format and for keys that no scenario has.
void CheckRoot(const YamlCursor& root);
/// Mechanism, controller, start and effects: all that a single run needs.
Scenario ReadRun(const YamlCursor& root);
/// touchdown_angle_deg: an angle, or a list of them.
void ReadAngles(const YamlCursor& owner, MechanismKind type, double* angle,
                std::vector<double>* angles);
/// Numbers by their names, at least `min_size`.
std::vector<NamedNumber> ReadNamedNumbers(const YamlCursor& cursor, std::size_t min_size);

}  // namespace hoplab
