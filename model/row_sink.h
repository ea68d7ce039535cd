#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <span>
#include <vector>

#include "model/channels/channel_reading.h"
#include "model/effects/active_effects.h"
#include "model/hybrid/engine.h"
#include "model/hybrid/ground_frame.h"
#include "model/simulate.h"

namespace hoplab {

/// One reading of a row: of the channels that one clock stamps.
struct Reading {
  int row = 0;
  int clock = -1;
};

/// The readings of a request in the order of their times, where clocks stamp its channels.
inline std::vector<Reading> ReadingsOf(const SimulationRequest& request) {
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

/// Copies each row's wanted channels, with their directions, into a trajectory.
template <class T>
class RowSink final : public RowReader<T> {
 public:
  RowSink(const SimulationRequest& request, const ActiveEffects<T>& effects,
          const Parameters<T>& parameters, std::span<const T> clock_offsets,
          const HybridSystem<T>& system, const GroundFrame<T>& frame, int first_direction,
          int directions, Trajectory& out)
      : request_(request),
        effects_(effects),
        parameters_(parameters),
        clock_offsets_(clock_offsets),
        readings_(ReadingsOf(request)),
        system_(system),
        frame_(frame),
        first_(first_direction),
        count_(directions),
        out_(out),
        body_only_(std::all_of(request.channels.begin(), request.channels.end(),
                               [](Channel c) { return c <= Channel::kBodyVy; }) &&
                   !parameters_.law_terms.leg_mass_active)  // M88
  {
    for (const Channel channel : request.channels) {
      const ChannelSource source = SourceOf(channel);
      sources_.push_back(source);
      if (source.reading && std::find(read_.begin(), read_.end(), source.reading) == read_.end())
        read_.push_back(source.reading);
    }
  }

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
    const int row = reading.row, clock = reading.clock;
    Observation<T> seen;
    if (body_only_) {
      for (int i = 0; i < 4; ++i) seen.channel[i] = z[i];
    } else {
      seen = system_.Observe(mode, time, z);
      frame_.LegToWorld(seen);
    }
    frame_.BodyToWorld(seen);
    const Instant<T> at{mode, time, z, system_, parameters_, frame_, seen};
    for (const ChannelReading* reading : read_) {
      ReadValues<T> values;
      reading->Read(at, values);
      WriteWhere(row, clock, [&](std::size_t c) -> const T* {
        const ChannelSource& source = sources_[c];
        return source.reading == reading ? &values[static_cast<std::size_t>(source.place)]
                                         : nullptr;
      });
    }
    effects_.ChangeObservation(time + parameters_.time_origin, seen);
    WriteWhere(row, clock, [&](std::size_t c) -> const T* {
      const Channel channel = request_.channels[c];
      return !sources_[c].reading && seen.Has(channel) ? &seen[channel] : nullptr;
    });
  }

 private:
  // What `value_of` tells of the row's channels that this clock stamps; where it tells nothing NaN
  // stays.
  template <class ValueOf>
  void WriteWhere(int row, int clock, const ValueOf& value_of) {
    const std::size_t channels = request_.channels.size(), width = request_.directions.size();
    for (std::size_t c = 0; c < channels; ++c) {
      if (!readings_.empty() && request_.channel_clocks[c] != clock) continue;
      const T* value = value_of(c);
      if (!value) continue;
      const std::size_t cell = static_cast<std::size_t>(row) * channels + c;
      out_.samples[cell] = Value(*value);
      for (int k = 0; k < count_; ++k)
        out_.sensitivities[cell * width + static_cast<std::size_t>(first_ + k)] = Slope(*value, k);
    }
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
  bool body_only_;
  boost::container::small_vector<ChannelSource, 8> sources_;       // of the request's channels
  boost::container::small_vector<const ChannelReading*, 2> read_;  // among them, each once
};

}  // namespace hoplab
