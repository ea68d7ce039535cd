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

}  // namespace

SimulationRequest RequestOfScenario(const Scenario& scenario,
                                    const std::vector<EffectSetting>& effects) {
  SimulationRequest request;
  const MechanismKind mechanism = MechanismOfSpec(scenario.mechanism);
  request.law = ResolveLaw(scenario.law.value_or(""), mechanism, scenario.law_origin.place);
  CheckVariant(scenario.mechanism.variant, request.law, scenario.origin.place);
  request.liftoff = LiftoffOfSpec(scenario.mechanism);
  request.parameters =
      ParametersOfSpec(scenario.mechanism, scenario.controller, scenario.touchdown_angle_rad);
  request.effects = effects;
  request.initial = StateOfSpec(RequireInitial(scenario));
  request.horizon = HorizonOf(scenario);
  request.max_hops = scenario.stop.hops.value_or(0);
  return request;
}

GeneratedDataset GenerateDataset(const Scenario& scenario, const GenerateOptions& options) {
  const MechanismKind mechanism = MechanismOfSpec(scenario.mechanism);
  const Law law = ResolveLaw(scenario.law.value_or(""), mechanism, scenario.law_origin.place);
  const std::vector<GenerateTrial> trials = TrialsOfScenario(scenario);
  const bool any_toe_mass = std::any_of(
      trials.begin(), trials.end(),
      [](const GenerateTrial& trial) { return LegMassOfSpec(trial.mechanism) == LegMass::kAtToe; });
  const std::vector<EffectSetting> effects =
      ResolveEffects(scenario.effects, law, any_toe_mass ? LegMass::kAtToe : LegMass::kNone);
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
    request.initial = StateOfSpec(truth);
    request.horizon = horizon;
    request.max_hops = scenario.stop.hops.value_or(0);
    request.row_times = times;
    request.channels = wanted;
    request.integrator = options.integrator;
    const Trajectory run = Simulate(request);

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
    trial.mechanism = plan.mechanism;
    trial.controller = plan.controller;
    trial.trace.time_s.assign(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(rows));
    // One stream a trial and channel: leaving one out does not change the others.
    for (std::size_t c = 0; c < channels.size(); ++c) {
      RandomStream random(options.seed, 1000 * (i + 1) + c);
      TraceColumn column{ChannelName(channels[c].id), {}};
      const bool noisy = channels[c].id != ChannelId::kContact;
      for (std::size_t row = 0; row < rows; ++row) {
        const double value = run.samples[row * wanted.size() + c];
        column.values.push_back(noisy ? value + *channels[c].sigma * random.Normal() : value);
      }
      trial.trace.columns.push_back(std::move(column));
    }
    trial.initial = truth;
    if (scenario.dataset && scenario.dataset->initial_sigma) {
      RandomStream random(options.seed, 1000 * (i + 1) + 999);
      std::array<double, 4> stated = StateOfSpec(truth);
      const std::array<double, 4> sigma = StateOfSpec(*scenario.dataset->initial_sigma);
      for (int k = 0; k < 4; ++k) {
        const double draw = random.Normal();
        if (std::isfinite(sigma[k])) stated[k] += sigma[k] * draw;
      }
      trial.initial = SpecOfState(stated);
      trial.initial_sigma = scenario.dataset->initial_sigma;
    }
    dataset.trials.push_back(std::move(trial));
  }
  return out;
}

}  // namespace hoplab
