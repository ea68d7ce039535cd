#include "app/terminal/text_table.h"

#include <algorithm>

namespace hoplab {

std::vector<std::string> TextTable::Lines() const {
  const auto cell = [](const std::vector<std::string>& row, std::size_t c) {
    return c < row.size() ? row[c] : std::string();
  };
  std::vector<std::size_t> width(columns_.size(), 0);
  std::vector<bool> used(columns_.size(), false);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      width[c] = std::max(width[c], cell(rows_[r], c).size());
      used[c] = used[c] || (r > 0 && !cell(rows_[r], c).empty());
    }
  }
  std::vector<std::string> lines;
  for (const std::vector<std::string>& row : rows_) {
    std::string line;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (!used[c]) continue;
      const std::string text = cell(row, c);
      const std::string padding(width[c] - text.size(), ' ');
      line += "  " + (columns_[c] == Align::kRight ? padding + text : text + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(line);
  }
  return lines;
}

}  // namespace hoplab
