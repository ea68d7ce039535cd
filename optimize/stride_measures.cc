#include "optimize/stride_measures.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace hoplab {
namespace {

constexpr int kRows = 1000;  // of a stride
// Stances whose middles lie within this share of a stride are at once.
constexpr double kTogether = 0.12;
// A flight shorter than this share of a stride is none.
constexpr double kLeastFlight = 0.01;

double AroundCircle(double share) { return share - std::round(share); }

GaitKind KindOf(const StrideMeasures& stride) {
  const bool together = stride.legs_apart <= kTogether;
  const bool flies = stride.flight_share > kLeastFlight;
  if (together) return flies ? GaitKind::kPronk : GaitKind::kCrouch;
  if (!flies) return GaitKind::kWalk;
  return stride.legs.size() == 2 ? GaitKind::kBound : GaitKind::kRun;
}

// The samples of one stride, row by row.
class StrideSamples {
 public:
  StrideSamples(const StrideMap& map, const SectionState& state, int legs) : legs_(legs) {
    SimulationRequest request = map.RequestFrom(state);
    std::vector<double> times;
    for (int row = 0; row < kRows; ++row) times.push_back(request.horizon * row / kRows);
    std::vector<Channel> channels;
    for (const Channel first : {Channel::kLegAngle1, Channel::kHipTorque1, Channel::kContact1})
      for (int leg = 0; leg < legs; ++leg) channels.push_back(OfLeg(first, leg));
    request.row_times = times;
    request.channels = channels;
    run_ = Simulate(request);
  }
  double Angle(int row, int leg) const { return At(row, leg); }
  double Torque(int row, int leg) const { return At(row, legs_ + leg); }
  bool Stands(int row, int leg) const { return At(row, 2 * legs_ + leg) > 0.5; }
  const Trajectory& run() const { return run_; }

 private:
  double At(int row, int channel) const {
    return run_.samples[static_cast<std::size_t>(row) * 3 * legs_ + channel];
  }
  int legs_;
  Trajectory run_;
};

double WorkOf(const StrideSamples& samples, int leg) {
  double work = 0.0;
  for (int row = 0; row + 1 < kRows; ++row) {
    const double torque = 0.5 * (samples.Torque(row, leg) + samples.Torque(row + 1, leg));
    work += std::max(0.0, torque * (samples.Angle(row + 1, leg) - samples.Angle(row, leg)));
  }
  return work;
}

}  // namespace

std::string_view NameOf(GaitKind kind) {
  switch (kind) {
    case GaitKind::kPronk:
      return "pronk";
    case GaitKind::kCrouch:
      return "crouch";
    case GaitKind::kBound:
      return "bound";
    case GaitKind::kWalk:
      return "walk";
    case GaitKind::kRun:
      return "run";
  }
  return "";
}

StrideMeasures MeasureStride(const StrideMap& map, const SectionState& state) {
  const Parameters<double>& p = map.hopper().request.parameters;
  const int legs = p.robot->legs;
  const StrideSamples samples(map, state, legs);
  StrideMeasures stride;
  const double way = samples.run().final_state[0];
  stride.speed = way / samples.run().end_time;
  double work = 0.0;
  stride.peak_torque = 0.0;
  std::vector<int> standing(kRows, 0);
  std::vector<std::complex<double>> middles;
  for (int leg = 0; leg < legs; ++leg) {
    work += WorkOf(samples, leg);
    std::complex<double> sum = 0.0;
    int rows = 0;
    for (int row = 0; row < kRows; ++row) {
      stride.peak_torque = std::max(stride.peak_torque, std::abs(samples.Torque(row, leg)));
      if (!samples.Stands(row, leg)) continue;
      ++rows;
      ++standing[static_cast<std::size_t>(row)];
      sum += std::polar(1.0, 2.0 * std::numbers::pi * row / kRows);
    }
    middles.push_back(sum);
    const double turn = std::arg(sum * std::conj(middles.front())) / (2.0 * std::numbers::pi);
    stride.legs.push_back({static_cast<double>(rows) / kRows, turn - std::floor(turn)});
    stride.legs_apart = std::max(stride.legs_apart, std::abs(AroundCircle(turn)));
  }
  stride.flight_share =
      static_cast<double>(std::count(standing.begin(), standing.end(), 0)) / kRows;
  const double weight = (p.m + legs * p.robot->leg_mass) * p.g;
  stride.cost_of_transport = work / (weight * std::abs(way));
  stride.kind = KindOf(stride);
  return stride;
}

}  // namespace hoplab
