#include "fitting/falls.h"

#include <algorithm>

namespace hoplab {
namespace {

constexpr double kLies_s = 0.1;
constexpr int kInARow = 3;  // samples: no stray ones

// Whether the samples from `first` on are those of a body that lies on the ground, or falls on.
bool LiesOrFalls(const Samples& s, std::size_t first, double lowest_m, double doubt) {
  constexpr double kRise_m = 0.015;
  const auto sunk = std::find_if(s.y.begin() + static_cast<std::ptrdiff_t>(first), s.y.end(),
                                 [&](double h) { return h < lowest_m - doubt; });
  if (sunk == s.y.end() || s.t.back() - s.t[static_cast<std::size_t>(sunk - s.y.begin())] < kLies_s)
    return false;
  double lowest = *sunk;
  int risen = 0;
  for (auto h = sunk; h != s.y.end(); ++h) {
    lowest = std::min(lowest, *h);
    risen = *h > std::min(lowest + kRise_m, lowest_m) + doubt ? risen + 1 : 0;
    if (risen == kInARow) return false;
  }
  return true;
}

}  // namespace

std::optional<std::size_t> FindTopBeforeFall(const Samples& heights, double lands_m,
                                             double lowest_m, double doubt) {
  const std::vector<double>& y = heights.y;
  const auto flies = [&](double h) { return h > lands_m + doubt; };
  const auto last =
      std::search_n(y.rbegin(), y.rend(), kInARow, true, [&](double h, bool) { return flies(h); });
  if (last == y.rend()) return std::nullopt;
  const auto behind = static_cast<std::size_t>(last.base() - y.begin());
  if (!LiesOrFalls(heights, behind, lowest_m, doubt)) return std::nullopt;
  const auto begin = std::find_if(last, y.rend(), [&](double h) { return h < lands_m - doubt; });
  return static_cast<std::size_t>(std::max_element(begin.base(), last.base()) - y.begin());
}

}  // namespace hoplab
