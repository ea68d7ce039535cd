#include <mutex>

#include "base/parallel.h"
#include "experiments/identification/identification.h"

namespace hoplab {

FitUnits ThreadedFits::On(const UnitContext& context) const {
  return [&context, *this](const std::string& stage, const std::vector<StudyUnit>& units) {
    std::vector<StudyFit> fits(units.size());
    std::mutex mutex;
    int done = 0;
    ParallelFor(static_cast<int>(units.size()), jobs, [&](int i) {
      const auto at = static_cast<std::size_t>(i);
      fits[at] = FitUnit(context, units[at]);
      if (!progress) return;
      const std::lock_guard lock(mutex);
      progress(stage, ++done, static_cast<int>(units.size()));
    });
    return fits;
  };
}

}  // namespace hoplab
