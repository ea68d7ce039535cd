#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace hoplab {

struct Table;

/// An instant as loggers write it.
struct ClockText {
  std::int64_t second = 0;    // whole ones: of the day, of the era where there is a date
  std::string_view fraction;  // digits behind the point, maybe none
  std::string_view date;      // as it stands there; empty: none
  bool is_dated = false;      // the date is of ISO 8601 and counts in `second`
};

/// Reads "10:00:00.125", also with AM or PM behind it, and "2026-05-01T10:00:00.125Z" (ISO 8601, a
/// blank for the T, a zone), and a date of another order before the time; nothing else.
std::optional<ClockText> ParseClockText(std::string_view text);

/// Turns columns of such texts into seconds since the earliest whole one, digit by digit, and tells
/// so in the table's notes. A column stays as it is where a cell is none, or where dates of another
/// order change. A clock without a date that goes back by more than half a day has passed midnight.
void TurnClocksToSeconds(Table* table);

}  // namespace hoplab
