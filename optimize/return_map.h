#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "optimize/hopper.h"

namespace hoplab {

/// State at an apex: (vx [m/s], y [m]). vy is 0 there, and x does not matter on level ground.
using ApexState = Eigen::Vector2d;

/// One hop from apex to apex (section 7 of the equation sheet), with derivatives along the section:
/// S + f dt_e/dp. Of a hop that fails only `outcome`, `events` and the closeness measures mean
/// anything; the rest is NaN.
struct Hop {
  Outcome outcome = Outcome::kIntegrationFailed;
  bool ok() const { return outcome == Outcome::kHopLimit; }

  ApexState next = ApexState::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Matrix2d jacobian =
      Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());  // DP: d next/d (vx, y)
  Eigen::Matrix2Xd by_parameter;  // dP/dp, a column per direction asked for
  double period = std::numeric_limits<double>::quiet_NaN();   // s
  double advance = std::numeric_limits<double>::quiet_NaN();  // m
  std::vector<EventKind> events;     // in their order: another order is another branch of the map
  double least_crossing_rate = 0.0;  // as in Trajectory: near 0 an event grazes
  double nearest_miss = 0.0;         // as in Trajectory: near 0 another event is about to happen
  bool simultaneous = false;
  double max_flexure = 0.0;
};

/// "touchdown liftoff apex".
std::string EventSequence(const Hop& hop);

/// The apex-to-apex map P of a legged hopper. Not for several threads at once: it keeps its memory.
class ReturnMap {
 public:
  explicit ReturnMap(Hopper hopper);

  /// The hop from `start`; with DP and with dP/dp for `parameters`.
  Hop Differentiate(const ApexState& start, std::span<const SensitivityDirection> parameters = {});
  /// The hop alone.
  Hop Apply(const ApexState& start);

  const Hopper& hopper() const { return hopper_; }
  Hopper& hopper() { return hopper_; }

  /// Energy over mass of a state at an apex [J/kg].
  double SpecificEnergy(const ApexState& state) const;
  /// Its derivative with respect to (vx, y).
  Eigen::RowVector2d SpecificEnergyRate(const ApexState& state) const;
  /// Whether a hop from `state` keeps the energy whatever the state: E(P(z)) = E(z), and so do the
  /// derivatives of both sides. Then DP has a multiplier 1, and fixed points are not isolated.
  bool ConservesEnergy(const ApexState& state);

 private:
  SimulationRequest RequestFrom(const ApexState& start) const;
  Hop Read(std::size_t parameters) const;

  Hopper hopper_;
  Trajectory run_;
};

}  // namespace hoplab
