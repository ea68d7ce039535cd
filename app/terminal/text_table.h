#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

/// Places that a text takes in a terminal: characters of UTF-8, not its bytes.
std::size_t DisplayWidth(std::string_view text);

/// Columns of text, padded so that they line up.
class TextTable {
 public:
  enum class Align { kLeft, kRight };
  explicit TextTable(std::vector<Align> columns) : columns_(std::move(columns)) {}

  void AddRow(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  /// The rows, each indented by two blanks, two blanks between columns, none at line ends. Columns
  /// that are empty in every row but the first are left out.
  std::vector<std::string> Lines() const;

 private:
  std::vector<Align> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace hoplab
