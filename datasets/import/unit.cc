#include "datasets/import/unit.h"

#include <algorithm>
#include <numbers>

#include "base/text.h"
#include "datasets/import/decimal.h"

namespace hoplab {
namespace {

struct UnitRow {
  const char* name;
  Dimension dimension;
  int power_of_ten;
  double factor;
  std::vector<std::string_view> aliases;
};

// NIST SP 811 for inch, foot, pound-force, kilogram-force.
const std::vector<UnitRow>& Rows() {
  using enum Dimension;
  static const std::vector<UnitRow> kRows = {
      {"s", kTime, 0, 1, {"sec", "secs", "second", "seconds"}},
      {"ms", kTime, -3, 1, {"msec", "millis", "millisecond", "milliseconds"}},
      {"us", kTime, -6, 1, {"µs", "μs", "usec", "microsecond", "microseconds"}},
      {"ns", kTime, -9, 1, {"nsec", "nanosecond", "nanoseconds"}},
      {"min", kTime, 0, 60, {"minute", "minutes"}},
      {"m", kLength, 0, 1, {"meter", "meters", "metre", "metres"}},
      {"mm", kLength, -3, 1, {"millimeter", "millimeters", "millimetre", "millimetres"}},
      {"cm", kLength, -2, 1, {"centimeter", "centimeters", "centimetre", "centimetres"}},
      {"um", kLength, -6, 1, {"µm", "μm", "micron", "microns", "micrometer", "micrometers"}},
      {"in", kLength, 0, 0.0254, {"inch", "inches", "\""}},
      {"ft", kLength, 0, 0.3048, {"foot", "feet"}},
      {"m/s", kVelocity, 0, 1, {"mps", "m s-1", "m s^-1", "m*s^-1", "m per s"}},
      {"mm/s", kVelocity, -3, 1, {"mmps", "mm s-1", "mm s^-1", "mm per s"}},
      {"cm/s", kVelocity, -2, 1, {"cm s-1", "cm s^-1", "cm per s"}},
      {"km/h", kVelocity, 0, 1 / 3.6, {"kmh", "kph"}},
      {"in/s", kVelocity, 0, 0.0254, {}},
      {"ft/s", kVelocity, 0, 0.3048, {}},
      {"rad", kAngle, 0, 1, {"rads", "radian", "radians"}},
      {"mrad", kAngle, -3, 1, {}},
      {"deg", kAngle, 0, std::numbers::pi / 180, {"°", "degs", "degree", "degrees"}},
      {"N", kForce, 0, 1, {"newton", "newtons"}},
      {"mN", kForce, -3, 1, {}},
      {"kN", kForce, 3, 1, {}},
      {"kgf", kForce, 0, 9.80665, {"kp"}},
      {"lbf", kForce, 0, 4.4482216152605, {}},
      {"N m", kTorque, 0, 1, {"Nm", "N*m", "N.m", "N·m", "N-m"}},
      {"N mm", kTorque, -3, 1, {"Nmm", "N*mm", "N.mm", "N·mm", "N-mm"}},
      {"N cm", kTorque, -2, 1, {"Ncm", "N*cm", "N.cm", "N·cm", "N-cm"}},
      {"kN m", kTorque, 3, 1, {"kNm"}},
      {"lbf in", kTorque, 0, 4.4482216152605 * 0.0254, {"in lbf", "lbf*in"}},
      {"lbf ft", kTorque, 0, 4.4482216152605 * 0.3048, {"ft lbf", "lbf*ft"}},
      {"m/s^2", kAcceleration, 0, 1, {"m/s2", "m/s²", "m s-2", "m s^-2", "m per s2"}},
      {"mm/s^2", kAcceleration, -3, 1, {"mm/s2", "mm/s²", "mm s-2"}},
      {"g0", kAcceleration, 0, 9.80665, {"gee", "gees"}},
      {"1", kNone, 0, 1, {"-", "bool"}},
  };
  return kRows;
}

bool SameLetters(std::string_view a, std::string_view b) {
  return a.size() == b.size() && EditDistance(a, b) == 0;
}

LogUnit ToUnit(const UnitRow& row) {
  return {row.name, row.dimension, row.power_of_ten, row.factor};
}

// The unit at the end of "body_y_m" or "pitch deg"; a single word that is a unit is a name.
ColumnTitle SplitAtWord(std::string_view title) {
  static constexpr std::string_view kBetween = " _/,";
  for (std::size_t at = title.find_first_of(kBetween, 1); at != title.npos;
       at = title.find_first_of(kBetween, at + 1)) {
    std::string words(Trim(title.substr(at + 1)));
    std::replace(words.begin(), words.end(), '_', ' ');
    std::string_view stem = Trim(title.substr(0, at));
    while (!stem.empty() && kBetween.find(stem.back()) != kBetween.npos) stem.remove_suffix(1);
    // "t / s" is met at its blank first; "in" and "min" are more often words than units.
    if (words.starts_with("/")) words = std::string(Trim(std::string_view(words).substr(1)));
    if (words == "in" || words == "min" || words == "-" || words == "1" || stem.empty()) continue;
    if (const auto unit = FindUnit(words)) return {std::string(stem), words};
  }
  return {std::string(title), ""};
}

}  // namespace

const char* DimensionName(Dimension dimension) {
  static constexpr const char* kNames[] = {
      "a time",  "a length", "a speed",         "an angle",
      "a force", "a torque", "an acceleration", "a number without unit"};
  return kNames[static_cast<std::size_t>(dimension)];
}

Dimension DimensionOf(Channel channel) {
  const std::optional<LogUnit> unit = FindUnit(ChannelUnit(channel));
  return unit ? unit->dimension : Dimension::kNone;
}

std::optional<LogUnit> FindUnit(std::string_view text) {
  text = Trim(text);
  for (const UnitRow& row : Rows()) {
    const bool alias = std::find(row.aliases.begin(), row.aliases.end(), text) != row.aliases.end();
    if (text == row.name || alias) return ToUnit(row);
  }
  const UnitRow* found = nullptr;
  for (const UnitRow& row : Rows()) {
    const bool alias = std::any_of(row.aliases.begin(), row.aliases.end(),
                                   [&](std::string_view name) { return SameLetters(name, text); });
    if (!alias && !SameLetters(row.name, text)) continue;
    if (found != nullptr) return std::nullopt;  // mN or MN
    found = &row;
  }
  // One or two letters of another case may well mean another unit: nm is no torque.
  const bool is_word = text.size() > 2 || SameLetters(text, "mm") || SameLetters(text, "ms");
  if (found == nullptr || !is_word) return std::nullopt;
  return ToUnit(*found);
}

std::vector<std::string> UnitNames(Dimension dimension) {
  std::vector<std::string> names;
  for (const UnitRow& row : Rows())
    if (row.dimension == dimension) names.emplace_back(row.name);
  return names;
}

std::string ToSi(std::string_view number, const LogUnit& unit) {
  if (unit.factor == 1) return ShiftDecimal(number, unit.power_of_ten);
  return FormatDouble(ParseDouble(number).value_or(0) * unit.factor);
}

ColumnTitle SplitTitle(std::string_view title) {
  title = Trim(title);
  for (const std::string_view brackets : {"[]", "()", "{}"}) {
    if (title.empty() || title.back() != brackets[1]) continue;
    const std::size_t open = title.rfind(brackets[0]);
    if (open == title.npos || open == 0) continue;
    const std::string_view inside = Trim(title.substr(open + 1, title.size() - open - 2));
    // Square brackets hold units, known or not, or an index; round ones may hold anything.
    const bool index = inside.find(':') != inside.npos;
    if (index || (brackets[0] != '[' && !FindUnit(inside))) continue;
    return {std::string(Trim(title.substr(0, open))), std::string(inside)};
  }
  return SplitAtWord(title);
}

}  // namespace hoplab
