#include "app/terminal/report_text.h"

#include <fmt/format.h>

#include "app/terminal/text_table.h"

namespace hoplab {
namespace {
constexpr std::size_t kLabelWidth = 13;
}  // namespace

std::string Plural(long count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string Wrapped(const std::string& text, std::size_t begin, std::size_t width) {
  std::string out;
  std::size_t column = begin;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::size_t length = DisplayWidth(std::string_view(text).substr(at, end - at));
    if (column > begin && column + 1 + length > width) {
      out += "\n" + std::string(begin, ' ');
      column = begin;
    } else if (column > begin) {
      out += ' ';
      ++column;
    }
    out += text.substr(at, end - at);
    column += length;
    at = end + 1;
  }
  return out;
}

std::string Labelled(const std::string& label, const std::string& text, bool colours) {
  const std::string padded = fmt::format("{:<{}}", label, kLabelWidth);
  return "  " + Styled(padded, Emphasis::kFaint, colours) + Wrapped(text, 2 + kLabelWidth) + "\n";
}

std::string WithHeader(const std::vector<std::string>& lines, bool colours) {
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i)
    text += (i == 0 ? Styled(lines[i], Emphasis::kFaint, colours) : lines[i]) + "\n";
  return text;
}

}  // namespace hoplab
