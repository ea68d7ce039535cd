#include "fitting/diagnosis/separate.h"

#include <algorithm>

#include "fitting/design/design_search.h"
#include "fitting/diagnosis/name.h"

namespace hoplab {
namespace {

// A few settings, and a diagnosis is waiting: `hoplab design` looks longer.
constexpr int kDesigns = 80;
constexpr int kRefittedDesigns = 4;
// The time of a search grows with the square of their number.
constexpr std::size_t kMostRivals = 4;

}  // namespace

bool SeparatingExperiment::Separates() const { return expected_nats >= kIndistinguishable; }

std::optional<SeparatingExperiment> ProposeExperiment(std::span<const FittedModel> rivals,
                                                      const std::vector<TrialProblem>& train,
                                                      int jobs) {
  if (rivals.size() < 2 || train.empty()) return std::nullopt;
  rivals = rivals.first(std::min(rivals.size(), kMostRivals));
  DesignSearchRequest request;
  request.space = PlainSpace(rivals[0].problem, train);
  request.budget = kDesigns;
  request.settled = kRefittedDesigns;
  request.distinct = 1;
  request.jobs = jobs;
  const std::vector<double> alike(rivals.size(), 1.0 / static_cast<double>(rivals.size()));
  const DesignSearchResult found = SearchSeparating(rivals, alike, train, request);
  if (found.best.empty()) return std::nullopt;
  const DesignTried& best = found.best.front();
  SeparatingExperiment out;
  out.design = best.design;
  out.expected_nats = best.least_nats;
  out.closest_rival = best.closest_rival;
  out.designs_tried = static_cast<int>(found.tried.size());
  return out;
}

}  // namespace hoplab
