#include "app/records/optimize_record.h"

#include <fmt/format.h>

#include <cmath>

#include "app/records/csv.h"
#include "app/records/gait_tables.h"
#include "app/records/trajectory_tables.h"
#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"

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
          {"max_flexure", NumberOrNull(point.flexure)},
          {"cost_of_transport", NumberOrNull(point.cost_of_transport)},
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
          {"starts", WorstRecord(r.starts)},
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

// "0.71 s after 2 hops", "falls (fell_no_return)".
std::string Worth(const SearchPoint& point) {
  switch (point.verdict) {
    case PointVerdict::kRunEnded:
      return "the run ends: " + std::string(SentenceOf(point.outcome));
    case PointVerdict::kNoConvergence:
      return "does not converge";
    case PointVerdict::kConstraint:
      return "breaks " + point.violated;
    case PointVerdict::kGood:
    case PointVerdict::kWideBand:
      break;
  }
  std::string text;
  if (point.convergence.converged())
    text = fmt::format("{} s{}, {} hop{}", Fixed(point.convergence.time, 3),
                       point.verdict == PointVerdict::kWideBand ? "* (2 %)" : "",
                       point.convergence.hops, point.convergence.hops == 1 ? "" : "s");
  if (!std::isnan(point.spectral_radius))
    text += fmt::format("{}spectral radius {}", text.empty() ? "" : ", ",
                        Significant(point.spectral_radius, 4));
  text += fmt::format(", {} m/s", Fixed(point.speed, 3));
  if (point.gait.empty()) return text;
  return point.gait + ": " + text +
         fmt::format(", cost of transport {}, at most {} N m",
                     Significant(point.cost_of_transport, 3), Significant(point.torque, 3));
}

std::string WorstText(const WorstCase& worst) {
  std::string text = fmt::format("{} of {} converge", worst.converged, worst.runs);
  if (std::isfinite(worst.worst_time))
    text += fmt::format(", at worst in {} s", Fixed(worst.worst_time, 3));
  return text + (worst.ended > 0 ? fmt::format(", {} fall", worst.ended) : "");
}

std::string NoiseText(const NoisyHops& noise) {
  return fmt::format("{} of {} runs of 60 hops fall, speed varies by {} %", noise.fell, noise.runs,
                     Significant(100.0 * noise.speed_deviation, 2));
}

}  // namespace

bool OptimizeRun::has_result() const {
  return !result.best.x.empty() && result.best.verdict <= PointVerdict::kWideBand;
}

std::string OptimizeRun::Failure() const {
  if (result.interrupted)
    return has_result() ? "interrupted; the result is the best of what was tried"
                        : "interrupted; nothing that converges had been found";
  if (!has_result())
    return "no point that converges within the constraints was found in " +
           std::to_string(result.evaluations) + " evaluations; widen search.over or loosen " +
           "search.constraints";
  return "";
}

void AddOptimize(const OptimizeRun& run, Json& record) {
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
}

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

std::string OptimizeReport(const std::string& name, const OptimizeRun& run, bool colours) {
  using enum TextTable::Align;
  const GainSearchResult& result = run.result;
  std::string text =
      Styled(name, Emphasis::kBold, colours) +
      fmt::format("  {} by {}, {} evaluations from {} seed{}\n\n", NameOf(run.problem.objective),
                  NameOf(run.options.algorithm), result.evaluations, result.seeds.size(),
                  result.seeds.size() == 1 ? "" : "s");
  if (!run.has_result()) return text;
  TextTable table({kLeft, kRight, kRight, kLeft});
  table.AddRow({"", "before", "best", "searched"});
  for (std::size_t i = 0; i < run.problem.variables.size(); ++i) {
    const SearchVariable& v = run.problem.variables[i];
    table.AddRow({v.name, Significant(run.scenario_x[i], 5), Significant(result.best.x[i], 5),
                  fmt::format("{} .. {}", Significant(v.low, 4), Significant(v.high, 4))});
  }
  const std::vector<std::string> lines = table.Lines();
  text += Styled(lines.front(), Emphasis::kFaint, colours) + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) text += lines[i] + "\n";
  text +=
      "\n  before         " + Worth(run.before) + "\n  best           " + Worth(result.best) + "\n";
  text += fmt::format("  how sure       {} of {} seeds end within 1 % of the best\n",
                      result.agreeing, result.seeds.size());
  text += "  stiffness 5 %  " + WorstText(run.best_robustness.stiffness) +
          " (before: " + WorstText(run.before_robustness.stiffness) + ")\n";
  text += "  25 starts      " + WorstText(run.best_robustness.starts) +
          " (before: " + WorstText(run.before_robustness.starts) + ")\n";
  if (run.best_robustness.noise.runs > 0)
    text += "  0.5 deg noise  " + NoiseText(run.best_robustness.noise) +
            " (before: " + NoiseText(run.before_robustness.noise) + ")\n";
  return text;
}

}  // namespace hoplab
