#pragma once

#include <string>
#include <vector>

namespace hoplab {

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
