#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "optimize/hopper.h"

namespace hoplab {

/// A state on the section of a return map: what tells the next one.
using SectionState = Eigen::VectorXd;

/// What happens in a hop; of a robot with the leg it happens to, 0 the hindmost.
struct HopEvent {
  EventKind kind = EventKind::kApex;
  int leg = -1;
  bool operator==(const HopEvent&) const = default;
};

/// One hop (or stride) from section to section (section 7 of the equation sheet), with derivatives
/// along the section. Of a hop that fails only `outcome`, `events` and the closeness measures mean
/// anything; the rest is NaN.
struct Hop {
  Outcome outcome = Outcome::kIntegrationFailed;
  bool returned = false;  // to the section, as it left it
  bool ok() const { return returned; }

  SectionState next;
  Eigen::MatrixXd jacobian;      // DP: d next/d state
  Eigen::MatrixXd by_parameter;  // dP/dp, a column per direction asked for
  double period = std::numeric_limits<double>::quiet_NaN();   // s
  double advance = std::numeric_limits<double>::quiet_NaN();  // m
  std::vector<HopEvent> events;      // in their order: another order is another branch of the map
  double least_crossing_rate = 0.0;  // as in Trajectory: near 0 an event grazes
  double nearest_miss = 0.0;         // as in Trajectory: near 0 another event is about to happen
  bool simultaneous = false;
  double max_deflection_ratio = 0.0;
};

/// "touchdown liftoff apex"; of a robot "touchdown 1 touchdown 2 ...".
std::string EventSequence(const Hop& hop);

/// One component of a section's state.
struct SectionComponent {
  std::string name;   // as in run.json, with its unit: "vx_m_per_s"
  double size = 1.0;  // a change of it that matters, SI
};

/// A return map P of a mechanism: its state where it passes a section, to that at the next passing.
/// Not for several threads at once: it keeps its memory.
class ReturnMap {
 public:
  explicit ReturnMap(Hopper hopper) : hopper_(std::move(hopper)) {}
  virtual ~ReturnMap() = default;
  virtual std::unique_ptr<ReturnMap> Clone() const = 0;

  /// The hop from `start`; with DP and with dP/dp for `parameters`.
  virtual Hop Differentiate(const SectionState& start,
                            std::span<const SensitivityDirection> parameters = {}) = 0;
  /// The hop alone.
  virtual Hop Apply(const SectionState& start) = 0;
  /// What a state consists of.
  virtual std::vector<SectionComponent> Components(const SectionState& at) const = 0;

  /// Energy over mass of a state [J/kg].
  virtual double SpecificEnergy(const SectionState& state) const = 0;
  /// Its derivative with respect to the state.
  virtual Eigen::RowVectorXd SpecificEnergyRate(const SectionState& state) const = 0;
  /// Whether a hop from `state` keeps the energy whatever the state: E(P(z)) = E(z), and so do the
  /// derivatives of both sides. Then DP has a multiplier 1, and fixed points are not isolated.
  virtual bool ConservesEnergy(const SectionState& state) = 0;

  const Hopper& hopper() const { return hopper_; }
  Hopper& hopper() { return hopper_; }

 protected:
  /// What every hop takes over from the run it was.
  static void ReadRun(const Trajectory& run, Hop& hop);

 private:
  Hopper hopper_;
};

}  // namespace hoplab
