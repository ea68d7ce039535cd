#include "fitting/diagnosis/movements.h"

#include <optional>
#include <utility>

namespace hoplab {

std::vector<Movement> MovementsOf(const FittedModel& null, const Uncertainty& uncertainty,
                                  const FittedModel& best) {
  std::vector<Movement> movements;
  for (int k = 0; k < null.problem.shared_count(); ++k) {
    const SharedParameter& s = null.problem.shared[static_cast<std::size_t>(k)];
    Movement m{s.name, s.unit, null.shared[k], best.shared[k], std::nullopt};
    const auto& error = uncertainty.parameters[static_cast<std::size_t>(k)].std_error;
    if (error && *error > 0.0) m.std_errors = (m.after - m.before) / *error;
    movements.push_back(std::move(m));
  }
  return movements;
}

}  // namespace hoplab
