#include "app/records/gait_record.h"

#include <fmt/format.h>

#include <cmath>

#include "app/records/csv.h"
#include "app/records/gait_tables.h"
#include "app/records/simulation_record.h"
#include "app/records/stride_record.h"
#include "app/records/trajectory_tables.h"
#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"

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

std::string EndText(BranchEnd end, Outcome outcome) {
  switch (end) {
    case BranchEnd::kRange:
      return "the end of the range";
    case BranchEnd::kHopFails:
      return "where the hop fails: " + std::string(SentenceOf(outcome));
    case BranchEnd::kNotConverged:
      return "where no fixed point is found any more";
    case BranchEnd::kPointLimit:
      return "the limit of points";
    case BranchEnd::kStopped:
      return "the interruption";
  }
  return "";
}

std::string BranchReport(const GaitRun& run) {
  const Branch& branch = run.branch;
  if (!run.along || branch.points.empty()) return "";
  const std::string& name = run.along->name;
  std::string text =
      fmt::format("\n  along {}, {} points from {} ({}) to {} ({})\n", name, branch.points.size(),
                  Significant(branch.points.front().parameter, 4),
                  EndText(branch.first_end, branch.first_outcome),
                  Significant(branch.points.back().parameter, 4),
                  EndText(branch.last_end, branch.last_outcome));
  // A stride has some twenty events: where their order changes is told, not how.
  const bool strides = HasStrides(run.hopper);
  std::string orders;
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    const BranchPoint &a = branch.points[i - 1], &b = branch.points[i];
    if (strides && b.sequence_changed)
      orders += (orders.empty() ? "" : ", ") + Significant(b.parameter, 4);
    const std::string place = fmt::format("  {} = {}: ", name, Significant(b.parameter, 4));
    if (b.sequence_changed && !strides)
      text += place + "an event grazes, " + EventSequence(a.fixed_point.hop) + " becomes " +
              EventSequence(b.fixed_point.hop) + "\n";
    else if (b.near_grazing && !a.near_grazing && !strides)
      text += place + "an event is close to grazing from here on\n";
    if (a.fixed_point.stable() != b.fixed_point.stable())
      text += place + (b.fixed_point.stable() ? "stable" : "unstable") + " from here on\n";
  }
  if (!orders.empty()) text += "  another order of events from " + name + " = " + orders + " on\n";
  for (const Bifurcation& b : branch.bifurcations)
    text += fmt::format("  {} = {}: {}\n", name, Significant(b.parameter, 4), NameOf(b.kind));
  return text;
}

std::string PredictionText(const GaitRun& run) {
  if (run.prediction.linear_hops < 0) return "none, it does not come back";
  return fmt::format("{} (the slowest mode starts at {} % and needs {})",
                     run.prediction.linear_hops, Significant(100.0 * run.prediction.e0, 3),
                     Fixed(run.prediction.hops, 1));
}

std::string CountedText(const GaitRun& run) {
  if (!run.counted || !run.counted->converged()) return "";
  return fmt::format("{} in the scenario's run, at {} s{}", run.counted->hops,
                     Fixed(run.counted->time, 3),
                     run.counted->band == ConvergenceTime::Band::kTwoPercent ? "* (2 %)" : "");
}

// What each parameter does to the spectral radius.
std::string RateTable(const GaitRun& run, bool colours) {
  using enum TextTable::Align;
  TextTable table({kLeft, kRight, kRight, kRight});
  table.AddRow({"parameter", "value (SI)", "d rho/d parameter", "rho per +1 %"});
  for (std::size_t i = 0; i < run.rates.size(); ++i) {
    const double value = ValueOf(run.hopper, GaitDirection(run.hopper, run.parameters[i]));
    const double rate = run.rates[i].value;
    table.AddRow({run.parameters[i], Significant(value, 5),
                  std::isnan(rate) ? "does not exist" : fmt::format("{:+.5e}", rate),
                  std::isnan(rate) ? "" : fmt::format("{:+.6f}", 0.01 * value * rate)});
  }
  const std::vector<std::string> lines = table.Lines();
  std::string text = "\n" + Styled(lines.front(), Emphasis::kFaint, colours) + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) text += lines[i] + "\n";
  return text;
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

}  // namespace

void AddGait(const GaitRun& run, Json& record) {
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
  record["max_flexure"] = found ? NumberOrNull(p.hop.max_flexure) : nullptr;
  record["iterations"] = p.iterations;
  record["residual"] = NumberOrNull(p.residual);
  record["counted"] = CountedRecord(run.counted);
  record["branch"] = BranchRecord(run);
  if (HasStrides(run.hopper)) AddStride(run, record);
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

std::string GaitReport(const std::string& name, const GaitRun& run, bool colours) {
  const FixedPoint& p = run.point;
  std::string text = Styled(name, Emphasis::kBold, colours);
  if (HasStrides(run.hopper)) {
    text += fmt::format("  law robot, {} strides from its start\n\n", Fixed(run.own_strides, 1));
    return p.found() ? text + StrideReport(run) + RateTable(run, colours) + BranchReport(run)
                     : text;
  }
  text +=
      fmt::format("  law {}, from an apex at {} m with {} m/s\n\n", NameOf(run.hopper.request.law),
                  Fixed(run.start[1], 4), Fixed(run.start[0], 4));
  if (!p.found()) return text;
  text += fmt::format("  steady hop       vx {} m/s, apex {} m, every {} s ({})\n",
                      Significant(p.state[0], 7), Significant(p.state[1], 7),
                      Significant(p.hop.period, 5), EventSequence(p.hop));
  text += fmt::format("  multipliers      {} and {}\n", Multiplier(p.multipliers[0]),
                      Multiplier(p.multipliers[1]));
  text += fmt::format("  spectral radius  {}, {}\n", Significant(p.spectral_radius, 7),
                      p.conserves_energy ? "one multiplier is the energy's, which is conserved"
                      : p.stable()       ? "stable"
                                         : "unstable");
  text += "  hops to 1 %      " + PredictionText(run) + "\n";
  if (const std::string counted = CountedText(run); !counted.empty())
    text += "  counted          " + counted + "\n";
  if (run.hopper.request.law == Law::kLargeDeflection && p.hop.max_flexure > kMaxFlexure)
    text += fmt::format("  the leg bends to F C/l0 = {}; beyond {} this law is not to be trusted\n",
                        Significant(p.hop.max_flexure, 2), kMaxFlexure);
  return text + RateTable(run, colours) + BranchReport(run);
}

}  // namespace hoplab
