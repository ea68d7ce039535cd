#include "datasets/copied_trials.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hoplab {
namespace {

constexpr std::ptrdiff_t kFewestAlike = 10;  // samples of a channel that are no chance

bool AreSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// Whether a channel of both has the same samples; a channel that stands still says nothing.
bool Copies(const std::vector<double>& a, const std::vector<double>& b) {
  const auto finite =
      std::count_if(a.begin(), a.end(), [](double value) { return std::isfinite(value); });
  const bool moves = std::any_of(
      a.begin(), a.end(), [&](double value) { return std::isfinite(value) && value != a.front(); });
  return finite >= kFewestAlike && moves &&
         std::equal(a.begin(), a.end(), b.begin(), b.end(), AreSame);
}

bool Copies(const Dataset& dataset, const Trial& a, const Trial& b) {
  bool any = false;
  for (const ChannelSpec& channel : dataset.channels) {
    const std::vector<double>*of_a = a.trace.Find(channel.id), *of_b = b.trace.Find(channel.id);
    if (of_a == nullptr || of_b == nullptr) continue;
    if (!std::equal(of_a->begin(), of_a->end(), of_b->begin(), of_b->end(), AreSame)) return false;
    any = any || Copies(*of_a, *of_b);
  }
  return any;
}

}  // namespace

std::vector<std::string> CopiedTrials(const Dataset& dataset) {
  std::vector<std::string> sentences;
  for (std::size_t i = 1; i < dataset.trials.size(); ++i) {
    const Trial& trial = dataset.trials[i];
    const auto end = dataset.trials.begin() + static_cast<std::ptrdiff_t>(i);
    const auto same = std::find_if(dataset.trials.begin(), end, [&](const Trial& before) {
      return Copies(dataset, before, trial);
    });
    if (same == end) continue;
    sentences.push_back(
        trial.origin.place + ": " + trial.file + " holds the samples of " + same->file + "; " +
        (same->role == trial.role ? "what is recorded once is counted twice"
                                  : "a held-out copy of what is fitted confirms nothing") +
        ". Leave one of them out");
  }
  return sentences;
}

}  // namespace hoplab
