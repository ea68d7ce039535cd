#pragma once

#include "experiments/identification/study_misfit.h"

namespace hoplab {

/// How the times of a table of initial states or moduli compare.
struct TimeScores {
  int converged = 0;
  int of = 0;  // cells that print a time
  /// Over those that converge [s]; NaN without any.
  double rms_s = std::numeric_limits<double>::quiet_NaN();
  double rank_correlation = std::numeric_limits<double>::quiet_NaN();  // Spearman
};

/// How well a hopper does on the printed tables.
struct StudyScores {
  double energy_rms = std::numeric_limits<double>::quiet_NaN();  // 6.5, points; NaN if a jump falls
  double energy_worst = std::numeric_limits<double>::quiet_NaN();  // largest difference
  /// Of the printed numbers, 6.3 and 6.4; NaN where a run has no steady hop.
  double stiffness_rms = std::numeric_limits<double>::quiet_NaN();
  double stiffness_worst = std::numeric_limits<double>::quiet_NaN();
  /// 6.1 to 6.4, in their order.
  std::array<TimeScores, 4> times;
  double modulus_trend;    // Kendall's tau of time against E in 6.4
  double convergence_rms;  // s, 6.2 and 6.4 together, over those that converge
};
StudyScores ScoresOf(const StudyRuns& runs, const StudyData& data,
                     const ConvergenceReading& reading);

}  // namespace hoplab
