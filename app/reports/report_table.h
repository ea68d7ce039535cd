#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "app/records/run_record.h"

namespace hoplab {

/// A CSV of a run folder on its way into a page: columns of numbers or of words, thinned out where
/// there are more rows than a plot can show.
class ReportTable {
 public:
  /// Throws InputError with `file` and line for a text that is no table.
  ReportTable(const std::string& file, std::string_view text);

  std::size_t rows() const { return rows_; }
  /// Of a row in a page, about.
  double bytes_per_row() const;

  /// The rows to show, ascending: all of them, or about `most`. Of each stretch of a series (a
  /// trial's channel, say) those with the least and the greatest value that matters are kept, the
  /// last row too.
  std::vector<std::size_t> Thinned(std::size_t most) const;

  /// {rows, shown, columns: [{name, bits, numbers} or {name, bits, words, places}]}: `numbers` are
  /// floats of 32 or 64 bits, `places` unsigned integers into `words`, both in base64, least
  /// significant byte first. An empty cell of a column of numbers is NaN.
  Json Packed(std::size_t most) const;

 private:
  struct Column {
    bool of_words = false;
    std::vector<double> numbers;        // not of_words
    std::vector<std::string> words;     // of_words: the different ones
    std::vector<std::uint32_t> places;  // of_words: one a row
  };

  const Column* Find(std::string_view name) const;
  std::vector<std::vector<std::size_t>> Series() const;

  std::size_t rows_ = 0;
  std::vector<std::string> names_;
  std::vector<Column> columns_;
};

}  // namespace hoplab
