#include "model/run.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cstdint>

#include "base/check.h"
#include "model/hybrid/engine.h"
#include "model/hybrid/ground_frame.h"
#include "model/laws/leg_load.h"
#include "model/row_sink.h"

namespace hoplab {
namespace {

constexpr std::size_t kMostClocks = 8;

// The request in scalar type T with directions first .. first + count seeded.
template <class T>
struct Seeds {
  MechanismSetup<T> setup;
  boost::container::static_vector<T, kMaxStates> initial;
  boost::container::static_vector<T, kMostClocks> clock_offsets;

  using InputValues = std::array<std::array<T, 2>, kInputKinds>;  // delay, scale
  using EffectValues = std::array<std::array<T, kMaxEffectParameters>, ActiveEffects<T>::kMax>;

  Seeds(const SimulationRequest& request, int first, int count) {
    setup.law = request.law;
    setup.liftoff = request.liftoff;
    setup.parameters = ConvertParameters<T>(request.parameters);
    HOPLAB_CHECK(request.initial.size() <= initial.capacity());
    for (const double value : request.initial) initial.push_back(T(value));
    HOPLAB_CHECK(request.clock_offsets.size() <= kMostClocks);
    for (const double offset : request.clock_offsets) clock_offsets.push_back(T(offset));
    for (const double angle : request.touchdown_angles) setup.touchdown_angles.push_back(T(angle));
    HOPLAB_CHECK(request.inputs.size() <= kInputKinds);
    InputValues input_values;
    for (std::size_t i = 0; i < request.inputs.size(); ++i)
      input_values[i] = {T(request.inputs[i].delay), T(request.inputs[i].scale)};
    EffectValues values;
    std::array<bool, ActiveEffects<T>::kMax> active{};
    HOPLAB_CHECK(request.effects.size() <= active.size());
    for (std::size_t e = 0; e < request.effects.size(); ++e) {
      // Where the law has it in itself, its null is another model.
      const EffectSetting& effect = request.effects[e];
      active[e] = !effect.IsNull() || IsPartOf(request.law, *effect.effect);
      for (int i = 0; i < kMaxEffectParameters; ++i) values[e][i] = T(effect.values[i]);
    }
    // An effect that any direction asks for acts in every chunk: all chunks run the same
    // simulation.
    for (const SensitivityDirection& d : request.directions) {
      if (d.of == SensitivityDirection::Of::kEffect) active[d.index] = true;
    }
    for (int k = 0; k < count; ++k) {
      T& seeded = NumberAlong(request.directions[first + k], values, input_values);
      seeded += Seeded<T>(0.0, k, 1.0);  // two directions may be along one number
    }
    for (std::size_t e = 0; e < request.effects.size(); ++e) {
      if (active[e]) setup.effects.Add(*request.effects[e].effect, values[e]);
    }
    setup.effects.ChangeParameters(setup.parameters);
    for (std::size_t i = 0; i < request.inputs.size(); ++i) {
      const DrivenInput& input = request.inputs[i];
      const auto family = static_cast<std::size_t>(FamilyOf(input.kind));
      T delay = input_values[i][0] + setup.parameters.input_delay[family];
      if (input.clock >= 0) delay += clock_offsets[static_cast<std::size_t>(input.clock)];
      setup.inputs.Set(input.kind,
                       {input, delay, input_values[i][1] + setup.parameters.input_scale[family]});
    }
    setup.inputs.Seek(0.0);
  }

  // The number that a direction is along.
  T& NumberAlong(const SensitivityDirection& d, EffectValues& values, InputValues& inputs) {
    switch (d.of) {
      case SensitivityDirection::Of::kInitialState:
        HOPLAB_CHECK(d.index < static_cast<int>(initial.size()));
        return initial[d.index];
      case SensitivityDirection::Of::kEffect:
        return values[d.index][d.component];
      case SensitivityDirection::Of::kInput:
        return inputs[d.index][d.component];
      case SensitivityDirection::Of::kTouchdownAngle:
        return setup.touchdown_angles[d.index];
      case SensitivityDirection::Of::kClock:
        return clock_offsets[d.index];
      case SensitivityDirection::Of::kParameter:
        break;
    }
    return Field(setup.parameters, d.parameter);
  }

  /// The same without directions.
  template <class To>
  MechanismSetup<To> SetupIn() const {
    MechanismSetup<To> to{setup.law, ConvertParameters<To>(setup.parameters),
                          setup.effects.template Convert<To>(), setup.liftoff,
                          setup.inputs.template Convert<To>()};
    for (const T& angle : setup.touchdown_angles) to.touchdown_angles.push_back(To(Value(angle)));
    return to;
  }
};

// Events and the final state of a run, from the frame of the ground.
void ToWorld(const GroundFrame<double>& frame, int bodies, Trajectory& run) {
  if (frame.level()) return;
  for (int body = 0; body < bodies; ++body) {
    const auto first = static_cast<std::ptrdiff_t>(body) * 4;
    frame.ToWorld(run.final_state.data() + first);
    frame.ToWorld(run.final_rate.data() + first);
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
std::uint32_t SharpDirections(const SimulationRequest& request, int first, int count) {
  std::uint32_t bits = 0;
  for (int k = 0; k < count; ++k) {
    const SensitivityDirection& d = request.directions[first + k];
    if (d.of == SensitivityDirection::Of::kEffect && request.effects[d.index].effect->info.sharp)
      bits |= std::uint32_t{1} << k;
  }
  return bits;
}

// The state a run begins with, in the frame of the ground.
template <class T>
void PlaceStart(std::span<const T> given, Mode mode, const HybridSystem<T>& system,
                const GroundFrame<T>& frame, T* z) {
  const int states = system.size(), count = static_cast<int>(given.size());
  HOPLAB_CHECK(count <= states);
  std::copy(given.begin(), given.end(), z);
  std::fill(z + count, z + states, T(0.0));
  for (int body = 0; 4 * (body + 1) <= count && body < system.BodyCount(mode); ++body)
    frame.FromWorld(z + static_cast<std::ptrdiff_t>(body) * 4);
  if (mode == Mode::kFlight || system.CompletesAnyStart())
    system.CompleteStart(z, count);
  else if (count > kContact)
    z[kContact] = frame.AlongGround(z[kContact]);
}

template <class T>
void RunChunk(const SimulationRequest& request, const Mechanism& mechanism, int first, int count,
              Trajectory& out) {
  const Seeds<T> seeds(request, first, count);
  SystemStorage<T> system;
  SystemStorage<double> values;
  SystemStorage<Jet<1>> rates;
  mechanism.Make(seeds.setup, system);
  mechanism.Make(seeds.template SetupIn<double>(), values);
  mechanism.Make(seeds.template SetupIn<Jet<1>>(), rates);
  // Every chunk runs the same simulation: only the first one's record of it is kept.
  Trajectory scratch;
  Trajectory& record = first == 0 ? out : scratch;
  const GroundFrame<T> frame(seeds.setup.parameters.slope);
  RowSink<T> sink(request, seeds.setup.effects, seeds.setup.parameters,
                  {seeds.clock_offsets.data(), seeds.clock_offsets.size()}, *system, frame, first,
                  count, out);
  IntegratorOptions integrator = request.integrator;
  integrator.steering = SharpDirections(request, first, count);
  Engine<T> engine({*system, *values, *rates}, integrator,
                   {request.horizon, request.max_hops, request.fly_on, request.feet}, sink, record);
  T z[kMaxStates];
  PlaceStart<T>({seeds.initial.data(), seeds.initial.size()}, request.start_mode, *system, frame,
                z);
  engine.Run(request.start_mode, z);
  if (first == 0) out.rows_in_run = sink.RowsAmong(out.rows_in_run);
  // A chunk that fails has no derivatives to give: then the whole has none.
  if (first > 0 && IsComplete(out.outcome)) out.outcome = record.outcome;

  // What the run leaves, in world W.
  const int states = system->ReportedSize(), bodies = system->BodyCount(record.final_mode);
  std::copy_n(engine.final_state(), states, z);
  for (int body = 0; body < bodies; ++body) frame.ToWorld(z + 4 * body);
  const std::size_t width = request.directions.size();
  if (first == 0) {
    out.final_state.resize(states);
    out.final_rate.resize(states);
    ToWorld(GroundFrame<double>(Value(seeds.setup.parameters.slope)), bodies, out);
    out.event_time_sensitivities.resize(out.events.size() * width);
    out.final_sensitivities.resize(out.final_state.size() * width);
  }
  const std::size_t events = std::min(out.events.size(), record.events.size());
  for (int k = 0; k < count; ++k) {
    for (std::size_t e = 0; e < events; ++e)
      out.event_time_sensitivities[e * width + first + k] =
          engine.event_times()[e * kJetWidth<T> + k];
    for (int i = 0; i < states; ++i)
      out.final_sensitivities[i * width + first + k] = Slope(z[i], k);
  }
}

}  // namespace

void RunRequest(const SimulationRequest& request, const Mechanism& mechanism, Trajectory& out) {
  const int directions = static_cast<int>(request.directions.size());
  if (directions == 0) return RunChunk<double>(request, mechanism, 0, 0, out);
  for (int first = 0; first < directions; first += kWidestJet) {
    const int count = std::min(directions - first, kWidestJet);
    if (count <= kNarrowJet)
      RunChunk<Jet<kNarrowJet>>(request, mechanism, first, count, out);
    else if (count <= kWideJet)
      RunChunk<Jet<kWideJet>>(request, mechanism, first, count, out);
    else
      RunChunk<Jet<kWidestJet>>(request, mechanism, first, count, out);
  }
}

double EnergyOf(const SimulationRequest& request, const Mechanism& mechanism, Mode mode,
                std::span<const double> state) {
  const Seeds<double> seeds(request, 0, 0);
  SystemStorage<double> system;
  mechanism.Make(seeds.setup, system);
  const GroundFrame<double> frame(seeds.setup.parameters.slope);
  double z[kMaxStates] = {};
  const int given = std::min(static_cast<int>(state.size()), system->size());
  std::copy_n(state.begin(), given, z);
  const int bodies = std::min(system->BodyCount(mode), given / 4);
  for (int body = 0; body < bodies; ++body)
    frame.FromWorld(z + static_cast<std::ptrdiff_t>(body) * 4);
  if (mode == Mode::kFlight) system->CompleteStart(z, given);
  system->StartSearch(mode, z);
  return system->Energy(mode, z);
}

}  // namespace hoplab
