#pragma once

#include "datasets/mechanism_spec.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {

// The block of a mechanism. Throws InputError for a missing, unknown or misspelt key, a value of
// the wrong type or outside its range.

MechanismSpec ReadMechanism(const YamlCursor& cursor);
/// The mechanism of a trial: `base`, read from `base_node`, with the values under `mechanism` of
/// `item` over it. One way of giving the section replaces the other. Throws if the trial changes
/// the type.
MechanismSpec ReadTrialMechanism(const YamlCursor& item, const YamlNode& base_node,
                                 const MechanismSpec& base);

}  // namespace hoplab
