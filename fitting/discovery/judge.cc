#include "fitting/discovery/judge.h"

#include <cmath>

#include "base/text.h"

namespace hoplab {

std::string_view NameOf(DiscoveryVerdict verdict) {
  switch (verdict) {
    case DiscoveryVerdict::kFound:
      return "found";
    case DiscoveryVerdict::kNothingStable:
      return "nothing_stable";
    case DiscoveryVerdict::kNotNeeded:
      return "not_needed";
  }
  return "";
}

void Judge(Discovery& out) {
  out.verdict = DiscoveryVerdict::kNothingStable;
  if (out.found.empty()) {
    out.reason = "something is missing, and no formula of the library pays for itself";
    return;
  }
  const FoundTerm& first = out.found.front();
  if (first.selected_in && *first.selected_in < kStable) {
    out.reason = "the best formula is picked in " +
                 FormatDouble(std::round(100.0 * *first.selected_in)) +
                 " % of the resamples of the trials only";
    return;
  }
  if (out.gain.ci95 && out.gain.ci95->second < 0.0) {
    out.reason = "the best formula makes held-out trials worse";
    return;
  }
  if (!first.selected_in && !out.gain.IsClaim()) {
    out.reason =
        "with one fitted trial, and held-out ones that do not confirm it, nothing says whether "
        "another would show the same";
    return;
  }
  out.verdict = DiscoveryVerdict::kFound;
  out.reason = first.selected_in
                   ? "picked in " + FormatDouble(std::round(100.0 * *first.selected_in)) +
                         " % of the resamples of the trials"
                   : "of one fitted trial, and held-out trials confirm it";
}

}  // namespace hoplab
