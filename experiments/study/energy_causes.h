#pragma once

#include "experiments/study/hopping_run.h"

namespace hoplab {

/// Where the energy comes from that the law `thesis` gains in an undamped, undriven jump at one
/// touch-down angle: percent of the energy left, from `thesis` (M5-M7) over each of the two changes
/// alone to both, which is `consistent`. NaN where a jump does not reach its next apex. All but
/// `study` have a massless leg.
struct EnergyCauses {
  double study;         // the study's own reading of its law
  double thesis;        // M7, tip not rotating
  double with_rolling;  // contact by the arc laid down (M8) alone
  double with_tip;      // tip rotates (M10), and what hangs on it, alone
  double with_both;
  double consistent;  // the law of that name: M9 to M12, compliance as in `thesis`
  /// Percentage points that each change removes, the mean over the two orders of making them; their
  /// sum is thesis - with_both.
  double removed_by_rolling, removed_by_tip;
  /// What integrating a hundred times as finely does to `thesis` [percentage points].
  double integration_error;
};
EnergyCauses EnergyCausesAt(const Study& study, double touchdown_angle_rad);

}  // namespace hoplab
