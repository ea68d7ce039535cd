#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hoplab {

// Arithmetic on numbers as they are printed, so that a change of unit by a power of ten, of sign or
// of origin keeps every digit of a log. All take what ParseDouble reads as a finite number.

/// `number` times 10^power, digit by digit: "412.50" by -3 is "0.41250".
std::string ShiftDecimal(std::string_view number, int power);

/// "-0.3" of "0.3" and the other way round; zero has no sign.
std::string NegateDecimal(std::string_view number);

/// The exact sum; nothing where the digits of the two reach over more than 36 places.
std::optional<std::string> AddDecimals(std::string_view a, std::string_view b);

}  // namespace hoplab
