#include "fitting/generate.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/random.h"
#include "base/text.h"
#include "fitting/model_of_spec.h"

namespace hoplab {
namespace {

constexpr double kDefaultRate = 500.0;  // Hz

std::vector<ChannelSpec> ChannelsOf(const Scenario& scenario, const GenerateOptions& options) {
  std::vector<ChannelSpec> channels;
  if (scenario.dataset) channels = scenario.dataset->channels;
  if (channels.empty()) {
    channels.push_back({ChannelId::kBodyX, 0.001});
    channels.push_back({ChannelId::kBodyY, 0.001});
  }
  for (ChannelSpec& c : channels) {
    if (options.noise) c.sigma = *options.noise;
    if (!c.sigma)
      throw InputError({c.origin.place, std::string(ChannelName(c.id)) + ": {sigma: estimate}",
                        "a dataset to generate needs the noise itself", "State sigma."});
  }
  return channels;
}

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
    written.column = InputName(written.id);
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
    TraceColumn column{InputName(scenario.inputs[i].spec.id), {}};
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
    inputs.push_back({.kind = static_cast<InputKind>(input.spec.id),
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
  const MechanismKind mechanism = MechanismOfSpec(scenario.mechanism);
  request.law = ResolveLaw(scenario.law.value_or(""), mechanism, scenario.law_origin.place);
  CheckVariant(scenario.mechanism.variant, request.law, scenario.origin.place);
  request.liftoff = LiftoffOfSpec(scenario.mechanism);
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

GeneratedDataset GenerateDataset(const Scenario& scenario, const GenerateOptions& options) {
  if (scenario.start_angle_rad)
    throw InputError({scenario.origin.place, "start_angle_deg",
                      "cannot go into a dataset, whose trials land at one angle each",
                      "Leave it out, or look at the run with simulate."});
  const MechanismKind mechanism = MechanismOfSpec(scenario.mechanism);
  const Law law = ResolveLaw(scenario.law.value_or(""), mechanism, scenario.law_origin.place);
  const std::vector<GenerateTrial> trials = TrialsOfScenario(scenario);
  const bool any_toe_mass = std::any_of(
      trials.begin(), trials.end(),
      [](const GenerateTrial& trial) { return LegMassOfSpec(trial.mechanism) == LegMass::kAtToe; });
  const std::vector<DrivenInput> inputs = DrivenInputsOf(scenario);
  const std::vector<EffectSetting> effects =
      ResolveEffects(scenario.effects, law, any_toe_mass ? LegMass::kAtToe : LegMass::kNone,
                     KindsOf(inputs), RobotLegsOfSpec(scenario.mechanism));
  const std::vector<ChannelSpec> channels = ChannelsOf(scenario, options);
  const double horizon = HorizonOf(scenario);
  const double rate =
      scenario.dataset ? scenario.dataset->sample_rate_hz.value_or(kDefaultRate) : kDefaultRate;

  GeneratedDataset out;
  Dataset& dataset = out.dataset;
  dataset.name =
      scenario.dataset && scenario.dataset->name ? *scenario.dataset->name : scenario.name;
  dataset.title = scenario.dataset && scenario.dataset->title
                      ? *scenario.dataset->title
                      : "Generated from the scenario " + scenario.name;
  dataset.source = {SourceKind::kSimulated, "hoplab generate", "",
                    "law " + std::string(NameOf(law)) + ", seed " + std::to_string(options.seed) +
                        ", integrator " + std::string(NameOf(options.integrator.kind))};
  dataset.mechanism = scenario.mechanism;
  dataset.controller = scenario.controller;
  dataset.channels = channels;
  dataset.inputs = WrittenInputs(scenario);

  std::vector<Channel> wanted;
  for (const ChannelSpec& c : channels) wanted.push_back(ChannelOfSpec(c.id));
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const GenerateTrial& plan = trials[i];
    const StateSpec truth = plan.initial ? *plan.initial : RequireInitial(scenario);
    std::vector<double> times;
    for (long row = 0; static_cast<double>(row) / rate <= horizon * (1.0 + 1e-12); ++row)
      times.push_back(static_cast<double>(row) / rate);

    SimulationRequest request;
    request.law = law;
    CheckVariant(plan.mechanism.variant, law, scenario.origin.place);
    request.liftoff = LiftoffOfSpec(plan.mechanism);
    request.parameters =
        ParametersOfSpec(plan.mechanism, plan.controller, plan.touchdown_angle_rad);
    request.effects = effects;
    request.initial = InitialOf(truth);
    request.start_mode = ModeOfSpec(truth.mode, plan.mechanism.type);
    request.touchdown_angles = plan.touchdown_angles_rad;
    request.inputs = inputs;
    request.horizon = horizon;
    request.max_hops = scenario.stop.hops.value_or(0);
    request.row_times = times;
    request.channels = wanted;
    request.integrator = options.integrator;
    const Trajectory run = Simulate(request);
    CheckAngleEach(plan.touchdown_angles_rad, run, scenario.origin.place, plan.file);

    std::size_t rows = 0;
    while (rows < times.size() && times[rows] <= run.end_time &&
           std::isfinite(run.samples[rows * wanted.size()]))
      ++rows;
    if (rows < 2) {
      throw InputError({scenario.origin.place, plan.file,
                        "cannot be generated: the simulation " +
                            std::string(SentenceOf(run.outcome)) + " at " +
                            FormatDouble(run.end_time) + " s",
                        "Start higher, or check touchdown_angle_deg and the leg's values."});
    }
    if (!IsComplete(run.outcome)) {
      out.notes.push_back(plan.file + ": " + std::string(SentenceOf(run.outcome)) + " at " +
                          FormatDouble(run.end_time) + " s; " + std::to_string(rows) + " of " +
                          std::to_string(times.size()) + " rows written");
    }

    Trial trial;
    trial.file = plan.file;
    trial.role = plan.role;
    trial.touchdown_angle_rad = plan.touchdown_angle_rad;
    trial.touchdown_angles_rad = plan.touchdown_angles_rad;
    if (scenario.dataset && scenario.dataset->touchdown_angle_sigma_rad)
      MisstateAngles(*scenario.dataset->touchdown_angle_sigma_rad, run,
                     RandomStream(options.seed, 1000 * (i + 1) + 998), trial);
    trial.inputs = dataset.inputs;
    trial.mechanism = plan.mechanism;
    trial.controller = plan.controller;
    trial.trace.time_s.assign(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(rows));
    // One stream a trial and channel: leaving one out does not change the others.
    for (std::size_t c = 0; c < channels.size(); ++c) {
      RandomStream random(options.seed, 1000 * (i + 1) + c);
      TraceColumn column{ChannelName(channels[c].id), {}};
      const bool noisy = !IsContact(channels[c].id);
      for (std::size_t row = 0; row < rows; ++row) {
        const double value = run.samples[row * wanted.size() + c];
        column.values.push_back(noisy ? value + *channels[c].sigma * random.Normal() : value);
      }
      trial.trace.columns.push_back(std::move(column));
    }
    WriteInputs(scenario, inputs, RandomStream(options.seed, 1000 * (i + 1) + 997), trial);
    trial.initial = truth;
    if (scenario.dataset && scenario.dataset->initial_sigma) {
      RandomStream random(options.seed, 1000 * (i + 1) + 999);
      Eigen::Vector4d stated = StateOfSpec(truth);
      const StateSpec& known = *scenario.dataset->initial_sigma;
      const Eigen::Vector4d sigma = StateOfSpec(known);
      for (int k = 0; k < 4; ++k) {
        const double draw = random.Normal();
        if (std::isfinite(sigma[k])) stated[k] += sigma[k] * draw;
      }
      trial.initial = SpecOfState(stated);
      trial.initial->mode = truth.mode;
      trial.initial->pitch_rad = truth.pitch_rad;
      trial.initial->pitch_rate_rad_per_s = truth.pitch_rate_rad_per_s;
      if (known.pitch_rad)
        trial.initial->pitch_rad =
            truth.pitch_rad.value_or(0.0) + *known.pitch_rad * random.Normal();
      if (known.pitch_rate_rad_per_s)
        trial.initial->pitch_rate_rad_per_s = truth.pitch_rate_rad_per_s.value_or(0.0) +
                                              *known.pitch_rate_rad_per_s * random.Normal();
      trial.initial->contact_x_m = truth.contact_x_m;
      if (truth.contact_x_m && known.contact_x_m)
        *trial.initial->contact_x_m += *known.contact_x_m * random.Normal();
      trial.initial_sigma = scenario.dataset->initial_sigma;
    }
    dataset.trials.push_back(std::move(trial));
  }
  return out;
}

}  // namespace hoplab
