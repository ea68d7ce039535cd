#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "model/effects/effect.h"
#include "tests/support/requests.h"

namespace hoplab::testing {

inline constexpr std::array kAllLaws = {
    Law::kThesis,   Law::kNoSlip,      Law::kConsistent, Law::kLargeDeflection,
    Law::kElastica, Law::kStraightLeg, Law::kBall};

inline constexpr std::array kBodyChannels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVx,
                                             Channel::kBodyVy};
inline constexpr std::array kSmoothChannels = {
    Channel::kBodyX,        Channel::kBodyY,        Channel::kBodyVx,
    Channel::kBodyVy,       Channel::kLegAngle,     Channel::kLegLength,
    Channel::kGroundForceX, Channel::kGroundForceY, Channel::kHipTorque};

/// Channels of a law that can be differentiated.
inline std::span<const Channel> ChannelsOf(Law law) {
  return std::span(kSmoothChannels).first(law == Law::kBall ? 4 : kSmoothChannels.size());
}

/// A run in which every effect has something to do: a controlled leg, or a bouncing ball.
inline SimulationRequest ExcitedRequest(Law law) {
  if (law == Law::kBall) {
    SimulationRequest q = BallRequest();
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    q.horizon = 2.2;
    return q;
  }
  if (law == Law::kStraightLeg) {
    SimulationRequest q = SteadyStraightLeg();
    q.initial[3] = -0.1;
    q.parameters.d = 60.0;
    q.parameters.kp = 20.0;
    q.parameters.v_des = 0.5;
    return q;
  }
  SimulationRequest q = ThickLegRequest(law);
  q.parameters.kp = 0.6;
  q.parameters.v_des = 1.6;
  return q;
}

/// The leg of the rig (datasets/rig-controlled) under its first angle, held by no damper: 3.7 mm of
/// strip, 9 cm of radius, law elastica. Mass, modulus, controller and start are the caller's.
inline SimulationRequest RigRequest() {
  SimulationRequest q;
  q.law = Law::kElastica;
  Parameters<double>& p = q.parameters;
  p.r = 0.09;
  p.G = 4e9;
  p.I = 0.03 * std::pow(0.003658, 3) / 12.0;
  p.A = 0.03 * 0.003658;
  p.d = 0.0;
  p.theta_td = Degrees(22.0);
  p.v_des = 1.8;
  return q;
}

/// Rows over a whole run, none so near an event that differences straddle it.
inline std::vector<double> TimesClearOfEvents(const Trajectory& run) {
  std::vector<double> times;
  for (double t : EvenTimes(run.end_time, 60)) {
    const bool clear = std::none_of(run.events.begin(), run.events.end(),
                                    [&](const Event& e) { return std::abs(e.time - t) < 0.008; });
    if (clear && t < run.end_time - 0.01) times.push_back(t);
  }
  return times;
}

/// One effect with its first parameter at `value`.
inline EffectSetting Setting(std::string_view effect, double value) {
  EffectSetting setting = EffectSetting::Null(*FindEffect(effect));
  setting.values[0] = value;
  return setting;
}

/// The first event of a kind.
inline const Event& First(const Trajectory& run, EventKind kind) {
  return *std::find_if(run.events.begin(), run.events.end(),
                       [&](const Event& e) { return e.kind == kind; });
}
/// Of the state that a run leaves [J].
inline double EnergyAtEnd(const SimulationRequest& q, const Trajectory& run) {
  return Energy(q, run.final_mode, run.final_state);
}

}  // namespace hoplab::testing
