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

// Mean square of the held-out errors over the channels' noise.
double HeldOutSquare(const Discovery& d) {
  double sum = 0.0;
  for (std::size_t c = 0; c < d.after.test.rmse.size(); ++c) {
    const double ratio = d.after.test.rmse[c] / d.base.problem.channels[c].sigma;
    sum += ratio * ratio;
  }
  return sum;
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
  return HeldOutSquare(instead) < 1.05 * HeldOutSquare(beside) ? instead : beside;
}

}  // namespace hoplab
