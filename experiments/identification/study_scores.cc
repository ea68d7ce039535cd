#include "experiments/identification/study_scores.h"

#include <algorithm>
#include <cmath>

#include "experiments/study/agreement.h"

namespace hoplab {
namespace {

double RootMeanSquare(const std::vector<double>& values) {
  if (values.empty()) return std::nan("");
  double sum = 0.0;
  for (double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double Worst(const std::vector<double>& values) {
  if (values.empty()) return std::nan("");
  double worst = 0.0;
  for (double v : values) worst = std::isnan(v) ? v : std::max(worst, std::abs(v));
  return worst;
}

// The times of one table as columns.
struct TimeColumns {
  std::vector<double> printed, ours;

  void Add(double print, const ConvergenceTime& time) {
    if (std::isnan(print)) return;
    printed.push_back(print);
    ours.push_back(time.time);
  }
  std::vector<double> Differences() const {
    std::vector<double> differences;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      if (!std::isnan(ours[i])) differences.push_back(ours[i] - printed[i]);
    }
    return differences;
  }
  TimeScores Scores() const {
    const std::vector<double> differences = Differences();
    return {static_cast<int>(differences.size()), static_cast<int>(ours.size()),
            RootMeanSquare(differences), RankCorrelation(printed, ours)};
  }
};

void ScoreEnergy(const StudyRuns& runs, const StudyData& data, StudyScores& s) {
  std::vector<double> off;
  for (std::size_t i = 0; i < data.energy.size(); ++i)
    off.push_back(runs.energy[i] - data.energy[i].percent);
  s.energy_rms = RootMeanSquare(off);
  s.energy_worst = Worst(off);
}

void ScoreStiffness(const StudyRuns& runs, const StudyData& data, StudyScores& s) {
  std::vector<double> off;
  for (std::size_t i = 0; i < data.modulus.size(); ++i) {
    const ModulusRow& row = data.modulus[i];
    if (std::isnan(row.k_min_N_per_m)) continue;
    off.push_back(runs.modulus[i].k_min_N_per_m / row.k_min_N_per_m - 1.0);
    off.push_back(runs.modulus[i].k_max_N_per_m / row.k_max_N_per_m - 1.0);
  }
  s.stiffness_rms = RootMeanSquare(off);
  s.stiffness_worst = Worst(off);
}

}  // namespace

StudyScores ScoresOf(const StudyRuns& runs, const StudyData& data,
                     const ConvergenceReading& reading) {
  StudyScores s;
  ScoreEnergy(runs, data, s);
  ScoreStiffness(runs, data, s);
  std::array<TimeColumns, 4> columns;
  std::vector<double> moduli, modulus_times;
  for (std::size_t i = 0; i < data.modulus.size(); ++i) {
    const ModulusRow& row = data.modulus[i];
    const ConvergenceTime time = runs.modulus[i].TimeBy(reading);
    columns[static_cast<std::size_t>(TableOf(row))].Add(row.convergence_time_s, time);
    if (TableOf(row) != StudyTableId::k64) continue;
    moduli.push_back(row.modulus_Pa);
    modulus_times.push_back(time.time);
  }
  for (std::size_t i = 0; i < data.initial_states.size(); ++i)
    columns[static_cast<std::size_t>(TableOf(data.initial_states[i]))].Add(
        data.initial_states[i].convergence_time_s, runs.initial_states[i].TimeBy(reading));
  for (std::size_t i = 0; i < columns.size(); ++i) s.times[i] = columns[i].Scores();
  s.modulus_trend = TrendOf(moduli, modulus_times).tau;
  std::vector<double> damped = columns[static_cast<std::size_t>(StudyTableId::k62)].Differences();
  const auto more = columns[static_cast<std::size_t>(StudyTableId::k64)].Differences();
  damped.insert(damped.end(), more.begin(), more.end());
  s.convergence_rms = RootMeanSquare(damped);
  return s;
}

}  // namespace hoplab
