#include "app/terminal/text_table.h"

#include <algorithm>

namespace hoplab {

std::size_t DisplayWidth(std::string_view text) {
  // Bytes that go on with a character are 10xxxxxx.
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

std::vector<std::string> TextTable::Lines() const {
  const auto cell = [](const std::vector<std::string>& row, std::size_t c) {
    return c < row.size() ? row[c] : std::string();
  };
  std::vector<std::size_t> width(columns_.size(), 0);
  std::vector<bool> used(columns_.size(), false);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      width[c] = std::max(width[c], DisplayWidth(cell(rows_[r], c)));
      used[c] = used[c] || (r > 0 && !cell(rows_[r], c).empty());
    }
  }
  std::vector<std::string> lines;
  for (const std::vector<std::string>& row : rows_) {
    std::string line;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (!used[c]) continue;
      const std::string text = cell(row, c);
      const std::string padding(width[c] - DisplayWidth(text), ' ');
      line += "  " + (columns_[c] == Align::kRight ? padding + text : text + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(line);
  }
  return lines;
}

}  // namespace hoplab
