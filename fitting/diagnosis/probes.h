#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fitting/diagnosis/score.h"

namespace hoplab {

/// One group of unit bumps: a free force, impulse, guard offset or sensor reading that needs no
/// name to be seen.
struct ProbeGroup {
  std::string name;     // "chord force, loading"
  std::string against;  // what its bumps are laid over: "compression [-]"; empty: one size each
  std::string unit;     // of the bumps' sizes
  std::vector<double> centres;  // of the bumps, in `against`
  int first = 0, count = 0;     // places among all probes
};

/// The probes that apply to a law, as effects with one parameter each, and their groups in order.
struct ProbeBasis {
  std::vector<Candidate> probes;
  std::vector<ProbeGroup> groups;
  std::vector<Hypothesis> hypotheses;  // one a group
};

ProbeBasis ProbesOf(Law law);

}  // namespace hoplab
