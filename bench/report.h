#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/timing.h"

namespace hoplab::bench {

/// One way to compute a stance, ours or a peer's.
struct StanceRow {
  std::string law, solver;
  Timing timing;
  long rhs_calls = 0, guard_calls = 0;  // 0: not counted
  double liftoff_error = 0.0;           // s, against the same law at tolerance 1e-13
  double own_event_error = 0.0;         // s, of the event time the tool itself reports
};

/// One of our simulations.
struct SimulationRow {
  std::string law, solver, what;
  int directions = 0;
  Timing timing;
};

/// A claim of the project about speed, and what was measured.
struct BoundRow {
  std::string claim;
  double value = 0.0, bound = 0.0;
  bool at_most = true;  // false: at least
  std::string unit;     // "x", "s"
  bool met() const { return at_most ? value <= bound : value >= bound; }
};

/// Everything one run of the comparison found.
struct Report {
  std::string date, cpu, compiler, build;
  int threads = 0;
  int rounds = 0;
  std::vector<StanceRow> stances;
  std::vector<SimulationRow> simulations;
  Timing fit;
  std::vector<BoundRow> bounds;
  std::vector<std::string> notes;  // what was left out, and why
};

/// Date and machine kind filled in.
Report NewReport();
std::string AsText(const Report& report);
std::string AsMarkdown(const Report& report);
nlohmann::json AsJson(const Report& report);

}  // namespace hoplab::bench
