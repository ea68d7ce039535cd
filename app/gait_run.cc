#include "app/gait_run.h"

#include <fmt/format.h>

#include <cmath>

#include "app/console.h"
#include "app/csv.h"
#include "app/gait_tables.h"
#include "app/quantity.h"
#include "app/simulation_record.h"
#include "app/stride_record.h"
#include "app/text_table.h"
#include "app/trajectory_tables.h"
#include "app/usage_error.h"
#include "base/input_error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "experiments/scenario_hopper.h"

namespace hoplab {
namespace {

// What a robot's gait is differentiated by.
std::vector<std::string> RobotParameterNames(const RobotParameters<double>& robot) {
  std::vector<std::string> names = {"clock_period", "clock_duty", "clock_sweep", "clock_offset"};
  for (int leg = 2; leg <= robot.legs; ++leg) names.push_back("clock_phase_" + std::to_string(leg));
  if (robot.own_moduli) {
    for (int leg = 1; leg <= robot.legs; ++leg) names.push_back("E_" + std::to_string(leg));
  } else {
    names.emplace_back("E");
  }
  for (const char* name : {"leg_damping", "motor_kp", "motor_kd", "pitch_inertia", "com_x"})
    names.emplace_back(name);
  return names;
}

std::vector<std::string> ParameterNames(const Hopper& hopper) {
  if (const auto& robot = hopper.request.parameters.robot) return RobotParameterNames(*robot);
  std::vector<std::string> names;
  for (const ParameterId id : ParametersOf(MechanismOf(hopper.request.law)))
    names.emplace_back(InfoOf(id).name);
  for (const EffectSetting& setting : hopper.effects) {
    for (const EffectParameter& p : setting.effect->info.parameters)
      names.push_back(std::string(setting.effect->info.name) + "." + std::string(p.name));
  }
  return names;
}

// A parameter of the clock, as "clock_period" or like the scenario's key "clock.period_s".
std::optional<ParameterId> ClockParameter(std::string name) {
  if (name.starts_with("clock.")) {
    name[5] = '_';
    for (const std::string unit : {"_s", "_rad"})
      if (name.ends_with(unit)) name.resize(name.size() - unit.size());
  }
  for (const ParameterId id : ClockParameters())
    if (InfoOf(id).name == name) return id;
  return std::nullopt;
}

SensitivityDirection DirectionOf(const Hopper& hopper, const std::string& name) {
  if (HasStrides(hopper)) {
    if (const auto clock = ClockParameter(name)) return SensitivityDirection::Parameter(*clock);
    if (name.starts_with("ground_slope"))
      throw InputError({"--along", name, "is not followed: the section turns with the ground",
                        "Give the slope in the scenario."});
  }
  return ResolveDirection(name, MechanismOf(hopper.request.law), LegMass::kNone, hopper.effects);
}

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
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    const BranchPoint &a = branch.points[i - 1], &b = branch.points[i];
    const std::string place = fmt::format("  {} = {}: ", name, Significant(b.parameter, 4));
    if (b.sequence_changed)
      text += place + "an event grazes, " + EventSequence(a.fixed_point.hop) + " becomes " +
              EventSequence(b.fixed_point.hop) + "\n";
    else if (b.near_grazing && !a.near_grazing)
      text += place + "an event is close to grazing from here on\n";
    if (a.fixed_point.stable() != b.fixed_point.stable())
      text += place + (b.fixed_point.stable() ? "stable" : "unstable") + " from here on\n";
  }
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
    const double value = ValueOf(run.hopper, DirectionOf(run.hopper, run.parameters[i]));
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

AlongRange ParseAlong(const std::string& text) {
  const std::size_t equals = text.find('='), colon = text.find(':', equals);
  if (equals != text.npos && colon != text.npos) {
    const auto low = ParseDouble(Trim(text.substr(equals + 1, colon - equals - 1)));
    const auto high = ParseDouble(Trim(text.substr(colon + 1)));
    if (equals > 0 && low && high && std::isfinite(*low) && std::isfinite(*high) && *low < *high)
      return {std::string(Trim(text.substr(0, equals))), *low, *high};
  }
  throw UsageError("--along: " + Printable(text) +
                   "; must be name=low:high in SI units, low below high, as kp=0.5:12");
}

std::string GaitRun::Failure() const {
  if (!HasStrides(hopper) && point.status == FixedPointStatus::kHopFails)
    return "no hop can be made from the start: " + std::string(SentenceOf(point.hop.outcome));
  if (HasStrides(hopper) && !map)
    return "the robot makes too few strides from its start: " +
           std::string(SentenceOf(own_outcome)) +
           "; search its clock with `hoplab optimize`, or try another initial state";
  if (HasStrides(hopper) && !point.found())
    return "no steady stride was found near the robot's run; search its clock with `hoplab "
           "optimize`, or try another initial state";
  if (!point.found())
    return "no fixed point was found near the start; try another initial state or --set "
           "controller.kp_N_s";
  return "";
}

namespace {

SectionState AsSection(const ApexState& state) { return state; }

void FindHop(GaitRun& run) {
  run.map = std::make_shared<ApexMap>(run.hopper);
  run.start = AsSection(StartApex(run.hopper));
  run.point = SearchFixedPoint(*run.map, run.start);
  const Trajectory own = Simulate(RequestOf(run.hopper));
  run.apexes = ApexSpeeds(own);
  if (IsComplete(own.outcome)) run.counted = ConvergenceTimeOf(run.apexes);
  if (run.point.found()) run.prediction = PredictHops(run.point, run.start);
}

void FindStride(GaitRun& run) {
  SteadyStride steady = FindSteadyStride(run.hopper);
  run.own_outcome = steady.start.outcome;
  run.own_strides = steady.start.strides;
  run.point = steady.point;
  if (!steady.start.map) return;
  run.start = steady.start.state;
  if (steady.point.found()) run.stride = MeasureStride(*steady.start.map, steady.point.state);
  run.map = std::make_shared<StrideMap>(std::move(*steady.start.map));
}

// What is followed must lie in its range.
std::optional<SensitivityDirection> DirectionAlong(const Hopper& hopper,
                                                   const std::optional<AlongRange>& along) {
  if (!along) return std::nullopt;
  const SensitivityDirection direction = DirectionOf(hopper, along->name);
  const double here = ValueOf(hopper, direction);
  if (direction.of == SensitivityDirection::Of::kInitialState || here < along->low ||
      here > along->high) {
    throw InputError({"--along", along->name + " = " + FormatDouble(here),
                      "must be a parameter whose value in the scenario lies in the range",
                      "Widen the range."});
  }
  return direction;
}

}  // namespace

GaitRun RunGait(const Hopper& hopper, const GaitOptions& options) {
  GaitRun run;
  run.hopper = hopper;
  run.along = options.along;
  run.parameters = ParameterNames(hopper);
  const std::optional<SensitivityDirection> along = DirectionAlong(hopper, options.along);
  const auto stage = [&](const std::string& text) {
    if (options.stage) options.stage(text);
  };
  const bool strides = HasStrides(hopper);
  stage("searching the fixed point");
  if (strides)
    FindStride(run);
  else
    FindHop(run);
  if (run.map) run.components = run.map->Components(run.start);
  if (!run.point.found()) return run;
  stage("differentiating the spectral radius");
  // A stride takes longer than a hop, and three levels tell six digits.
  const int levels = strides ? 3 : kRadiusLevels;
  run.rates.resize(run.parameters.size());
  ParallelFor(static_cast<int>(run.parameters.size()), options.jobs, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    if (options.stop && *options.stop) return;
    run.rates[at] = DifferentiateSpectralRadius(*run.map, run.point,
                                                DirectionOf(hopper, run.parameters[at]), levels);
  });
  if (along) {
    stage("following the fixed point along " + options.along->name);
    ContinuationOptions continuation{.low = options.along->low, .high = options.along->high};
    if (strides) continuation.fixed_point.tolerance = kStrideResidual;
    continuation.stop = options.stop;
    run.branch = FollowFixedPoint(*run.map, run.point, *along, continuation);
  }
  run.interrupted = options.stop && *options.stop;
  return run;
}

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
