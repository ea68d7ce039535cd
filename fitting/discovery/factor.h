#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/discovery/term.h"

namespace hoplab {

/// One factor of a term: a power of a variable, with its unit and size.
struct Factor {
  std::string text;  // "vx^2"
  std::string unit;
  double size = 1.0;
  std::string words;     // "the square of speed"
  std::string variable;  // empty: none
  std::optional<TermPower> power = {};
};

/// The factor that changes nothing.
inline const Factor kOne{"1", "1", 1.0, "", "", {}};

/// sign(v), v, |v| v, v^2, v^3: of a variable that has a direction, which odd powers keep.
void AddSigned(std::vector<Factor>& to, const std::string& v, const std::string& unit, double size,
               const std::string& words);
/// v, v^2, v^3 of a size; the exponent may be freed.
void AddPositive(std::vector<Factor>& to, const std::string& v, const std::string& unit,
                 double size, const std::string& words);
/// v, v^2, v^3 of a place or an angle.
void AddPlain(std::vector<Factor>& to, const std::string& v, const std::string& unit, double size,
              const std::string& words);

}  // namespace hoplab
