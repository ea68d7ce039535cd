#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <span>
#include <utility>
#include <vector>

#include "model/channels/channel_reading.h"
#include "model/effects/active_effects.h"
#include "model/hybrid/engine.h"
#include "model/hybrid/ground_frame.h"
#include "model/simulate.h"

namespace hoplab {

/// One reading of a row: of the channels that are stamped alike.
struct Reading {
  int row = 0;
  int clock = -1;
  bool of_pose = false;  // told apart only where an effect gives the pose a time of its own

  bool IsStampedAs(const Reading& other) const {
    return clock == other.clock && of_pose == other.of_pose;
  }
};

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
        system_(system),
        frame_(frame),
        first_(first_direction),
        count_(directions),
        out_(out),
        body_only_(std::all_of(request.channels.begin(), request.channels.end(),
                               [](Channel c) { return c <= Channel::kBodyVy; }) &&
                   !parameters_.law_terms.leg_mass_active &&                 // M88
                   !(parameters_.robot && effects_.HasObservationChange()))  // M102
  {
    for (const Channel channel : request.channels) {
      const ChannelSource source = SourceOf(channel);
      sources_.push_back(source);
      if (source.reading && std::find(read_.begin(), read_.end(), source.reading) == read_.end())
        read_.push_back(source.reading);
    }
    if (!request.channel_clocks.empty() || effects.HasPoseTime()) ListReadings();
  }

  int count() const override {
    return static_cast<int>(readings_.empty() ? request_.row_times.size() : readings_.size());
  }
  T Time(int i) const override {
    return readings_.empty() ? effects_.ObservationTime(T(request_.row_times[i]))
                             : TimeOf(readings_[static_cast<std::size_t>(i)]);
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
    Observation<T> seen;
    if (body_only_) {
      for (int i = 0; i < 4; ++i) seen.channel[i] = z[i];
    } else {
      seen = system_.Observe(mode, time, z);
      frame_.LegToWorld(seen);
    }
    frame_.BodyToWorld(seen);
    const Instant<T> at{mode, time, z, system_, parameters_, frame_, seen};
    for (const ChannelReading* more : read_) {
      ReadValues<T> values;
      more->Read(at, values);
      WriteWhere(reading, [&](std::size_t c) -> const T* {
        const ChannelSource& source = sources_[c];
        return source.reading == more ? &values[static_cast<std::size_t>(source.place)] : nullptr;
      });
    }
    effects_.ChangeObservation(time + parameters_.time_origin, seen);
    WriteWhere(reading, [&](std::size_t c) -> const T* {
      const Channel channel = request_.channels[c];
      return !sources_[c].reading && seen.Has(channel) ? &seen[channel] : nullptr;
    });
  }

 private:
  T TimeOf(const Reading& reading) const {
    T time(request_.row_times[static_cast<std::size_t>(reading.row)]);
    if (reading.clock >= 0) time += clock_offsets_[static_cast<std::size_t>(reading.clock)];
    return reading.of_pose ? effects_.PoseTime(time) : effects_.ObservationTime(time);
  }
  // Those of every row, in the order of their times.
  void ListReadings() {
    const bool splits = effects_.HasPoseTime();
    boost::container::small_vector<Reading, 4> stamps;  // each once
    for (std::size_t c = 0; c < request_.channels.size(); ++c) {
      const Reading stamp{0, request_.channel_clocks.empty() ? -1 : request_.channel_clocks[c],
                          splits && IsPose(request_.channels[c])};
      stamps_.push_back(stamp);
      if (std::none_of(stamps.begin(), stamps.end(),
                       [&](const Reading& other) { return stamp.IsStampedAs(other); }))
        stamps.push_back(stamp);
    }
    std::vector<std::pair<double, Reading>> timed;
    timed.reserve(stamps.size() * request_.row_times.size());
    for (int row = 0; row < static_cast<int>(request_.row_times.size()); ++row) {
      for (const Reading& stamp : stamps) {
        const Reading reading{row, stamp.clock, stamp.of_pose};
        timed.emplace_back(Value(TimeOf(reading)), reading);
      }
    }
    std::stable_sort(timed.begin(), timed.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    readings_.reserve(timed.size());
    for (const auto& [time, reading] : timed) readings_.push_back(reading);
  }
  // What `value_of` tells of the row's channels that are stamped as the reading; where it tells
  // nothing NaN stays.
  template <class ValueOf>
  void WriteWhere(const Reading& reading, const ValueOf& value_of) {
    const std::size_t channels = request_.channels.size(), width = request_.directions.size();
    for (std::size_t c = 0; c < channels; ++c) {
      if (!readings_.empty() && !reading.IsStampedAs(stamps_[c])) continue;
      const T* value = value_of(c);
      if (!value) continue;
      const std::size_t cell = static_cast<std::size_t>(reading.row) * channels + c;
      out_.samples[cell] = Value(*value);
      for (int k = 0; k < count_; ++k)
        out_.sensitivities[cell * width + static_cast<std::size_t>(first_ + k)] = Slope(*value, k);
    }
  }

  const SimulationRequest& request_;
  const ActiveEffects<T>& effects_;
  const Parameters<T>& parameters_;
  std::span<const T> clock_offsets_;
  boost::container::small_vector<Reading, 8> stamps_;  // of the request's channels
  std::vector<Reading> readings_;                      // empty: row by row, all channels at once
  const HybridSystem<T>& system_;
  const GroundFrame<T>& frame_;
  int first_, count_;
  Trajectory& out_;
  bool body_only_;
  boost::container::small_vector<ChannelSource, 8> sources_;       // of the request's channels
  boost::container::small_vector<const ChannelReading*, 2> read_;  // among them, each once
};

}  // namespace hoplab
