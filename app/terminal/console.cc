#include "app/terminal/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <optional>

#include "base/text.h"

namespace hoplab {
namespace {

std::string_view CodeOf(Emphasis emphasis) {
  switch (emphasis) {
    case Emphasis::kBold:
      return "\033[1m";
    case Emphasis::kFaint:
      return "\033[2m";
    case Emphasis::kWarning:
      return "\033[33m";
    case Emphasis::kError:
      return "\033[31m";
  }
  return "";
}

// Below this nothing could be read; a terminal of no size is none.
constexpr std::size_t kLeastColumns = 40;

// Columns of the terminal behind `descriptor`: what COLUMNS says, else what the terminal says.
std::optional<std::size_t> ColumnsOf(int descriptor) {
  if (const char* said = std::getenv("COLUMNS")) {
    const std::optional<double> columns = ParseDouble(said);
    if (columns && *columns >= kLeastColumns && *columns < 1e4)
      return static_cast<std::size_t>(*columns);
  }
  winsize size{};
  if (ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
  return std::max<std::size_t>(size.ws_col, kLeastColumns);
}

}  // namespace

Console ProcessConsole() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  const bool dumb = !term || std::string_view(term) == "dumb";
  const bool wanted = !(no_color && *no_color) && !dumb;
  const bool err_terminal = isatty(STDERR_FILENO) != 0;
  const std::size_t out_columns = ColumnsOf(STDOUT_FILENO).value_or(kReportWidth);
  return {.out = std::cout,
          .err = std::cerr,
          .out_colours = wanted && isatty(STDOUT_FILENO) != 0,
          .err_colours = wanted && err_terminal,
          .err_live = err_terminal && !dumb,
          .out_columns = std::min(out_columns, kReportWidth),
          .err_columns = ColumnsOf(STDERR_FILENO).value_or(kNoWidth)};
}

void MakePlain(Console& console) {
  console.out_colours = console.err_colours = console.err_live = false;
}

std::string Styled(std::string_view text, Emphasis emphasis, bool colours) {
  if (!colours) return std::string(text);
  return std::string(CodeOf(emphasis)) + std::string(text) + "\033[0m";
}

void Warn(const Console& console, std::string_view text) {
  console.err << Styled("warning:", Emphasis::kWarning, console.err_colours) << ' ' << text << '\n';
}

}  // namespace hoplab
