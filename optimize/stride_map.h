#pragma once

#include <optional>

#include "optimize/fixed_point.h"
#include "optimize/return_map.h"

namespace hoplab {

/// The return map of a robot whose motors follow a clock: its state at one phase of the clock, to
/// that one period later (section 7 of the equation sheet). The state is all of the robot's but x:
/// y, vx, vy, pitch, its rate, the motors' angles and rates, and of each leg whose foot holds how
/// far ahead of the body's reference point its contact coordinate lies [m], 0 of the others; of
/// motors that lag what they give. Whole
/// turns of the motors are taken off, on a slope also the height gained.
class StrideMap final : public ReturnMap {
 public:
  /// The section lies at `phase` of the period, where the legs do what `feet` say. A stride that
  /// comes back with other feet has not returned.
  StrideMap(Hopper hopper, double phase, std::vector<Foot> feet);
  std::unique_ptr<ReturnMap> Clone() const override;

  Hop Differentiate(const SectionState& start,
                    std::span<const SensitivityDirection> parameters = {}) override;
  Hop Apply(const SectionState& start) override;
  std::vector<SectionComponent> Components(const SectionState& at) const override;

  /// NaN: motors take and give energy.
  double SpecificEnergy(const SectionState& state) const override;
  Eigen::RowVectorXd SpecificEnergyRate(const SectionState& state) const override;
  bool ConservesEnergy(const SectionState&) override { return false; }

  double phase() const { return phase_; }
  const std::vector<Foot>& feet() const { return feet_; }
  /// A stride from `start`, to be run and sampled; it points into this map.
  SimulationRequest RequestFrom(const SectionState& start) const;

 private:
  Hop Read(std::span<const SensitivityDirection> parameters) const;

  double phase_;
  std::vector<Foot> feet_;
  Trajectory run_;
};

/// A section of a robot's strides and a state on it, taken from a run of the robot.
struct StrideStart {
  Outcome outcome = Outcome::kCompleted;  // how the run ended
  double strides = 0.0;                   // how many it made
  std::optional<StrideMap> map;           // absent: it made too few
  SectionState state;
};

/// Runs `hopper`, a robot with a clock, from its own start for `strides` periods, and lays the
/// section into the longest time between two events or corners of the clock in the last of them.
StrideStart StartStrides(const Hopper& hopper, int strides);

/// The steady stride that the robot's run leads to, or one near the last it makes before it falls;
/// with the map it belongs to.
struct SteadyStride {
  StrideStart start;
  FixedPoint point;
};
SteadyStride FindSteadyStride(const Hopper& hopper);

/// Newton's residual of a robot's stride: its arcs' roots are found to some 1e-13 of their loads.
inline constexpr double kStrideResidual = 1e-9;

/// Whether the hopper is a robot whose motors follow a clock.
bool HasStrides(const Hopper& hopper);

}  // namespace hoplab
