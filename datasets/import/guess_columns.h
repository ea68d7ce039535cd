#pragma once

#include <optional>
#include <string>
#include <vector>

#include "datasets/import/column_map.h"

namespace hoplab {

// Guesses at what a log's columns are, from their names and from physics: between contacts a height
// falls at 9.81 m/s^2, which tells the vertical axis, its sign and its unit. Each says why; none is
// used unless the user confirms it.

/// Whether a column of this name is the time: "time_s", "log.t", "Zeit [s]".
bool IsTimeName(const std::string& name);

/// The column of time: the one of that name, else the first that increases throughout. Throws
/// InputError if there is none.
MappedColumn GuessTime(const Table& table);

/// A height that is not taken, since it would fall in another unit than the file says.
struct UnitDoubt {
  std::string text;
  std::string map_text;  // the --map option that takes it so
};

struct Guesses {
  std::vector<MappedColumn> columns;
  std::vector<std::string> notes;  // what was not taken, and why
  std::optional<UnitDoubt> doubt;
  std::string unclear_legs;  // why a robot's legs cannot be told apart by their columns
};

/// Channels by what their columns are called and how they move. `map` has the time. A channel's
/// unit is left empty where the file states it. Those of a robot: as ResolveColumns has it.
Guesses GuessChannels(const Table& table, const ColumnMap& map, std::optional<MechanismKind> type);

struct GuessedUnit {
  LogUnit unit;
  std::string why;
};

/// The unit of a column from its numbers: a time by its steps, a height by how it falls, another
/// length as one that is known already; nothing for the rest.
std::optional<GuessedUnit> GuessUnit(const Table& table, const ColumnMap& map,
                                     const MappedColumn& mapped);

}  // namespace hoplab
