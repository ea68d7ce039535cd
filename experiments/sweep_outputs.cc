#include "experiments/sweep_outputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/input_error.h"
#include "base/nan.h"
#include "base/text.h"
#include "experiments/leg_stiffness.h"
#include "optimize/convergence_time.h"
#include "optimize/search_point.h"

namespace hoplab {
namespace {

constexpr double kSampleStep = 1e-3;  // s
constexpr std::array kSampled = {Channel::kContact, Channel::kLegAngle, Channel::kLegLength,
                                 Channel::kHipTorque};

// A run and what is derived from it, each thing once.
struct Results {
  const Hopper& hopper;
  SimulationRequest request;
  Trajectory run;
  ConvergenceTime convergence;
  std::optional<FixedPoint> steady;
  double stiffness_min = kNaN, stiffness_max = kNaN;  // N/m
  double torque_max = kNaN;                           // N m
};

void ReadSamples(Results& results) {
  const std::vector<double>& samples = results.run.samples;
  for (std::size_t row = 0; row + kSampled.size() <= samples.size(); row += kSampled.size()) {
    if (samples[row] != 1.0) continue;  // in flight, or past the end
    const double stiffness = StanceStiffness(results.request, samples[row + 1], samples[row + 2]);
    results.stiffness_min = std::fmin(results.stiffness_min, stiffness);
    results.stiffness_max = std::fmax(results.stiffness_max, stiffness);
    results.torque_max = std::fmax(results.torque_max, std::abs(samples[row + 3]));
  }
}

const Event* LastApex(const Trajectory& run) {
  for (std::size_t i = run.events.size(); i-- > 0;) {
    if (run.events[i].kind == EventKind::kApex) return &run.events[i];
  }
  return nullptr;
}

double LastApexHeight(const Results& r) {
  const Event* apex = LastApex(r.run);
  return apex ? apex->y : kNaN;
}

double LastApexSpeed(const Results& r) {
  const Event* apex = LastApex(r.run);
  return apex ? apex->vx : kNaN;
}

double EnergyAt(const Results& r, double y, double vx, double vy) {
  const std::array<double, 5> state = {0.0, y, vx, vy, 0.0};
  return Energy(r.request, Mode::kFlight, state);
}

double EnergyPercent(const Results& r) {
  const Event* apex = LastApex(r.run);
  if (!apex) return kNaN;
  const auto& s = r.request.initial;
  return 100.0 * EnergyAt(r, apex->y, apex->vx, apex->vy) / EnergyAt(r, s[1], s[2], s[3]);
}

// The state of a hopper's apex begins with vx and y, that of a robot's section with y and vx.
bool IsOfARobot(const Results& r) { return static_cast<bool>(r.request.parameters.robot); }
double SteadyState(const Results& r, Eigen::Index i) {
  return r.steady->found() ? r.steady->state[i] : kNaN;
}

double BandPercent(const Results& r) {
  if (!r.convergence.converged()) return kNaN;
  return r.convergence.band == ConvergenceTime::Band::kOnePercent ? 1.0 : 2.0;
}

// A column and how it is read off the results.
struct Column {
  SweepOutput output;
  double (*value)(const Results&);
};

const std::vector<Column>& Columns() {
  using R = const Results&;
  static const std::vector<Column> columns = {
      {{"convergence_time_s", "s"}, [](R r) { return r.convergence.time; }},
      {{"convergence_hops", ""},
       [](R r) {
         return r.convergence.converged() ? static_cast<double>(r.convergence.hops) : kNaN;
       }},
      {{"convergence_band_percent", "%"}, BandPercent},
      {{"steady_speed_m_per_s", "m/s"}, [](R r) { return r.convergence.steady_speed; }},
      {{"hops", ""}, [](R r) { return static_cast<double>(r.run.hops); }},
      {{"end_time_s", "s"}, [](R r) { return r.run.end_time; }},
      {{"end_x_m", "m"}, [](R r) { return r.run.final_state[0]; }},
      {{"apex_height_m", "m"}, LastApexHeight},
      {{"apex_speed_m_per_s", "m/s"}, LastApexSpeed},
      {{"energy_percent", "%"}, EnergyPercent},
      {{"max_flexure", ""}, [](R r) { return r.run.max_deflection_ratio; }},
      {{"stiffness_min_N_per_m", "N/m", true}, [](R r) { return r.stiffness_min; }},
      {{"stiffness_max_N_per_m", "N/m", true}, [](R r) { return r.stiffness_max; }},
      {{"max_torque_N_m", "N m", true}, [](R r) { return r.torque_max; }},
      {{"fixed_point_vx_m_per_s", "m/s", false, true},
       [](R r) { return SteadyState(r, IsOfARobot(r) ? 1 : 0); }},
      {{"fixed_point_y_m", "m", false, true},
       [](R r) { return SteadyState(r, IsOfARobot(r) ? 0 : 1); }},
      {{"period_s", "s", false, true},
       [](R r) { return r.steady->found() ? r.steady->hop.period : kNaN; }},
      {{"spectral_radius", "", false, true}, [](R r) { return r.steady->spectral_radius; }}};
  return columns;
}

// These are still true of a run that ended early.
bool SurvivesAFall(std::string_view name) {
  constexpr std::array<std::string_view, 7> kNames = {"hops",
                                                      "end_time_s",
                                                      "end_x_m",
                                                      "max_flexure",
                                                      "stiffness_min_N_per_m",
                                                      "stiffness_max_N_per_m",
                                                      "max_torque_N_m"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

}  // namespace

const std::vector<SweepOutput>& AllSweepOutputs() {
  static const std::vector<SweepOutput> outputs = [] {
    std::vector<SweepOutput> all;
    for (const Column& column : Columns()) all.push_back(column.output);
    return all;
  }();
  return outputs;
}

const SweepOutput& ResolveSweepOutput(const std::string& name, const std::string& place) {
  std::vector<std::string> known;
  for (const SweepOutput& output : AllSweepOutputs()) {
    if (output.name == name) return output;
    known.emplace_back(output.name);
  }
  throw InputError(
      {place, "sweep.outputs: " + Printable(name), "is no output", DidYouMean(name, known)});
}

SweepRow ComputeSweepRow(const Hopper& hopper, const std::vector<const SweepOutput*>& outputs) {
  const auto wanted = [&](bool SweepOutput::*need) {
    return std::any_of(outputs.begin(), outputs.end(),
                       [&](const SweepOutput* output) { return output->*need; });
  };
  Results results{hopper, RequestOf(hopper)};
  SimulationRequest request = results.request;
  std::vector<double> rows;
  if (wanted(&SweepOutput::needs_stance_samples)) {
    for (int i = 0; i * kSampleStep <= request.horizon; ++i) rows.push_back(i * kSampleStep);
    request.row_times = rows;
    request.channels = kSampled;
  }
  results.run = Simulate(request);
  const bool complete = IsComplete(results.run.outcome);
  if (complete) results.convergence = ConvergenceTimeOf(ApexSpeeds(results.run));
  ReadSamples(results);
  // A leg with a toe mass has no return map of speed and height alone.
  if (wanted(&SweepOutput::needs_fixed_point))
    results.steady = hopper.request.parameters.m_toe > 0.0 ? FixedPoint{} : SteadyHop(hopper);

  SweepRow row;
  row.outcome = std::string(NameOf(results.run.outcome));
  if (!complete) row.reason = std::string(SentenceOf(results.run.outcome));
  for (const SweepOutput* output : outputs) {
    const auto column = std::find_if(Columns().begin(), Columns().end(), [&](const Column& c) {
      return c.output.name == output->name;
    });
    const bool known = complete || output->needs_fixed_point || SurvivesAFall(output->name);
    row.values.push_back(known ? column->value(results) : kNaN);
  }
  return row;
}

}  // namespace hoplab
