#include "model/simulate.h"

#include "base/nan.h"
#include "model/mechanisms/ball.h"
#include "model/mechanisms/leg.h"
#include "model/mechanisms/robot.h"
#include "model/mechanisms/toe_mass_body.h"
#include "model/pose_filter.h"
#include "model/run.h"

namespace hoplab {
namespace {

const Mechanism& MechanismFor(const SimulationRequest& request) {
  static constexpr Mechanism kBall = MakeMechanism<Ball>();
  static constexpr Mechanism kRobot = MakeMechanism<Robot>();
  static constexpr Mechanism kWithToe = MakeMechanism<ToeMassBody>();
  if (request.law == Law::kBall) return kBall;
  if (request.law == Law::kRobot) return kRobot;
  return request.parameters.m_toe > 0.0 ? kWithToe : LegLawOf(request.law).body;
}

void SimulateRows(const SimulationRequest& request, Trajectory& out) {
  out.Clear();
  out.directions = static_cast<int>(request.directions.size());
  out.channels = static_cast<int>(request.channels.size());
  const std::size_t cells = request.row_times.size() * request.channels.size();
  out.samples.assign(cells, kNaN);
  out.sensitivities.assign(cells * request.directions.size(), kNaN);
  RunRequest(request, MechanismFor(request), out);
}

}  // namespace

void Simulate(const SimulationRequest& request, Trajectory& out) {
  const std::vector<PoseFilter> filters = PoseFiltersOf(request);
  if (filters.empty()) return SimulateRows(request, out);
  const FilterRows rows(request, filters);
  SimulationRequest wide = request;
  wide.row_times = rows.times();
  SimulateRows(wide, out);
  rows.Filter(out);
}

Trajectory Simulate(const SimulationRequest& request) {
  Trajectory out;
  Simulate(request, out);
  return out;
}

double Energy(const SimulationRequest& request, Mode mode, std::span<const double> state) {
  return EnergyOf(request, MechanismFor(request), mode, state);
}

}  // namespace hoplab
