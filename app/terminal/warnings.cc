#include "app/terminal/warnings.h"

#include <algorithm>

namespace hoplab {
namespace {

// The sentence without its place ("drops/train-1.csv: "), every number alike.
std::string KindOf(const std::string& warning) {
  const std::size_t colon = warning.find(": ");
  std::string kind;
  for (const char c : warning.substr(colon == warning.npos ? 0 : colon)) {
    const bool numeric = (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
    if (!numeric) {
      kind += c;
    } else if (kind.empty() || kind.back() != '#') {
      kind += '#';
    }
  }
  // An exponent belongs to its number.
  for (std::size_t at = kind.find("#e#"); at != kind.npos; at = kind.find("#e#"))
    kind.replace(at, 3, "#");
  return kind;
}

}  // namespace

std::vector<std::string> CollapseWarnings(const std::vector<std::string>& warnings) {
  struct Group {
    std::string kind, first;
    int more;
  };
  std::vector<Group> groups;
  for (const std::string& warning : warnings) {
    const std::string kind = KindOf(warning);
    const auto same =
        std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.kind == kind; });
    if (same == groups.end()) {
      groups.push_back({kind, warning, 0});
    } else {
      ++same->more;
    }
  }
  std::vector<std::string> lines;
  for (const Group& g : groups) {
    lines.push_back(g.first);
    if (g.more > 0)
      lines.back() += " (likewise in " + std::to_string(g.more) +
                      (g.more == 1 ? " more file)" : " more files)");
  }
  return lines;
}

}  // namespace hoplab
