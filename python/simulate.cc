#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/records/simulation_record.h"
#include "app/runs/sensitivity_direction.h"
#include "base/input_error.h"
#include "base/range.h"
#include "base/text.h"
#include "datasets/read_scenario.h"
#include "fitting/generate.h"
#include "fitting/model_of_spec.h"
#include "python/bindings.h"
#include "python/convert.h"

namespace hoplab::python {
namespace {

constexpr double kRate = 1000.0;  // Hz, where the caller gives no times

ScenarioDocument DocumentOf(const py::dict& options) {
  const auto file = Option<std::string>(options, "file");
  ScenarioDocument document =
      file.empty() ? ScenarioDocument::FromText(Option<std::string>(options, "text"), "scenario")
                   : ScenarioDocument::FromFile(file);
  for (const auto& [key, value] :
       Option<std::vector<std::pair<std::string, std::string>>>(options, "set"))
    document.Set(key, value);
  return document;
}

std::vector<ParameterId> IdsOf(MechanismKind mechanism, LegMass mass,
                               const Parameters<double>& parameters) {
  const auto of = ParametersOf(mechanism), toe = ToeParameters();
  std::vector<ParameterId> ids(of.begin(), of.end());
  std::erase_if(ids, [&](ParameterId id) { return !IsOfLegs(id, parameters); });
  if (mass == LegMass::kAtToe) ids.insert(ids.end(), toe.begin(), toe.end());
  return ids;
}

void SetParameters(const std::map<std::string, double>& values, const std::vector<ParameterId>& ids,
                   Parameters<double>& parameters) {
  std::vector<std::string> known;
  for (const ParameterId id : ids) known.emplace_back(InfoOf(id).name);
  for (const auto& [name, value] : values) {
    const std::optional<ParameterId> id = FindParameter(name);
    if (!id || std::find(ids.begin(), ids.end(), *id) == ids.end())
      throw InputError({"parameters", Printable(name), "is no parameter of this hopper",
                        DidYouMean(name, known)});
    const ParameterInfo& info = InfoOf(*id);
    const Range range = {info.lower, info.upper, false, false, info.unit.data()};
    if (!range.Contains(value))
      throw InputError({"parameters", name + " = " + FormatDouble(value),
                        "must be in " + range.Text(), RangeRemedy(value, range)});
    Field(parameters, *id) = value;
  }
}

std::vector<Channel> ChannelsOf(const py::dict& options, MechanismKind mechanism) {
  std::vector<Channel> channels;
  std::vector<std::string> known;
  std::vector<Channel> of_hoppers = RecordedChannels();
  std::erase_if(of_hoppers, IsRobotChannel);
  for (const Channel channel : of_hoppers) known.emplace_back(NameOf(channel));
  const auto wanted = Option<std::optional<std::vector<std::string>>>(options, "channels");
  if (wanted) {
    for (const std::string& name : *wanted) {
      const std::optional<Channel> channel = ChannelFromName(name);
      if (!channel)
        throw InputError({"channels", Printable(name), "is no channel", DidYouMean(name, known)});
      channels.push_back(*channel);
    }
    return channels;
  }
  for (const Channel channel : of_hoppers) {
    const bool of_every_mechanism = channel <= Channel::kBodyVy || channel == Channel::kContact;
    if (of_every_mechanism || mechanism != MechanismKind::kBall) channels.push_back(channel);
  }
  return channels;
}

// Everything this run can be differentiated by.
std::vector<std::string> AllDirections(const std::vector<ParameterId>& ids,
                                       const std::vector<EffectSetting>& effects) {
  std::vector<std::string> names;
  for (const ParameterId id : ids) names.emplace_back(InfoOf(id).name);
  for (const EffectSetting& setting : effects) {
    for (const EffectParameter& p : setting.effect->info.parameters)
      names.push_back(std::string(setting.effect->info.name) + "." + std::string(p.name));
  }
  names.insert(names.end(), {"x0", "y0", "vx0", "vy0"});
  return names;
}

// Times at the default rate to the end of the run.
std::vector<double> DefaultTimes(const Trajectory& run) {
  std::vector<double> times;
  const double end = std::isfinite(run.end_time) ? run.end_time : 0.0;
  for (long row = 0; static_cast<double>(row) / kRate <= end; ++row)
    times.push_back(static_cast<double>(row) / kRate);
  return times;
}

py::dict ResultOf(const SimulationRequest& request, const Trajectory& run,
                  const Trajectory& sampled, const std::vector<std::string>& directions) {
  Json record = Json::object();
  AddSimulation(request, run, directions, record);
  const auto rows = static_cast<py::ssize_t>(request.row_times.size());
  const auto channels = static_cast<py::ssize_t>(request.channels.size());
  const auto width = static_cast<py::ssize_t>(directions.size());
  const auto events = static_cast<py::ssize_t>(run.events.size());
  const std::vector<double> times(request.row_times.begin(), request.row_times.end());
  std::vector<std::string> names;
  for (const Channel channel : request.channels) names.emplace_back(NameOf(channel));

  py::dict out;
  out["record"] = PythonOf(record);
  out["time_s"] = ArrayOf(times, {rows});
  out["channel_names"] = names;
  out["parameter_names"] = directions;
  out["samples"] = ArrayOf(sampled.samples, {rows, channels});
  out["sensitivities"] = py::none();
  out["event_time_sensitivities"] = py::none();
  if (width > 0) {
    out["sensitivities"] = ArrayOf(sampled.sensitivities, {rows, channels, width});
    out["event_time_sensitivities"] = ArrayOf(run.event_time_sensitivities, {events, width});
  }
  return out;
}

py::dict SimulationOf(const py::dict& options) {
  const Scenario scenario = DocumentOf(options).Read();
  const MechanismKind mechanism = scenario.mechanism.type;
  const LegMass mass = LegMassOfSpec(scenario.mechanism);
  const Law law = ResolveLaw(scenario.law.value_or(""), mechanism, scenario.law_origin.place);
  const std::vector<DrivenInput> inputs = DrivenInputsOf(scenario);
  const std::vector<EffectSetting> effects = ResolveEffects(
      scenario.effects, law, mass, KindsOf(inputs), RobotLegsOfSpec(scenario.mechanism));
  SimulationRequest request = RequestOfScenario(scenario, effects, inputs);
  request.integrator = IntegratorOf(options);
  const std::vector<ParameterId> ids = IdsOf(mechanism, mass, request.parameters);
  SetParameters(Option<std::map<std::string, double>>(options, "parameters"), ids,
                request.parameters);

  const auto wanted = Option<std::optional<std::vector<std::string>>>(options, "sensitivities");
  const std::vector<std::string> names = wanted ? *wanted : AllDirections(ids, effects);
  std::vector<SensitivityDirection> directions;
  for (const std::string& name : names)
    directions.push_back(ResolveDirection(name, request, mass, effects));
  const std::vector<Channel> channels = ChannelsOf(options, mechanism);
  std::optional<std::vector<double>> times;
  if (!options["times"].is_none()) times = VectorOf(Option<DoubleArray>(options, "times"));

  // Events and the end are those of the run without rows, as the command makes it: rows move the
  // last digits.
  request.directions = directions;
  Trajectory run, sampled;
  {
    const py::gil_scoped_release unlocked;
    Simulate(request, run);
    if (!times) times = DefaultTimes(run);
    request.row_times = *times;
    request.channels = channels;
    Simulate(request, sampled);
  }
  return ResultOf(request, run, sampled, names);
}

}  // namespace

void BindSimulate(py::module_& m) { m.def("simulate", &SimulationOf); }

}  // namespace hoplab::python
