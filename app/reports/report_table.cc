#include "app/reports/report_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

// Tables of fewer cells keep all their digits.
constexpr std::size_t kExactCells = 20000;

// Splits CSV as CsvText writes it.
class CsvReader {
 public:
  CsvReader(const std::string& file, std::string_view text) : file_(file), rest_(text) {}

  bool AtEnd() const { return rest_.empty(); }
  int line() const { return line_; }

  void ReadRow(std::vector<std::string>& cells) {
    cells.clear();
    ++line_;
    for (bool more = true; more;) {
      cells.emplace_back();
      more = ReadCell(cells.back());
    }
  }

 private:
  // Whether another cell follows in this row.
  bool ReadCell(std::string& cell) {
    if (rest_.starts_with('"')) ReadQuoted(cell);
    const std::size_t end = std::min(rest_.find_first_of(",\n"), rest_.size());
    cell.append(rest_.substr(0, end));
    if (!cell.empty() && cell.back() == '\r') cell.pop_back();
    const bool more = end < rest_.size() && rest_[end] == ',';
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return more;
  }

  void ReadQuoted(std::string& cell) {
    rest_.remove_prefix(1);
    while (true) {
      const std::size_t quote = rest_.find('"');
      if (quote == rest_.npos)
        throw InputError({file_ + ":" + std::to_string(line_), "", "a quoted cell has no end",
                          "Write the run anew."});
      cell.append(rest_.substr(0, quote));
      rest_.remove_prefix(quote + 1);
      if (!rest_.starts_with('"')) return;
      cell += '"';
      rest_.remove_prefix(1);
    }
  }

  std::string file_;
  std::string_view rest_;
  int line_ = 0;
};

std::string Base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63U];
  }
  return out;
}

static_assert(std::endian::native == std::endian::little, "a page reads the least byte first");

template <class Number, class Values>
std::string Bytes(const Values& values, const std::vector<std::size_t>& rows) {
  std::string bytes(rows.size() * sizeof(Number), '\0');
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto number = static_cast<Number>(values[rows[i]]);
    std::memcpy(bytes.data() + i * sizeof(Number), &number, sizeof number);
  }
  return Base64(bytes);
}

// The value whose extremes a reader of a thinned plot would miss, most telling first.
constexpr std::array<std::string_view, 5> kTelling = {"whitened", "before", "evidence",
                                                      "ground_force_y_N", "measured"};
// Words that change along a series rather than name it.
constexpr std::array<std::string_view, 4> kAlong = {"mode", "event", "mode_before", "mode_after"};

}  // namespace

ReportTable::ReportTable(const std::string& file, std::string_view text) {
  CsvReader reader(file, text);
  if (reader.AtEnd())
    throw InputError({file, "", "is empty; a table has a line of names", "Write the run anew."});
  reader.ReadRow(names_);
  columns_.resize(names_.size());
  std::vector<std::unordered_map<std::string, std::uint32_t>> known(names_.size());
  const auto place_of = [&](std::size_t c, const std::string& word) {
    const auto [at, fresh] =
        known[c].emplace(word, static_cast<std::uint32_t>(columns_[c].words.size()));
    if (fresh) columns_[c].words.push_back(word);
    return at->second;
  };
  std::vector<std::string> cells;
  while (!reader.AtEnd()) {
    reader.ReadRow(cells);
    if (cells.size() != names_.size())
      throw InputError({file + ":" + std::to_string(reader.line()), std::to_string(cells.size()),
                        "cells; the line of names has " + std::to_string(names_.size()),
                        "Write the run anew."});
    for (std::size_t c = 0; c < cells.size(); ++c) {
      Column& column = columns_[c];
      if (!column.of_words) {
        const std::optional<double> number =
            cells[c].empty() ? std::numeric_limits<double>::quiet_NaN() : ParseDouble(cells[c]);
        if (number) {
          column.numbers.push_back(*number);
          continue;
        }
        column.of_words = true;
        for (const double earlier : column.numbers)
          column.places.push_back(
              place_of(c, std::isnan(earlier) ? std::string() : FormatDouble(earlier)));
        column.numbers = {};
      }
      column.places.push_back(place_of(c, cells[c]));
    }
    ++rows_;
  }
}

double ReportTable::bytes_per_row() const {
  constexpr double kNumber = 4.0 * 4.0 / 3.0, kWord = 2.0 * 4.0 / 3.0;  // in base64
  double bytes = 0.0;
  for (const Column& column : columns_) bytes += column.of_words ? kWord : kNumber;
  return bytes;
}

const ReportTable::Column* ReportTable::Find(std::string_view name) const {
  for (std::size_t c = 0; c < names_.size(); ++c) {
    if (names_[c] == name) return &columns_[c];
  }
  return nullptr;
}

std::vector<std::vector<std::size_t>> ReportTable::Series() const {
  std::vector<const Column*> keys;
  for (std::size_t c = 0; c < names_.size(); ++c) {
    const bool along = std::find(kAlong.begin(), kAlong.end(), names_[c]) != kAlong.end();
    if (columns_[c].of_words && !along) keys.push_back(&columns_[c]);
  }
  std::map<std::vector<std::uint32_t>, std::size_t> known;
  std::vector<std::vector<std::size_t>> series;
  std::vector<std::uint32_t> key(keys.size());
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t k = 0; k < keys.size(); ++k) key[k] = keys[k]->places[row];
    const auto [at, fresh] = known.emplace(key, series.size());
    if (fresh) series.emplace_back();
    series[at->second].push_back(row);
  }
  return series;
}

std::vector<std::size_t> ReportTable::Thinned(std::size_t most) const {
  most = std::max<std::size_t>(most, 2);
  std::vector<std::size_t> kept;
  if (rows_ <= most) {
    for (std::size_t row = 0; row < rows_; ++row) kept.push_back(row);
    return kept;
  }
  const Column* telling = nullptr;
  for (const std::string_view name : kTelling) {
    const Column* column = Find(name);
    if (!telling && column && !column->of_words) telling = column;
  }
  for (auto c = columns_.rbegin(); !telling && c != columns_.rend(); ++c) {
    if (!c->of_words) telling = &*c;
  }
  const std::size_t stretch = 2 * rows_ / most + 1;
  for (const std::vector<std::size_t>& series : Series()) {
    for (std::size_t begin = 0; begin < series.size(); begin += stretch) {
      const auto first = series.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto last =
          series.begin() + static_cast<std::ptrdiff_t>(std::min(begin + stretch, series.size()));
      kept.push_back(*first);
      if (telling) {
        // Among the cells that have a number; NaN is less than none and more than none.
        std::vector<std::size_t> told;
        std::copy_if(first, last, std::back_inserter(told),
                     [&](std::size_t row) { return !std::isnan(telling->numbers[row]); });
        if (told.empty()) continue;
        const auto less = [&](std::size_t a, std::size_t b) {
          return telling->numbers[a] < telling->numbers[b];
        };
        const auto [low, high] = std::minmax_element(told.begin(), told.end(), less);
        kept.back() = *low;
        kept.push_back(*high);
      } else {
        kept.push_back(*(first + (last - first) / 2));
      }
    }
    kept.push_back(series.back());
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  // Very many very short series: then every so many of the rows.
  const std::size_t step = kept.size() / (2 * most) + 1;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < kept.size(); i += step) shown.push_back(kept[i]);
  return shown;
}

Json ReportTable::Packed(std::size_t most) const {
  const std::vector<std::size_t> rows = Thinned(most);
  const bool exact = rows.size() * names_.size() <= kExactCells;
  Json columns = Json::array();
  for (std::size_t c = 0; c < names_.size(); ++c) {
    const Column& column = columns_[c];
    Json packed = {{"name", names_[c]}};
    if (column.of_words) {
      const bool narrow = column.words.size() <= std::numeric_limits<std::uint16_t>::max();
      packed["bits"] = narrow ? 16 : 32;
      packed["words"] = column.words;
      packed["places"] = narrow ? Bytes<std::uint16_t>(column.places, rows)
                                : Bytes<std::uint32_t>(column.places, rows);
    } else {
      packed["bits"] = exact ? 64 : 32;
      packed["numbers"] =
          exact ? Bytes<double>(column.numbers, rows) : Bytes<float>(column.numbers, rows);
    }
    columns.push_back(std::move(packed));
  }
  return {{"rows", rows_}, {"shown", rows.size()}, {"columns", columns}};
}

}  // namespace hoplab
