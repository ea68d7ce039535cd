#include "datasets/import/decimal.h"

#include <algorithm>
#include <charconv>

#include "base/check.h"
#include "base/text.h"

namespace hoplab {
namespace {

__extension__ using Integer = __int128;
constexpr std::size_t kMostDigits = 36;  // of an Integer, with room for a carry

// digits x 10^exponent. The last digit is the last printed one; no leading zeros but in "0".
struct Decimal {
  bool negative = false;
  std::string digits = "0";
  long exponent = 0;
};

bool IsZero(const Decimal& d) { return d.digits.find_first_not_of('0') == std::string::npos; }

Decimal Parse(std::string_view text) {
  text = Trim(text);
  Decimal d;
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    d.negative = text.front() == '-';
    text.remove_prefix(1);
  }
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  const std::string_view mantissa = text.substr(0, e);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  d.digits = std::string(mantissa.substr(0, point));
  if (point < mantissa.size()) d.digits += mantissa.substr(point + 1);
  d.exponent = point < mantissa.size() ? -static_cast<long>(mantissa.size() - point - 1) : 0;
  HOPLAB_CHECK(!d.digits.empty() && d.digits.find_first_not_of("0123456789") == std::string::npos);
  d.digits.erase(0, std::min(d.digits.find_first_not_of('0'), d.digits.size() - 1));
  if (e < text.size()) {
    std::string_view power = text.substr(e + 1);
    if (!power.empty() && power.front() == '+') power.remove_prefix(1);
    long value = 0;
    const auto [end, error] = std::from_chars(power.data(), power.data() + power.size(), value);
    // A finite number with an exponent beyond all bounds is zero.
    if (error != std::errc() || std::abs(value) > 100'000) return {};
    d.exponent += value;
  }
  if (IsZero(d)) d.negative = false;
  return d;
}

std::string Format(const Decimal& d) {
  const long size = static_cast<long>(d.digits.size());
  const std::string sign = d.negative ? "-" : "";
  constexpr long kMostZeros = 12;  // written out before the digits or behind them
  if (IsZero(d) && (d.exponent > 0 || d.exponent < -kMostZeros)) return "0";
  if (d.exponent > kMostZeros || d.exponent < -size - kMostZeros)
    return sign + d.digits + "e" + std::to_string(d.exponent);
  if (d.exponent >= 0) return sign + d.digits + std::string(d.exponent, '0');
  std::string digits = d.digits;
  if (size <= -d.exponent) digits.insert(0, static_cast<std::size_t>(1 - size - d.exponent), '0');
  digits.insert(digits.size() - static_cast<std::size_t>(-d.exponent), ".");
  return sign + digits;
}

Integer ToInteger(const Decimal& d) {
  Integer value = 0;
  for (const char c : d.digits) value = value * 10 + (c - '0');
  return d.negative ? -value : value;
}

// The same number with a lower exponent; false if that takes too many digits.
bool Align(Decimal* d, long exponent) {
  const auto zeros = static_cast<std::size_t>(d->exponent - exponent);
  if (IsZero(*d)) {
    d->digits = "0";
  } else if (zeros > kMostDigits || d->digits.size() + zeros > kMostDigits) {
    return false;
  } else {
    d->digits.append(zeros, '0');
  }
  d->exponent = exponent;
  return d->digits.size() <= kMostDigits;
}

}  // namespace

std::string ShiftDecimal(std::string_view number, int power) {
  Decimal d = Parse(number);
  d.exponent += power;
  return Format(d);
}

std::string NegateDecimal(std::string_view number) {
  Decimal d = Parse(number);
  d.negative = !d.negative && !IsZero(d);
  return Format(d);
}

std::optional<std::string> AddDecimals(std::string_view a, std::string_view b) {
  Decimal x = Parse(a), y = Parse(b);
  const long exponent = std::min(x.exponent, y.exponent);
  if (!Align(&x, exponent) || !Align(&y, exponent)) return std::nullopt;
  Integer sum = ToInteger(x) + ToInteger(y);
  Decimal result;
  result.negative = sum < 0;
  if (sum < 0) sum = -sum;
  result.exponent = exponent;
  result.digits.clear();
  for (; sum > 0; sum /= 10)
    result.digits.insert(result.digits.begin(),
                         static_cast<char>('0' + static_cast<int>(sum % 10)));
  if (result.digits.empty()) result.digits = "0";
  return Format(result);
}

}  // namespace hoplab
