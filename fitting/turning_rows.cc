#include "fitting/turning_rows.h"

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

constexpr double kBeyondNoise = 10.0;                   // sigma
constexpr double kLeastDepth = 0.02, kMostDepth = 0.1;  // of the range of heights

}  // namespace

std::vector<int> TurningRows(const std::function<double(int)>& y, int rows, double sigma) {
  std::vector<int> seen;
  for (int row = 0; row < rows; ++row)
    if (!std::isnan(y(row))) seen.push_back(row);
  if (seen.empty()) return {};
  const auto lower = [&](int a, int b) { return y(a) < y(b); };
  const auto [lowest, highest] = std::minmax_element(seen.begin(), seen.end(), lower);
  const double range = y(*highest) - y(*lowest);
  // Where flights are short the noise is not known well: parabolas were laid across the ground.
  const double wanted = std::isnan(sigma) ? 0.0 : kBeyondNoise * sigma;
  const double depth = std::clamp(wanted, kLeastDepth * range, kMostDepth * range);
  std::vector<int> turns;
  int extreme = seen.front();
  bool falls = false;  // by more than `depth` from the last top
  for (const int row : seen) {
    if (falls ? y(row) < y(extreme) : y(row) > y(extreme)) extreme = row;
    if (!(std::abs(y(row) - y(extreme)) > depth)) continue;
    if (falls) turns.push_back(extreme);
    falls = !falls;
    extreme = row;
  }
  return turns;
}

}  // namespace hoplab
