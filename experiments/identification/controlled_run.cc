#include "experiments/identification/controlled_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/units.h"
#include "experiments/leg_stiffness.h"
#include "optimize/apex_map.h"
#include "optimize/fixed_point.h"

namespace hoplab {
namespace {

using C = StudyConstant;

constexpr double kControlledAngle = DegToRad(40.0);
constexpr std::size_t kSteadyHops = 5;
constexpr double kInstantStep = 0.01;  // s
constexpr double kSettled = 60.0;      // s, of a run that has

// Rows over each stance after `begin`, ends included, as times after `begin`.
std::vector<double> StanceRows(const Trajectory& run, double begin) {
  constexpr int kRows = 40;
  constexpr double kInside = 1e-7;  // s: rows belong to the stance, not to what follows
  std::vector<double> rows;
  for (const Segment& s : run.segments) {
    if (s.mode == Mode::kFlight || s.begin < begin || s.end - s.begin < 4.0 * kInside) continue;
    const double first = s.begin - begin + kInside, last = s.end - begin - kInside;
    for (int i = 0; i <= kRows; ++i) rows.push_back(first + (last - first) * i / kRows);
  }
  return rows;
}

// The request's run again, with rows at `times`; the stiffness there where the leg stands.
std::optional<StiffnessRangeOfHops> StiffnessAt(SimulationRequest request,
                                                const std::vector<double>& times) {
  constexpr std::array kChannels = {Channel::kLegAngle, Channel::kLegLength, Channel::kContact};
  request.row_times = times;
  request.channels = kChannels;
  const Trajectory run = Simulate(request);
  if (!IsComplete(run.outcome)) return std::nullopt;
  StiffnessRangeOfHops range{std::numeric_limits<double>::infinity(), 0.0};
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double* row = &run.samples[i * kChannels.size()];
    if (!(row[2] > 0.5)) continue;
    const double k = StanceStiffness(request, row[0], row[1]);
    range = {std::min(range.low, k), std::max(range.high, k)};
  }
  if (range.high == 0.0) return std::nullopt;
  return range;
}

const Event* ApexBeforeLast(const Trajectory& run, std::size_t hops) {
  for (auto e = run.events.rbegin(); e != run.events.rend(); ++e) {
    if (e->kind == EventKind::kApex && hops-- == 0) return &*e;
  }
  return nullptr;
}

// The last five hops; a leg with a toe mass from the start, since its toe moves at an apex.
std::optional<StiffnessRangeOfHops> SteadyStiffness(const SimulationRequest& request,
                                                    const Trajectory& run) {
  const Event* from = ApexBeforeLast(run, kSteadyHops);
  if (from == nullptr) return std::nullopt;
  if (request.parameters.m_toe == 0.0)
    return StiffnessFromApex(request, from->vx, from->y, kSteadyHops);
  std::vector<double> rows = StanceRows(run, from->time);
  for (double& t : rows) t += from->time;
  return StiffnessAt(request, rows);
}

// Speed of the steady hop near the end of `run`. Apexes alone do not tell the next ones of a leg
// that swings: such a one runs on until it has settled.
double FixedSpeed(const StudyHopper& hopper, SimulationRequest request, const Trajectory& run) {
  const Event* last = ApexBeforeLast(run, 0);
  if (last == nullptr) return std::nan("");
  if (!HasToeMass(hopper)) {
    ApexMap map({request, EffectsOf(hopper)});
    const FixedPoint point = FindFixedPoint(map, ApexState(last->vx, last->y));
    return point.stable() ? point.state[0] : std::nan("");
  }
  request.horizon = kSettled;
  const std::vector<ApexSpeed> speeds = ApexSpeeds(Simulate(request));
  if (speeds.size() < kSteadyHops) return std::nan("");
  double sum = 0.0;
  for (std::size_t i = speeds.size() - kSteadyHops; i < speeds.size(); ++i) sum += speeds[i].vx;
  return sum / kSteadyHops;
}

}  // namespace

SimulationRequest ControlledRequest(const StudyHopper& hopper, const ControlledSettings& settings) {
  SimulationRequest request =
      RequestOf(hopper, settings.modulus_Pa, settings.damping_N_s_per_m, kControlledAngle);
  request.parameters.kp = At(hopper.constants, C::kGain);
  request.parameters.v_des = At(hopper.constants, C::kDesiredSpeed);
  request.initial = {0.0, settings.height_m, settings.speed_m_per_s, 0.0};
  request.horizon = kControlledTime;
  return request;
}

ControlledRun RunControlled(const StudyHopper& hopper, const ControlledSettings& settings,
                            const RunWants& wants) {
  SimulationRequest request = ControlledRequest(hopper, settings);
  const std::vector<EffectSetting> effects = EffectsOf(hopper);
  request.effects = effects;
  std::vector<double> times;
  static constexpr std::array kSpeedChannel = {Channel::kBodyVx};
  if (wants.instants) {
    for (int i = 0; i * kInstantStep <= request.horizon; ++i) times.push_back(i * kInstantStep);
    request.channels = kSpeedChannel;
  }
  request.row_times = times;
  const Trajectory run = Simulate(request);
  ControlledRun out;
  out.outcome = run.outcome;
  out.end_time_s = run.end_time;
  out.speeds = SpeedHistoryOf(run, request.initial[0], times, run.samples);
  request.row_times = {};
  request.channels = {};
  if (!IsComplete(run.outcome)) return out;
  if (wants.fixed_speed) out.fixed_speed_m_per_s = FixedSpeed(hopper, request, run);
  if (!wants.stiffness) return out;
  if (const auto range = SteadyStiffness(request, run)) {
    out.k_min_N_per_m = range->low;
    out.k_max_N_per_m = range->high;
  }
  return out;
}

std::optional<StiffnessRangeOfHops> StiffnessFromApex(SimulationRequest request, double vx,
                                                      double y, int hops) {
  request.initial = {0.0, y, vx, 0.0};
  request.parameters.start_angle = std::numeric_limits<double>::quiet_NaN();
  request.max_hops = hops;
  const Trajectory plain = Simulate(request);
  if (!IsComplete(plain.outcome)) return std::nullopt;
  return StiffnessAt(request, StanceRows(plain, 0.0));
}

}  // namespace hoplab
