#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

namespace hoplab {

/// Where a command writes, and what may stand there.
struct Console {
  std::ostream& out;         // results
  std::ostream& err;         // progress and messages
  bool out_colours = false;  // escape sequences are understood, and wanted
  bool err_colours = false;
  bool err_live = false;  // a line may be written over
};

/// The console of this process: colours only on a terminal, and not where NO_COLOR is set.
Console ProcessConsole();

/// `text` in an emphasis, or plain where colours are off.
enum class Emphasis { kBold, kFaint, kWarning, kError };
std::string Styled(std::string_view text, Emphasis emphasis, bool colours);

/// "warning: <text>" on its own line of `console.err`.
void Warn(const Console& console, std::string_view text);

}  // namespace hoplab
