#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

namespace hoplab {

/// Columns that text keeps to, where a terminal is not narrower.
inline constexpr std::size_t kReportWidth = 98;
inline constexpr std::size_t kNoWidth = static_cast<std::size_t>(-1);

/// Where a command writes, and what may stand there.
struct Console {
  std::ostream& out;         // results
  std::ostream& err;         // progress and messages
  bool out_colours = false;  // escape sequences are understood, and wanted
  bool err_colours = false;
  bool err_live = false;  // a line may be written over
  // Widths: of the terminal, or what COLUMNS says; else unlimited for a line that is written over,
  // and kReportWidth for text.
  std::size_t out_columns = kReportWidth, err_columns = kNoWidth;
};

/// The console of this process: colours only on a terminal, and not where NO_COLOR is set.
Console ProcessConsole();

/// No escape sequence any more: no colours, no line that is written over.
void MakePlain(Console& console);

/// `text` in an emphasis, or plain where colours are off.
enum class Emphasis { kBold, kFaint, kWarning, kError };
std::string Styled(std::string_view text, Emphasis emphasis, bool colours);

/// "warning: <text>" on its own line of `console.err`.
void Warn(const Console& console, std::string_view text);

}  // namespace hoplab
