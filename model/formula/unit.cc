#include "model/formula/unit.h"

#include <boost/spirit/home/x3.hpp>
#include <cmath>

#include "base/text.h"

namespace hoplab {
namespace {

namespace x3 = boost::spirit::x3;

constexpr double kRounding = 1e-9;

constexpr Unit kMetre{{1.0, 0.0, 0.0}};
constexpr Unit kKilogram{{0.0, 1.0, 0.0}};
constexpr Unit kSecond{{0.0, 0.0, 1.0}};
constexpr Unit kNewton{{1.0, 1.0, -2.0}};

struct UnitNames : x3::symbols<Unit> {
  UnitNames() {
    add("m", kMetre)("kg", kKilogram)("s", kSecond)("N", kNewton)("Pa", {{-1.0, 1.0, -2.0}})(
        "J", {{2.0, 1.0, -2.0}})("W", {{2.0, 1.0, -3.0}})("Hz", {{0.0, 0.0, -1.0}})("rad", Unit{})(
        "1", Unit{})("-", Unit{});
  }
} const kUnitNames;

const x3::rule<struct UnitProductTag, Unit> kUnitProduct = "product";
const x3::rule<struct FactorTag, Unit> kUnitFactor = "factor";

const auto kSet = [](auto& ctx) { x3::_val(ctx) = x3::_attr(ctx); };
const auto kRaise = [](auto& ctx) { x3::_val(ctx) = x3::_val(ctx).ToThe(x3::_attr(ctx)); };
const auto kTimes = [](auto& ctx) { x3::_val(ctx) = x3::_val(ctx) * x3::_attr(ctx); };
const auto kOver = [](auto& ctx) { x3::_val(ctx) = x3::_val(ctx) / x3::_attr(ctx); };

// A name ends where its letters do.
const auto kUnitFactor_def = ((x3::lexeme[kUnitNames >> !x3::alpha])[kSet] |
                              ('(' >> kUnitProduct >> ')')[kSet]) >>
                             -('^' >> x3::double_[kRaise]);
const auto kUnitProduct_def = kUnitFactor[kSet] >> *(('/' >> kUnitFactor[kOver]) |
                                                     (-x3::lit('*') >> kUnitFactor[kTimes]));

BOOST_SPIRIT_DEFINE(kUnitProduct, kUnitFactor)

// "m^2" of a base unit to a power.
void Append(const char* name, double power, std::string& to) {
  if (!to.empty()) to += ' ';
  to += name;
  if (std::abs(power - 1.0) > kRounding) to += "^" + FormatDouble(power);
}

// Numerator over denominator of the powers of N, kg, m, s; `newtons` are taken out.
std::string Fraction(const Unit& unit, double newtons) {
  const Unit rest = unit / kNewton.ToThe(newtons);
  const std::array<std::pair<const char*, double>, 4> parts = {
      {{"N", newtons}, {"kg", rest.power[1]}, {"m", rest.power[0]}, {"s", rest.power[2]}}};
  std::string above, below;
  int factors = 0;
  for (const auto& [name, power] : parts) {
    if (power > kRounding) Append(name, power, above);
    if (power < -kRounding) {
      Append(name, -power, below);
      ++factors;
    }
  }
  if (above.empty()) above = "1";
  if (below.empty()) return above;
  return above + (factors > 1 ? "/(" + below + ")" : "/" + below);
}

}  // namespace

Unit Unit::ToThe(double exponent) const {
  Unit u = *this;
  for (double& p : u.power) p *= exponent;
  return u;
}

Unit operator*(const Unit& a, const Unit& b) {
  Unit u = a;
  for (std::size_t i = 0; i < u.power.size(); ++i) u.power[i] += b.power[i];
  return u;
}

bool operator==(const Unit& a, const Unit& b) {
  for (std::size_t i = 0; i < a.power.size(); ++i)
    if (!(std::abs(a.power[i] - b.power[i]) < kRounding)) return false;
  return true;
}

std::optional<Unit> ParseUnit(std::string_view text) {
  constexpr std::size_t kLongest = 60;  // more than that says nothing any more
  if (text.size() > kLongest) return std::nullopt;
  // The parser's classes of characters are those of ASCII.
  for (const char c : text)
    if (static_cast<unsigned char>(c) > 127) return std::nullopt;
  Unit unit;
  const char* first = text.data();
  const char* const last = first + text.size();
  if (!x3::phrase_parse(first, last, kUnitProduct, x3::blank, unit) || first != last)
    return std::nullopt;
  for (const double p : unit.power)
    if (!(std::abs(p) < 100.0)) return std::nullopt;
  return unit;
}

std::string TextOf(const Unit& unit) {
  if (unit.IsOne()) return "-";
  // A force is told as such wherever there is a mass.
  return Fraction(unit, unit.power[1]);
}

}  // namespace hoplab
