#pragma once

#include <array>
#include <string_view>

#include "base/channel.h"
#include "model/hybrid/ground_frame.h"
#include "model/hybrid/hybrid_system.h"
#include "model/parameters.h"

namespace hoplab {

/// What is known at one instant of a run. `z` is in the frame of the ground, `seen` what the
/// automaton tells, in the world, before effects change what sensors show.
template <class T>
struct Instant {
  Mode mode;
  const T& time;
  const T* z;
  const HybridSystem<T>& system;
  const Parameters<T>& parameters;
  const GroundFrame<T>& frame;
  const Observation<T>& seen;
};

/// Most channels of one reading.
inline constexpr int kMostRead = 4;
template <class T>
using ReadValues = std::array<T, kMostRead>;

/// Channels that follow from the motion of any mechanism, and how: what a file in model/channels
/// registers.
struct ChannelReading {
  std::array<std::string_view, kMostRead> names;  // of their rows; the last ones empty
  void (*read0)(const Instant<double>&, ReadValues<double>&);
  void (*read_narrow)(const Instant<Jet<kNarrowJet>>&, ReadValues<Jet<kNarrowJet>>&);
  void (*read_wide)(const Instant<Jet<kWideJet>>&, ReadValues<Jet<kWideJet>>&);
  void (*read_widest)(const Instant<Jet<kWidestJet>>&, ReadValues<Jet<kWidestJet>>&);

  template <class T>
  void Read(const Instant<T>& at, ReadValues<T>& values) const {
    if constexpr (kJetWidth<T> == 0)
      read0(at, values);
    else if constexpr (kJetWidth<T> == kNarrowJet)
      read_narrow(at, values);
    else if constexpr (kJetWidth<T> == kWideJet)
      read_wide(at, values);
    else
      read_widest(at, values);
  }
};

/// The entry of a class with `kNames` and `template <class T> static void Read(const Instant<T>&,
/// ReadValues<T>&)`.
template <class R>
constexpr ChannelReading MakeChannelReading() {
  return {R::kNames, R::template Read<double>, R::template Read<Jet<kNarrowJet>>,
          R::template Read<Jet<kWideJet>>, R::template Read<Jet<kWidestJet>>};
}

/// Where a channel is read: the reading and its place there; none for one the automaton tells.
struct ChannelSource {
  const ChannelReading* reading = nullptr;
  int place = 0;
};
ChannelSource SourceOf(Channel channel);

}  // namespace hoplab
