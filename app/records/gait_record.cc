#include "app/records/gait_record.h"

#include "app/records/csv.h"
#include "app/records/gait_tables.h"
#include "app/records/solver_record.h"
#include "app/records/stride_record.h"
#include "app/records/trajectory_tables.h"

namespace hoplab {
namespace {

int BandPercent(ConvergenceTime::Band band) {
  return band == ConvergenceTime::Band::kOnePercent ? 1 : 2;
}

Json CountedRecord(const std::optional<ConvergenceTime>& counted) {
  if (!counted || !counted->converged()) return nullptr;
  return {{"time_s", counted->time},
          {"hops", counted->hops},
          {"band_percent", BandPercent(counted->band)},
          {"steady_speed_m_per_s", counted->steady_speed}};
}

Json BranchRecord(const GaitRun& run) {
  if (!run.along) return nullptr;
  Json points = Json::array(), bifurcations = Json::array();
  for (const BranchPoint& p : run.branch.points) {
    Json point = {{"parameter", p.parameter}};
    point.update(StateRecord(run.components, p.fixed_point.state));
    point.update(Json{{"speed_m_per_s", NumberOrNull(SpeedOf(p.fixed_point.hop))},
                      {"spectral_radius", NumberOrNull(p.fixed_point.spectral_radius)},
                      {"stable", p.fixed_point.stable()},
                      {"sequence_changed", p.sequence_changed},
                      {"near_grazing", p.near_grazing}});
    points.push_back(point);
  }
  for (const Bifurcation& b : run.branch.bifurcations)
    bifurcations.push_back({{"kind", NameOf(b.kind)}, {"parameter", b.parameter}});
  const auto end = [](BranchEnd why, Outcome outcome) {
    return Json{{"why", NameOf(why)},
                {"outcome", why == BranchEnd::kHopFails ? Json(NameOf(outcome)) : Json(nullptr)}};
  };
  return {{"parameter", run.along->name},
          {"points", points},
          {"bifurcations", bifurcations},
          {"first_end", end(run.branch.first_end, run.branch.first_outcome)},
          {"last_end", end(run.branch.last_end, run.branch.last_outcome)}};
}

// The branch as CSV.
std::string BranchTable(const GaitRun& run) {
  std::vector<std::string> header = {run.along->name};
  for (const SectionComponent& c : run.components) header.push_back(c.name);
  header.emplace_back("spectral_radius");
  for (std::size_t i = 1; i <= run.components.size(); ++i)
    for (const char* part : {"_re", "_im"})
      header.push_back("multiplier_" + std::to_string(i) + part);
  for (const char* name : {"stable", "sequence_changed", "near_grazing", "speed_m_per_s", "events"})
    header.emplace_back(name);
  CsvText csv(header);
  for (const BranchPoint& point : run.branch.points) {
    const FixedPoint& p = point.fixed_point;
    csv.Cell(point.parameter);
    for (const double component : p.state) csv.Cell(component);
    csv.Cell(p.spectral_radius);
    for (const std::complex<double>& m : p.multipliers) csv.Cell(m.real()).Cell(m.imag());
    csv.Cell(p.stable() ? 1.0 : 0.0)
        .Cell(point.sequence_changed ? 1.0 : 0.0)
        .Cell(point.near_grazing ? 1.0 : 0.0)
        .Cell(SpeedOf(p.hop))
        .Cell(EventSequence(p.hop));
    csv.EndRow();
  }
  return csv.text();
}

// What every gait has.
void AddGaitKeys(const GaitRun& run, Json& record) {
  const FixedPoint& p = run.point;
  record["start"] = StateRecord(run.components, run.start);
  const bool found = p.found();
  record["fixed_point"] = StateRecord(run.components, found ? p.state : SectionState());
  record["multipliers"] = Json::array();
  for (const std::complex<double>& m : p.multipliers)
    record["multipliers"].push_back({NumberOrNull(m.real()), NumberOrNull(m.imag())});
  record["spectral_radius"] = NumberOrNull(p.spectral_radius);
  record["period_s"] = found ? NumberOrNull(p.hop.period) : nullptr;
  record["advance_m"] = found ? NumberOrNull(p.hop.advance) : nullptr;
  const bool predicted = run.prediction.linear_hops >= 0;
  record["predicted_hops"] = predicted ? Json(run.prediction.linear_hops) : Json(nullptr);
  record["slowest_mode"] = {{"e0", NumberOrNull(run.prediction.e0)},
                            {"hops", NumberOrNull(run.prediction.hops)}};
  record["d_spectral_radius"] = Json::object();
  record["d_spectral_radius_error"] = Json::object();
  for (std::size_t i = 0; i < run.parameters.size(); ++i) {
    const SpectralRadiusRate rate = i < run.rates.size() ? run.rates[i] : SpectralRadiusRate();
    record["d_spectral_radius"][run.parameters[i]] = NumberOrNull(rate.value);
    record["d_spectral_radius_error"][run.parameters[i]] = NumberOrNull(rate.error);
  }
  record["stable"] = found ? Json(p.stable()) : Json(nullptr);
  record["conserves_energy"] = found ? Json(p.conserves_energy) : Json(nullptr);
  record["events"] = EventSequence(p.hop);
  record["mechanism"] = MechanismRecord(RequestOf(run.hopper));
  record["apex_speeds"] = Json::array();
  for (const ApexSpeed& apex : run.apexes)
    record["apex_speeds"].push_back({{"time_s", apex.time}, {"vx_m_per_s", apex.vx}});
  record["max_flexure"] = found ? NumberOrNull(p.hop.max_deflection_ratio) : nullptr;
  record["iterations"] = p.iterations;
  record["residual"] = NumberOrNull(p.residual);
  record["counted"] = CountedRecord(run.counted);
  record["branch"] = BranchRecord(run);
  if (HasStrides(run.hopper)) AddStride(run, record);
}

Json NewGaitRecord(const GaitSettings& settings, const Scenario& scenario, Law law) {
  RecordHeader header;
  header.command = "gait";
  header.law = std::string(NameOf(law));
  header.reading = scenario.mechanism.reading;
  header.options = {{"scenario", settings.scenario.scenario},
                    {"set", settings.scenario.set},
                    {"with", settings.scenario.with},
                    {"along", settings.along.empty() ? Json(nullptr) : Json(settings.along)}};
  RecordSolver(settings.solver, header.options);
  Json record = NewRecord(header);
  record["scenario"] = scenario.name;
  return record;
}

}  // namespace

Json GaitRecord(const GaitSettings& settings, const Scenario& scenario, const GaitRun& run) {
  Json record = NewGaitRecord(settings, scenario, run.hopper.request.law);
  AddGaitKeys(run, record);
  if (const std::string failure = run.Failure(); !failure.empty()) SetFailed(record, failure);
  return record;
}

std::map<std::string, std::string> GaitTables(const GaitRun& run) {
  constexpr double kLongest = 30.0;  // s
  std::map<std::string, std::string> tables = {
      {"trajectory.csv", OwnRunTable(run.hopper, kLongest)}};
  if (run.point.found())
    tables["cycles.csv"] = CycleTable(
        {{HasStrides(run.hopper) ? "steady stride" : "steady hop", &run.hopper, &run.point}});
  if (run.along && !run.branch.points.empty()) tables["branch.csv"] = BranchTable(run);
  return tables;
}

}  // namespace hoplab
