#include "datasets/scenario.h"

#include "base/input_error.h"

namespace hoplab {

const StateSpec& RequireInitial(const Scenario& scenario) {
  if (!scenario.initial)
    throw InputError({scenario.origin.place, "", "must have the key initial",
                      "Add initial: {x_m: 0, y_m: 0.3, vx_m_per_s: 1, vy_m_per_s: 0}."});
  return *scenario.initial;
}

}  // namespace hoplab
