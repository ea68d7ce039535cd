#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "fitting/model_of_spec.h"
#include "fitting/problem.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab::testing {

/// A hopper whose motor ripples and whose leg touches down at another angle each time, as a log of
/// it would be: the torque it measured drives the simulation, the angles are those it measured.
struct DrivenHops {
  double torque_noise_N_m = 0.02;
  double angle_noise_rad = 0.003;
  double position_noise_m = 0.001;
  bool held = false;
  double torque_delay_s = 0.0;  // by which the log is late
  double motor_clock_s = 0.0;   // what the torque's stamps are off, where a clock is said
  double ripple_N_m = 0.6;
  double rate_hz = 250.0;
  HopTruth truth = {};
};

/// Six train trials of three hops each; nominal E and d are off the truth. What the log has of
/// angles and torque is noisy. The dataset states the noise of each.
inline Dataset DrivenDataset(const DrivenHops& hops, std::uint64_t seed) {
  const Scenario scenario = HopScenario(3, hops.truth);
  Dataset dataset;
  dataset.name = "driven";
  dataset.mechanism = scenario.mechanism;
  dataset.mechanism.c_leg.E_Pa = 20e9;
  dataset.mechanism.c_leg.damping_N_s_per_m = 1.0;
  dataset.channels = {{Channel::kBodyX, hops.position_noise_m},
                      {Channel::kBodyY, hops.position_noise_m}};
  InputSpec torque;
  torque.id = InputKind::kHipTorque;
  torque.column = "motor_torque_N_m";
  torque.held = hops.held;
  dataset.inputs = {torque};
  for (int i = 0; i < 6; ++i) {
    const GenerateTrial& plan = scenario.dataset->trials[static_cast<std::size_t>(i)];
    RandomStream random(seed, static_cast<std::uint64_t>(i) + 1);
    std::vector<double> angles;
    for (int k = 0; k < 3; ++k) angles.push_back(plan.touchdown_angle_rad + 0.03 * random.Normal());
    std::vector<double> times, ripple;
    for (int row = 0; row / hops.rate_hz < 1.6; ++row) {
      const double t = row / hops.rate_hz;
      times.push_back(t);
      ripple.push_back(0.3 + hops.ripple_N_m * std::sin(37.0 * t + 0.7 * i));
    }
    const std::vector<DrivenInput> inputs = {{.kind = InputKind::kHipTorque,
                                              .times = times,
                                              .values = ripple,
                                              .held = hops.held,
                                              .delay = -hops.torque_delay_s}};
    const std::vector<Channel> channels = {Channel::kBodyX, Channel::kBodyY};
    SimulationRequest q;
    q.parameters = ParametersOfSpec(scenario.mechanism, std::nullopt, plan.touchdown_angle_rad);
    q.initial = InitialOf(*plan.initial);
    q.touchdown_angles = angles;
    q.inputs = inputs;
    q.horizon = times.back();
    q.max_hops = 3;
    q.row_times = times;
    q.channels = channels;
    // Another method than fits use.
    q.integrator = {IntegratorKind::kErkStep, 1e-12, 1e-13};
    const Trajectory run = Simulate(q);
    Trial trial;
    trial.file = "train-" + std::to_string(i + 1) + ".csv";
    trial.mechanism = dataset.mechanism;
    trial.touchdown_angle_sigma_rad = hops.angle_noise_rad;
    trial.inputs = dataset.inputs;
    trial.initial = plan.initial;
    TraceColumn x{"body_x_m", {}}, y{"body_y_m", {}}, u{torque.column, {}};
    for (std::size_t row = 0; row < times.size() && times[row] <= run.end_time; ++row) {
      trial.trace.time_s.push_back(times[row]);
      x.values.push_back(run.samples[2 * row] + hops.position_noise_m * random.Normal());
      y.values.push_back(run.samples[2 * row + 1] + hops.position_noise_m * random.Normal());
      u.values.push_back(ripple[row] + hops.torque_noise_N_m * random.Normal());
    }
    trial.trace.columns = {x, y, u};
    for (const double angle : angles)
      trial.touchdown_angles_rad.push_back(angle + hops.angle_noise_rad * random.Normal());
    trial.touchdown_angle_rad = trial.touchdown_angles_rad.front();
    dataset.trials.push_back(std::move(trial));
  }
  return dataset;
}

}  // namespace hoplab::testing
