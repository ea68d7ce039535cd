#include "fitting/stance_torques.h"

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

constexpr std::size_t kAtRest = 5;  // rows before it
constexpr double kNone = 0.05, kThere = 0.25;

double Largest(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

// Of its largest torque it has none in some rows, and a part in the next.
bool StepsIn(const std::vector<double>& torque) {
  const double largest = Largest(torque);
  std::size_t at_rest = 0;
  for (const double v : torque) {
    if (at_rest >= kAtRest && std::abs(v) > kThere * largest) return true;
    at_rest = std::abs(v) < kNone * largest ? at_rest + 1 : 0;
  }
  return false;
}

}  // namespace

std::vector<std::string> StanceTorques(const FitProblem& problem) {
  std::size_t stepping = 0;
  bool held = false;
  for (const TrialProblem& trial : problem.trials)
    for (const DrivenColumn& c : trial.inputs)
      if (c.kind == InputKind::kHipTorque && !c.of_stance && StepsIn(c.values)) {
        ++stepping;
        held = c.held;
      }
  if (2 * stepping <= problem.trials.size()) return {};
  return {
      std::string("hip_torque_N_m: there is none in flight, and one row later it is there. From "
                  "a touch-down to that row the simulation has ") +
      (held ? "none, and then a blow" : "a part of it, and the rest comes within the row") +
      ", which may lift the foot off; `hold: stance` holds each row's torque, and from a "
      "touch-down on that of the row behind it"};
}

}  // namespace hoplab
