#include <algorithm>
#include <array>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/column_numbers.h"
#include "datasets/import/guess_columns.h"

namespace hoplab {
namespace {

bool Increases(const Table& table, std::size_t column) {
  const std::vector<double> values = ColumnNumbers(table, column);
  if (values.size() < 2) return false;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1])) return false;
  return true;
}

constexpr std::array<std::string_view, 8> kTimeNames = {"time_s", "time",    "t",       "timestamp",
                                                        "zeit",   "seconds", "elapsed", "sim_time"};

std::string TimeStem(const std::string& name) {
  std::string stem = LowerStem(name);
  const std::size_t parent = stem.find_last_of("/.");  // log.t, /body/t
  if (parent != stem.npos) stem.erase(0, parent + 1);
  return stem;
}

}  // namespace

bool IsTimeName(const std::string& name) {
  return std::find(kTimeNames.begin(), kTimeNames.end(), TimeStem(name)) != kTimeNames.end();
}

MappedColumn GuessTime(const Table& table) {
  for (const std::string_view wanted : kTimeNames) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const std::string& name = table.columns[i].name;
      if (TimeStem(name) != wanted) continue;
      MappedColumn time{std::nullopt, i};
      time.guessed = name != "time_s" && table.units.count(Dimension::kTime) == 0;
      time.why = time.guessed ? "is called so" : "the format's own name";
      return time;
    }
  }
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string stem = LowerStem(table.columns[i].name);
    if (stem.starts_with("frame") || stem.starts_with("index") || !Increases(table, i)) continue;
    const std::string& unit = table.columns[i].unit;
    if (!unit.empty() && (!FindUnit(unit) || FindUnit(unit)->dimension != Dimension::kTime))
      continue;
    MappedColumn time{std::nullopt, i};
    time.guessed = true;
    time.why = "the first column that increases throughout";
    return time;
  }
  throw InputError({table.file, "", "no column could be told to be the time",
                    "Name it, as --map t=COLUMN:ms, or give the sample rate, as --rate 500."});
}

std::optional<GuessedUnit> GuessUnit(const Table& table, const ColumnMap& map,
                                     const MappedColumn& mapped) {
  if (mapped.target.IsTime()) {
    std::vector<double> times = ColumnNumbers(table, mapped.column);
    std::vector<double> steps;
    for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
    if (steps.empty()) return std::nullopt;
    std::nth_element(steps.begin(), steps.begin() + static_cast<long>(steps.size() / 2),
                     steps.end());
    const double step = steps[steps.size() / 2];
    // A hop lasts some tenths of a second and is sampled a hundred to some thousand times a second.
    const std::string why = "a sample every " + Rounded(step);
    if (step >= 5e-5 && step < 0.1) return GuessedUnit{*FindUnit("s"), why};
    if (step >= 0.1 && step < 50) return GuessedUnit{*FindUnit("ms"), why};
    if (step >= 50 && step < 50'000) return GuessedUnit{*FindUnit("us"), why};
    if (step >= 50'000) return GuessedUnit{*FindUnit("ns"), why};
    return std::nullopt;
  }
  if (TargetDimension(mapped.target) != Dimension::kLength) return std::nullopt;
  if (mapped.target == Channel::kBodyY) {
    const double per_unit = Fall(table, mapped.column, Times(table, map));
    for (const char* name : {"m", "mm", "cm"}) {
      const LogUnit unit = *FindUnit(name);
      const double fall = per_unit * SiFactor(unit);
      if (IsGravity(fall))
        return GuessedUnit{
            unit, "falls at " + Rounded(fall) + " m/s^2 in flight if it is in " + unit.name};
    }
  }
  for (const MappedColumn& other : map.columns)
    if (TargetDimension(other.target) == Dimension::kLength)
      return GuessedUnit{other.unit, "as " + table.columns[other.column].name};
  return std::nullopt;
}

}  // namespace hoplab
