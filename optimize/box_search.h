#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hoplab {

/// A function to be made small within a box, without derivatives.
struct BoxSearchRequest {
  std::function<double(std::span<const double>)> cost;  // finite everywhere in the box
  std::vector<double> low, high;                        // low < high
  std::vector<double> start;  // empty: a random point; else there is no global search
  int budget = 1000;          // evaluations of `cost`
  std::uint64_t seed = 1;
  /// Share of the budget that polishes the best point of the global search.
  double polish_share = 0.4;
  const std::atomic<bool>* stop = nullptr;  // keeps the best so far
};

struct BoxSearchResult {
  std::vector<double> x;  // empty if stopped before the first evaluation
  double cost = 0.0;
  int evaluations = 0;
};

/// NLopt's controlled random search with local mutation (CRS2), then Sbplx from its best point, or
/// from `start`. The same request gives the same result.
BoxSearchResult SearchBox(const BoxSearchRequest& request);

}  // namespace hoplab
