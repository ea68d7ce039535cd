#include "app/records/simulation_record.h"

#include <array>

#include "fitting/run_end.h"

namespace hoplab {
namespace {

constexpr std::array<const char*, 4> kStateNames = {"x_m", "y_m", "vx_m_per_s", "vy_m_per_s"};

Json EventRecord(const Event& e) {
  return {{"time_s", e.time},
          {"kind", NameOf(e.kind)},
          {"mode_before", NameOf(e.mode_before)},
          {"mode_after", NameOf(e.mode_after)},
          {"x_m", NumberOrNull(e.x)},
          {"y_m", NumberOrNull(e.y)},
          {"vx_m_per_s", NumberOrNull(e.vx)},
          {"vy_m_per_s", NumberOrNull(e.vy)},
          {"vx_after_m_per_s", NumberOrNull(e.vx_after)},
          {"vy_after_m_per_s", NumberOrNull(e.vy_after)},
          {"simultaneous", e.simultaneous}};
}

Json SensitivitiesRecord(const Trajectory& run, const std::vector<std::string>& names) {
  if (names.empty() || FailedAtOnce(run)) return nullptr;
  Json out = Json::object();
  for (std::size_t d = 0; d < names.size(); ++d) {
    Json state = Json::object(), times = Json::array();
    for (std::size_t i = 0; i < kStateNames.size(); ++i)
      state[kStateNames[i]] = NumberOrNull(run.final_sensitivities[i * names.size() + d]);
    for (std::size_t e = 0; e < run.events.size(); ++e)
      times.push_back(NumberOrNull(run.event_time_sensitivities[e * names.size() + d]));
    out[names[d]] = {{"final_state", state}, {"event_times", times}};
  }
  return out;
}

}  // namespace

bool FailedAtOnce(const Trajectory& run) {
  return !IsComplete(run.outcome) && run.end_time == 0.0 && run.events.empty();
}

std::vector<std::pair<double, double>> ApexEnergies(const SimulationRequest& request,
                                                    const Trajectory& run) {
  std::vector<std::pair<double, double>> energies;
  if (request.law == Law::kRobot) return energies;  // an apex does not tell pitch and motors
  const auto add = [&](double time, const std::vector<double>& s) {
    const std::array<double, 5> state = {s[0], s[1], s[2], s[3], 0.0};
    energies.emplace_back(time, Energy(request, Mode::kFlight, state));
  };
  add(0.0, request.initial);
  for (const Event& e : run.events) {
    if (e.kind == EventKind::kApex) add(e.time, {e.x, e.y, e.vx, e.vy});
  }
  return energies;
}

void AddSimulation(const SimulationRequest& request, const Trajectory& run,
                   const std::vector<std::string>& direction_names, Json& record) {
  record["outcome"] = NameOf(run.outcome);
  record["outcome_sentence"] = WhyEnded(run, request.effects, request.initial);
  record["end_time_s"] = NumberOrNull(run.end_time);
  record["hops"] = run.hops;
  Json state = {{"mode", NameOf(run.final_mode)}};
  for (std::size_t i = 0; i < kStateNames.size(); ++i)
    state[kStateNames[i]] = i < run.final_state.size() ? NumberOrNull(run.final_state[i]) : nullptr;
  record["final_state"] = state;
  record["events"] = Json::array();
  for (const Event& e : run.events) record["events"].push_back(EventRecord(e));
  record["apex_energies"] = Json::array();
  for (const auto& [time, energy] : ApexEnergies(request, run))
    record["apex_energies"].push_back({{"time_s", time}, {"energy_J", NumberOrNull(energy)}});
  record["sensitivities"] = SensitivitiesRecord(run, direction_names);
  record["max_flexure"] = NumberOrNull(run.max_deflection_ratio);
  record["least_crossing_rate_per_s"] = NumberOrNull(run.least_crossing_rate);
  record["nearest_miss"] = NumberOrNull(run.nearest_miss);
}

}  // namespace hoplab
