#include "datasets/import/text_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/table.h"

namespace hoplab {

namespace {

// The quote that closes the one at `open`: a doubled one within is one of the text.
std::size_t ClosingQuote(std::string_view line, std::size_t open) {
  std::size_t at = line.find('"', open + 1);
  while (at != line.npos && line.substr(at + 1, 1) == "\"") at = line.find('"', at + 2);
  return at;
}

}  // namespace

std::vector<TextLine> SplitLines(std::string_view text) {
  std::vector<TextLine> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    lines.push_back({lines.size() + 1, text.substr(0, end)});
    const bool two = text.substr(end, 2) == "\r\n";
    text.remove_prefix(std::min(text.size(), end + (two ? 2 : 1)));
  }
  return lines;
}

std::vector<std::string_view> SplitCells(std::string_view line, char delimiter) {
  std::vector<std::string_view> cells;
  if (delimiter == ' ') {
    for (line = Trim(line); !line.empty(); line = Trim(line)) {
      const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
      cells.push_back(line.substr(0, end));
      line.remove_prefix(end);
    }
    return cells;
  }
  while (true) {
    const std::size_t start = std::min(line.find_first_not_of(' '), line.size());
    std::size_t end = line.npos;
    if (start < line.size() && line[start] == '"') {
      const std::size_t closing = ClosingQuote(line, start);
      end = line.find(delimiter, closing == line.npos ? start : closing);
    } else {
      end = line.find(delimiter);
    }
    end = std::min(end, line.size());
    std::string_view cell = Trim(line.substr(0, end));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
      cell = Trim(cell.substr(1, cell.size() - 2));
    cells.push_back(cell);
    if (end == line.size()) return cells;
    line.remove_prefix(end + 1);
  }
}

void AddRow(const TextLine& line, const std::vector<std::string_view>& cells, Table* table) {
  const std::size_t wanted = table->columns.size();
  std::size_t present = cells.size();
  while (present > wanted && cells[present - 1].empty()) --present;
  if (present != wanted)
    throw InputError({table->file + ":" + std::to_string(line.number),
                      std::to_string(present) + " cells",
                      "must have " + std::to_string(wanted) + ", one for each column",
                      "Look for a missing or a stray separator, or a line that was cut off."});
  for (std::size_t i = 0; i < wanted; ++i) table->columns[i].cells.push_back(cells[i]);
  table->lines.push_back(line.number);
}

bool IsMissing(std::string_view cell) {
  static constexpr std::array<std::string_view, 7> kWords = {"",  "NA",   "N/A", "null",
                                                             "-", "None", "--"};
  if (std::find(kWords.begin(), kWords.end(), cell) != kWords.end()) return true;
  const std::optional<double> value = ParseDouble(cell);
  return value && std::isnan(*value);
}

}  // namespace hoplab
