#pragma once

#include <cstddef>
#include <vector>

namespace hoplab {

/// Rows [begin, end) in which a logged torque is none: five or more below a twentieth of its
/// largest. It steps where the row next to them has a quarter or more of that stance's largest, or
/// falls by more than three times the changes beside it.
struct TorqueRest {
  std::size_t begin, end;
  bool steps_out, steps_in;  // at begin, at end
};
std::vector<TorqueRest> TorqueRests(const std::vector<double>& torque);

/// M123: the torque of a log that has none in flight, held on through every flight from the stance
/// before it and back from the one behind it, to the middle, where it steps. Where `contact` (1 or
/// 0 a row, or empty) has the foot on the ground in the five rows without torque next to a step,
/// the torque ended, or began, within the stance, and the rows stay as they are.
std::vector<double> HeldThroughFlights(const std::vector<double>& torque,
                                       const std::vector<double>& contact);

}  // namespace hoplab
