#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/effects/effect.h"
#include "model/integrators/integrator_options.h"
#include "model/observation.h"
#include "model/parameters.h"
#include "model/trajectory.h"

namespace hoplab {

/// One quantity a simulation can be differentiated by.
struct SensitivityDirection {
  enum class Of { kParameter, kInitialState, kEffect };
  Of of = Of::kParameter;
  ParameterId parameter = ParameterId::kE;  // kParameter
  int index = 0;      // kInitialState: 0..3 (x, y, vx, vy); kEffect: place in `effects`
  int component = 0;  // kEffect: which of its parameters

  static SensitivityDirection Parameter(ParameterId id) {
    return {.of = Of::kParameter, .parameter = id};
  }
  static SensitivityDirection InitialState(int component) {
    return {.of = Of::kInitialState, .index = component};
  }
  static SensitivityDirection EffectParameter(int effect, int component) {
    return {.of = Of::kEffect, .index = effect, .component = component};
  }
};

/// What to simulate. The run starts in flight at time 0; with `parameters.m_toe` > 0 its leg is
/// relaxed at the touch-down angle and moves with the hip.
struct SimulationRequest {
  Law law = Law::kLargeDeflection;
  LiftoffRule liftoff = LiftoffRule::kZeroForce;  // of a massless leg
  Parameters<double> parameters;
  std::span<const EffectSetting> effects;
  std::array<double, 4> initial{};  // x, y [m], vx, vy [m/s]
  double horizon = 1.0;             // s
  int max_hops = 0;                 // 0: no limit
  /// Row stamps since the start [s], ascending; negative ones lie before it.
  std::span<const double> row_times;
  std::span<const Channel> channels;  // what to sample in each row
  std::span<const SensitivityDirection> directions;
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
