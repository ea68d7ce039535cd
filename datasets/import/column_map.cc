#include "datasets/import/column_map.h"

#include <algorithm>
#include <utility>

#include "base/channel.h"
#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/guess_columns.h"

namespace hoplab {
namespace {

std::string Shown(const Table& table) {
  std::vector<std::string> names;
  for (const SourceColumn& column : table.columns) names.push_back(column.name);
  constexpr std::size_t kMost = 24;
  const std::size_t more = names.size() > kMost ? names.size() - kMost : 0;
  names.resize(names.size() - more);
  return Printable(Join(names), 600) + (more > 0 ? ", and " + std::to_string(more) + " more" : "");
}

// Columns that `name` may mean: by exact name, else by the title without its unit, else either in
// letters of any case.
std::vector<std::size_t> Candidates(const Table& table, const std::string& name) {
  const auto same = [](const std::string& a, const std::string& b) {
    return a.size() == b.size() && EditDistance(a, b) == 0;
  };
  for (int loose = 0; loose < 3; ++loose) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const std::string& full = table.columns[i].name;
      const std::string stem = SplitTitle(full).stem;
      const bool match = loose == 0   ? full == name
                         : loose == 1 ? stem == name
                                      : same(full, name) || same(stem, name);
      if (match) found.push_back(i);
    }
    if (!found.empty()) return found;
  }
  return {};
}

std::size_t FindColumn(const Table& table, const std::string& name) {
  const bool numbered = name.size() > 1 && name[0] == '#' &&
                        name.find_first_not_of("0123456789", 1) == std::string::npos &&
                        name.size() < 9;
  if (numbered) {
    const std::size_t number = std::stoul(name.substr(1));
    if (number >= 1 && number <= table.columns.size()) return number - 1;
    throw InputError({table.file, "column " + name,
                      "the file has " + std::to_string(table.columns.size()) + " columns",
                      "They are: " + Shown(table) + "."});
  }
  const std::vector<std::size_t> found = Candidates(table, name);
  if (found.size() == 1) return found[0];
  if (found.empty()) {
    std::vector<std::string> names;
    for (const SourceColumn& column : table.columns) {
      names.push_back(column.name);
      names.push_back(SplitTitle(column.name).stem);
    }
    const auto nearest = NearestWord(name, names);
    throw InputError({table.file, "column " + Printable(name), "there is no such column",
                      (nearest ? "Did you mean " + Printable(*nearest) + "? " : "") +
                          "The columns are: " + Shown(table) + "."});
  }
  std::string numbers;
  for (const std::size_t i : found)
    numbers += (numbers.empty() ? "#" : " or #") + std::to_string(i + 1);
  throw InputError({table.file, "column " + Printable(name),
                    std::to_string(found.size()) + " columns are called so",
                    "Say which by its number: " + numbers + "."});
}

// The column that an entry means: with a minus in front where the file has such a name itself.
std::pair<std::size_t, bool> FindSigned(const Table& table, const MapEntry& entry) {
  if (entry.negate && !Candidates(table, "-" + entry.column).empty())
    return {FindColumn(table, "-" + entry.column), false};
  return {FindColumn(table, entry.column), entry.negate};
}

[[noreturn]] void FailUnit(const Table& table, const MappedColumn& mapped, const std::string& unit,
                           const std::string& rule) {
  const Dimension wanted = TargetDimension(mapped.target);
  const std::string kind = DimensionName(wanted);  // "an angle"
  throw InputError(
      {table.file,
       "column " + Printable(table.columns[mapped.column].name) +
           (unit.empty() ? "" : " in " + Printable(unit)),
       rule,
       "Units of " + kind.substr(kind.find(' ') + 1) + ": " + Join(UnitNames(wanted)) +
           "; say which, as --map " + MapText(table, mapped) +
           (unit.empty() ? ", or --unit '" + UnitNames(wanted).front() + "' for all without one."
                         : ".")});
}

// The unit of a column: what the user says, else what the file says of it or of all such columns,
// else a guess.
void FindUnitOf(const Table& table, const std::string& said, ColumnMap* map, MappedColumn* mapped) {
  const Dimension wanted = TargetDimension(mapped->target);
  const std::string target = TargetName(mapped->target);
  if (mapped->target.channel && IsContact(*mapped->target.channel)) {
    mapped->unit = *FindUnit("1");
    return;
  }
  std::string stated = table.columns[mapped->column].unit;
  const auto general = table.units.find(wanted);
  if (stated.empty() && general != table.units.end()) stated = general->second;
  mapped->unit = {UnitNames(wanted).front(), wanted, 0, 1};  // for messages
  if (!said.empty()) {
    const std::optional<LogUnit> unit = FindUnit(said);
    if (!unit || unit->dimension != wanted)
      FailUnit(table, *mapped, said, target + " is " + DimensionName(wanted));
    const std::optional<LogUnit> in_file = FindUnit(stated);
    if (!stated.empty() && (!in_file || in_file->name != unit->name))
      map->warnings.push_back(table.file + ": " + table.columns[mapped->column].name + " is in " +
                              stated + " by the file and in " + unit->name +
                              " by --map; taken as " + unit->name);
    mapped->unit = *unit;
    return;
  }
  if (!stated.empty()) {
    const std::optional<LogUnit> unit = FindUnit(stated);
    if (!unit) FailUnit(table, *mapped, stated, "is no unit that is known");
    if (unit->dimension != wanted)
      FailUnit(table, *mapped, stated, target + " is " + DimensionName(wanted));
    mapped->unit = *unit;
    return;
  }
  const std::optional<GuessedUnit> guess = GuessUnit(table, *map, *mapped);
  if (!guess)
    FailUnit(table, *mapped, "", "its unit stands nowhere and cannot be told from the numbers");
  mapped->unit = guess->unit;
  mapped->guessed = true;
  mapped->why += (mapped->why.empty() ? "" : "; ") + guess->why;
}

void CheckTwice(const Table& table, const ColumnMap& map) {
  for (std::size_t i = 0; i < map.columns.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const MappedColumn &one = map.columns[j], &other = map.columns[i];
      if (other.target == one.target)
        throw InputError(
            {"--map", TargetName(other.target), "is given twice", "Remove one of the two."});
      // A measured angle may be what the motor follows, too.
      const bool drives = other.target.input.has_value() != one.target.input.has_value();
      if (other.column == one.column && !drives)
        throw InputError(
            {"--map", "column " + Printable(table.columns[one.column].name),
             "is taken for " + TargetName(one.target) + " and for " + TargetName(other.target),
             "Name another column for one of the two, or leave it out."});
    }
}

}  // namespace

std::optional<MapEntry> ParseMapEntry(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) return std::nullopt;
  MapEntry entry;
  entry.column = std::string(Trim(std::string_view(text).substr(equals + 1)));
  const std::size_t colon = entry.column.rfind(':');
  if (colon != std::string::npos && colon > 0 && FindUnit(entry.column.substr(colon + 1))) {
    entry.unit = std::string(Trim(std::string_view(entry.column).substr(colon + 1)));
    entry.column = std::string(Trim(std::string_view(entry.column).substr(0, colon)));
  }
  if (entry.column.starts_with('-')) {
    entry.negate = true;
    entry.column.erase(0, 1);
  }
  if (entry.column.empty()) return std::nullopt;
  entry.target = TargetOfWord(std::string(Trim(std::string_view(text).substr(0, equals))), "--map");
  return entry;
}

bool ColumnMap::HasGuesses() const {
  return std::any_of(columns.begin(), columns.end(),
                     [](const MappedColumn& column) { return column.guessed; });
}

bool ColumnMap::IsRobots() const {
  return std::any_of(columns.begin(), columns.end(),
                     [](const MappedColumn& column) { return column.target.IsRobots(); });
}

ColumnMap ResolveColumns(const Table& table, const std::vector<MapEntry>& entries,
                         bool without_time, std::optional<MechanismKind> type) {
  ColumnMap map;
  std::vector<std::pair<MappedColumn, std::string>> said;
  bool has_time = without_time;
  for (const MapEntry& entry : entries) {
    const auto [column, negate] = FindSigned(table, entry);
    said.push_back({MappedColumn{entry.target, column, negate}, entry.unit});
    has_time = has_time || entry.target.IsTime();
  }
  // Time first, then the height: guessed units of the others are told by them.
  const auto rank = [](const MappedColumn& mapped) {
    return mapped.target.IsTime() ? 0 : mapped.target == Channel::kBodyY ? 1 : 2;
  };
  std::stable_sort(said.begin(), said.end(),
                   [&](const auto& a, const auto& b) { return rank(a.first) < rank(b.first); });
  if (!has_time) said.insert(said.begin(), {GuessTime(table), ""});
  for (auto& [mapped, unit] : said) {
    FindUnitOf(table, unit, &map, &mapped);
    map.columns.push_back(mapped);
  }
  std::optional<UnitDoubt> doubt;
  if (entries.empty()) {
    Guesses guesses = GuessChannels(table, map, type);
    // Here what needs no guess goes before all of them.
    const auto order = [&](const MappedColumn& m) {
      const bool known = !m.unit.name.empty() || !table.columns[m.column].unit.empty();
      return known ? -1 : rank(m);
    };
    std::stable_sort(guesses.columns.begin(), guesses.columns.end(),
                     [&](const auto& a, const auto& b) { return order(a) < order(b); });
    map.warnings.insert(map.warnings.end(), guesses.notes.begin(), guesses.notes.end());
    doubt = guesses.doubt;
    for (MappedColumn guess : guesses.columns) {
      if (guess.unit.name.empty()) FindUnitOf(table, "", &map, &guess);
      map.columns.push_back(guess);
    }
  }
  CheckTwice(table, map);
  const auto channels =
      std::count_if(map.columns.begin(), map.columns.end(),
                    [](const MappedColumn& m) { return m.target.channel.has_value(); });
  if (channels == 0)
    throw InputError({table.file, "", "no column could be told to be a channel of a dataset",
                      (doubt ? doubt->text + ". " : "") + "Name them, as --map t=COLUMN:ms --map " +
                          (doubt ? "'" + doubt->map_text + "'" : "y=COLUMN:mm") +
                          "; the columns are: " + Shown(table) + "."});
  if (doubt)
    map.warnings.push_back(table.file + ": " + doubt->text + "; add --map '" + doubt->map_text +
                           "' to the words below");
  return map;
}

std::string MapText(const Table& table, const MappedColumn& mapped) {
  const std::string& name = table.columns[mapped.column].name;
  const bool several = Candidates(table, name).size() != 1;
  return WordOf(mapped.target) + "=" + (mapped.negate ? "-" : "") +
         (several ? "#" + std::to_string(mapped.column + 1) : name) +
         (mapped.unit.name.empty() || mapped.unit.dimension == Dimension::kNone
              ? ""
              : ":" + mapped.unit.name);
}

}  // namespace hoplab
