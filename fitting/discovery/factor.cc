#include "fitting/discovery/factor.h"

#include <cmath>

namespace hoplab {
namespace {

std::string Raised(const std::string& unit, int exponent) {
  if (exponent == 1 || unit == "1") return unit;
  return "(" + unit + ")^" + std::to_string(exponent);
}

// How a power is told.
std::string PowerWords(const std::string& of, int exponent) {
  if (exponent == 1) return of;
  return (exponent == 2 ? "the square of " : "the cube of ") + of;
}

}  // namespace

void AddSigned(std::vector<Factor>& to, const std::string& v, const std::string& unit, double size,
               const std::string& words) {
  const auto power = [&](double exponent) {
    return TermPower{"abs(" + v + ")", "sign(" + v + ")", unit, exponent, size};
  };
  to.push_back({"sign(" + v + ")", "1", 1.0, "the direction of " + words, v, {}});
  to.push_back({v, unit, size, words, v, power(1)});
  to.push_back({"abs(" + v + ") * " + v, Raised(unit, 2), size * size, "the square of " + words, v,
                power(2)});
  to.push_back({v + "^2",
                Raised(unit, 2),
                size * size,
                "the square of " + words + ", whatever its direction",
                v,
                {}});
  to.push_back(
      {v + "^3", Raised(unit, 3), size * size * size, "the cube of " + words, v, power(3)});
}

void AddPositive(std::vector<Factor>& to, const std::string& v, const std::string& unit,
                 double size, const std::string& words) {
  for (int n = 1; n <= 3; ++n) {
    to.push_back({n == 1 ? v : v + "^" + std::to_string(n), Raised(unit, n), std::pow(size, n),
                  PowerWords(words, n), v, TermPower{v, "", unit, static_cast<double>(n), size}});
  }
}

void AddPlain(std::vector<Factor>& to, const std::string& v, const std::string& unit, double size,
              const std::string& words) {
  for (int n = 1; n <= 3; ++n)
    to.push_back({n == 1 ? v : v + "^" + std::to_string(n),
                  Raised(unit, n),
                  std::pow(size, n),
                  PowerWords(words, n),
                  v,
                  {}});
}

}  // namespace hoplab
