#include "datasets/import/typed_columns.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/text.h"
#include "datasets/import/number_block.h"
#include "datasets/import/text_rows.h"

namespace hoplab {
namespace {

double NumberIn(const Table& table, std::size_t column, std::size_t row) {
  const std::string_view cell = table.columns[column].cells[row];
  if (IsMissing(cell)) return std::numeric_limits<double>::quiet_NaN();
  return ParseDouble(cell).value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void AddTurnAngles(const std::string& name, std::size_t w, std::size_t x, std::size_t y,
                   std::size_t z, Table* table) {
  const std::size_t rows = table->columns[w].cells.size();
  const std::array<std::pair<std::size_t, const char*>, 3> axes = {
      {{x, ".angle_X"}, {y, ".angle_Y"}, {z, ".angle_Z"}}};
  for (const auto& [axis, suffix] : axes) {
    std::vector<double> angles;
    double before = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      // q and -q are the same turn: the angle nearest to the one before is meant.
      double angle = 2 * std::atan2(NumberIn(*table, axis, row), NumberIn(*table, w, row));
      constexpr double kTurn = 2 * std::numbers::pi;
      if (std::isfinite(angle)) before = angle -= kTurn * std::round((angle - before) / kTurn);
      angles.push_back(angle);
    }
    table->texts.emplace_back();
    SourceColumn column;
    column.name = name + suffix;
    column.unit = "rad";
    column.cells = TextOfNumbers(
        rows, [&](std::size_t row) { return angles[row]; }, &table->texts.back());
    table->columns.push_back(std::move(column));
  }
}

}  // namespace hoplab
