#include "experiments/identification/steady_hop.h"

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

constexpr int kHopsToLook = 12;   // from which Newton's method starts
constexpr int kNewtonSteps = 12;  // it is near, or it is not
constexpr int kRealHops = 3;      // before the linear map takes over
constexpr double kNear = 1e-7;    // m/s and m: a search integrates no better

// The first hops of the controlled run.
Trajectory FirstHops(const StudyHopper& hopper, const ControlledSettings& settings, int hops) {
  SimulationRequest request = ControlledRequest(hopper, settings);
  const std::vector<EffectSetting> effects = EffectsOf(hopper);
  request.effects = effects;
  request.max_hops = hops;
  return Simulate(request);
}

// Time from an apex down to the height of touch-down [s], and about that up to one from a lift-off.
double FallTime(const Parameters<double>& p, double height) {
  const double touchdown =
      p.theta_td > 0.0 ? p.r * (1.0 + std::cos(p.theta_td)) : 2.0 * p.r * std::cos(p.theta_td);
  return std::sqrt(2.0 * std::max(height - touchdown, 0.0) / p.g);
}

// The hops after the last one of `speeds`, which ends at `last`, by the linear map; a hop is longer
// than the steady one by what its two half flights are.
void AddPredictedHops(const Parameters<double>& p, const FixedPoint& point, const Event& last,
                      SpeedHistory& speeds) {
  const ApexState steady = point.state;
  const double fall = FallTime(p, steady[1]), mean = point.hop.advance / point.hop.period;
  ApexState off(last.vx - steady[0], last.y - steady[1]);
  double apex = last.time;
  while (true) {
    const double before = FallTime(p, steady[1] + off[1]);
    off = point.hop.jacobian * off;
    const double after = FallTime(p, steady[1] + off[1]);
    apex += point.hop.period + before - fall + after - fall;
    if (!(apex <= kControlledTime)) return;
    const double vx = steady[0] + off[0];
    speeds.apex.push_back({apex, vx});
    speeds.flight.push_back({apex - after, vx});
    // The mean speed of a hop differs from that of its apex by what it does in the steady one.
    speeds.hop_mean.push_back({apex, vx + mean - steady[0]});
  }
}

}  // namespace

SteadyHop FindSteadyHop(const StudyHopper& hopper, double modulus_Pa, double damping_N_s_per_m) {
  const ControlledSettings settings{.modulus_Pa = modulus_Pa,
                                    .damping_N_s_per_m = damping_N_s_per_m};
  SteadyHop steady;
  const Trajectory run = FirstHops(hopper, settings, kHopsToLook);
  steady.start.outcome = run.outcome;
  steady.start.end_time_s = run.end_time;
  if (!IsComplete(run.outcome) || run.events.empty()) return steady;
  ApexMap map({ControlledRequest(hopper, settings), EffectsOf(hopper)});
  FixedPointOptions options;
  options.max_iterations = kNewtonSteps;
  options.tolerance = kNear;
  const Event& last = run.events.back();
  steady.point = FindFixedPoint(map, ApexState(last.vx, last.y), options);
  return steady;
}

ControlledRun PredictControlled(const StudyHopper& hopper, const ControlledSettings& settings,
                                const FixedPoint& point, const RunWants& wants) {
  const Trajectory run = FirstHops(hopper, settings, kRealHops);
  ControlledRun out;
  out.outcome = run.outcome;
  out.end_time_s = run.end_time;
  if (!IsComplete(run.outcome)) return out;
  out.speeds = SpeedHistoryOf(run, 0.0, {}, {});
  out.fixed_speed_m_per_s = point.state[0];
  SimulationRequest request = ControlledRequest(hopper, settings);
  if (run.outcome == Outcome::kHopLimit)
    AddPredictedHops(request.parameters, point, run.events.back(), out.speeds);
  out.outcome = Outcome::kCompleted;
  out.end_time_s = kControlledTime;
  if (!wants.stiffness) return out;
  const std::vector<EffectSetting> effects = EffectsOf(hopper);
  request.effects = effects;
  if (const auto range = StiffnessFromApex(request, point.state[0], point.state[1], 1)) {
    out.k_min_N_per_m = range->low;
    out.k_max_N_per_m = range->high;
  }
  return out;
}

}  // namespace hoplab
