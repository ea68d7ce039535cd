#include "datasets/key_advice.h"

#include <algorithm>
#include <array>

#include "base/text.h"

namespace hoplab {
namespace {

// What people write behind a quantity. "per" and powers join them, as in m_per_s2.
constexpr std::array kUnitWords = {
    "m",   "mm",  "cm",  "dm",  "km",      "um",      "nm",      "in",      "inch", "ft",  "kg",
    "g",   "mg",  "t",   "lb",  "lbs",     "s",       "ms",      "us",      "ns",   "min", "h",
    "hz",  "khz", "n",   "kn",  "mn",      "pa",      "kpa",     "mpa",     "gpa",  "bar", "psi",
    "j",   "kj",  "w",   "rad", "deg",     "degrees", "radians", "m2",      "mm2",  "cm2", "m3",
    "mm3", "m4",  "mm4", "cm4", "s2",      "ms2",     "g0",      "percent", "per",  "nm2", "rads",
    "sec", "mps", "kmh", "rpm", "seconds", "meters",  "metres",  "pascal"};

bool IsUnitWord(std::string_view word) {
  std::string lower(word);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return std::find(kUnitWords.begin(), kUnitWords.end(), lower) != kUnitWords.end();
}

// Whether all words of "mm_per_s" are units; false for an empty text.
bool IsUnit(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('_'), text.size());
    if (!IsUnitWord(text.substr(0, end))) return false;
    if (end == text.size()) return true;
    text.remove_prefix(end + 1);
  }
  return false;
}

// "E" of "E_Pa", "damping" of "damping_N_s_per_m", "y" of "y_m": the shortest start behind which
// only units stand; the whole key where there is none.
std::string_view Stem(std::string_view key) {
  for (std::size_t at = key.find('_'); at != key.npos; at = key.find('_', at + 1))
    if (at > 0 && IsUnit(key.substr(at + 1))) return key.substr(0, at);
  return key;
}

}  // namespace

std::string UnitOfKey(std::string_view key) {
  const std::string_view stem = Stem(key);
  if (stem.size() == key.size()) return "";
  std::string unit(key.substr(stem.size() + 1));
  const std::size_t per = unit.find("_per_");
  if (per != unit.npos) unit.replace(per, 5, "/");
  std::replace(unit.begin(), unit.end(), '_', ' ');
  return unit;
}

std::optional<KeyAdvice> WrongUnitAdvice(std::string_view key,
                                         const std::vector<std::string>& known,
                                         bool unit_may_be_absent) {
  const std::string_view stem = Stem(key);
  const bool has_unit = stem.size() != key.size();
  if (!has_unit && unit_may_be_absent) return std::nullopt;
  for (const std::string& name : known) {
    const std::string_view known_stem = Stem(name);
    if (known_stem != stem || name == key) continue;
    const bool known_has_unit = known_stem.size() != name.size();
    if (!known_has_unit)
      return KeyAdvice{"is written " + name + ": it has no unit", "Rename it to " + name + "."};
    const std::string why =
        has_unit ? "the unit in its name does not belong to it" : "its unit stands in its name";
    return KeyAdvice{"is written " + name + ": " + why,
                     "Rename it to " + name + " and give the value in " + UnitOfKey(name) + "."};
  }
  return std::nullopt;
}

KeyAdvice UnknownKeyAdvice(std::string_view key, const std::vector<std::string>& known) {
  if (ParseDouble(key))
    return {"is a number where a key is wanted",
            "The decimal sign is a point; a comma in braces begins the next key."};
  if (const auto advice = WrongUnitAdvice(key, known)) return *advice;
  return {"unknown key", DidYouMean(key, known)};
}

}  // namespace hoplab
