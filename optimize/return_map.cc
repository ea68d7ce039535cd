#include "optimize/return_map.h"

namespace hoplab {

std::string EventSequence(const Hop& hop) {
  std::string names;
  for (const HopEvent& event : hop.events) {
    if (!names.empty()) names += ' ';
    names += NameOf(event.kind);
    if (event.leg >= 0) names += ' ' + std::to_string(event.leg + 1);
  }
  return names;
}

void ReturnMap::ReadRun(const Trajectory& run, Hop& hop) {
  hop.outcome = run.outcome;
  hop.least_crossing_rate = run.least_crossing_rate;
  hop.nearest_miss = run.nearest_miss;
  hop.simultaneous = run.has_simultaneous_events;
  hop.max_deflection_ratio = run.max_deflection_ratio;
}

}  // namespace hoplab
