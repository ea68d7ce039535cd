#include "app/records/csv.h"

#include <cmath>

#include "base/text.h"

namespace hoplab {

CsvText::CsvText(const std::vector<std::string>& header) {
  for (const std::string& name : header) Cell(std::string_view(name));
  EndRow();
}

void CsvText::Separate() {
  if (row_begun_) text_ += ',';
  row_begun_ = true;
}

CsvText& CsvText::Cell(double value) {
  Separate();
  if (!std::isnan(value)) text_ += FormatDouble(value);
  return *this;
}

CsvText& CsvText::Cell(std::string_view text) {
  Separate();
  if (text.find_first_of(",\"\n\r") == text.npos) {
    text_ += text;
    return *this;
  }
  text_ += '"';
  for (const char c : text) {
    if (c == '"') text_ += '"';
    text_ += c;
  }
  text_ += '"';
  return *this;
}

void CsvText::EndRow() {
  text_ += '\n';
  row_begun_ = false;
}

}  // namespace hoplab
