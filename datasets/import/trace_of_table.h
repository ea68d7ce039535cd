#pragma once

#include <map>
#include <optional>
#include <string>

#include "datasets/import/column_map.h"
#include "datasets/import/mend_times.h"
#include "datasets/import/table.h"

namespace hoplab {

struct TraceOptions {
  std::optional<double> rate_hz;       // times are sample / rate; the map then has no time
  std::optional<double> from_s, to_s;  // by the log's clock, both included
  bool zero_time = false;              // the first row kept is at 0
  bool mend_times = false;             // repeated and swapped stamps are mended, not refused
  /// Added to a column after its sign is changed: decimal text in SI units.
  std::map<ColumnTarget, std::string> shifts;
};

struct ImportedTrace {
  std::string csv;  // of a trial, in the order of ColumnTarget
  std::size_t rows = 0;
  double first_s = 0, last_s = 0;               // as in csv
  std::map<ColumnTarget, std::size_t> missing;  // samples
  MendedTimes mended;
};

/// The mapped columns of a log in SI units, every printed digit kept where a unit is metric. Throws
/// InputError with the log's own line, column and value if a cell is no number or far out of its
/// channel's range, a time is missing or (unless mended) not increasing, columns differ in length,
/// or no row lies between from_s and to_s.
ImportedTrace TraceOfTable(const Table& table, const ColumnMap& map, const TraceOptions& options);

}  // namespace hoplab
