#include "model/run.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cstdint>

#include "base/check.h"
#include "model/hybrid/engine.h"
#include "model/hybrid/ground_frame.h"
#include "model/laws/leg_load.h"

namespace hoplab {
namespace {

constexpr std::size_t kMostClocks = 8;

// One reading of a row: of the channels that one clock stamps.
struct Reading {
  int row = 0;
  int clock = -1;
};

// The readings of a request in the order of their times, where clocks stamp its channels.
std::vector<Reading> ReadingsOf(const SimulationRequest& request) {
  std::vector<Reading> readings;
  if (request.channel_clocks.empty()) return readings;
  const auto offset = [&](int clock) { return clock < 0 ? 0.0 : request.clock_offsets[clock]; };
  std::vector<int> clocks(request.channel_clocks.begin(), request.channel_clocks.end());
  std::sort(clocks.begin(), clocks.end());
  clocks.erase(std::unique(clocks.begin(), clocks.end()), clocks.end());
  for (int row = 0; row < static_cast<int>(request.row_times.size()); ++row)
    for (const int clock : clocks) readings.push_back({row, clock});
  std::stable_sort(readings.begin(), readings.end(), [&](const Reading& a, const Reading& b) {
    return request.row_times[a.row] + offset(a.clock) < request.row_times[b.row] + offset(b.clock);
  });
  return readings;
}

// The request in scalar type T with directions first .. first + count seeded.
template <class T>
struct Seeds {
  MechanismSetup<T> setup;
  boost::container::static_vector<T, kMaxStates> initial;
  boost::container::static_vector<T, kMostClocks> clock_offsets;

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
    std::array<std::array<T, 2>, kInputKinds> input_values;
    for (std::size_t i = 0; i < request.inputs.size(); ++i)
      input_values[i] = {T(request.inputs[i].delay), T(request.inputs[i].scale)};
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
      T* seeded = nullptr;
      switch (d.of) {
        case SensitivityDirection::Of::kParameter:
          seeded = &Field(setup.parameters, d.parameter);
          break;
        case SensitivityDirection::Of::kInitialState:
          HOPLAB_CHECK(d.index < static_cast<int>(initial.size()));
          seeded = &initial[d.index];
          break;
        case SensitivityDirection::Of::kEffect:
          seeded = &values[d.index][d.component];
          break;
        case SensitivityDirection::Of::kInput:
          seeded = &input_values[d.index][d.component];
          break;
        case SensitivityDirection::Of::kTouchdownAngle:
          seeded = &setup.touchdown_angles[d.index];
          break;
        case SensitivityDirection::Of::kClock:
          seeded = &clock_offsets[d.index];
          break;
      }
      *seeded = Seeded<T>(Value(*seeded), k, 1.0);
    }
    for (std::size_t e = 0; e < request.effects.size(); ++e) {
      if (active[e]) setup.effects.Add(*request.effects[e].effect, values[e]);
    }
    setup.effects.ChangeParameters(setup.parameters);
    for (std::size_t i = 0; i < request.inputs.size(); ++i) {
      const DrivenInput& input = request.inputs[i];
      const auto kind = static_cast<std::size_t>(input.kind);
      T delay = input_values[i][0] + setup.parameters.input_delay[kind];
      if (input.clock >= 0) delay += clock_offsets[static_cast<std::size_t>(input.clock)];
      setup.inputs.Set(input.kind,
                       {input, delay, input_values[i][1] + setup.parameters.input_scale[kind]});
    }
    setup.inputs.Seek(0.0);
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

// Copies each row's wanted channels, with their directions, into a trajectory.
template <class T>
class RowSink final : public RowReader<T> {
 public:
  RowSink(const SimulationRequest& request, const Seeds<T>& seeds, const HybridSystem<T>& system,
          const GroundFrame<T>& frame, int first_direction, int directions, Trajectory& out)
      : request_(request),
        effects_(seeds.setup.effects),
        parameters_(seeds.setup.parameters),
        clock_offsets_(seeds.clock_offsets.data(), seeds.clock_offsets.size()),
        readings_(ReadingsOf(request)),
        system_(system),
        frame_(frame),
        first_(first_direction),
        count_(directions),
        out_(out),
        body_only_(std::all_of(request.channels.begin(), request.channels.end(),
                               [](Channel c) { return c <= Channel::kBodyVy; }) &&
                   !parameters_.law_terms.leg_mass_active),  // M88
        accelerations_(
            std::any_of(request.channels.begin(), request.channels.end(), IsAcceleration)) {}

  int count() const override {
    return static_cast<int>(readings_.empty() ? request_.row_times.size() : readings_.size());
  }
  T Time(int i) const override {
    if (readings_.empty()) return effects_.ObservationTime(T(request_.row_times[i]));
    const Reading& reading = readings_[static_cast<std::size_t>(i)];
    T time(request_.row_times[reading.row]);
    if (reading.clock >= 0) time += clock_offsets_[static_cast<std::size_t>(reading.clock)];
    return effects_.ObservationTime(time);
  }
  // How many rows, from the first on, have all their readings among the first `count`.
  int RowsAmong(int count) const {
    int rows = static_cast<int>(request_.row_times.size());
    for (std::size_t i = static_cast<std::size_t>(count); i < readings_.size(); ++i)
      rows = std::min(rows, readings_[i].row);
    return readings_.empty() ? count : rows;
  }

  void Read(int i, Mode mode, const T& time, const T* z) override {
    const Reading reading = readings_.empty() ? Reading{i} : readings_[static_cast<std::size_t>(i)];
    const int row = reading.row;
    Observation<T> seen;
    if (body_only_) {
      for (int i = 0; i < 4; ++i) seen.channel[i] = z[i];
    } else {
      seen = system_.Observe(mode, time, z);
      frame_.LegToWorld(seen);
      if (accelerations_) ReadAccelerations(mode, time, z, seen);
    }
    frame_.BodyToWorld(seen);
    effects_.ChangeObservation(time + parameters_.time_origin, seen);
    const int channels = static_cast<int>(request_.channels.size());
    const int width = static_cast<int>(request_.directions.size());
    for (int c = 0; c < channels; ++c) {
      if (!readings_.empty() && request_.channel_clocks[c] != reading.clock) continue;
      if (!seen.Has(request_.channels[c])) continue;  // stays NaN
      const T& value = seen[request_.channels[c]];
      const std::size_t cell = static_cast<std::size_t>(row) * channels + c;
      out_.samples[cell] = Value(value);
      for (int k = 0; k < count_; ++k)
        out_.sensitivities[cell * width + first_ + k] = Slope(value, k);
    }
  }

 private:
  // M55: of the body, and as an accelerometer on it reads them, without gravity.
  void ReadAccelerations(Mode mode, const T& time, const T* z, Observation<T>& seen) const {
    using std::cos;
    using std::sin;
    T dz[kMaxStates];
    system_.Derivative(mode, time, z, dz);
    seen[Channel::kBodyAx] = dz[2];
    seen[Channel::kBodyAy] = dz[3];
    const bool level = IsZero(parameters_.slope);
    const T along = level ? T(0.0) : T(parameters_.g * sin(parameters_.slope));
    const T down = level ? parameters_.g : T(parameters_.g * cos(parameters_.slope));
    seen[Channel::kImuAx] = dz[2] + along;
    seen[Channel::kImuAy] = dz[3] + down;
    frame_.AccelerationsToWorld(seen);
  }

  const SimulationRequest& request_;
  const ActiveEffects<T>& effects_;
  const Parameters<T>& parameters_;
  std::span<const T> clock_offsets_;
  std::vector<Reading> readings_;  // empty: row by row
  const HybridSystem<T>& system_;
  const GroundFrame<T>& frame_;
  int first_, count_;
  Trajectory& out_;
  bool body_only_, accelerations_;
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
  RowSink<T> sink(request, seeds, *system, frame, first, count, out);
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
  for (int first = 0; first < directions;) {
    const int left = directions - first;
    if (left <= kNarrowJet) {
      RunChunk<Jet<kNarrowJet>>(request, mechanism, first, left, out);
      first += left;
    } else {
      const int count = std::min(left, kWideJet);
      RunChunk<Jet<kWideJet>>(request, mechanism, first, count, out);
      first += count;
    }
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
