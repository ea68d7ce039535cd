#include "app/records/optimize_record.h"

#include "app/records/csv.h"
#include "app/records/gait_tables.h"
#include "app/records/solver_record.h"
#include "app/records/trajectory_tables.h"

namespace hoplab {
namespace {

Json ParametersRecord(const OptimizeRun& run, const std::vector<double>& x) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < x.size(); ++i) parameters[run.problem.variables[i].name] = x[i];
  return parameters;
}

Json PointRecord(const OptimizeRun& run, const SearchPoint& point) {
  const bool ended = point.verdict == PointVerdict::kRunEnded;
  return {{"parameters", ParametersRecord(run, point.x)},
          {"verdict", NameOf(point.verdict)},
          {"outcome", ended ? Json(NameOf(point.outcome)) : Json(nullptr)},
          {"violated", point.violated.empty() ? Json(nullptr) : Json(point.violated)},
          {"objective", NumberOrNull(point.objective)},
          {"convergence_time_s", NumberOrNull(point.convergence.time)},
          {"convergence_hops",
           point.convergence.converged() ? Json(point.convergence.hops) : Json(nullptr)},
          {"asterisk", point.convergence.band == ConvergenceTime::Band::kTwoPercent},
          {"spectral_radius", NumberOrNull(point.spectral_radius)},
          {"steady_speed_m_per_s", NumberOrNull(point.speed)},
          {"max_torque_N_m", NumberOrNull(point.torque)},
          {"clearance_m", NumberOrNull(point.clearance)},
          {"max_flexure", NumberOrNull(point.deflection_ratio)},
          {"cost_of_transport", NumberOrNull(point.cost_of_transport)},
          {"legs_apart", NumberOrNull(point.legs_apart)},
          {"flight_share", NumberOrNull(point.flight_share)},
          {"gait", point.gait.empty() ? Json(nullptr) : Json(point.gait)}};
}

Json WorstRecord(const WorstCase& worst) {
  return {{"runs", worst.runs},
          {"converged", worst.converged},
          {"ended", worst.ended},
          {"worst_time_s", NumberOrNull(worst.worst_time)}};
}

Json RobustnessRecord(const Robustness& r) {
  return {{"stiffness_5_percent", WorstRecord(r.stiffness)},
          {"starts", WorstRecord(r.initial_states)},
          {"touchdown_noise_half_deg",
           {{"runs", r.noise.runs},
            {"fell", r.noise.fell},
            {"relative_speed_deviation", NumberOrNull(r.noise.speed_deviation)}}}};
}

Json StepsRecord(const std::vector<SearchStep>& steps) {
  Json history = Json::array();
  for (const SearchStep& step : steps) {
    history.push_back({{"evaluation", step.evaluation},
                       {"objective", NumberOrNull(step.objective)},
                       {"score", NumberOrNull(step.score)}});
  }
  return history;
}

Json VariablesRecord(const OptimizeRun& run) {
  Json out = Json::array();
  for (std::size_t i = 0; i < run.problem.variables.size(); ++i) {
    const SearchVariable& v = run.problem.variables[i];
    out.push_back(
        {{"name", v.name}, {"low", v.low}, {"high", v.high}, {"before", run.scenario_x[i]}});
  }
  return out;
}

Json NewOptimizeRecord(const OptimizeSettings& settings, const Scenario& scenario,
                       const OptimizeRun& run) {
  RecordHeader header;
  header.command = "optimize";
  header.law = std::string(NameOf(run.problem.hopper_at(run.scenario_x).request.law));
  header.reading = scenario.mechanism.reading;
  header.seed = settings.seed;
  Json over = Json::object();
  for (const SearchVariable& v : run.problem.variables) over[v.name] = {v.low, v.high};
  header.options = {{"scenario", settings.scenario.scenario},
                    {"set", settings.scenario.set},
                    {"with", settings.scenario.with},
                    {"over", over},
                    {"algorithm", settings.algorithm},
                    {"budget", run.options.budget},
                    {"seeds", settings.seeds},
                    {"weight", settings.weight},
                    {"map", settings.map_size}};
  RecordSolver(settings.solver, header.options);
  Json record = NewRecord(header);
  record["scenario"] = scenario.name;
  return record;
}

// The objective map.
std::string MapTable(const OptimizeRun& run) {
  const auto& variables = run.problem.variables;
  std::vector<std::string> header = {variables[0].name};
  if (variables.size() > 1) header.push_back(variables[1].name);
  for (const char* name : {"verdict", "outcome", "objective", "score", "convergence_time_s",
                           "spectral_radius", "steady_speed_m_per_s"})
    header.emplace_back(name);
  CsvText csv(header);
  for (const MapCell& cell : run.map) {
    csv.Cell(cell.first);
    if (variables.size() > 1) csv.Cell(cell.second);
    const SearchPoint& p = cell.point;
    csv.Cell(NameOf(p.verdict)).Cell(NameOf(p.outcome)).Cell(p.objective).Cell(p.score);
    csv.Cell(p.convergence.time).Cell(p.spectral_radius).Cell(p.speed);
    csv.EndRow();
  }
  return csv.text();
}

// The history of all seeds.
std::string HistoryTable(const OptimizeRun& run) {
  CsvText csv({"seed", "evaluation", "objective", "score"});
  for (const SeedResult& seed : run.result.seeds) {
    for (const SearchStep& step : seed.history) {
      csv.Cell(static_cast<double>(seed.seed)).Cell(static_cast<double>(step.evaluation));
      csv.Cell(step.objective).Cell(step.score);
      csv.EndRow();
    }
  }
  return csv.text();
}

// The steady hops before and best, from apex to apex.
std::string CyclesTable(const OptimizeRun& run) {
  const Hopper before = run.problem.hopper_at(run.scenario_x);
  std::vector<LabelledGait> gaits = {{"before", &before, &run.before_gait}};
  Hopper best;
  if (run.has_result()) {
    best = run.problem.hopper_at(run.result.best.x);
    gaits.push_back({"best", &best, &run.best_gait});
  }
  return CycleTable(gaits);
}

}  // namespace

Json OptimizeRecord(const OptimizeSettings& settings, const Scenario& scenario,
                    const OptimizeRun& run) {
  Json record = NewOptimizeRecord(settings, scenario, run);
  const GainSearchResult& result = run.result;
  record["objective"] = NameOf(run.problem.objective);
  record["algorithm"] = NameOf(run.options.algorithm);
  record["variables"] = VariablesRecord(run);
  record["best"] = run.has_result() ? PointRecord(run, result.best) : Json(nullptr);
  record["before"] = PointRecord(run, run.before);
  record["evaluations"] = result.evaluations;
  record["history"] =
      result.seeds.empty() ? Json::array() : StepsRecord(result.seeds[result.best_seed].history);
  record["seeds"] = Json::array();
  for (const SeedResult& seed : result.seeds) {
    Json entry = {{"seed", seed.seed}, {"evaluations", seed.evaluations}};
    entry["best"] = seed.evaluations > 0 ? PointRecord(run, seed.best) : Json(nullptr);
    record["seeds"].push_back(entry);
  }
  record["agreeing_seeds"] = result.agreeing;
  record["robustness"] = {
      {"before", RobustnessRecord(run.before_robustness)},
      {"best", run.has_result() ? RobustnessRecord(run.best_robustness) : Json(nullptr)}};
  record["gaits"] = {{"before", GaitPointRecord(run.before_gait)},
                     {"best", GaitPointRecord(run.best_gait)}};
  const Hopper before = run.problem.hopper_at(run.scenario_x);
  record["mechanism"] = MechanismRecord(RequestOf(before));
  if (const std::string failure = run.Failure(); !failure.empty()) SetFailed(record, failure);
  return record;
}

std::map<std::string, std::string> OptimizeTables(const OptimizeRun& run) {
  std::map<std::string, std::string> tables = {{"history.csv", HistoryTable(run)},
                                               {"cycles.csv", CyclesTable(run)}};
  if (!run.map.empty()) tables["map.csv"] = MapTable(run);
  return tables;
}

}  // namespace hoplab
