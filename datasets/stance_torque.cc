#include "datasets/stance_torque.h"

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

constexpr std::size_t kAtRest = 5;  // rows
constexpr double kNone = 0.05, kThere = 0.25;
constexpr std::size_t kNear = 3;  // changes next to an edge
constexpr double kSudden = 3.0;   // of them, a step

double Largest(const std::vector<double>& torque, std::size_t begin, std::size_t end) {
  double largest = 0.0;
  for (std::size_t row = begin; row < end; ++row)
    largest = std::max(largest, std::abs(torque[row]));
  return largest;
}

// Whether the torque of a stance, rows [begin, end), steps at one end of it from the row outside.
bool Steps(const std::vector<double>& torque, std::size_t begin, std::size_t end, bool at_end,
           double none) {
  const std::size_t rows = end - begin;
  if (rows == 0) return false;
  const auto value = [&](std::size_t k) { return torque[at_end ? end - 1 - k : begin + k]; };
  if (std::abs(value(0)) >= kThere * Largest(torque, begin, end)) return true;
  double change = 0.0;
  for (std::size_t k = 0; k < std::min(kNear, rows - 1); ++k)
    change = std::max(change, std::abs(value(k) - value(k + 1)));
  const double drop = std::abs(value(0) - torque[at_end ? end : begin - 1]);
  return rows > 1 && drop > std::max(none, kSudden * change);
}

// Whether the foot is on the ground in each of the rows.
bool OnGround(const std::vector<double>& contact, std::size_t begin) {
  if (contact.empty()) return false;
  const auto first = contact.begin() + static_cast<std::ptrdiff_t>(begin);
  return std::all_of(first, first + kAtRest, [](double c) { return c > 0.5; });
}

}  // namespace

std::vector<TorqueRest> TorqueRests(const std::vector<double>& torque) {
  const std::size_t rows = torque.size();
  const double none = kNone * Largest(torque, 0, rows);
  std::vector<TorqueRest> rests;
  for (std::size_t row = 0; row < rows; ++row) {
    if (!(std::abs(torque[row]) < none)) continue;
    const std::size_t begin = row;
    while (row < rows && std::abs(torque[row]) < none) ++row;
    if (row - begin >= kAtRest) rests.push_back({begin, row, false, false});
  }
  for (std::size_t k = 0; k < rests.size(); ++k) {
    TorqueRest& rest = rests[k];
    const std::size_t last = k > 0 ? rests[k - 1].end : 0;
    const std::size_t next = k + 1 < rests.size() ? rests[k + 1].begin : rows;
    rest.steps_out = Steps(torque, last, rest.begin, true, none);
    rest.steps_in = Steps(torque, rest.end, next, false, none);
  }
  return rests;
}

std::vector<double> HeldThroughFlights(const std::vector<double>& torque,
                                       const std::vector<double>& contact) {
  std::vector<double> held = torque;
  for (const TorqueRest& rest : TorqueRests(torque)) {
    const bool on = rest.steps_out && !OnGround(contact, rest.begin);
    const bool back = rest.steps_in && !OnGround(contact, rest.end - kAtRest);
    const auto middle = rest.begin == 0             ? rest.begin
                        : rest.end == torque.size() ? rest.end
                                                    : rest.begin + (rest.end - rest.begin) / 2;
    const auto at = [&](std::size_t row) {
      return held.begin() + static_cast<std::ptrdiff_t>(row);
    };
    if (on) std::fill(at(rest.begin), at(middle), torque[rest.begin - 1]);
    if (back) std::fill(at(middle), at(rest.end), torque[rest.end]);
  }
  return held;
}

}  // namespace hoplab
