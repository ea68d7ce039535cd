#include "experiments/identification/study_misfit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/study/agreement.h"

namespace hoplab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kRunTime = 15.0;  // s, of a controlled run

double Square(double x) { return x * x; }

// The rows whose stiffness ranges stand for all: per damping, the one with the greatest E.
std::vector<ModulusRow> StandingForAll(const std::vector<ModulusRow>& rows) {
  std::vector<ModulusRow> chosen;
  for (const ModulusRow& row : rows) {
    const bool is_greatest = std::none_of(rows.begin(), rows.end(), [&](const ModulusRow& other) {
      return other.damping_N_s_per_m == row.damping_N_s_per_m && !std::isnan(other.k_min_N_per_m) &&
             other.modulus_Pa > row.modulus_Pa;
    });
    if (is_greatest && !std::isnan(row.k_min_N_per_m)) chosen.push_back(row);
  }
  return chosen;
}

ControlledSettings SettingsOf(const ModulusRow& row) {
  return {.modulus_Pa = row.modulus_Pa, .damping_N_s_per_m = row.damping_N_s_per_m};
}
ControlledSettings SettingsOf(const StartCell& cell) {
  return {.damping_N_s_per_m = cell.damping_N_s_per_m,
          .speed_m_per_s = cell.speed_m_per_s,
          .height_m = cell.height_m,
          .with_stiffness = false};
}

double StiffnessMisfit(const ControlledRun& run, const ModulusRow& row) {
  // Off by a factor of e, and further the earlier the run ends: a slope towards runs that last.
  if (std::isnan(run.k_min_N_per_m))
    return Square(1.0 / kStiffnessUnit) * (2.0 - run.end_time_s / kRunTime);
  const double worst = Square(1.0 / kStiffnessUnit);
  const auto square = [&](double ours, double printed) {
    return std::min(Square(std::log(ours / printed) / kStiffnessUnit), worst);
  };
  return 0.5 * (square(run.k_min_N_per_m, row.k_min_N_per_m) +
                square(run.k_max_N_per_m, row.k_max_N_per_m));
}

double ConvergenceMisfit(const ControlledRun& run, double printed) {
  constexpr double kMissing = 8.0;  // s
  const double off = run.convergence.converged() ? run.convergence.time - printed : kMissing;
  return Square(std::min(std::abs(off), kMissing) / kConvergenceUnit);
}

double RootMeanSquare(const std::vector<double>& values) {
  if (values.empty()) return kNaN;
  double sum = 0.0;
  for (double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double Worst(const std::vector<double>& values) {
  if (values.empty()) return kNaN;
  double worst = 0.0;
  for (double v : values) worst = std::isnan(v) ? v : std::max(worst, std::abs(v));
  return worst;
}

bool IsTimed(const ModulusRow& row) {
  return row.damping_N_s_per_m > 0.0 && !std::isnan(row.convergence_time_s);
}

}  // namespace

StudyPredictions PredictionsOf(const StudyHopper& hopper, const StudyData& data,
                               const StudyTables& tables) {
  StudyPredictions out;
  if (tables.energy) {
    for (const EnergyCell& cell : data.energy)
      out.energy.push_back(EnergyPercent(hopper, cell).value_or(kNaN));
  }
  if (tables.stiffness || tables.convergence) {
    for (const ModulusRow& row : data.modulus)
      out.modulus.push_back(RunControlled(hopper, SettingsOf(row)));
  }
  if (tables.convergence) {
    for (const StartCell& cell : data.starts)
      out.starts.push_back(RunControlled(hopper, SettingsOf(cell)));
  }
  return out;
}

StudyScores ScoresOf(const StudyHopper& hopper, const StudyData& data) {
  const StudyPredictions ours = PredictionsOf(hopper, data, {true, true, true});
  StudyScores s{};
  std::vector<double> energy, stiffness, times_off;
  for (std::size_t i = 0; i < data.energy.size(); ++i)
    energy.push_back(ours.energy[i] - data.energy[i].percent);
  s.energy_rms = RootMeanSquare(energy);
  s.energy_worst = Worst(energy);
  std::vector<double> moduli, modulus_times;
  for (std::size_t i = 0; i < data.modulus.size(); ++i) {
    const ModulusRow& row = data.modulus[i];
    const ControlledRun& run = ours.modulus[i];
    if (!std::isnan(row.k_min_N_per_m)) {
      stiffness.push_back(run.k_min_N_per_m / row.k_min_N_per_m - 1.0);
      stiffness.push_back(run.k_max_N_per_m / row.k_max_N_per_m - 1.0);
    }
    if (!IsTimed(row)) continue;
    moduli.push_back(row.modulus_Pa);
    modulus_times.push_back(run.convergence.time);
    if (!run.convergence.converged()) continue;
    ++s.converged_moduli;
    times_off.push_back(run.convergence.time - row.convergence_time_s);
  }
  s.stiffness_rms = RootMeanSquare(stiffness);
  s.stiffness_worst = Worst(stiffness);
  s.modulus_trend = TrendOf(moduli, modulus_times).tau;
  std::vector<double> printed, found;
  for (std::size_t i = 0; i < data.starts.size(); ++i) {
    const ConvergenceTime& time = ours.starts[i].convergence;
    printed.push_back(data.starts[i].convergence_time_s);
    found.push_back(time.time);
    if (!time.converged()) continue;
    ++s.converged_starts;
    times_off.push_back(time.time - data.starts[i].convergence_time_s);
  }
  s.start_rank_correlation = RankCorrelation(printed, found);
  s.convergence_rms = RootMeanSquare(times_off);
  return s;
}

double MisfitOf(const StudyHopper& hopper, const StudyData& data, const StudyTables& tables) {
  constexpr double kFallen = 10.0;  // percentage points
  double misfit = 0.0;
  if (tables.energy && !data.energy.empty()) {
    double sum = 0.0;
    for (const EnergyCell& cell : data.energy) {
      const std::optional<double> percent = EnergyPercent(hopper, cell);
      const double off = percent ? std::abs(*percent - cell.percent) : kFallen;
      sum += Square(std::min(off, kFallen) / kEnergyUnit);
    }
    misfit += sum / static_cast<double>(data.energy.size());
  }
  if (tables.stiffness) {
    const std::vector<ModulusRow> rows = StandingForAll(data.modulus);
    for (const ModulusRow& row : rows)
      misfit += StiffnessMisfit(RunControlled(hopper, SettingsOf(row)), row) /
                static_cast<double>(rows.size());
  }
  if (tables.convergence) {
    double sum = 0.0, count = 0.0;
    for (const StartCell& cell : data.starts) {
      sum += ConvergenceMisfit(RunControlled(hopper, SettingsOf(cell)), cell.convergence_time_s);
      count += 1.0;
    }
    for (const ModulusRow& row : data.modulus) {
      if (!IsTimed(row)) continue;
      ControlledSettings settings = SettingsOf(row);
      settings.with_stiffness = false;
      sum += ConvergenceMisfit(RunControlled(hopper, settings), row.convergence_time_s);
      count += 1.0;
    }
    if (count > 0.0) misfit += sum / count;
  }
  return misfit;
}

int ResidualCount(const StudyData& data, const StudyTables& tables) {
  std::size_t count = tables.energy ? data.energy.size() : 0;
  if (tables.stiffness) count += 2 * StandingForAll(data.modulus).size();
  return static_cast<int>(count);
}

bool ResidualsOf(const StudyHopper& hopper, const StudyData& data, const StudyTables& tables,
                 const std::vector<StudyConstant>& free, Eigen::VectorXd& residuals,
                 Eigen::MatrixXd* jacobian) {
  Eigen::Index row = 0;
  if (tables.energy) {
    const double scale = 1.0 / (kEnergyUnit * std::sqrt(static_cast<double>(data.energy.size())));
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
  }
  if (!tables.stiffness) return true;
  constexpr double kStep = 1e-4;  // of the logarithm
  const std::vector<ModulusRow> rows = StandingForAll(data.modulus);
  const double scale = 1.0 / (kStiffnessUnit * std::sqrt(2.0 * static_cast<double>(rows.size())));
  for (const ModulusRow& printed : rows) {
    const auto logs = [&](const StudyHopper& at) {
      const ControlledRun run = RunControlled(at, SettingsOf(printed));
      return Eigen::Vector2d(scale * std::log(run.k_min_N_per_m / printed.k_min_N_per_m),
                             scale * std::log(run.k_max_N_per_m / printed.k_max_N_per_m));
    };
    residuals.segment<2>(row) = logs(hopper);
    for (std::size_t i = 0; jacobian && i < free.size(); ++i) {
      StudyHopper above = hopper, below = hopper;
      At(above.constants, free[i]) *= std::exp(kStep);
      At(below.constants, free[i]) *= std::exp(-kStep);
      const Eigen::Vector2d slope = (logs(above) - logs(below)) / (2.0 * kStep);
      // Beside a point where a run fails the range has no slope that a step could follow.
      jacobian->block<2, 1>(row, static_cast<Eigen::Index>(i)) =
          slope.allFinite() ? slope : Eigen::Vector2d(0.0, 0.0);
    }
    row += 2;
  }
  return residuals.allFinite();
}

}  // namespace hoplab
