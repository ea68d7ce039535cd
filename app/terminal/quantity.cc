#include "app/terminal/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace hoplab {
namespace {

struct Prefix {
  double size;
  std::string_view letter;
};
constexpr std::array<Prefix, 7> kPrefixes = {
    {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1.0, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e-9, "n"}}};

// Units a prefix may stand before without changing their meaning.
bool TakesPrefix(std::string_view unit) {
  constexpr std::array<std::string_view, 5> kSimple = {"Pa", "N", "m", "s", "J"};
  return std::find(kSimple.begin(), kSimple.end(), unit) != kSimple.end();
}

std::string Formatted(const char* format, int precision, double value) {
  if (std::isnan(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, format, precision, value);
  return text;
}

}  // namespace

ReadableUnit ReadableUnitOf(double value, const std::string& unit) {
  if (unit == "-") return {1.0, ""};
  if (!TakesPrefix(unit) || value == 0.0 || !std::isfinite(value)) return {1.0, unit};
  const double size = std::abs(value);
  // Plain units serve from a tenth to ten thousand.
  if (size >= 0.1 && size < 1e4) return {1.0, unit};
  for (const Prefix& p : kPrefixes) {
    if (size >= p.size) return {1.0 / p.size, std::string(p.letter) + unit};
  }
  return {1.0, unit};
}

int DecimalsFor(double half_width) {
  if (!(half_width > 0.0) || !std::isfinite(half_width)) return 3;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(half_width))), 0, 12);
}

std::string Fixed(double value, int decimals) { return Formatted("%.*f", decimals, value); }

std::string FixedOrMore(double value, int decimals) {
  if (value == 0.0 || !std::isfinite(value)) return Fixed(value, decimals);
  const int needed = 1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  return needed > decimals ? Significant(value, 2) : Fixed(value, decimals);
}

std::string Significant(double value, int digits) {
  const double size = std::abs(value);
  if (std::isfinite(value) && size >= 1e-4 && size < 1e6) {
    const int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(size)));
    return Fixed(value, std::clamp(decimals, 0, 12));
  }
  return Formatted("%.*g", digits, value);
}

std::string ErrorText(double value, const std::string& unit) {
  if (std::isnan(value)) return "not computed";
  const bool length = unit == "m";
  const std::string number = Significant(length ? 1e3 * value : value, 3);
  const std::string shown = length ? "mm" : unit == "-" ? "" : unit;
  return shown.empty() ? number : number + " " + shown;
}

std::string WithoutUnit(const std::string& channel) {
  // The longest first: "_m" ends "_N_m" too.
  for (std::string_view suffix : {"_m_per_s2", "_m_per_s", "_N_m", "_rad", "_m", "_N"}) {
    if (channel.ends_with(suffix)) return channel.substr(0, channel.size() - suffix.size());
  }
  return channel;
}

std::string UnitOfChannel(const std::string& channel) {
  if (channel.ends_with("_m_per_s2")) return "m/s^2";
  if (channel.ends_with("_m_per_s")) return "m/s";
  if (channel.ends_with("_N_m")) return "N m";
  if (channel.ends_with("_rad")) return "rad";
  if (channel.ends_with("_m")) return "m";
  if (channel.ends_with("_N")) return "N";
  return "";
}

}  // namespace hoplab
