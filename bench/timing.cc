#include "bench/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace hoplab::bench {
namespace {

// Mean wall time of one of `calls` calls [s].
double SecondsPerCall(const std::function<void()>& body, long calls) {
  const auto begin = std::chrono::steady_clock::now();
  for (long i = 0; i < calls; ++i) body();
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  return passed.count() / static_cast<double>(calls);
}

}  // namespace

double Timing::Min() const {
  if (seconds.empty()) return std::numeric_limits<double>::quiet_NaN();
  return *std::min_element(seconds.begin(), seconds.end());
}

double Timing::Median() const {
  if (seconds.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

int RoundRobin::Add(std::string name, std::function<void()> body) {
  const double once = SecondsPerCall(body, 1);
  const long calls = std::max(1L, std::lround(batch_s_ / std::max(once, 1e-7)));
  things_.push_back({std::move(name), std::move(body), calls, {}});
  return count() - 1;
}

void RoundRobin::Round() {
  for (Thing& thing : things_) {
    if (thing.calls > 1) thing.body();  // what ran before has the caches
    thing.timing.seconds.push_back(SecondsPerCall(thing.body, thing.calls));
  }
}

}  // namespace hoplab::bench
