#pragma once

#include <string_view>
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
  std::vector<StartCell> initial_states;
};

/// The tables: 6.1 (initial states, undamped), 6.2 (damped), 6.3 (moduli, undamped), 6.4
/// (damped), 6.5.
enum class StudyTableId { k61, k62, k63, k64, k65 };
inline constexpr int kStudyTableCount = 5;
/// "6.1" to "6.5".
std::string_view NameOf(StudyTableId table);

StudyTableId TableOf(const StartCell& cell);
StudyTableId TableOf(const ModulusRow& row);

/// The numbers of `experiments/published`.
StudyData PublishedStudyData();

/// The cells of some tables alone.
StudyData OnlyTables(const StudyData& data, const std::vector<StudyTableId>& tables);

/// Rows of `modulus` whose stiffness ranges stand for all, which grow with E: of each damping the
/// one with the greatest E that has a range.
std::vector<ModulusRow> RowsForRanges(const std::vector<ModulusRow>& rows);

}  // namespace hoplab
