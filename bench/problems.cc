#include "bench/problems.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/check.h"

namespace hoplab::bench {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kDropHeight = 0.3, kForwardSpeed = 1.0;  // m, m/s

SimulationRequest Request(Law law, int directions, int hops) {
  SimulationRequest request;
  request.law = law;
  request.parameters = LegParameters(law);
  request.initial = {0.0, kDropHeight, kForwardSpeed, 0.0};
  request.horizon = 30.0;
  request.max_hops = hops;
  request.directions = Directions(directions);
  return request;
}

}  // namespace

Parameters<double> LegParameters(Law law) {
  Parameters<double> p;
  p.m = 1.0;
  p.g = 9.81;
  p.d = 3.0;
  if (law == Law::kStraightLeg) {
    p.k = 2350.0;
    p.l0 = 0.18;
    p.theta_td = 15.0 * kDegree;
    return p;
  }
  const double width = 0.03, height = 0.0038;  // of the section [m]
  p.r = 0.09;
  p.E = 22e9;
  p.G = 4e9;
  p.I = width * height * height * height / 12.0;
  p.A = width * height;
  p.theta_td = 30.0 * kDegree;
  return p;
}

std::span<const SensitivityDirection> Directions(int count) {
  using D = SensitivityDirection;
  using P = ParameterId;
  static const std::array<D, 16> kAll = {D::Parameter(P::kE),       D::Parameter(P::kD),
                                         D::Parameter(P::kM),       D::Parameter(P::kR),
                                         D::Parameter(P::kGravity), D::Parameter(P::kThetaTd),
                                         D::Parameter(P::kG),       D::Parameter(P::kSecondMoment),
                                         D::Parameter(P::kArea),    D::Parameter(P::kShearFactor),
                                         D::Parameter(P::kKp),      D::Parameter(P::kVDes),
                                         D::InitialState(0),        D::InitialState(1),
                                         D::InitialState(2),        D::InitialState(3)};
  HOPLAB_CHECK(count >= 0 && count <= static_cast<int>(kAll.size()));
  return std::span(kAll).first(count);
}

std::array<double, 4> TouchdownState(Law law) {
  const Parameters<double> p = LegParameters(law);
  const double y =
      law == Law::kStraightLeg ? p.l0 * std::cos(p.theta_td) : p.r * (1.0 + std::cos(p.theta_td));
  const double fall = std::sqrt(2.0 * (kDropHeight - y) / p.g);  // s
  return {kForwardSpeed * fall, y, kForwardSpeed, -p.g * fall};
}

SimulationRequest StanceRequest(Law law, int directions) {
  SimulationRequest request = Request(law, directions, 1);
  const std::array<double, 4> start = TouchdownState(law);
  request.initial.assign(start.begin(), start.end());
  return request;
}

SimulationRequest HopRequest(Law law, int directions) { return Request(law, directions, 1); }

SimulationRequest TenHopRequest(Law law, int directions) {
  SimulationRequest request = Request(law, directions, 10);
  request.parameters.kp = 3.0;
  request.parameters.v_des = 1.8;
  request.parameters.theta_td = 26.0 * kDegree;
  request.initial[2] = 1.5;
  return request;
}

double LiftoffTime(const Trajectory& trajectory) {
  for (const Event& event : trajectory.events) {
    if (event.kind == EventKind::kLiftoff) return event.time;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace hoplab::bench
