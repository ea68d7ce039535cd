#include "experiments/identification/fit_ranking.h"

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

using Fits = std::vector<StudyFit>;

template <class Same>
Fits BestThatDiffer(const Fits& fits, int count, const Same& same) {
  Fits best;
  for (const StudyFit& fit : fits) {
    const bool is_known = std::any_of(best.begin(), best.end(), [&](const StudyFit& other) {
      return same(other.reading, fit.reading);
    });
    if (!is_known && std::ssize(best) < count && !std::isnan(fit.misfit)) best.push_back(fit);
  }
  return best;
}

}  // namespace

void SortByMisfit(Fits& fits) {
  std::stable_sort(fits.begin(), fits.end(), [](const StudyFit& a, const StudyFit& b) {
    return std::isnan(b.misfit) ? !std::isnan(a.misfit) : a.misfit < b.misfit;
  });
}

Fits Best(const Fits& fits, int count) {
  const auto kept = std::min(std::ssize(fits), static_cast<std::ptrdiff_t>(count));
  return {fits.begin(), fits.begin() + kept};
}

Fits BestReadings(const Fits& fits, int count) {
  return BestThatDiffer(fits, count,
                        [](const StudyReading& a, const StudyReading& b) { return a == b; });
}

Fits BestLaws(const Fits& fits, int count) {
  return BestThatDiffer(
      fits, count, [](const StudyReading& a, const StudyReading& b) { return a.law == b.law; });
}

}  // namespace hoplab
