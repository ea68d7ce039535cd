#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

/// What is wrong with a name that stands where one of some known names is wanted.
struct KeyAdvice {
  std::string rule;    // "is written E_Pa: the unit belongs to the name"
  std::string remedy;  // "Give the value in Pa."
};

/// The unit at the end of a name of the format ("E_Pa": "Pa", "kp_N_s": "N s"); empty if there is
/// none ("restitution", "initial_sigma").
std::string UnitOfKey(std::string_view key);

/// Advice where `key` is one of `known` with the wrong unit, as `E_GPa` for `E_Pa`, or, if
/// `unit_may_be_absent` is false, without its unit, as `E` or `gravity`; otherwise nothing.
std::optional<KeyAdvice> WrongUnitAdvice(std::string_view key,
                                         const std::vector<std::string>& known,
                                         bool unit_may_be_absent = false);

/// Advice for a key that is not in `known`: WrongUnitAdvice, else the nearest known key, else all
/// of them.
KeyAdvice UnknownKeyAdvice(std::string_view key, const std::vector<std::string>& known);

}  // namespace hoplab
