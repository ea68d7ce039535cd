#include "datasets/touchdowns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hoplab {
namespace {

std::vector<double> TimesOfContact(const Trace& trace, const std::vector<double>& contact) {
  std::vector<double> times;
  std::ptrdiff_t last = -1;
  for (std::size_t row = 0; row < contact.size(); ++row) {
    if (std::isnan(contact[row])) continue;
    if (last >= 0 && contact[row] > 0.5 && contact[static_cast<std::size_t>(last)] < 0.5)
      times.push_back(0.5 * (trace.time_s[static_cast<std::size_t>(last)] + trace.time_s[row]));
    last = static_cast<std::ptrdiff_t>(row);
  }
  return times;
}

}  // namespace

std::vector<double> TouchdownTimes(
    const Trace& trace, const std::function<double(std::size_t, std::size_t)>& touchdown_height) {
  if (const std::vector<double>* contact = trace.Find(Channel::kContact))
    return TimesOfContact(trace, *contact);
  std::vector<double> times;
  const std::vector<double>* y = trace.Find(Channel::kBodyY);
  if (y == nullptr) return times;
  constexpr double kClear = 1.01;  // of touch-down height: beyond what noise does
  bool flies = false;
  double above_before = 0, time_before = 0;
  for (std::size_t row = 0; row < y->size(); ++row) {
    const double height = touchdown_height(times.size(), row), above = (*y)[row] - height;
    if (std::isnan(above)) continue;
    if (flies && above < 0) {
      const double share = above_before > 0 ? above_before / (above_before - above) : 0.0;
      times.push_back(time_before + share * (trace.time_s[row] - time_before));
      flies = false;
    }
    flies = flies || (*y)[row] > kClear * height;
    above_before = above;
    time_before = trace.time_s[row];
  }
  return times;
}

bool TellsTouchdowns(const Trace& trace) {
  return trace.Find(Channel::kContact) != nullptr || trace.Find(Channel::kBodyY) != nullptr;
}

double ValueAt(const Trace& trace, const std::vector<double>& column, double time_s) {
  const auto at = std::lower_bound(trace.time_s.begin(), trace.time_s.end(), time_s);
  auto above = static_cast<std::ptrdiff_t>(at - trace.time_s.begin());
  auto below = above - 1;
  const auto rows = static_cast<std::ptrdiff_t>(column.size());
  const auto missing = [&](std::ptrdiff_t row) {
    return std::isnan(column[static_cast<std::size_t>(row)]);
  };
  while (above < rows && missing(above)) ++above;
  while (below >= 0 && missing(below)) --below;
  if (below < 0 || above >= rows) return std::nan("");
  const auto a = static_cast<std::size_t>(below), b = static_cast<std::size_t>(above);
  const double share = (time_s - trace.time_s[a]) / (trace.time_s[b] - trace.time_s[a]);
  return column[a] + share * (column[b] - column[a]);
}

}  // namespace hoplab
