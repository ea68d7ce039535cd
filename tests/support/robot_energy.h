#pragma once

#include <algorithm>
#include <vector>

#include "model/hybrid/engine.h"
#include "model/mechanisms/robot.h"
#include "model/simulate.h"

namespace hoplab::testing {

/// The total energy of a run at rows 1 ms apart [J].
class EnergyRows final : public RowReader<double> {
 public:
  EnergyRows(const HybridSystem<double>& system, double horizon)
      : system_(system), count_(static_cast<int>(horizon * 1e3)) {}
  int count() const override { return count_; }
  double Time(int i) const override { return 1e-3 * (i + 0.5); }
  void Read(int, Mode mode, const double& time, const double* z) override {
    times.push_back(time);
    energy.push_back(system_.Energy(mode, z));
  }
  std::vector<double> times, energy;

 private:
  const HybridSystem<double>& system_;
  int count_;
};

/// A run, and its energy [J] at those times [s].
struct EnergyRun {
  Trajectory run;
  std::vector<double> times, energy;
};
/// Runs a robot that starts in flight.
inline EnergyRun RunWithEnergy(const SimulationRequest& q) {
  MechanismSetup<double> setup;
  MechanismSetup<Jet<1>> rate_setup;
  setup.parameters = q.parameters;
  rate_setup.parameters = ConvertParameters<Jet<1>>(q.parameters);
  Robot<double> robot(setup), values(setup);
  Robot<Jet<1>> rates(rate_setup);
  EnergyRun out;
  EnergyRows rows(robot, q.horizon);
  Engine<double> engine({robot, values, rates}, q.integrator, {.horizon = q.horizon}, rows,
                        out.run);
  std::vector<double> z(static_cast<std::size_t>(robot.size()), 0.0);
  std::copy(q.initial.begin(), q.initial.end(), z.begin());
  robot.CompleteStart(z.data(), static_cast<int>(q.initial.size()));
  engine.Run(Mode::kFlight, z.data());
  out.times = rows.times;
  out.energy = rows.energy;
  return out;
}

}  // namespace hoplab::testing
