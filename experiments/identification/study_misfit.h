#pragma once

#include <Eigen/Core>

#include "experiments/identification/study_model.h"

namespace hoplab {

/// Which tables a misfit is made of.
struct StudyTables {
  bool energy = true;        // 6.5
  bool stiffness = false;    // ranges of 6.3 and 6.4
  bool convergence = false;  // times of 6.2 and 6.4
};

/// Sizes a difference from the print is measured in.
inline constexpr double kEnergyUnit = 0.1;       // percentage points
inline constexpr double kStiffnessUnit = 0.015;  // of the printed number
inline constexpr double kConvergenceUnit = 0.8;  // s, two hops

/// How well a hopper does on the printed tables.
struct StudyScores {
  double energy_rms;              // 6.5, percentage points; NaN if a jump falls
  double energy_worst;            // largest difference
  double stiffness_rms;           // 6.3 and 6.4, of the printed numbers; NaN if none compares
  double stiffness_worst;         // NaN where a run has no steady hop
  int converged_starts = 0;       // of 6.2
  double start_rank_correlation;  // Spearman, 6.2; NaN where fewer than three converge
  int converged_moduli = 0;       // of 6.4
  double modulus_trend;           // Kendall's tau of time against E in 6.4
  double convergence_rms;         // s, 6.2 and 6.4 together, over those that converge
};
StudyScores ScoresOf(const StudyHopper& hopper, const StudyData& data);

/// Every number of the tables with ours beside it, in the order of `data`. NaN where there is none.
struct StudyPredictions {
  std::vector<double> energy;
  std::vector<ControlledRun> modulus;
  std::vector<ControlledRun> starts;
};
StudyPredictions PredictionsOf(const StudyHopper& hopper, const StudyData& data,
                               const StudyTables& tables);

/// The mean squares of the differences in the units above, summed over the tables: finite
/// everywhere. A jump that falls counts as 10 points off, a run that ends early as stiffness off by
/// a factor of e and the more the earlier it ends, a run without convergence as 8 s off. Of
/// `data.modulus` the rows with the greatest modulus stand for all stiffness ranges, which grow
/// with it.
double MisfitOf(const StudyHopper& hopper, const StudyData& data, const StudyTables& tables);

/// Residuals whose sum of squares is the smooth part of that misfit, table 6.5 and stiffness, for a
/// least-squares solver: energy with slopes from the sensitivities, stiffness by differences.
/// Columns belong to the logarithms of the constants in `free`. False where a run fails.
int ResidualCount(const StudyData& data, const StudyTables& tables);
bool ResidualsOf(const StudyHopper& hopper, const StudyData& data, const StudyTables& tables,
                 const std::vector<StudyConstant>& free, Eigen::VectorXd& residuals,
                 Eigen::MatrixXd* jacobian);

}  // namespace hoplab
