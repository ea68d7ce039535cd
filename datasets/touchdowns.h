#pragma once

#include <functional>
#include <vector>

#include "datasets/trace.h"

namespace hoplab {

/// When a trace shows the foot come down, in its own time, between the two rows it lies between: by
/// the column `contact` where there is one, else where body_y_m comes down through the height
/// `touchdown_height(touch-downs before, row)` [m] after it was a hundredth of it above. Rows that
/// miss a sample are passed over. Empty where the trace has neither column.
std::vector<double> TouchdownTimes(
    const Trace& trace, const std::function<double(std::size_t, std::size_t)>& touchdown_height);

/// Whether a trace can tell them.
bool TellsTouchdowns(const Trace& trace);

/// A column at a time between its rows, linear; NaN where it has no sample on both sides.
double ValueAt(const Trace& trace, const std::vector<double>& column, double time_s);

}  // namespace hoplab
