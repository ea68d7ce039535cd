#include <cmath>

#include "fitting/diagnosis/null_fit.h"
#include "fitting/discovery/discover.h"

namespace hoplab {
namespace {

// The model a diagnosis ended with, its causes a part of it.
Diagnosis WithItsCauses(Diagnosis base, const DiagnosisOptions& options) {
  const std::vector<TrialProblem> train = TrialsOf(base.problem, TrialRole::kTrain);
  base.null = base.naming.best;
  base.plain = base.null;
  base.plain.problem.noise = {};
  RefitSettings settings = SettingsOf(options, train);
  settings.discrepancy = Discrepancy::kNone;
  Settle(base.plain, settings);
  base.null.members.clear();
  base.plain.members.clear();
  base.problem = base.null.problem;
  return base;
}

// Whether the held-out errors of `a`, each over its channel's noise, are less in the square than
// `share` of those of `b`. A channel that neither tells of does not count; where one of the two
// cannot be held against a channel, the other is the better.
bool ErrsLess(const Discovery& a, const Discovery& b, double share) {
  double of_a = 0.0, of_b = 0.0;
  for (std::size_t c = 0; c < a.after.test.rmse.size() && c < b.after.test.rmse.size(); ++c) {
    const double sigma = a.base.problem.channels[c].sigma;
    const double in_a = a.after.test.rmse[c] / sigma, in_b = b.after.test.rmse[c] / sigma;
    if (std::isfinite(in_a) != std::isfinite(in_b)) return std::isfinite(in_a);
    if (!std::isfinite(in_a)) continue;
    of_a += in_a * in_a;
    of_b += in_b * in_b;
  }
  return of_a < share * of_b;
}

}  // namespace

Discovery DiscoverBeside(const Diagnosis& diagnosis, const DiagnosisOptions& options) {
  if (!diagnosis.extension) return DiscoverFrom(diagnosis, options);
  Discovery beside = DiscoverFrom(WithItsCauses(diagnosis, options), options);
  if (!diagnosis.CausesMayStandIn() || beside.base.interrupted) return beside;
  Discovery instead = DiscoverFrom(diagnosis, options);
  instead.in_place_of_causes = true;
  const bool found = instead.verdict == DiscoveryVerdict::kFound;
  if (found != (beside.verdict == DiscoveryVerdict::kFound)) return found ? instead : beside;
  if (instead.after.test.rmse.empty() || beside.after.test.rmse.empty()) return beside;
  // A few in a hundred decide nothing: then the simpler model does.
  return ErrsLess(instead, beside, 1.05) ? instead : beside;
}

}  // namespace hoplab
