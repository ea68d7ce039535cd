#include "optimize/return_map.h"

#include <cmath>
#include <limits>

#include "base/check.h"

namespace hoplab {
namespace {

// No hop takes as long: a run that reaches this is rolling or standing on its leg.
constexpr double kHopHorizon = 20.0;  // s

// A hop at tolerance 1e-9 keeps its energy to about 1e-8; the least damping worth a name loses
// more.
constexpr double kEnergyKept = 1e-6;

}  // namespace

std::string EventSequence(const Hop& hop) {
  std::string names;
  for (const EventKind event : hop.events) {
    if (!names.empty()) names += ' ';
    names += NameOf(event);
  }
  return names;
}

ReturnMap::ReturnMap(Hopper hopper) : hopper_(std::move(hopper)) {
  HOPLAB_CHECK(MechanismOf(hopper_.request.law) != MechanismKind::kBall);
}

SimulationRequest ReturnMap::RequestFrom(const ApexState& start) const {
  SimulationRequest request = RequestOf(hopper_);
  request.initial = {0.0, start[1], start[0], 0.0};
  request.parameters.start_angle = std::numeric_limits<double>::quiet_NaN();  // it is placed
  request.horizon = kHopHorizon;
  request.max_hops = 1;
  return request;
}

Hop ReturnMap::Read(std::size_t parameters) const {
  Hop hop;
  hop.outcome = run_.outcome == Outcome::kCompleted ? Outcome::kFellNoReturn : run_.outcome;
  for (const Event& event : run_.events) hop.events.push_back(event.kind);
  hop.least_crossing_rate = run_.least_crossing_rate;
  hop.nearest_miss = run_.nearest_miss;
  hop.simultaneous = run_.has_simultaneous_events;
  hop.max_flexure = run_.max_flexure;
  if (!hop.ok()) return hop;
  hop.next = {run_.final_state[2], run_.final_state[1]};
  hop.period = run_.end_time;
  hop.advance = run_.final_state[0];
  if (run_.directions == 0) return hop;
  // The sensitivities belong to a fixed time; along the section they gain f dt_e/dp.
  const std::size_t width = 2 + parameters;
  const double* dt = &run_.event_time_sensitivities[(run_.events.size() - 1) * width];
  const auto along = [&](std::size_t component, std::size_t direction) {
    return run_.final_sensitivities[component * width + direction] +
           run_.final_rate[component] * dt[direction];
  };
  hop.by_parameter.resize(2, static_cast<Eigen::Index>(parameters));
  for (std::size_t k = 0; k < width; ++k) {
    const Eigen::Vector2d column(along(2, k), along(1, k));
    if (k < 2)
      hop.jacobian.col(static_cast<Eigen::Index>(k)) = column;
    else
      hop.by_parameter.col(static_cast<Eigen::Index>(k - 2)) = column;
  }
  return hop;
}

Hop ReturnMap::Differentiate(const ApexState& start,
                             std::span<const SensitivityDirection> parameters) {
  std::vector<SensitivityDirection> directions = {SensitivityDirection::InitialState(2),
                                                  SensitivityDirection::InitialState(1)};
  directions.insert(directions.end(), parameters.begin(), parameters.end());
  SimulationRequest request = RequestFrom(start);
  request.directions = directions;
  Simulate(request, run_);
  return Read(parameters.size());
}

Hop ReturnMap::Apply(const ApexState& start) {
  Simulate(RequestFrom(start), run_);
  return Read(0);
}

double ReturnMap::SpecificEnergy(const ApexState& state) const {
  const SimulationRequest request = RequestOf(hopper_);
  const std::array<double, 5> z = {0.0, state[1], state[0], 0.0, 0.0};
  return Energy(request, Mode::kFlight, z) / request.parameters.m;
}

Eigen::RowVector2d ReturnMap::SpecificEnergyRate(const ApexState& state) const {
  // Quadratic in vx and linear in y: a central difference has no truncation error.
  constexpr double kStep = 0.1;
  Eigen::RowVector2d rate;
  for (int i = 0; i < 2; ++i) {
    ApexState up = state, down = state;
    up[i] += kStep;
    down[i] -= kStep;
    rate[i] = (SpecificEnergy(up) - SpecificEnergy(down)) / (2.0 * kStep);
  }
  return rate;
}

bool ReturnMap::ConservesEnergy(const ApexState& state) {
  const Hop hop = Differentiate(state);
  if (!hop.ok()) return false;
  const double before = SpecificEnergy(state), after = SpecificEnergy(hop.next);
  const Eigen::RowVector2d rate = SpecificEnergyRate(state);
  const Eigen::RowVector2d carried = SpecificEnergyRate(hop.next) * hop.jacobian;
  return std::abs(after - before) <= kEnergyKept * std::abs(before) &&
         (carried - rate).norm() <= kEnergyKept * rate.norm() * (1.0 + hop.jacobian.norm());
}

}  // namespace hoplab
