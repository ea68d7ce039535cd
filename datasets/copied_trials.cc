#include "datasets/copied_trials.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

namespace hoplab {
namespace {

constexpr std::size_t kFewestAlike = 10;  // different samples of a channel that are no chance

bool AreSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// Whether equal samples of a channel are no chance: rest and contact have few values.
bool TellsOneFromAnother(const std::vector<double>& samples) {
  std::set<double> different;
  for (const double sample : samples) {
    if (std::isfinite(sample)) different.insert(sample);
    if (different.size() == kFewestAlike) return true;
  }
  return false;
}

bool Copies(const Dataset& dataset, const Trial& a, const Trial& b) {
  bool any = false;
  for (const ChannelSpec& channel : dataset.channels) {
    const std::vector<double>*of_a = a.trace.Find(channel.id), *of_b = b.trace.Find(channel.id);
    if (of_a == nullptr || of_b == nullptr) continue;
    if (!std::equal(of_a->begin(), of_a->end(), of_b->begin(), of_b->end(), AreSame)) return false;
    any = any || TellsOneFromAnother(*of_a);
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
