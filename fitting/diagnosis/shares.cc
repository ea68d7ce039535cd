#include "fitting/diagnosis/shares.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace hoplab {

double ErrorGrowsBy(const std::vector<double>& without, const std::vector<double>& with) {
  double most = 0.0;
  for (std::size_t c = 0; c < std::min(without.size(), with.size()); ++c)
    most = std::max(most, without[c] / with[c]);
  return most;
}

bool IsMainCause(double share, double error_grows, const HeldOutGain& gain, double material) {
  // What an engineer would see; and what he needs no interval for, where the noise of a model that
  // lacks the cause is so large that likelihoods tell little.
  constexpr double kSeen = 1.1, kPlain = 1.25;
  const bool measured = gain.ci95.has_value(), explains = share >= material;
  const bool confirmed = !measured || gain.IsClaim() || (explains && error_grows > kPlain);
  return (explains || error_grows > kSeen) && confirmed;
}

bool Differs(const Heterogeneity& sizes) {
  constexpr double kCertain = 0.01;
  return sizes.spread > 0.0 && sizes.p_value < kCertain;
}

bool CauseReport::Varies() const { return std::any_of(sizes.begin(), sizes.end(), Differs); }

std::vector<CauseReport> TakeApart(const Naming& naming, const SharesRequest& request,
                                   const RefitSettings& settings) {
  const FittedModel& best = naming.best;
  const double fall = request.plain_square - request.extended_square;
  std::vector<CauseReport> causes(best.members.size());
  ParallelFor(static_cast<int>(causes.size()), settings.jobs, [&](int i) {
    CauseReport& cause = causes[static_cast<std::size_t>(i)];
    cause.candidate = naming.best_set[static_cast<std::size_t>(i)];
    cause.cause = best.members[static_cast<std::size_t>(i)];
    cause.evidence_probability =
        naming.candidates[static_cast<std::size_t>(cause.candidate)].probability;
    cause.rmse_without.assign(best.problem.channels.size(),
                              std::numeric_limits<double>::quiet_NaN());
    const FittedModel& without = naming.without[static_cast<std::size_t>(i)];
    if (!without.ok()) {
      cause.share = 1.0;  // nothing could be simulated without it
      cause.main = true;
      return;
    }
    // Without it no more is missed than by the plain model, which is one of the models without it;
    // a refit that ends above has ended in the wrong place.
    const double missed = std::min(2.0 * without.cost, request.plain_square);
    cause.share = fall > 0.0 ? (missed - request.extended_square) / fall : 0.0;
    const HeldOutErrors errors =
        MeasureHeldOut(without, settings.jobs, /*test_only=*/true, request.after);
    if (!errors.test.rmse.empty()) cause.rmse_without = errors.test.rmse;
    cause.gain = CompareHeldOut(without, errors, *request.after, request.seed, nullptr);
    // What acts in several trials alone is confirmed by each of them; a held-out one sees no more
    // of it than the values that all trials share, and may have it, too.
    cause.main =
        (cause.cause.only_recordings.size() > 1 && cause.share >= request.material) ||
        IsMainCause(cause.share, ErrorGrowsBy(cause.rmse_without, request.after->test.rmse),
                    cause.gain, request.material);
  });
  std::stable_sort(causes.begin(), causes.end(),
                   [](const CauseReport& a, const CauseReport& b) { return a.share > b.share; });
  return causes;
}

}  // namespace hoplab
