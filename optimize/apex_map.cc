#include "optimize/apex_map.h"

#include <algorithm>
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

ApexMap::ApexMap(Hopper hopper) : ReturnMap(std::move(hopper)) {
  const MechanismKind kind = MechanismOf(this->hopper().request.law);
  HOPLAB_CHECK(kind != MechanismKind::kBall && kind != MechanismKind::kRobot);
}

std::unique_ptr<ReturnMap> ApexMap::Clone() const { return std::make_unique<ApexMap>(hopper()); }

std::vector<SectionComponent> ApexMap::Components(const SectionState& at) const {
  return {{"vx_m_per_s", std::max(std::abs(at[0]), 0.1)}, {"y_m", at[1]}};
}

SimulationRequest ApexMap::RequestFrom(const SectionState& start) const {
  SimulationRequest request = RequestOf(hopper());
  request.initial = {0.0, start[1], start[0], 0.0};
  request.parameters.start_angle = std::numeric_limits<double>::quiet_NaN();  // it is placed
  request.horizon = kHopHorizon;
  request.max_hops = 1;
  return request;
}

Hop ApexMap::Read(std::size_t parameters) const {
  Hop hop;
  ReadRun(run_, hop);
  if (run_.outcome == Outcome::kCompleted) hop.outcome = Outcome::kFellNoReturn;
  for (const Event& event : run_.events) hop.events.push_back({event.kind});
  hop.returned = run_.outcome == Outcome::kHopLimit;
  if (!hop.ok()) return hop;
  hop.next = ApexState(run_.final_state[2], run_.final_state[1]);
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
  hop.jacobian.resize(2, 2);
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

Hop ApexMap::Differentiate(const SectionState& start,
                           std::span<const SensitivityDirection> parameters) {
  std::vector<SensitivityDirection> directions = {SensitivityDirection::InitialState(2),
                                                  SensitivityDirection::InitialState(1)};
  directions.insert(directions.end(), parameters.begin(), parameters.end());
  SimulationRequest request = RequestFrom(start);
  request.directions = directions;
  Simulate(request, run_);
  return Read(parameters.size());
}

Hop ApexMap::Apply(const SectionState& start) {
  Simulate(RequestFrom(start), run_);
  return Read(0);
}

double ApexMap::SpecificEnergy(const SectionState& state) const {
  const SimulationRequest request = RequestOf(hopper());
  const std::array<double, 5> z = {0.0, state[1], state[0], 0.0, 0.0};
  return Energy(request, Mode::kFlight, z) / request.parameters.m;
}

Eigen::RowVectorXd ApexMap::SpecificEnergyRate(const SectionState& state) const {
  // Quadratic in vx and linear in y: a central difference has no truncation error.
  constexpr double kStep = 0.1;
  Eigen::RowVectorXd rate(2);
  for (int i = 0; i < 2; ++i) {
    SectionState up = state, down = state;
    up[i] += kStep;
    down[i] -= kStep;
    rate[i] = (SpecificEnergy(up) - SpecificEnergy(down)) / (2.0 * kStep);
  }
  return rate;
}

bool ApexMap::ConservesEnergy(const SectionState& state) {
  const Hop hop = Differentiate(state);
  if (!hop.ok()) return false;
  const double before = SpecificEnergy(state), after = SpecificEnergy(hop.next);
  const Eigen::RowVectorXd rate = SpecificEnergyRate(state);
  const Eigen::RowVectorXd carried = SpecificEnergyRate(hop.next) * hop.jacobian;
  return std::abs(after - before) <= kEnergyKept * std::abs(before) &&
         (carried - rate).norm() <= kEnergyKept * rate.norm() * (1.0 + hop.jacobian.norm());
}

}  // namespace hoplab
