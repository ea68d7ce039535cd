#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/import/table.h"

namespace hoplab {

/// Adds what unit quaternions say of a planar machine: `name`.angle_X, .angle_Y and .angle_Z, in
/// rad, the turn about that axis alone (2 atan2 of its component and w), without jumps of a whole
/// turn. `w`, `x`, `y`, `z` are the components' columns. A row that misses one has no angle.
void AddTurnAngles(const std::string& name, std::size_t w, std::size_t x, std::size_t y,
                   std::size_t z, Table* table);

}  // namespace hoplab
