#include "app/console.h"

#include <unistd.h>

#include <cstdlib>
#include <iostream>

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

}  // namespace

Console ProcessConsole() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  const bool dumb = !term || std::string_view(term) == "dumb";
  const bool wanted = !(no_color && *no_color) && !dumb;
  const bool err_terminal = isatty(STDERR_FILENO) != 0;
  return {std::cout, std::cerr, wanted && isatty(STDOUT_FILENO) != 0, wanted && err_terminal,
          err_terminal && !dumb};
}

std::string Styled(std::string_view text, Emphasis emphasis, bool colours) {
  if (!colours) return std::string(text);
  return std::string(CodeOf(emphasis)) + std::string(text) + "\033[0m";
}

void Warn(const Console& console, std::string_view text) {
  console.err << Styled("warning:", Emphasis::kWarning, console.err_colours) << ' ' << text << '\n';
}

}  // namespace hoplab
