#include "app/export/template_text.h"

#include <sstream>

#include "base/check.h"

namespace hoplab {
namespace {

constexpr std::string_view kIf = "/*@if ", kElse = "/*@else*/", kEnd = "/*@end*/";

std::string Chosen(std::string_view text, const std::set<std::string>& flags) {
  std::istringstream lines{std::string(text)};
  std::string out;
  bool taken = true;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kIf))
      taken = flags.contains(line.substr(kIf.size(), line.find("*/") - kIf.size()));
    else if (line == kElse)
      taken = !taken;
    else if (line == kEnd)
      taken = true;
    else if (taken)
      out += line + "\n";
  }
  return out;
}

bool IsNameLetter(char c) { return (c >= 'A' && c <= 'Z') || c == '_'; }

}  // namespace

std::string FilledTemplate(std::string_view text, const std::map<std::string, std::string>& values,
                           const std::set<std::string>& flags) {
  const std::string chosen = Chosen(text, flags);
  std::string out;
  for (std::size_t at = 0; at < chosen.size();) {
    std::size_t end = at + 1;
    while (chosen[at] == '@' && end < chosen.size() && IsNameLetter(chosen[end])) ++end;
    if (chosen[at] != '@' || end == at + 1 || end == chosen.size() || chosen[end] != '@') {
      out += chosen[at++];
      continue;
    }
    const auto value = values.find(chosen.substr(at + 1, end - at - 1));
    HOPLAB_CHECK(value != values.end());
    out += value->second;
    at = end + 1;
  }
  return out;
}

}  // namespace hoplab
