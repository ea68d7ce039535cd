#include "app/records/gait_tables.h"

#include <algorithm>

#include "app/records/stride_record.h"
#include "app/records/trajectory_tables.h"
#include "optimize/stride_map.h"

namespace hoplab {
namespace {

constexpr double kCycleRate = 1000.0;  // Hz
constexpr double kOwnRunRate = 250.0;  // Hz

}  // namespace

std::string CycleTable(const std::vector<LabelledGait>& gaits) {
  const int legs = gaits.empty() ? 0 : RobotLegsOf(gaits.front().hopper->request.parameters);
  CsvText csv(TrajectoryHeader({"run"}, legs));
  for (const LabelledGait& gait : gaits) {
    if (!gait.point->found()) continue;
    if (HasStrides(*gait.hopper)) {
      const SteadyStride steady = FindSteadyStride(*gait.hopper);
      AddTrajectoryRows(steady.start.map->RequestFrom(steady.point.state), kCycleRate, {gait.label},
                        0.0, csv);
      continue;
    }
    SimulationRequest request = RequestOf(*gait.hopper);
    request.initial = {0.0, gait.point->state[1], gait.point->state[0], 0.0};
    request.horizon = gait.point->hop.period;
    request.max_hops = 0;
    AddTrajectoryRows(request, kCycleRate, {gait.label}, 0.0, csv);
  }
  return csv.text();
}

std::string OwnRunTable(const Hopper& hopper, double longest) {
  CsvText csv(TrajectoryHeader({}, RobotLegsOf(hopper.request.parameters)));
  SimulationRequest request = RequestOf(hopper);
  request.horizon = std::min(request.horizon, longest);
  AddTrajectoryRows(request, kOwnRunRate, {}, 0.0, csv);
  return csv.text();
}

Json GaitPointRecord(const FixedPoint& point) {
  if (!point.found()) return nullptr;
  Json multipliers = Json::array();
  for (const std::complex<double>& m : point.multipliers)
    multipliers.push_back({NumberOrNull(m.real()), NumberOrNull(m.imag())});
  // Of a robot the state leads with height and speed, and its mean speed says more.
  const bool strides = point.state.size() > 2;
  return {{"vx_m_per_s", NumberOrNull(strides ? SpeedOf(point.hop) : point.state[0])},
          {"y_m", NumberOrNull(point.state[strides ? 0 : 1])},
          {"period_s", NumberOrNull(point.hop.period)},
          {"advance_m", NumberOrNull(point.hop.advance)},
          {"multipliers", multipliers},
          {"spectral_radius", NumberOrNull(point.spectral_radius)},
          {"stable", point.stable()},
          {"events", EventSequence(point.hop)}};
}

}  // namespace hoplab
