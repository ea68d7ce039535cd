#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

struct Table;

/// One line of a text file and where it stands.
struct TextLine {
  std::size_t number = 0;
  std::string_view text;
};

/// All lines, whatever ends them: LF, CRLF, CR.
std::vector<TextLine> SplitLines(std::string_view text);

/// The cells of a line, trimmed, without the quotes around a cell; a delimiter within quotes
/// belongs to the cell, and doubled quotes stay doubled. A blank as delimiter stands for any run of
/// blanks and tabs.
std::vector<std::string_view> SplitCells(std::string_view line, char delimiter);

/// Adds a row to the table, one cell for each column. Throws InputError if there are fewer cells
/// than columns or, not counting empty ones at the end, more.
void AddRow(const TextLine& line, const std::vector<std::string_view>& cells, Table* table);

/// Whether a cell stands for a missing sample: empty, nan, NA and the like.
bool IsMissing(std::string_view cell);

}  // namespace hoplab
