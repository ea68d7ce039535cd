#include "datasets/import/column_numbers.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/text.h"
#include "datasets/suspect_things.h"

namespace hoplab {
namespace {

constexpr double kGravity_m_per_s2 = 9.81;
constexpr double kFallTolerance =
    0.25;  // of gravity: noise, friction, windows that see some stance

}  // namespace

std::vector<double> ColumnNumbers(const Table& table, std::size_t column) {
  std::vector<double> values;
  values.reserve(table.columns[column].cells.size());
  for (const std::string_view cell : table.columns[column].cells)
    values.push_back(ParseDouble(cell).value_or(std::nan("")));
  return values;
}

double SiFactor(const LogUnit& unit) { return unit.factor * std::pow(10.0, unit.power_of_ten); }

std::string LowerStem(const std::string& name) {
  std::string stem = SplitTitle(name).stem;
  std::transform(stem.begin(), stem.end(), stem.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return stem;
}

std::vector<double> Times(const Table& table, const ColumnMap& map) {
  for (const MappedColumn& mapped : map.columns) {
    if (!mapped.target.IsTime()) continue;
    std::vector<double> times = ColumnNumbers(table, mapped.column);
    for (double& t : times) t *= SiFactor(mapped.unit);
    return times;
  }
  return {};
}

double Fall(const Table& table, std::size_t column, const std::vector<double>& times) {
  const std::vector<double> values = ColumnNumbers(table, column);
  if (times.empty() || values.size() != times.size()) return std::nan("");
  return ApparentGravity(times, values);
}

double FromGravity(double fall) { return std::abs(fall / kGravity_m_per_s2 - 1); }

bool IsGravity(double fall) { return FromGravity(fall) < kFallTolerance; }

}  // namespace hoplab
