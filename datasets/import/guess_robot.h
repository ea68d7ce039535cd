#pragma once

#include <vector>

#include "datasets/import/guess_columns.h"

namespace hoplab {

/// Columns of a robot by what they are called: its pitch, and of each leg, hindmost first, angle,
/// torque, contact and the angle its controller follows. Legs are told by numbers, from 0 or 1
/// without a gap, or by front, middle and rear. What is of more than four legs, or of two legs of
/// one place, is not taken and noted. `map` has the time. Units of angles that the file does not
/// state are guessed from how far and how fast they turn; left empty where that does not tell.
Guesses GuessRobot(const Table& table, const ColumnMap& map);

/// Whether there is a pitch, and columns of legs that cannot be told apart.
bool HasUnclearLegs(const Guesses& guesses);

/// Whether a pitch and a leg's angle are among the columns.
bool LooksLikeRobot(const std::vector<MappedColumn>& columns);

}  // namespace hoplab
