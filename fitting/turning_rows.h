#pragma once

#include <functional>
#include <vector>

namespace hoplab {

/// Rows where a height turns from down to up by much more than noise does, the lowest of each turn.
/// A flight has none, at any rate of sampling and with missing samples (NaN): gravity and drag only
/// bend it down. So between a row and the next lies the ground, also where no row shows it.
/// `y(row)` [m], of `rows` rows; `sigma` its noise [m]. It has to rise and fall by ten sigma, by no
/// less than a fiftieth and no more than a tenth of the range of heights.
std::vector<int> TurningRows(const std::function<double(int)>& y, int rows, double sigma);

}  // namespace hoplab
