#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "datasets/suspect_things.h"
#include "fitting/stray_samples.h"

namespace hoplab {
namespace {

constexpr double kByChance = 1e-3;  // of equal samples in a whole column
constexpr double kSameStep = 1e-3;  // two steps of one grid, of a step
constexpr double kOften = 0.05;     // of all steps, those of one grid
constexpr double kFinest = 1e-12;   // decimals
constexpr double kSteps = 8.0;      // of its digits, that a body has moved on while it was held
constexpr double kAhead = 2.5;      // of the step that follows, likewise
constexpr double kNoisy = 20.0;     // of its digits, the noise of a sensor that may hold
constexpr std::size_t kNear = 3;    // steps before it was held and after, in which the body moves
constexpr double kFast = 6.0;       // of the noise, how far

// Whether the body moves both before and after the samples from `first` to before `end`: one at
// rest slows down and begins anew.
bool MovesOnBothSides(const Samples& s, std::size_t first, std::size_t end, double least) {
  if (first <= kNear || end + kNear >= s.size()) return false;
  return std::abs(s.y[first - 1] - s.y[first - 1 - kNear]) > least &&
         std::abs(s.y[end + kNear] - s.y[end]) > least;
}

// Whether the body has moved on while its samples from `first` to before `end` repeated the one
// before: one at rest goes on from where it was.
bool HasMovedOn(const Samples& s, std::size_t first, std::size_t end, double digit, double sigma) {
  if (MovesOnBothSides(s, first, end, std::max(kSteps * digit, kFast * sigma))) return true;
  if (end + 1 < s.size()) {
    const double moved = std::abs(s.y[end] - s.y[first]);
    return moved > kSteps * digit && moved > kAhead * std::abs(s.y[end + 1] - s.y[end]);
  }
  if (first < 3) return false;
  const double speed = (s.y[first - 1] - s.y[first - 3]) / (s.t[first - 1] - s.t[first - 3]);
  return std::abs(speed * (s.t.back() - s.t[first - 1])) > kSteps * digit;
}

// How fine the values are: the grid of a sensor, where the least difference is met again and again,
// or else that of their decimals, an
// angle's perhaps in degrees.
double Fineness(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] != values[i - 1]) steps.push_back(std::abs(values[i] - values[i - 1]));
  if (steps.empty()) return std::numeric_limits<double>::infinity();
  const double least = *std::min_element(steps.begin(), steps.end());
  const auto often = std::count_if(steps.begin(), steps.end(),
                                   [&](double step) { return step < (1.0 + kSameStep) * least; });
  if (static_cast<double>(often) > kOften * static_cast<double>(steps.size())) return least;
  for (double unit = 1.0; unit > kFinest; unit /= 10.0) {
    for (const double digit : {unit, DegToRad(unit)}) {
      const bool all = std::all_of(values.begin(), values.end(), [&](double value) {
        return std::abs(value / digit - std::round(value / digit)) < kSameStep;
      });
      if (all) return digit;
    }
  }
  return kFinest;
}

}  // namespace

std::vector<bool> RepeatedSamples(const Samples& s, const std::vector<bool>& held_rows) {
  std::vector<bool> again(s.size(), false);
  for (std::size_t i = 1; i < s.size(); ++i) again[i] = s.y[i] == s.y[i - 1];
  const Samples fresh = s.Without(again);
  const double sigma = HighFrequencyNoise(fresh.t, fresh.y), step = Fineness(s.y);
  const double by_chance = sigma > 0.0 ? step / sigma : 1.0;
  for (std::size_t first = 1; first < s.size(); ++first) {
    if (!again[first]) continue;
    std::size_t end = first;
    while (end < s.size() && again[end]) ++end;
    const double times =
        static_cast<double>(s.size()) * std::pow(by_chance, static_cast<double>(end - first));
    const auto is_held = [&] {
      if (HasMovedOn(s, first, end, step, sigma)) return true;
      for (std::size_t i = first; i < end; ++i)
        if (s.row[i] >= held_rows.size() || !held_rows[s.row[i]]) return false;
      return true;
    };
    if (!(by_chance * kNoisy < 1.0 && times < kByChance && is_held()))
      std::fill(again.begin() + static_cast<std::ptrdiff_t>(first),
                again.begin() + static_cast<std::ptrdiff_t>(end), false);
    first = end;
  }
  return again;
}

}  // namespace hoplab
