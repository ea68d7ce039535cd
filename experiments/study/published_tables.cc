#include "experiments/study/published_tables.h"

#include <algorithm>
#include <limits>

#include "base/check.h"
#include "base/text.h"
#include "experiments/study/published_texts.h"

namespace hoplab {
namespace {

std::vector<std::string_view> Split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(Trim(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

PublishedTable Parse(const PublishedText& source) {
  PublishedTable table{std::string(source.name), {}, {}};
  for (const std::string_view line : Split(source.text, '\n')) {
    if (line.empty()) continue;
    const std::vector<std::string_view> cells = Split(line, ',');
    if (table.columns.empty()) {
      table.columns.assign(cells.begin(), cells.end());
      continue;
    }
    HOPLAB_CHECK(cells.size() == table.columns.size());
    std::vector<double> row;
    for (const std::string_view cell : cells) {
      const std::optional<double> value = ParseDouble(cell);
      HOPLAB_CHECK(value || cell.empty());
      row.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::vector<double> PublishedTable::Column(std::string_view column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  HOPLAB_CHECK(found != columns.end());
  std::vector<double> values;
  for (const std::vector<double>& row : rows) values.push_back(row[found - columns.begin()]);
  return values;
}

const PublishedTable& FindPublishedTable(std::string_view name) {
  static const std::vector<PublishedTable> tables = [] {
    std::vector<PublishedTable> all;
    for (const PublishedText& text : PublishedTexts()) all.push_back(Parse(text));
    return all;
  }();
  const auto found = std::find_if(tables.begin(), tables.end(),
                                  [&](const PublishedTable& t) { return t.name == name; });
  HOPLAB_CHECK(found != tables.end());
  return *found;
}

}  // namespace hoplab
