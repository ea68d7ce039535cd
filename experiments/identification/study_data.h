#pragma once

#include <vector>

namespace hoplab {

/// Table 6.5 of the published study: energy left after one undriven jump.
struct EnergyCell {
  double touchdown_angle_rad = 0.0, damping_N_s_per_m = 0.0;
  double percent = 0.0;  // of the energy before
};

/// Tables 6.3 and 6.4: controlled hopping with one modulus. NaN where nothing is printed.
struct ModulusRow {
  double modulus_Pa = 0.0, damping_N_s_per_m = 0.0;
  double convergence_time_s = 0.0;
  double k_min_N_per_m = 0.0, k_max_N_per_m = 0.0;  // chord stiffness of the steady hop
};

/// Tables 6.1 and 6.2: controlled hopping from one start.
struct StartCell {
  double speed_m_per_s = 0.0, height_m = 0.0, damping_N_s_per_m = 0.0;
  double convergence_time_s = 0.0;
};

/// What constants and reading of the study are identified from.
struct StudyData {
  std::vector<EnergyCell> energy;
  std::vector<ModulusRow> modulus;
  std::vector<StartCell> starts;
};

/// The numbers of `experiments/published`: tables 6.5, 6.3, 6.4 and, of the two grids of starts,
/// the damped one, 6.2 (undamped, convergence takes as long as the runs and has no pattern).
StudyData PublishedStudyData();

}  // namespace hoplab
