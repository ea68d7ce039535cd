#include "experiments/identification/study_misfit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace hoplab {
namespace {

constexpr double kFallen = 10.0;  // percentage points
// s: what a run without convergence is off by, and the most that one with it is.
constexpr double kMissingDamped = 6.0, kMissingUndamped = 12.0;

double Square(double x) { return x * x; }
std::size_t Index(StudyPart part) { return static_cast<std::size_t>(part); }
bool IsDamped(StudyTableId table) {
  return table == StudyTableId::k62 || table == StudyTableId::k64;
}

// Differences in units, clamped; from these squares and residuals are made.
double EnergyDifference(double printed, double ours) {
  if (std::isnan(ours)) return kFallen / kEnergyUnit;
  return std::clamp(ours - printed, -kFallen, kFallen) / kEnergyUnit;
}

// From 1, for a run that lasts, to 2: how much what is missing counts.
double Earliness(const ControlledRun& run) {
  return IsComplete(run.outcome) ? 1.0 : 2.0 - run.end_time_s / kControlledTime;
}

double StiffnessDifference(const ControlledRun& run, double printed, double ours) {
  constexpr double kWorst = 1.0;  // a factor of e
  if (std::isnan(ours)) return kWorst / kStiffnessUnit * std::sqrt(Earliness(run));
  return std::clamp(std::log(ours / printed), -kWorst, kWorst) / kStiffnessUnit;
}

double TimeDifference(const ControlledRun& run, StudyTableId table, double printed,
                      const ConvergenceTime& ours) {
  const double missing = IsDamped(table) ? kMissingDamped : kMissingUndamped;
  const double unit = IsDamped(table) ? kDampedTimeUnit : kUndampedTimeUnit;
  if (!ours.converged()) return missing / unit * std::sqrt(Earliness(run));
  return std::clamp(ours.time - printed, -missing, missing) / unit;
}

// The timed cells of the tables, of whatever kind.
struct TimedCell {
  StudyTableId table;
  const ControlledRun* run;
  double printed;
};
std::vector<TimedCell> TimedCells(const StudyRuns& runs, const StudyData& data) {
  std::vector<TimedCell> cells;
  for (std::size_t i = 0; i < data.modulus.size(); ++i) {
    const ModulusRow& row = data.modulus[i];
    if (!std::isnan(row.convergence_time_s))
      cells.push_back({TableOf(row), &runs.modulus[i], row.convergence_time_s});
  }
  for (std::size_t i = 0; i < data.initial_states.size(); ++i) {
    const StartCell& cell = data.initial_states[i];
    cells.push_back({TableOf(cell), &runs.initial_states[i], cell.convergence_time_s});
  }
  return cells;
}

// A part's times are the mean over its tables, in each of which every cell counts alike.
class TableCounts {
 public:
  explicit TableCounts(const std::vector<TimedCell>& cells) {
    for (const TimedCell& cell : cells) counts_[static_cast<std::size_t>(cell.table)] += 1.0;
  }
  /// By how much the square of one of its cells is divided.
  double Share(StudyTableId table) const {
    double tables = 0.0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const bool is_sister = IsDamped(static_cast<StudyTableId>(i)) == IsDamped(table);
      tables += is_sister && counts_[i] > 0.0 ? 1.0 : 0.0;
    }
    return tables * counts_[static_cast<std::size_t>(table)];
  }

 private:
  std::array<double, kStudyTableCount> counts_{};
};

// Mean squares of the damped and of the undamped times by one reading.
struct TimeSquares {
  double damped = 0.0, undamped = 0.0;
};
TimeSquares TimeSquaresBy(const ConvergenceReading& reading, const std::vector<TimedCell>& cells,
                          const TableCounts& counts) {
  TimeSquares squares;
  for (const TimedCell& cell : cells) {
    const double square =
        Square(TimeDifference(*cell.run, cell.table, cell.printed, cell.run->TimeBy(reading)));
    (IsDamped(cell.table) ? squares.damped : squares.undamped) += square / counts.Share(cell.table);
  }
  return squares;
}

double StiffnessMisfit(const StudyRuns& runs, const StudyData& data) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < data.modulus.size(); ++i) {
    const ModulusRow& row = data.modulus[i];
    if (std::isnan(row.k_min_N_per_m)) continue;
    const ControlledRun& run = runs.modulus[i];
    sum += Square(StiffnessDifference(run, row.k_min_N_per_m, run.k_min_N_per_m)) +
           Square(StiffnessDifference(run, row.k_max_N_per_m, run.k_max_N_per_m));
    count += 2.0;
  }
  return count == 0.0 ? 0.0 : sum / count;
}

// Each part's shares add up to 1.
void Normalise(std::vector<PullingCell>& cells, std::size_t from) {
  double sum = 0.0;
  for (std::size_t i = from; i < cells.size(); ++i) sum += cells[i].share;
  for (std::size_t i = from; i < cells.size() && sum > 0.0; ++i) cells[i].share /= sum;
}

void AddEnergyCells(const StudyRuns& runs, const StudyData& data, std::vector<PullingCell>& cells) {
  const std::size_t from = cells.size();
  for (std::size_t i = 0; i < data.energy.size(); ++i) {
    const EnergyCell& cell = data.energy[i];
    cells.push_back({StudyTableId::k65,
                     fmt::format("{:.4g} deg, d = {:g}", RadToDeg(cell.touchdown_angle_rad),
                                 cell.damping_N_s_per_m),
                     "energy", "%", cell.percent, runs.energy[i],
                     Square(EnergyDifference(cell.percent, runs.energy[i]))});
  }
  Normalise(cells, from);
}

void AddStiffnessCells(const StudyRuns& runs, const StudyData& data,
                       std::vector<PullingCell>& cells) {
  const std::size_t from = cells.size();
  for (std::size_t i = 0; i < data.modulus.size(); ++i) {
    const ModulusRow& row = data.modulus[i];
    if (std::isnan(row.k_min_N_per_m)) continue;
    const std::string at = fmt::format("{:.4g} GPa", row.modulus_Pa * 1e-9);
    const ControlledRun& run = runs.modulus[i];
    const auto add = [&](const char* quantity, double printed, double ours) {
      cells.push_back({TableOf(row), at, quantity, "N/m", printed, ours,
                       Square(StiffnessDifference(run, printed, ours))});
    };
    add("k_min", row.k_min_N_per_m, run.k_min_N_per_m);
    add("k_max", row.k_max_N_per_m, run.k_max_N_per_m);
  }
  Normalise(cells, from);
}

void AddTimes(bool damped, const StudyRuns& runs, const StudyData& data,
              const ConvergenceReading& reading, std::vector<PullingCell>& cells) {
  const std::size_t from = cells.size();
  const auto add = [&](StudyTableId table, std::string at, const ControlledRun& run,
                       double printed) {
    if (IsDamped(table) != damped || std::isnan(printed)) return;
    const ConvergenceTime time = run.TimeBy(reading);
    cells.push_back({table, std::move(at), "convergence_time", "s", printed, time.time,
                     Square(TimeDifference(run, table, printed, time))});
  };
  for (std::size_t i = 0; i < data.modulus.size(); ++i)
    add(TableOf(data.modulus[i]), fmt::format("{:.4g} GPa", data.modulus[i].modulus_Pa * 1e-9),
        runs.modulus[i], data.modulus[i].convergence_time_s);
  for (std::size_t i = 0; i < data.initial_states.size(); ++i) {
    const StartCell& cell = data.initial_states[i];
    add(TableOf(cell), fmt::format("{:g} m/s, {:g} m", cell.speed_m_per_s, cell.height_m),
        runs.initial_states[i], cell.convergence_time_s);
  }
  Normalise(cells, from);
}

}  // namespace

std::string_view NameOf(StudyPart part) {
  static constexpr std::array<std::string_view, kStudyPartCount> kNames = {
      "energy", "stiffness", "damped_times", "undamped_times"};
  return kNames[Index(part)];
}

double StudyMisfit::Total(const StudyWeights& weights) const {
  double total = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (weights[i] > 0.0) total += weights[i] * parts[i];
  }
  return total;
}

double EnergyMisfit(const std::vector<double>& percent, const StudyData& data) {
  double sum = 0.0;
  for (std::size_t i = 0; i < data.energy.size(); ++i)
    sum += Square(EnergyDifference(data.energy[i].percent, percent[i]));
  return data.energy.empty() ? 0.0 : sum / static_cast<double>(data.energy.size());
}

StudyMisfit MisfitOf(const StudyRuns& runs, const StudyData& data,
                     const std::vector<ConvergenceReading>& readings, const StudyWeights& weights) {
  StudyMisfit misfit;
  misfit.parts[Index(StudyPart::kEnergy)] = EnergyMisfit(runs.energy, data);
  misfit.parts[Index(StudyPart::kStiffness)] = StiffnessMisfit(runs, data);
  const std::vector<TimedCell> cells = TimedCells(runs, data);
  const TableCounts counts(cells);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const TimeSquares squares = TimeSquaresBy(readings[i], cells, counts);
    const double sum = weights[Index(StudyPart::kDampedTimes)] * squares.damped +
                       weights[Index(StudyPart::kUndampedTimes)] * squares.undamped;
    if (!(sum < least)) continue;
    least = sum;
    misfit.reading = static_cast<int>(i);
    misfit.parts[Index(StudyPart::kDampedTimes)] = squares.damped;
    misfit.parts[Index(StudyPart::kUndampedTimes)] = squares.undamped;
  }
  return misfit;
}

std::vector<double> ResidualsOf(const StudyRuns& runs, const StudyData& data,
                                const ConvergenceReading& reading, const StudyWeights& weights) {
  std::vector<double> residuals;
  const auto weight_of = [&](StudyPart part, double count) {
    return std::sqrt(weights[Index(part)] / std::max(count, 1.0));
  };
  const double energy = weight_of(StudyPart::kEnergy, static_cast<double>(data.energy.size()));
  for (std::size_t i = 0; i < data.energy.size(); ++i)
    residuals.push_back(energy * EnergyDifference(data.energy[i].percent, runs.energy[i]));
  double ranges = 0.0;
  for (const ModulusRow& row : data.modulus) ranges += std::isnan(row.k_min_N_per_m) ? 0.0 : 2.0;
  const double stiffness = weight_of(StudyPart::kStiffness, ranges);
  for (std::size_t i = 0; i < data.modulus.size(); ++i) {
    const ModulusRow& row = data.modulus[i];
    if (std::isnan(row.k_min_N_per_m)) continue;
    const ControlledRun& run = runs.modulus[i];
    for (const auto& [printed, ours] : {std::pair(row.k_min_N_per_m, run.k_min_N_per_m),
                                        std::pair(row.k_max_N_per_m, run.k_max_N_per_m)})
      residuals.push_back(stiffness * StiffnessDifference(run, printed, ours));
  }
  const std::vector<TimedCell> cells = TimedCells(runs, data);
  const TableCounts counts(cells);
  for (const TimedCell& cell : cells) {
    const StudyPart part =
        IsDamped(cell.table) ? StudyPart::kDampedTimes : StudyPart::kUndampedTimes;
    residuals.push_back(
        weight_of(part, counts.Share(cell.table)) *
        TimeDifference(*cell.run, cell.table, cell.printed, cell.run->TimeBy(reading)));
  }
  return residuals;
}

RunWants WantsOf(const std::vector<ConvergenceReading>& readings) {
  RunWants wants;
  for (const ConvergenceReading& reading : readings) {
    wants.instants |= reading.speed == ConvergenceReading::Speed::kInstant;
    wants.fixed_speed |= reading.steady == ConvergenceReading::Steady::kFixedPoint;
  }
  return wants;
}

std::vector<PullingCell> PullingCells(const StudyRuns& runs, const StudyData& data,
                                      const ConvergenceReading& reading) {
  std::vector<PullingCell> cells;
  AddEnergyCells(runs, data, cells);
  AddStiffnessCells(runs, data, cells);
  for (const bool damped : {true, false}) AddTimes(damped, runs, data, reading, cells);
  std::stable_sort(cells.begin(), cells.end(),
                   [](const PullingCell& a, const PullingCell& b) { return a.share > b.share; });
  return cells;
}

}  // namespace hoplab
