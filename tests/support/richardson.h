#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace hoplab::testing {

/// A derivative by differences, with the error each component may still have.
struct DifferenceColumn {
  std::vector<double> value, error;
  double error_norm = std::numeric_limits<double>::infinity();
};

/// d f/dx at x: central differences with steps h, h/2, h/4, ..., extrapolated (Neville in h^2). Of
/// the extrapolations the one that changed least from its neighbours is taken; the change is its
/// error. `f(x)` returns a vector of fixed size. If it does not, the result's value is empty.
template <class Function>
DifferenceColumn RichardsonDerivative(const Function& f, double x, double h) {
  constexpr int kLevels = 6;
  const auto norm_of_change = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
  };
  DifferenceColumn best;
  std::array<std::array<std::vector<double>, kLevels>, kLevels> table;
  for (int i = 0; i < kLevels; ++i, h *= 0.5) {
    const std::vector<double> up = f(x + h), down = f(x - h);
    if (up.size() != down.size()) return {};
    table[i][0].resize(up.size());
    for (std::size_t c = 0; c < up.size(); ++c) table[i][0][c] = (up[c] - down[c]) / (2.0 * h);
    if (i > 0 && table[i][0].size() != table[i - 1][0].size()) return {};
    double power = 1.0;
    for (int j = 1; j <= i; ++j) {
      power *= 4.0;
      table[i][j].resize(up.size());
      for (std::size_t c = 0; c < up.size(); ++c) {
        table[i][j][c] =
            table[i][j - 1][c] + (table[i][j - 1][c] - table[i - 1][j - 1][c]) / (power - 1.0);
      }
      const double error = std::max(norm_of_change(table[i][j], table[i][j - 1]),
                                    norm_of_change(table[i][j], table[i - 1][j - 1]));
      if (error >= best.error_norm) continue;
      best = {table[i][j], std::vector<double>(up.size()), error};
      for (std::size_t c = 0; c < up.size(); ++c) {
        best.error[c] = std::max(std::abs(table[i][j][c] - table[i][j - 1][c]),
                                 std::abs(table[i][j][c] - table[i - 1][j - 1][c]));
      }
    }
  }
  return best;
}

}  // namespace hoplab::testing
