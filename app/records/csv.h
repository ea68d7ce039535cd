#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

/// Text of a CSV file: numbers that read back exactly, NaN as an empty cell, texts quoted where
/// they must be.
class CsvText {
 public:
  explicit CsvText(const std::vector<std::string>& header);
  CsvText& Cell(double value);
  CsvText& Cell(std::string_view text);
  void EndRow();
  const std::string& text() const { return text_; }

 private:
  void Separate();
  std::string text_;
  bool row_begun_ = false;
};

}  // namespace hoplab
