#include "app/reports/text_entries.h"

#include <algorithm>

#include "base/check.h"
#include "base/text.h"

namespace hoplab {

std::vector<TextEntry> ParseEntries(std::string_view text, std::span<const std::string_view> keys) {
  std::vector<TextEntry> entries;
  std::size_t next = 0;  // key that may come
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    if (line.empty()) {
      next = 0;
    } else if (line.front() == ' ') {
      HOPLAB_CHECK(next > 0);
      entries.back()[next - 1].append(" ").append(Trim(line));
    } else if (line.front() != '#') {
      const std::size_t colon = line.find(':');
      HOPLAB_CHECK(colon != line.npos);
      const auto key = std::find(keys.begin(), keys.end(), line.substr(0, colon));
      const auto place = static_cast<std::size_t>(key - keys.begin());
      HOPLAB_CHECK(key != keys.end() && place >= next && (place == 0 || next > 0));
      if (place == 0) entries.emplace_back(keys.size());
      entries.back()[place] = Trim(line.substr(colon + 1));
      next = place + 1;
    }
  }
  return entries;
}

std::vector<TextEntry> EntriesOf(std::string_view file, std::span<const std::string_view> keys) {
  return ParseEntries(ReportText(file), keys);
}

}  // namespace hoplab
