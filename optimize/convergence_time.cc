#include "optimize/convergence_time.h"

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

constexpr std::size_t kSteadyApexes = 5;

// Index of the first apex from which on all lie within `band` of the steady speed; the number of
// apexes if the last five do not.
std::size_t FirstInBand(std::span<const ApexSpeed> apexes, double steady, double band) {
  std::size_t first = apexes.size();
  while (first > 0 && std::abs(apexes[first - 1].vx - steady) <= band * std::abs(steady)) --first;
  return first + kSteadyApexes <= apexes.size() ? first : apexes.size();
}

}  // namespace

std::vector<ApexSpeed> ApexSpeeds(const Trajectory& run) {
  std::vector<ApexSpeed> apexes;
  for (const Event& event : run.events) {
    if (event.kind == EventKind::kApex) apexes.push_back({event.time, event.vx});
  }
  return apexes;
}

ConvergenceTime ConvergenceTimeOf(std::span<const ApexSpeed> apexes) {
  ConvergenceTime result;
  if (apexes.size() < kSteadyApexes) return result;
  const auto last = apexes.last(kSteadyApexes);
  result.steady_speed = 0.0;
  for (const ApexSpeed& apex : last) result.steady_speed += apex.vx / kSteadyApexes;
  result.spread = 0.0;
  for (const ApexSpeed& apex : last)
    result.spread = std::max(result.spread, std::abs(apex.vx - result.steady_speed));
  result.spread /= std::abs(result.steady_speed);  // infinite for a hopper that stands
  for (const auto& [band, name] : {std::pair{0.01, ConvergenceTime::Band::kOnePercent},
                                   std::pair{0.02, ConvergenceTime::Band::kTwoPercent}}) {
    const std::size_t first = FirstInBand(apexes, result.steady_speed, band);
    if (first == apexes.size()) continue;
    result.band = name;
    result.time = apexes[first].time;
    result.hops = static_cast<int>(first) + 1;
    return result;
  }
  return result;
}

}  // namespace hoplab
