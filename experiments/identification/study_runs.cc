#include "experiments/identification/study_runs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "experiments/identification/energy_jump.h"
#include "experiments/identification/steady_hop.h"

namespace hoplab {
namespace {

// A run that has no stable steady hop: as if it had ended where its first hops did, which tells a
// search how far it is from one that lasts.
ControlledRun WithoutSteadyHop(const ControlledRun& start) {
  ControlledRun out = start;
  if (IsComplete(out.outcome)) out.end_time_s = 0.5 * kControlledTime;
  out.outcome = Outcome::kFellNoReturn;
  return out;
}

// Steady hops by modulus and damping, each found once.
class SteadyHops {
 public:
  explicit SteadyHops(const StudyHopper& hopper) : hopper_(hopper) {}

  ControlledRun Predict(const ControlledSettings& settings, const RunWants& wants) {
    const auto key = std::pair(settings.modulus_Pa, settings.damping_N_s_per_m);
    auto found = steady_.find(key);
    if (found == steady_.end())
      found = steady_.emplace(key, FindSteadyHop(hopper_, key.first, key.second)).first;
    const SteadyHop& steady = found->second;
    if (!steady.point.stable()) return WithoutSteadyHop(steady.start);
    return PredictControlled(hopper_, settings, steady.point, wants);
  }

 private:
  const StudyHopper& hopper_;
  std::map<std::pair<double, double>, SteadyHop> steady_;
};

// The start speed in the middle of those of the table [m/s].
double MiddleSpeed(const std::vector<StartCell>& initial_states) {
  std::vector<double> speeds;
  for (const StartCell& cell : initial_states) speeds.push_back(cell.speed_m_per_s);
  std::sort(speeds.begin(), speeds.end());
  return speeds.empty() ? 0.0 : speeds[speeds.size() / 2];
}

}  // namespace

ControlledSettings SettingsOf(const ModulusRow& row) {
  return {.modulus_Pa = row.modulus_Pa, .damping_N_s_per_m = row.damping_N_s_per_m};
}
ControlledSettings SettingsOf(const StartCell& cell) {
  return {.damping_N_s_per_m = cell.damping_N_s_per_m,
          .speed_m_per_s = cell.speed_m_per_s,
          .height_m = cell.height_m};
}

std::vector<double> RunEnergy(const StudyHopper& hopper, const StudyData& data) {
  std::vector<double> percent;
  for (const EnergyCell& cell : data.energy)
    percent.push_back(EnergyPercent(hopper, cell).value_or(std::nan("")));
  return percent;
}

StudyRuns RunTables(const StudyHopper& hopper, const StudyData& data, const RunWants& wants) {
  StudyRuns runs;
  runs.energy = RunEnergy(hopper, data);
  RunWants of_modulus = wants;
  of_modulus.stiffness = true;
  for (const ModulusRow& row : data.modulus)
    runs.modulus.push_back(RunControlled(hopper, SettingsOf(row), of_modulus));
  for (const StartCell& cell : data.initial_states)
    runs.initial_states.push_back(RunControlled(hopper, SettingsOf(cell), wants));
  return runs;
}

StudyData SteadyData(const StudyData& data, bool has_toe_mass) {
  StudyData steady = data;
  steady.modulus = RowsForRanges(data.modulus);
  if (!has_toe_mass) return steady;
  const double middle = MiddleSpeed(data.initial_states);
  std::erase_if(steady.initial_states,
                [&](const StartCell& c) { return c.speed_m_per_s != middle; });
  return steady;
}

StudyRuns RunSteady(const StudyHopper& hopper, const StudyData& steady_data,
                    const RunWants& wants) {
  if (HasToeMass(hopper)) return RunTables(hopper, steady_data, wants);
  StudyRuns runs;
  runs.energy = RunEnergy(hopper, steady_data);
  SteadyHops steady(hopper);
  RunWants of_modulus = wants;
  of_modulus.stiffness = true;
  for (const ModulusRow& row : steady_data.modulus)
    runs.modulus.push_back(steady.Predict(SettingsOf(row), of_modulus));
  for (const StartCell& cell : steady_data.initial_states)
    runs.initial_states.push_back(steady.Predict(SettingsOf(cell), wants));
  return runs;
}

}  // namespace hoplab
