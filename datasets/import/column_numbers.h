#pragma once

#include <string>
#include <vector>

#include "datasets/import/column_map.h"

namespace hoplab {

// What the numbers of a log's columns tell, for guesses.

/// The samples of a column as the file has them; NaN where there is none.
std::vector<double> ColumnNumbers(const Table& table, std::size_t column);
/// SI value over value in `unit`.
double SiFactor(const LogUnit& unit);
/// A column's name without its unit, in lower case.
std::string LowerStem(const std::string& name);
/// Times in seconds by the map; none where a sample rate stands in for them.
std::vector<double> Times(const Table& table, const ColumnMap& map);
/// How a column falls in free flight [m/s^2] if it is in metres; NaN if it cannot be told.
double Fall(const Table& table, std::size_t column, const std::vector<double>& times);
/// How far an acceleration is from gravity, relative to it.
double FromGravity(double fall);
bool IsGravity(double fall);

}  // namespace hoplab
