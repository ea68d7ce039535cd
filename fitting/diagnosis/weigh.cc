#include "fitting/diagnosis/weigh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hoplab {
namespace {

// Weights below this share of the best are not told.
constexpr double kLeastWeight = 1e-4;

// Nats that the best model without any of the group lies behind.
double GapOf(const CandidateSet& set, const std::vector<int>& group, const Refits& refits,
             const Naming& naming) {
  double gap = std::numeric_limits<double>::infinity();
  for (const auto& [other, worth] : refits.Visited()) {
    const bool has = std::any_of(other.begin(), other.end(), [&](int i) {
      return std::any_of(group.begin(), group.end(), [&](int g) {
        return naming.candidates[i].candidate.effect == naming.candidates[g].candidate.effect;
      });
    });
    if (!has) gap = std::min(gap, refits.Worth(set) - worth);
  }
  return gap;
}

}  // namespace

void FindGroups(const CandidateSet& set, const Refits& refits, Naming& naming) {
  constexpr double kHeld = 0.95, kMostNatsBehind = 20.0;
  for (const int member : set) {
    CandidateSet less = set;
    less.erase(std::find(less.begin(), less.end(), member));
    std::vector<std::pair<double, int>> place = {{refits.Worth(set), member}};
    for (int i = 0; i < static_cast<int>(naming.candidates.size()); ++i) {
      if (std::find(set.begin(), set.end(), i) != set.end()) continue;
      const CandidateSet swapped = With(less, i);
      if (refits.Settled(swapped)) place.emplace_back(refits.Worth(swapped), i);
    }
    std::stable_sort(place.begin() + 1, place.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    double whole = 0.0, held = 0.0;
    for (const auto& [worth, i] : place) whole += std::exp(worth - refits.Worth(set));
    std::vector<int> group;
    std::vector<double> weights;
    std::vector<FittedModel> rivals;
    std::vector<WiderGroup> wider;
    std::vector<int> with_next;
    double held_with_next = 0.0;
    for (const auto& [worth, i] : place) {
      if (worth < refits.Worth(set) - kMostNatsBehind) break;
      with_next.push_back(i);
      held_with_next += std::exp(worth - refits.Worth(set));
      if (held >= kHeld * whole) {
        wider.push_back({held / held_with_next, GapOf(set, with_next, refits, naming),
                         static_cast<double>(with_next.size() - 1)});
        continue;
      }
      group.push_back(i);
      weights.push_back(std::exp(worth - refits.Worth(set)));
      rivals.push_back(refits.At(With(less, i)));
      held += weights.back();
    }
    for (double& w : weights) w /= held;
    naming.wider.push_back(std::move(wider));
    naming.gaps.push_back(GapOf(set, group, refits, naming));
    naming.groups.push_back(std::move(group));
    naming.rivals.push_back(std::move(rivals));
    naming.group_weights.push_back(std::move(weights));
  }
}

void Weigh(const Refits& refits, Naming& naming) {
  std::vector<std::pair<CandidateSet, double>> visited = refits.Visited();
  std::stable_sort(visited.begin(), visited.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  const double best = visited.front().second;
  double sum = 0.0;
  for (auto& [set, worth] : visited) sum += worth = std::exp(worth - best);
  for (auto& [set, weight] : visited) {
    const double share = weight / sum;
    for (const int i : set) naming.candidates[static_cast<std::size_t>(i)].probability += share;
    naming.unlisted_probability += share * refits.At(set).evidence.discrepancy_probability();
    if (weight >= kLeastWeight) naming.posterior.emplace_back(set, share);
  }
}

}  // namespace hoplab
