#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/mechanism_kind.h"
#include "datasets/import/column_target.h"
#include "datasets/import/table.h"

namespace hoplab {

/// What the user says of one channel: `y=-Z:mm`.
struct MapEntry {
  ColumnTarget target;
  std::string column;  // as the file has it, its title without unit, or #3
  bool negate = false;
  std::string unit;  // empty: as the file says
};

/// Nothing where the text is not CHANNEL=[-]COLUMN[:UNIT]. What stands behind the last colon is a
/// unit if there is one of that name, else part of the column's. Throws InputError for a channel
/// that does not exist.
std::optional<MapEntry> ParseMapEntry(const std::string& text);

/// One target and where its samples come from.
struct MappedColumn {
  ColumnTarget target;
  std::size_t column = 0;  // of the table
  bool negate = false;
  LogUnit unit;
  bool guessed = false;  // the column or its unit is neither in the file nor said by the user
  std::string why;       // "falls at 9.79 m/s^2"
};

/// Channels of a table, time first unless the log has none.
struct ColumnMap {
  std::vector<MappedColumn> columns;
  std::vector<std::string> warnings;
  bool HasGuesses() const;
  /// Whether a column is one that only a robot has.
  bool IsRobots() const;
};

/// What the user's entries mean in this table; time, units and, if there are no entries, channels
/// that they do not say are guessed. `without_time`: a sample rate stands in for the times. Columns
/// of a robot are guessed where `type` is one, and without `type` where a pitch and a leg's angle
/// are among them. Throws InputError if a column is not there or is several, a unit does not belong
/// to its channel, or there is nothing to guess from.
ColumnMap ResolveColumns(const Table& table, const std::vector<MapEntry>& entries,
                         bool without_time, std::optional<MechanismKind> type = std::nullopt);

/// The --map option that says the same as `mapped` of `table`: "y=-Z:mm".
std::string MapText(const Table& table, const MappedColumn& mapped);

}  // namespace hoplab
