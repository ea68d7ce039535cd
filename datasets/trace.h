#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/channel.h"

namespace hoplab {

/// One column of a trace; NaN where the sample is missing. Two are equal if names and samples are,
/// a missing sample being equal to a missing one.
struct TraceColumn {
  std::string name;
  std::vector<double> values;
  bool operator==(const TraceColumn& other) const;
};

/// A measured trial: times, strictly increasing, not necessarily uniform, and columns of the same
/// length, those included that are no channel.
struct Trace {
  std::vector<double> time_s;
  std::vector<TraceColumn> columns;

  /// The column's samples, or null if there is no such column.
  const std::vector<double>* Find(std::string_view name) const;
  const std::vector<double>* Find(Channel id) const { return Find(ChannelName(id)); }
  bool operator==(const Trace& other) const = default;
};

/// Reads a trace from CSV text. Throws InputError with `place`:line and the column if the first
/// column is not time_s, a name is repeated, empty or has the wrong unit, a row is ragged, a cell
/// is no number or out of its channel's range, time is missing or not increasing, or there are no
/// rows or too many columns.
Trace ParseTraceCsv(std::string_view bytes, const std::string& place);

/// CSV text that ParseTraceCsv reads back as the same trace.
std::string FormatTraceCsv(const Trace& trace);

}  // namespace hoplab
