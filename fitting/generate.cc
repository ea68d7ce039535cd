#include "fitting/generate.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/random.h"
#include "base/text.h"
#include "fitting/generated_channels.h"
#include "fitting/model_of_spec.h"
#include "fitting/run_end.h"
#include "model/pose_filter.h"

namespace hoplab {
namespace {

constexpr double kDefaultRate = 500.0;  // Hz

std::vector<GenerateTrial> TrialsOfScenario(const Scenario& scenario) {
  if (scenario.dataset) return scenario.dataset->trials;
  GenerateTrial trial;
  trial.file = "train-1.csv";
  trial.touchdown_angle_rad = scenario.touchdown_angle_rad;
  trial.touchdown_angles_rad = scenario.touchdown_angles_rad;
  trial.initial = scenario.initial;
  trial.controller = scenario.controller;
  trial.mechanism = scenario.mechanism;
  return {trial};
}

double HorizonOf(const Scenario& scenario) {
  if (scenario.stop.time_s) return *scenario.stop.time_s;
  if (scenario.stop.hops) return 60.0;  // s; the hops end it long before
  throw InputError({scenario.origin.place, "stop", "is absent: when does the run end?",
                    "Add `stop: {time_s: 2}` or `stop: {hops: 3}`."});
}

int Touchdowns(const Trajectory& run) {
  return static_cast<int>(std::count_if(run.events.begin(), run.events.end(), [](const Event& e) {
    return e.kind == EventKind::kTouchdown;
  }));
}

// The inputs as a dataset names them: what they say, not by how much they were late or off.
std::vector<InputSpec> WrittenInputs(const Scenario& scenario) {
  std::vector<InputSpec> inputs;
  for (const ScenarioInput& input : scenario.inputs) {
    InputSpec written = input.spec;
    written.column = InfoOf(written.id).key;
    written.delay_s = 0.0;
    written.scale = 1.0;
    inputs.push_back(std::move(written));
  }
  return inputs;
}

// The columns that drove a run, as its log shows them: read at its rows, with their noise.
void WriteInputs(const Scenario& scenario, const std::vector<DrivenInput>& inputs,
                 RandomStream random, Trial& trial) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    InputSignal<double> logged(inputs[i], 0.0, 1.0);
    TraceColumn column{InfoOf(scenario.inputs[i].spec.id).key, {}};
    for (const double t : trial.trace.time_s) {
      logged.Seek(t);
      const double noise =
          scenario.inputs[i].sigma > 0 ? scenario.inputs[i].sigma * random.Normal() : 0.0;
      column.values.push_back(logged.At(t) + noise);
    }
    trial.trace.columns.push_back(std::move(column));
  }
}

// What a log states of a run's touch-down angles: each off by a draw.
void MisstateAngles(double sigma_rad, const Trajectory& run, RandomStream random, Trial& trial) {
  trial.touchdown_angle_sigma_rad = sigma_rad;
  std::vector<double>& angles = trial.touchdown_angles_rad;
  if (angles.empty())
    angles.assign(static_cast<std::size_t>(std::max(Touchdowns(run), 1)),
                  trial.touchdown_angle_rad);
  for (double& angle : angles) angle += sigma_rad * random.Normal();
  trial.touchdown_angle_rad = angles.front();
}

}  // namespace

void CheckAngleEach(const std::vector<double>& angles, const Trajectory& run,
                    const std::string& place, const std::string& file) {
  const int touchdowns = Touchdowns(run);
  if (angles.empty() || touchdowns <= static_cast<int>(angles.size())) return;
  throw InputError(
      {place,
       (file.empty() ? "" : file + ": ") + "touchdown_angle_deg has " +
           std::to_string(angles.size()) + (angles.size() == 1 ? " angle" : " angles"),
       "the run touches down " + std::to_string(touchdowns) + " times, and each needs its own",
       "Add what is missing, or let the run stop before."});
}

InputSet KindsOf(const std::vector<DrivenInput>& inputs) {
  InputSet kinds = 0;
  for (const DrivenInput& input : inputs) kinds |= BitOf(input.kind);
  return kinds;
}

std::vector<DrivenInput> DrivenInputsOf(const Scenario& scenario) {
  std::vector<DrivenInput> inputs;
  for (const ScenarioInput& input : scenario.inputs)
    inputs.push_back({.kind = input.spec.id,
                      .times = input.time_s,
                      .values = input.values,
                      .held = input.spec.held,
                      .delay = input.spec.delay_s,
                      .scale = input.spec.scale});
  return inputs;
}

SimulationRequest RequestOfScenario(const Scenario& scenario,
                                    const std::vector<EffectSetting>& effects) {
  if (!scenario.inputs.empty() || !scenario.touchdown_angles_rad.empty())
    throw InputError(
        {scenario.origin.place, scenario.inputs.empty() ? "touchdown_angle_deg" : "inputs",
         "tells one run from its log, and this command makes runs of its own",
         "Use simulate or generate, or give one touchdown_angle_deg and a controller."});
  return RequestOfScenario(scenario, effects, {});
}

SimulationRequest RequestOfScenario(const Scenario& scenario,
                                    const std::vector<EffectSetting>& effects,
                                    const std::vector<DrivenInput>& inputs) {
  SimulationRequest request;
  const MechanismKind mechanism = scenario.mechanism.type;
  request.law = ResolveLaw(scenario.law.value_or(""), mechanism, scenario.law_origin.place);
  CheckReading(scenario.mechanism.reading, request.law, scenario.origin.place);
  request.liftoff = scenario.mechanism.liftoff;
  request.parameters =
      ParametersOfSpec(scenario.mechanism, scenario.controller, scenario.touchdown_angle_rad);
  if (scenario.start_angle_rad) request.parameters.start_angle = *scenario.start_angle_rad;
  request.effects = effects;
  request.initial = InitialOf(RequireInitial(scenario));
  request.start_mode = ModeOfSpec(scenario.initial->mode, scenario.mechanism.type);
  request.touchdown_angles = scenario.touchdown_angles_rad;
  request.inputs = inputs;
  request.horizon = HorizonOf(scenario);
  request.max_hops = scenario.stop.hops.value_or(0);
  return request;
}

namespace {

// What every trial of a dataset shares.
struct Recording {
  const Scenario& scenario;
  const GenerateOptions& options;
  Law law;
  std::vector<DrivenInput> inputs;
  std::vector<EffectSetting> effects;
  std::vector<ChannelSpec> channels;
  std::vector<Channel> wanted;
  std::vector<double> times;

  RandomStream Stream(std::size_t trial, std::size_t purpose) const {
    return RandomStream(options.seed, 1000 * (trial + 1) + purpose);
  }
};

Recording RecordingOf(const Scenario& scenario, const GenerateOptions& options,
                      const std::vector<GenerateTrial>& trials) {
  const MechanismKind mechanism = scenario.mechanism.type;
  Recording r{.scenario = scenario,
              .options = options,
              .law = ResolveLaw(scenario.law.value_or(""), mechanism, scenario.law_origin.place)};
  const bool any_toe_mass = std::any_of(
      trials.begin(), trials.end(),
      [](const GenerateTrial& trial) { return LegMassOfSpec(trial.mechanism) == LegMass::kAtToe; });
  r.inputs = DrivenInputsOf(scenario);
  r.effects =
      ResolveEffects(scenario.effects, r.law, any_toe_mass ? LegMass::kAtToe : LegMass::kNone,
                     KindsOf(r.inputs), RobotLegsOfSpec(scenario.mechanism));
  r.channels = ChannelsToGenerate(scenario, options.noise);
  for (const ChannelSpec& c : r.channels) r.wanted.push_back(c.id);
  const double horizon = HorizonOf(scenario);
  const double rate =
      scenario.dataset ? scenario.dataset->sample_rate_hz.value_or(kDefaultRate) : kDefaultRate;
  for (long row = 0; static_cast<double>(row) / rate <= horizon * (1.0 + 1e-12); ++row)
    r.times.push_back(static_cast<double>(row) / rate);
  return r;
}

// A dataset without trials.
Dataset HeadOf(const Recording& r) {
  const Scenario& scenario = r.scenario;
  Dataset dataset;
  dataset.name =
      scenario.dataset && scenario.dataset->name ? *scenario.dataset->name : scenario.name;
  dataset.title = scenario.dataset && scenario.dataset->title
                      ? *scenario.dataset->title
                      : "Generated from the scenario " + scenario.name;
  dataset.source = {SourceKind::kSimulated, "hoplab generate", "",
                    "law " + std::string(NameOf(r.law)) + ", seed " +
                        std::to_string(r.options.seed) + ", integrator " +
                        std::string(NameOf(r.options.integrator.kind))};
  dataset.mechanism = scenario.mechanism;
  dataset.controller = scenario.controller;
  dataset.channels = r.channels;
  dataset.inputs = WrittenInputs(scenario);
  return dataset;
}

Trajectory RunOf(const Recording& r, const GenerateTrial& plan, const StateSpec& truth) {
  SimulationRequest request;
  request.law = r.law;
  CheckReading(plan.mechanism.reading, r.law, r.scenario.origin.place);
  request.liftoff = plan.mechanism.liftoff;
  request.parameters = ParametersOfSpec(plan.mechanism, plan.controller, plan.touchdown_angle_rad);
  request.effects = r.effects;
  request.initial = InitialOf(truth);
  request.start_mode = ModeOfSpec(truth.mode, plan.mechanism.type);
  request.touchdown_angles = plan.touchdown_angles_rad;
  request.inputs = r.inputs;
  request.horizon = HorizonOf(r.scenario);
  if (!PoseFiltersOf(r.effects).empty()) request.horizon += kFilterMargin;
  request.max_hops = r.scenario.stop.hops.value_or(0);
  request.row_times = r.times;
  request.channels = r.wanted;
  request.integrator = r.options.integrator;
  Trajectory run = Simulate(request);
  CheckAngleEach(plan.touchdown_angles_rad, run, r.scenario.origin.place, plan.file);
  return run;
}

// How many rows the run has, some of their channels at least; a note where it ends before its time.
std::size_t RowsOf(const Recording& r, const GenerateTrial& plan, const StateSpec& truth,
                   const Trajectory& run, std::vector<std::string>& notes) {
  const auto has_samples = [&](std::size_t row) {
    const auto first = run.samples.begin() + static_cast<std::ptrdiff_t>(row * r.wanted.size());
    return std::any_of(first, first + static_cast<std::ptrdiff_t>(r.wanted.size()),
                       [](double sample) { return std::isfinite(sample); });
  };
  std::size_t rows = 0;
  while (rows < r.times.size() && r.times[rows] <= run.end_time && has_samples(rows)) ++rows;
  const std::string end =
      WhyEnded(run, r.effects, InitialOf(truth)) + " at " + FormatDouble(run.end_time) + " s";
  if (rows < 2) {
    throw InputError({r.scenario.origin.place, plan.file,
                      "cannot be generated: the simulation " + end,
                      "Start higher, or check touchdown_angle_deg and the leg's values."});
  }
  if (!IsComplete(run.outcome))
    notes.push_back(plan.file + ": " + end + "; " + std::to_string(rows) + " of " +
                    std::to_string(r.times.size()) + " rows written");
  return rows;
}

// One stream a trial and channel: leaving one out does not change the others.
std::vector<TraceColumn> NoisyColumns(const Recording& r, const Trajectory& run, std::size_t rows,
                                      std::size_t trial) {
  const std::vector<PoseFilter> filters = PoseFiltersOf(r.effects);
  std::vector<TraceColumn> columns;
  for (std::size_t c = 0; c < r.channels.size(); ++c) {
    RandomStream random = r.Stream(trial, c);
    std::vector<double> values(rows, 0.0);
    if (!IsContact(r.channels[c].id))
      for (double& value : values) value = *r.channels[c].sigma * random.Normal();
    for (const PoseFilter& filter : filters)
      if (IsFiltered(r.channels[c].id))
        values = ThroughFilter(filter, std::span(r.times).first(rows), values);
    for (std::size_t row = 0; row < rows; ++row)
      values[row] += run.samples[row * r.wanted.size() + c];
    columns.push_back({ChannelName(r.channels[c].id), std::move(values)});
  }
  return columns;
}

// The start as it is stated where it is known within `known`.
StateSpec StatedStart(const StateSpec& truth, const StateSpec& known, RandomStream random) {
  Eigen::Vector4d stated = StateOfSpec(truth);
  const Eigen::Vector4d sigma = StateOfSpec(known);
  for (int k = 0; k < 4; ++k) {
    const double draw = random.Normal();
    if (std::isfinite(sigma[k])) stated[k] += sigma[k] * draw;
  }
  StateSpec start = SpecOfState(stated);
  start.mode = truth.mode;
  start.pitch_rad = truth.pitch_rad;
  start.pitch_rate_rad_per_s = truth.pitch_rate_rad_per_s;
  if (known.pitch_rad)
    start.pitch_rad = truth.pitch_rad.value_or(0.0) + *known.pitch_rad * random.Normal();
  if (known.pitch_rate_rad_per_s)
    start.pitch_rate_rad_per_s =
        truth.pitch_rate_rad_per_s.value_or(0.0) + *known.pitch_rate_rad_per_s * random.Normal();
  start.contact_x_m = truth.contact_x_m;
  if (truth.contact_x_m && known.contact_x_m)
    *start.contact_x_m += *known.contact_x_m * random.Normal();
  return start;
}

Trial RecordTrial(const Recording& r, const GenerateTrial& plan, std::size_t i,
                  std::vector<std::string>& notes) {
  const Scenario& scenario = r.scenario;
  const StateSpec truth = plan.initial ? *plan.initial : RequireInitial(scenario);
  const Trajectory run = RunOf(r, plan, truth);
  const std::size_t rows = RowsOf(r, plan, truth, run, notes);
  Trial trial;
  trial.file = plan.file;
  trial.role = plan.role;
  trial.touchdown_angle_rad = plan.touchdown_angle_rad;
  trial.touchdown_angles_rad = plan.touchdown_angles_rad;
  if (scenario.dataset && scenario.dataset->touchdown_angle_sigma_rad)
    MisstateAngles(*scenario.dataset->touchdown_angle_sigma_rad, run, r.Stream(i, 998), trial);
  trial.inputs = WrittenInputs(scenario);
  trial.mechanism = plan.mechanism;
  trial.controller = plan.controller;
  trial.trace.time_s.assign(r.times.begin(), r.times.begin() + static_cast<std::ptrdiff_t>(rows));
  trial.trace.columns = NoisyColumns(r, run, rows, i);
  WriteInputs(scenario, r.inputs, r.Stream(i, 997), trial);
  trial.initial = truth;
  if (scenario.dataset && scenario.dataset->initial_sigma) {
    StateSpec known = *scenario.dataset->initial_sigma;
    if (trial.mechanism.on_guide) known.vx_m_per_s = kFreeSigma;  // a guide leaves no doubt of it
    trial.initial = StatedStart(truth, known, r.Stream(i, 999));
    trial.initial_sigma = scenario.dataset->initial_sigma;
  }
  return trial;
}

}  // namespace

GeneratedDataset GenerateDataset(const Scenario& scenario, const GenerateOptions& options) {
  if (scenario.start_angle_rad)
    throw InputError({scenario.origin.place, "start_angle_deg",
                      "cannot go into a dataset, whose trials land at one angle each",
                      "Leave it out, or look at the run with simulate."});
  const std::vector<GenerateTrial> trials = TrialsOfScenario(scenario);
  const Recording recording = RecordingOf(scenario, options, trials);
  GeneratedDataset out;
  out.dataset = HeadOf(recording);
  for (std::size_t i = 0; i < trials.size(); ++i)
    out.dataset.trials.push_back(RecordTrial(recording, trials[i], i, out.notes));
  CheckGenerated(out.dataset, options.noise);
  return out;
}

}  // namespace hoplab
