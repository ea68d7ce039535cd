#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "model/effects/active_effects.h"
#include "model/hybrid/engine.h"
#include "model/hybrid/ground_frame.h"
#include "model/integrators/cvodes.h"
#include "model/integrators/dop853.h"
#include "model/integrators/erkstep.h"
#include "model/laws/leg_load.h"
#include "model/simulate.h"

namespace hoplab {

/// Copies each row's wanted channels, with their directions, into a trajectory.
template <class T>
class RowSink {
 public:
  RowSink(const SimulationRequest& request, const ActiveEffects<T>& effects,
          const GroundFrame<T>& frame, int first_direction, int directions, Trajectory& out)
      : request_(request),
        effects_(effects),
        frame_(frame),
        first_(first_direction),
        count_(directions),
        out_(out) {
    body_only_ = std::all_of(request.channels.begin(), request.channels.end(),
                             [](Channel c) { return c <= Channel::kBodyVy; });
  }

  template <class System>
  void operator()(int row, Mode mode, const T& time, const T* z, const System& system) {
    Observation<T> seen;
    if (body_only_) {
      for (int i = 0; i < 4; ++i) seen.channel[i] = z[i];
    } else {
      seen = system.Observe(mode, time, z);
      frame_.LegToWorld(seen);
    }
    frame_.BodyToWorld(seen);
    effects_.ChangeObservation(seen);
    const int channels = static_cast<int>(request_.channels.size());
    const int width = static_cast<int>(request_.directions.size());
    for (int c = 0; c < channels; ++c) {
      const T& value = seen[request_.channels[c]];
      const std::size_t cell = static_cast<std::size_t>(row) * channels + c;
      out_.samples[cell] = Value(value);
      for (int k = 0; k < count_; ++k)
        out_.sensitivities[cell * width + first_ + k] = Slope(value, k);
    }
  }

 private:
  const SimulationRequest& request_;
  const ActiveEffects<T>& effects_;
  const GroundFrame<T>& frame_;
  int first_, count_;
  Trajectory& out_;
  bool body_only_;
};

namespace run_detail {

// The request in scalar type T with directions first .. first + count seeded.
template <class T>
struct Seeds {
  Parameters<T> parameters;
  ActiveEffects<T> effects;
  std::array<T, 4> initial;

  Seeds(const SimulationRequest& request, int first, int count)
      : parameters(ConvertParameters<T>(request.parameters)) {
    for (int i = 0; i < 4; ++i) initial[i] = T(request.initial[i]);
    std::array<std::array<T, kMaxEffectParameters>, ActiveEffects<T>::kMax> values;
    std::array<bool, ActiveEffects<T>::kMax> active{};
    HOPLAB_CHECK(request.effects.size() <= active.size());
    for (std::size_t e = 0; e < request.effects.size(); ++e) {
      active[e] = !request.effects[e].IsNull();
      for (int i = 0; i < kMaxEffectParameters; ++i) values[e][i] = T(request.effects[e].values[i]);
    }
    // An effect that any direction asks for acts in every chunk: all chunks run the same
    // simulation.
    for (const SensitivityDirection& d : request.directions) {
      if (d.of == SensitivityDirection::Of::kEffect) active[d.index] = true;
    }
    for (int k = 0; k < count; ++k) {
      const SensitivityDirection& d = request.directions[first + k];
      switch (d.of) {
        case SensitivityDirection::Of::kParameter: {
          T& field = Field(parameters, d.parameter);
          field = Seeded<T>(Value(field), k, 1.0);
          break;
        }
        case SensitivityDirection::Of::kInitialState:
          initial[d.index] = Seeded<T>(Value(initial[d.index]), k, 1.0);
          break;
        case SensitivityDirection::Of::kEffect:
          values[d.index][d.component] = Seeded<T>(Value(values[d.index][d.component]), k, 1.0);
          break;
      }
    }
    for (std::size_t e = 0; e < request.effects.size(); ++e) {
      if (active[e]) effects.Add(*request.effects[e].effect, values[e]);
    }
    effects.ChangeParameters(parameters);
  }
};

// Events and the final state of a run, from the frame of the ground.
inline void ToWorld(const GroundFrame<double>& frame, Trajectory& run) {
  const bool has_toe = run.final_state.size() == kToeStateSize;
  if (!has_toe)
    run.final_state.resize(std::min<std::size_t>(run.final_state.size(), kLegStateSize));
  run.final_rate.resize(run.final_state.size());
  if (frame.level()) return;
  frame.ToWorld(run.final_state.data());
  frame.ToWorld(run.final_rate.data());
  if (has_toe && run.final_mode == Mode::kFlight) {
    frame.ToWorld(&run.final_state[kToeX]);
    frame.ToWorld(&run.final_rate[kToeX]);
  }
  for (Event& e : run.events) {
    double before[] = {e.x, e.y, e.vx, e.vy}, after[] = {e.x, e.y, e.vx_after, e.vy_after};
    frame.ToWorld(before);
    frame.ToWorld(after);
    e.x = before[0];
    e.y = before[1];
    e.vx = before[2];
    e.vy = before[3];
    e.vx_after = after[2];
    e.vy_after = after[3];
  }
}

// The directions of a chunk along a sharp effect: at null they see what the state does not.
inline std::uint32_t SharpDirections(const SimulationRequest& request, int first, int count) {
  std::uint32_t bits = 0;
  for (int k = 0; k < count; ++k) {
    const SensitivityDirection& d = request.directions[first + k];
    if (d.of == SensitivityDirection::Of::kEffect && request.effects[d.index].effect->info.sharp)
      bits |= std::uint32_t{1} << k;
  }
  return bits;
}

template <template <class> class System, class T, template <int, int, class> class Stepper>
void RunChunk(const SimulationRequest& request, int first, int count, Trajectory& out) {
  const Seeds<T> seeds(request, first, count);
  const ActiveEffects<double> value_effects = seeds.effects.template Convert<double>();
  const ActiveEffects<Jet<1>> rate_effects = seeds.effects.template Convert<Jet<1>>();
  const System<T> system(seeds.parameters, seeds.effects, request.liftoff);
  const System<double> value_system(ConvertParameters<double>(seeds.parameters), value_effects,
                                    request.liftoff);
  const System<Jet<1>> rate_system(ConvertParameters<Jet<1>>(seeds.parameters), rate_effects,
                                   request.liftoff);
  // Every chunk runs the same simulation: only the first one's record of it is kept.
  Trajectory scratch;
  Trajectory& record = first == 0 ? out : scratch;
  const GroundFrame<T> frame(seeds.parameters.slope);
  RowSink<T> sink(request, seeds.effects, frame, first, count, out);
  const RunSettings settings{request.horizon, request.max_hops, request.row_times,
                             request.channels};
  IntegratorOptions integrator = request.integrator;
  integrator.steering = SharpDirections(request, first, count);
  Engine<System, T, Stepper, RowSink<T>> engine(system, value_system, rate_system, integrator,
                                                settings, sink, record);
  std::array<T, System<T>::kDim> z;
  std::fill(z.begin(), z.end(), T(0.0));
  std::copy(seeds.initial.begin(), seeds.initial.end(), z.begin());
  frame.FromWorld(z.data());
  if constexpr (requires { system.PlaceToe(z.data()); }) system.PlaceToe(z.data());
  engine.Run(Mode::kFlight, z.data(),
             [&](int row) { return seeds.effects.ObservationTime(T(request.row_times[row])); });
  // A chunk that fails has no derivatives to give: then the whole has none.
  if (first > 0 && IsComplete(out.outcome)) out.outcome = record.outcome;

  // What the run leaves, in world W and without a lag's own state.
  std::array<T, System<T>::kDim> final_state = engine.final_state();
  frame.ToWorld(final_state.data());
  if constexpr (System<T>::kDim == kToeStateSize) {
    if (record.final_mode == Mode::kFlight) frame.ToWorld(&final_state[kToeX]);
  }
  const std::size_t width = request.directions.size();
  if (first == 0) {
    ToWorld(GroundFrame<double>(Value(seeds.parameters.slope)), out);
    out.event_time_sensitivities.resize(out.events.size() * width);
    out.final_sensitivities.resize(out.final_state.size() * width);
  }
  if constexpr (kJetWidth < T >> 0) {
    const std::size_t events = std::min(out.events.size(), record.events.size());
    for (std::size_t e = 0; e < events; ++e) {
      for (int k = 0; k < count; ++k)
        out.event_time_sensitivities[e * width + first + k] =
            engine.event_times()[e * kJetWidth<T> + k];
    }
    for (std::size_t i = 0; i < out.final_state.size(); ++i) {
      for (int k = 0; k < count; ++k)
        out.final_sensitivities[i * width + first + k] = Slope(final_state[i], k);
    }
  }
}

template <template <class> class System, template <int, int, class> class Stepper>
void RunWith(const SimulationRequest& request, Trajectory& out) {
  const int directions = static_cast<int>(request.directions.size());
  if (directions == 0) return RunChunk<System, double, Stepper>(request, 0, 0, out);
  for (int first = 0; first < directions;) {
    const int left = directions - first;
    if (left <= kNarrowJet) {
      RunChunk<System, Jet<kNarrowJet>, Stepper>(request, first, left, out);
      first += left;
    } else {
      const int count = std::min(left, kWideJet);
      RunChunk<System, Jet<kWideJet>, Stepper>(request, first, count, out);
      first += count;
    }
  }
}

}  // namespace run_detail

/// Runs `request` on the automaton `System`; `out` is cleared and sized already.
template <template <class> class System>
void RunAutomaton(const SimulationRequest& request, Trajectory& out) {
  switch (request.integrator.kind) {
    case IntegratorKind::kDop853:
      return run_detail::RunWith<System, Dop853>(request, out);
    case IntegratorKind::kErkStep:
      return run_detail::RunWith<System, ErkStepper>(request, out);
    case IntegratorKind::kCvodes:
      return run_detail::RunWith<System, CvodesStepper>(request, out);
  }
}

/// The same for a leg; `Lagged` is the automaton with the motor's torque as one state more, for a
/// lag long enough to be integrated.
template <template <class> class System, template <class> class Lagged>
void RunLeg(const SimulationRequest& request, Trajectory& out) {
  constexpr double kShortestLag = 1e-5;  // s
  const bool lagged =
      !request.effects.empty() &&
      run_detail::Seeds<double>(request, 0, 0).parameters.torque_lag >= kShortestLag;
  return lagged ? RunAutomaton<Lagged>(request, out) : RunAutomaton<System>(request, out);
}

/// Energy of a state on the automaton `System`.
template <template <class> class System>
double EnergyOn(const SimulationRequest& request, Mode mode, std::span<const double> state) {
  const run_detail::Seeds<double> seeds(request, 0, 0);
  System<double> system(seeds.parameters, seeds.effects, request.liftoff);
  std::array<double, System<double>::kDim> z{};
  std::copy_n(state.begin(), std::min(state.size(), z.size()), z.begin());
  const GroundFrame<double> frame(seeds.parameters.slope);
  frame.FromWorld(z.data());
  if constexpr (requires { system.PlaceToe(z.data()); }) {
    if (mode == Mode::kFlight && state.size() < z.size())
      system.PlaceToe(z.data());
    else if (mode == Mode::kFlight)
      frame.FromWorld(&z[kToeX]);
  }
  system.StartSearch(mode, z.data());
  return system.Energy(mode, z.data());
}

}  // namespace hoplab
