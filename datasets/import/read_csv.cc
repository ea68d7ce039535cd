// Plain CSV as loggers, spreadsheets and scripts write it: any of the usual separators, decimal
// commas, lines before the titles, a row of units below them, or no titles at all.

#include <algorithm>
#include <optional>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/clock_text.h"
#include "datasets/import/guess_columns.h"
#include "datasets/import/table.h"
#include "datasets/import/text_rows.h"
#include "datasets/text_file.h"

namespace hoplab {
namespace {

using Cells = std::vector<std::string_view>;

bool IsComment(std::string_view line) {
  line = Trim(line);
  return line.starts_with('#') || line.starts_with('%') || line.starts_with("//");
}

std::vector<TextLine> ContentLines(std::string_view text) {
  std::vector<TextLine> lines = SplitLines(text);
  std::erase_if(
      lines, [](const TextLine& line) { return Trim(line.text).empty() || IsComment(line.text); });
  return lines;
}

// What separates the cells of most lines. Decimal commas and commas in text stand behind others.
char DelimiterOf(const std::vector<TextLine>& lines) {
  for (const char delimiter : {'\t', ';', ','}) {
    const auto with = std::count_if(lines.begin(), lines.end(), [&](const TextLine& line) {
      return line.text.find(delimiter) != line.text.npos;
    });
    if (2 * with > static_cast<long>(lines.size())) return delimiter;
  }
  return ' ';
}

// What counts as a number: seconds alone, or times of a clock, too.
enum class Numbers { kPlain, kOrClock };

bool IsNumber(std::string_view cell, Numbers numbers) {
  return ParseDouble(cell).has_value() ||
         (numbers == Numbers::kOrClock && ParseClockText(cell).has_value());
}

// Whether a row is one of samples: its first cell or most of them are numbers.
bool IsData(const Cells& cells, Numbers which) {
  const auto numbers = static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [&](auto cell) { return IsNumber(cell, which); }));
  const auto missing = static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [](auto cell) { return IsMissing(cell); }));
  return numbers > 0 && (IsNumber(cells[0], which) || 2 * (numbers + missing) > cells.size());
}

// A title in quotes has those of its own doubled.
std::string WithSingleQuotes(std::string_view title) {
  std::string text(title);
  for (std::size_t at = text.find("\"\""); at != text.npos; at = text.find("\"\"", at + 1))
    text.erase(at, 1);
  return text;
}

bool HasDecimalComma(const std::vector<TextLine>& lines, char delimiter) {
  if (delimiter == ',') return false;
  const auto is_one = [](std::string_view cell) {
    const std::size_t comma = cell.find(',');
    if (comma == cell.npos || cell.find(',', comma + 1) != cell.npos) return false;
    std::string with_point(cell);
    with_point[comma] = '.';
    return ParseDouble(with_point).has_value();
  };
  // Spreadsheets leave out zeros behind the comma: one row may have none.
  constexpr std::size_t kRows = 200;
  const std::size_t first = lines.size() > kRows ? lines.size() - kRows : 0;
  return std::any_of(lines.begin() + static_cast<std::ptrdiff_t>(first), lines.end(),
                     [&](const TextLine& line) {
                       const Cells cells = SplitCells(line.text, delimiter);
                       return std::any_of(cells.begin(), cells.end(), is_one);
                     });
}

// Titles of the columns from the rows above the samples: a row of names, maybe with a row of units
// below it.
struct Titles {
  Cells names, units;
};

// Titles in the last comment before the samples, one of which is the time: "# t,x,y".
Titles TitlesInComment(std::string_view text, std::size_t number, char delimiter,
                       std::size_t width) {
  const std::vector<TextLine> all = SplitLines(text);
  for (std::size_t i = number - 1; i-- > 0;) {
    std::string_view line = Trim(all[i].text);
    if (line.empty()) continue;
    if (!IsComment(line)) break;
    line = Trim(line.substr(std::min(line.find_first_not_of("#%/"), line.size())));
    const Cells cells = SplitCells(line, delimiter);
    const bool tells_time = std::any_of(cells.begin(), cells.end(),
                                        [](auto cell) { return IsTimeName(std::string(cell)); });
    if (cells.size() != width || !tells_time) break;
    return {cells, {}};
  }
  return {};
}

Titles FindTitles(const std::vector<TextLine>& lines, std::size_t first, char delimiter,
                  std::size_t width) {
  Titles titles;
  if (width == 1) {
    titles.names = {Trim(lines[first - 1].text)};
    return titles;
  }
  Cells above = SplitCells(lines[first - 1].text, delimiter);
  while (above.size() > width && above.back().empty()) above.pop_back();
  const auto is_unit = [](std::string_view cell) {
    const std::string_view inside = cell.size() > 2 && (cell.front() == '[' || cell.front() == '(')
                                        ? cell.substr(1, cell.size() - 2)
                                        : cell;
    return cell.empty() || FindUnit(inside).has_value();
  };
  if (first > 1 && above.size() == width && std::all_of(above.begin(), above.end(), is_unit)) {
    titles.units = above;
    above = SplitCells(lines[first - 2].text, delimiter);
  }
  if (above.size() != width)
    throw InputError({"", std::to_string(above.size()) + " titles",
                      "must have " + std::to_string(width) + ", one for each cell below",
                      "Give each column a title, none with the separator in it unless in quotes."});
  titles.names = above;
  return titles;
}

std::string WithoutBrackets(std::string_view cell) {
  if (cell.size() > 2 && (cell.front() == '[' || cell.front() == '('))
    cell = cell.substr(1, cell.size() - 2);
  return std::string(cell);
}

class CsvReader {
 public:
  CsvReader(std::string bytes, const std::string& name) {
    table_.file = name;
    table_.format = "CSV";
    table_.texts.push_back(std::move(bytes));
  }

  Table Read() {
    text_ = CheckText(table_.texts.back(), table_.file);
    lines_ = ContentLines(text_);
    if (lines_.empty())
      throw InputError({table_.file, "", "is empty; must have a row of titles and samples",
                        "Export the recording again."});
    delimiter_ = DelimiterOf(lines_);
    if (HasDecimalComma(lines_, delimiter_)) {
      table_.notes.emplace_back("decimal commas are read as points");
      table_.texts.emplace_back(text_);
      std::string& copy = table_.texts.back();
      for (const TextLine& line : lines_) {
        const auto at = line.text.data() - text_.data();
        std::replace(copy.begin() + at, copy.begin() + at + static_cast<long>(line.text.size()),
                     ',', '.');
      }
      text_ = copy;
      lines_ = ContentLines(text_);
    }
    const std::size_t first = FirstDataLine();
    MakeColumns(first);
    for (std::size_t i = first; i < lines_.size(); ++i)
      AddRow(lines_[i], SplitCells(lines_[i].text, delimiter_), &table_);
    TurnClocksToSeconds(&table_);
    return std::move(table_);
  }

 private:
  // Times of a clock count where no row is one of samples without them: they stand above, too.
  std::size_t FirstDataLine() {
    for (const Numbers numbers : {Numbers::kPlain, Numbers::kOrClock})
      if (const std::optional<std::size_t> first = FindFirst(numbers)) return *first;
    throw InputError({table_.file + ":" + std::to_string(lines_.back().number),
                      Printable(lines_.back().text, 40), "no row holds numbers",
                      "Separate the cells by commas, semicolons, tabs or blanks."});
  }

  // The first of two rows of samples alike; else one below a row of titles; else any.
  std::optional<std::size_t> FindFirst(Numbers numbers) {
    const auto cells_of = [&](std::size_t i) { return SplitCells(lines_[i].text, delimiter_); };
    const auto like = [&](std::size_t i, std::size_t width, bool data) {
      if (i >= lines_.size()) return false;
      const Cells cells = cells_of(i);
      return cells.size() == width && IsData(cells, numbers) == data;
    };
    for (int pass = 0; pass < 3; ++pass) {
      for (std::size_t i = 0; i < lines_.size(); ++i) {
        const Cells cells = cells_of(i);
        const bool fits = pass == 0   ? like(i + 1, cells.size(), true)
                          : pass == 1 ? i > 0 && like(i - 1, cells.size(), false)
                                      : true;
        if (!IsData(cells, numbers) || !fits) continue;
        width_ = cells.size();
        return i;
      }
    }
    return std::nullopt;
  }

  void MakeColumns(std::size_t first) {
    Titles titles;
    try {
      titles = first > 0 ? FindTitles(lines_, first, delimiter_, width_)
                         : TitlesInComment(text_, lines_[0].number, delimiter_, width_);
    } catch (const InputError& error) {
      throw InputError({table_.file + ":" + std::to_string(lines_[first - 1].number),
                        error.parts().value, error.parts().rule, error.parts().remedy});
    }
    for (std::size_t i = 0; i < width_; ++i) {
      SourceColumn column;
      if (i < titles.names.size()) column.name = WithSingleQuotes(titles.names[i]);
      if (column.name.empty()) column.name = "#" + std::to_string(i + 1);
      column.unit = SplitTitle(column.name).unit;
      if (i < titles.units.size() && !titles.units[i].empty())
        column.unit = WithoutBrackets(titles.units[i]);
      table_.columns.push_back(std::move(column));
    }
  }

  Table table_;
  std::string_view text_;
  std::vector<TextLine> lines_;
  char delimiter_ = ',';
  std::size_t width_ = 0;
};

}  // namespace

Table ReadPlainCsv(std::string bytes, const std::string& name) {
  return CsvReader(std::move(bytes), name).Read();
}

}  // namespace hoplab
