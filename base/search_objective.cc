#include "base/search_objective.h"

#include <cstddef>

namespace hoplab {

std::string_view NameOf(SearchObjective objective) {
  static constexpr std::array<std::string_view, kSearchObjectives.size()> kNames = {
      "convergence_time",  "spectral_radius", "weighted", "speed",
      "cost_of_transport", "peak_torque"};
  return kNames[static_cast<std::size_t>(objective)];
}

}  // namespace hoplab
