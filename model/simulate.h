#pragma once

#include <span>
#include <vector>

#include "model/effects/effect.h"
#include "model/inputs.h"
#include "model/integrators/integrator_options.h"
#include "model/observation.h"
#include "model/parameters.h"
#include "model/trajectory.h"

namespace hoplab {

/// One quantity a simulation can be differentiated by.
struct SensitivityDirection {
  enum class Of { kParameter, kInitialState, kEffect, kInput, kTouchdownAngle, kClock };
  Of of = Of::kParameter;
  ParameterId parameter = ParameterId::kE;  // kParameter
  int index = 0;      // kInitialState: place in `initial`; kEffect: place in `effects`
                      // kInput: in `inputs`; kTouchdownAngle: which touch-down; kClock: which
  int component = 0;  // kEffect: which of its parameters; kInput: 0 delay, 1 scale

  static SensitivityDirection Parameter(ParameterId id) {
    return {.of = Of::kParameter, .parameter = id};
  }
  static SensitivityDirection InitialState(int component) {
    return {.of = Of::kInitialState, .index = component};
  }
  static SensitivityDirection EffectParameter(int effect, int component) {
    return {.of = Of::kEffect, .index = effect, .component = component};
  }
  static SensitivityDirection InputDelay(int input) { return {.of = Of::kInput, .index = input}; }
  static SensitivityDirection InputScale(int input) {
    return {.of = Of::kInput, .index = input, .component = 1};
  }
  /// The commanded angle of a touch-down, in the order of the run.
  static SensitivityDirection TouchdownAngle(int touchdown) {
    return {.of = Of::kTouchdownAngle, .index = touchdown};
  }
  /// The offset of a sensors' clock.
  static SensitivityDirection ClockOffset(int clock) { return {.of = Of::kClock, .index = clock}; }
};

/// What to simulate. The run starts at time 0, in flight unless `start_mode` says otherwise; with
/// `parameters.m_toe` > 0 its leg is relaxed at the touch-down angle and moves with the hip.
struct SimulationRequest {
  Law law = Law::kElastica;
  LiftoffRule liftoff = LiftoffRule::kZeroForce;  // of a massless leg
  Parameters<double> parameters;
  std::span<const EffectSetting> effects;
  /// x, y [m], vx, vy [m/s]; of a start in stance the place of the contact follows [m]. What a
  /// mechanism has beside them may follow, else it starts as it rests. Of a robot: pitch [rad], its
  /// rate [rad/s], then nothing or the rest of its state; with starts_leaning how far each foot
  /// that stands is ahead [m], and each motor [rad] (M119).
  std::vector<double> initial = std::vector<double>(4, 0.0);
  /// kStance of a C-leg is whichever of rolling and toe it is in.
  Mode start_mode = Mode::kFlight;
  /// Of a robot that goes on where another run ended: that run's final_feet, a leg after the other.
  /// `initial` is then its whole final state. Empty: M79 says which legs stand.
  std::span<const Foot> feet;
  /// Commanded leg angles of the run's touch-downs, the last one's for later ones [rad]; empty:
  /// parameters.theta_td for all.
  std::span<const double> touchdown_angles;
  /// What drives it from outside, at most one of a kind.
  std::span<const DrivenInput> inputs;
  /// Offsets of sensors' clocks [s], and of each channel which clock stamps it (-1: none does).
  /// What a clock stamps t was read at t + offset. Empty: no clocks.
  std::span<const double> clock_offsets;
  std::span<const int> channel_clocks;
  double horizon = 1.0;  // s
  int max_hops = 0;      // 0: no limit
  /// Row stamps since the start [s], ascending; negative ones lie before it.
  std::span<const double> row_times;
  std::span<const Channel> channels;  // what to sample in each row
  std::span<const SensitivityDirection> directions;
  /// Rows past the end of a run that ends early (it fell) are read from the body flying on from
  /// there without a leg, in place of NaN: smooth in every parameter, so that a search can step
  /// back. The outcome is told all the same.
  bool fly_on = false;
  IntegratorOptions integrator;
};

/// Runs the request; the result replaces what `out` held, reusing its memory. Never throws for
/// what physics or numerics do: see Trajectory::outcome.
void Simulate(const SimulationRequest& request, Trajectory& out);
/// The same, returning a new trajectory.
Trajectory Simulate(const SimulationRequest& request);

/// Total energy [J] of a state (x, y, vx, vy, contact) in a mode, strain energy included; state as
/// in Trajectory::final_state, in world W. Of a leg with a toe mass in flight the toe's state
/// follows; absent: the leg as a run starts with it.
double Energy(const SimulationRequest& request, Mode mode, std::span<const double> state);

}  // namespace hoplab
