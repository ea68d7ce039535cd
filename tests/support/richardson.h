#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace hoplab::testing {

/// A derivative by differences, with the error each component may still have.
struct DifferenceColumn {
  std::vector<double> value, error;
  double error_norm = std::numeric_limits<double>::infinity();
};

/// Differences `difference(h)` with steps h, h/2, h/4, ..., extrapolated to zero (Neville); an
/// order of error falls by `base`, then base^2, ... as the step is halved. Of the extrapolations
/// the one that changed least from its neighbours is taken; the change is its error. Empty if a
/// difference is, or their sizes differ.
template <class Difference>
DifferenceColumn RichardsonTable(const Difference& difference, double h, double base) {
  constexpr int kLevels = 8;
  const auto norm_of_change = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
  };
  DifferenceColumn best;
  std::array<std::array<std::vector<double>, kLevels>, kLevels> table;
  for (int i = 0; i < kLevels; ++i, h *= 0.5) {
    const auto found = difference(h);
    if (!found) return {};
    const std::size_t size = found->size();
    table[i][0] = *found;
    if (i > 0 && size != table[i - 1][0].size()) return {};
    double power = 1.0;
    for (int j = 1; j <= i; ++j) {
      power *= base;
      table[i][j].resize(size);
      for (std::size_t c = 0; c < size; ++c) {
        table[i][j][c] =
            table[i][j - 1][c] + (table[i][j - 1][c] - table[i - 1][j - 1][c]) / (power - 1.0);
      }
      const double error = std::max(norm_of_change(table[i][j], table[i][j - 1]),
                                    norm_of_change(table[i][j], table[i - 1][j - 1]));
      if (!(error < best.error_norm)) continue;  // also NaN: a run that has ended before
      best = {table[i][j], std::vector<double>(size), error};
      for (std::size_t c = 0; c < size; ++c) {
        best.error[c] = std::max(std::abs(table[i][j][c] - table[i][j - 1][c]),
                                 std::abs(table[i][j][c] - table[i - 1][j - 1][c]));
      }
    }
  }
  return best;
}

/// d f/dx at x by central differences, Neville in h^2. `f(x)` returns a vector of fixed size; if it
/// does not, the result's value is empty.
template <class Function>
DifferenceColumn RichardsonDerivative(const Function& f, double x, double h) {
  return RichardsonTable(
      [&](double step) -> std::optional<std::vector<double>> {
        const std::vector<double> up = f(x + step), down = f(x - step);
        if (up.size() != down.size()) return std::nullopt;
        std::vector<double> slope(up.size());
        for (std::size_t c = 0; c < up.size(); ++c) slope[c] = (up[c] - down[c]) / (2.0 * step);
        return slope;
      },
      h, 4.0);
}

/// The same where `f` may only be asked at x and above: forward differences, Neville in h.
template <class Function>
DifferenceColumn RichardsonForward(const Function& f, double x, double h) {
  return RichardsonTable(
      [&, here = f(x)](double step) -> std::optional<std::vector<double>> {
        const std::vector<double> up = f(x + step);
        if (up.size() != here.size()) return std::nullopt;
        std::vector<double> slope(up.size());
        for (std::size_t c = 0; c < up.size(); ++c) slope[c] = (up[c] - here[c]) / step;
        return slope;
      },
      h, 2.0);
}

}  // namespace hoplab::testing
