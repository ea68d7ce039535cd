#include "experiments/identification/study_residuals.h"

#include <cmath>

#include "experiments/identification/energy_jump.h"
#include "experiments/identification/study_misfit.h"
#include "experiments/identification/study_runs.h"

namespace hoplab {
namespace {

bool EnergyResiduals(const StudyHopper& hopper, const StudyData& data,
                     const std::vector<StudyConstant>& free, Eigen::VectorXd& residuals,
                     Eigen::MatrixXd* jacobian) {
  const double scale = 1.0 / (kEnergyUnit * std::sqrt(static_cast<double>(data.energy.size())));
  Eigen::Index row = 0;
  for (const EnergyCell& cell : data.energy) {
    StudySlopes slopes;
    const auto percent = EnergyPercent(hopper, cell, jacobian ? &slopes : nullptr);
    if (!percent) return false;
    residuals[row] = scale * (*percent - cell.percent);
    for (std::size_t i = 0; jacobian && i < free.size(); ++i)
      (*jacobian)(row, static_cast<Eigen::Index>(i)) =
          scale * slopes[static_cast<std::size_t>(free[i])];
    ++row;
  }
  return true;
}

// Logarithms of the two ends of a row's range over the printed ones, in units.
Eigen::Vector2d RangeResiduals(const StudyHopper& hopper, const ModulusRow& printed) {
  const ControlledRun run = RunControlled(hopper, SettingsOf(printed), {.stiffness = true});
  return Eigen::Vector2d(std::log(run.k_min_N_per_m / printed.k_min_N_per_m),
                         std::log(run.k_max_N_per_m / printed.k_max_N_per_m)) /
         kStiffnessUnit;
}

}  // namespace

int ResidualCount(const StudyData& data, bool stiffness) {
  std::size_t count = data.energy.size();
  if (stiffness) count += 2 * RowsForRanges(data.modulus).size();
  return static_cast<int>(count);
}

bool ResidualsOf(const StudyHopper& hopper, const StudyData& data, bool stiffness,
                 const std::vector<StudyConstant>& free, Eigen::VectorXd& residuals,
                 Eigen::MatrixXd* jacobian) {
  if (!EnergyResiduals(hopper, data, free, residuals, jacobian)) return false;
  if (!stiffness) return true;
  constexpr double kStep = 1e-4;  // of the logarithm
  const std::vector<ModulusRow> rows = RowsForRanges(data.modulus);
  const double scale = 1.0 / std::sqrt(2.0 * static_cast<double>(rows.size()));
  auto row = static_cast<Eigen::Index>(data.energy.size());
  for (const ModulusRow& printed : rows) {
    residuals.segment<2>(row) = scale * RangeResiduals(hopper, printed);
    for (std::size_t i = 0; jacobian && i < free.size(); ++i) {
      StudyHopper above = hopper, below = hopper;
      At(above.constants, free[i]) *= std::exp(kStep);
      At(below.constants, free[i]) *= std::exp(-kStep);
      const Eigen::Vector2d slope =
          scale * (RangeResiduals(above, printed) - RangeResiduals(below, printed)) / (2.0 * kStep);
      // Beside a point where a run fails the range has no slope that a step could follow.
      jacobian->block<2, 1>(row, static_cast<Eigen::Index>(i)) =
          slope.allFinite() ? slope : Eigen::Vector2d(0.0, 0.0);
    }
    row += 2;
  }
  return residuals.allFinite();
}

}  // namespace hoplab
