#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/timing.h"
#include "model/simulate.h"

namespace hoplab::bench {

/// A peer that runs as a program of its own: a script of bench/peers and what interprets it.
struct PeerProgram {
  std::string name;         // "scipy solve_ivp DOP853"
  std::string interpreter;  // command; empty: not installed
  std::string script;       // path
};

/// scipy's solve_ivp, by the first Python that can import it.
PeerProgram FindScipy();
/// Octave's ode45.
PeerProgram FindOctave();

/// What a peer program made of one problem.
struct PeerRun {
  bool ran = false;
  std::string version;
  double liftoff_time = 0.0;      // s since touch-down
  double own_liftoff_time = 0.0;  // s, where its own event finder put it; else the same
  long rhs_calls = 0;
  Timing timing;  // grows with every run
};

/// Lets `peer` solve the stance of `law` `repetitions` times more and adds the times to `run`.
void RunPeer(const PeerProgram& peer, Law law, int repetitions,
             const std::filesystem::path& scratch_folder, PeerRun& run);

}  // namespace hoplab::bench
