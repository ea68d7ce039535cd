#include "fitting/stance_torques.h"

#include <algorithm>

#include "datasets/stance_torque.h"

namespace hoplab {
namespace {

bool StepsIn(const std::vector<double>& torque) {
  const std::vector<TorqueRest> rests = TorqueRests(torque);
  return std::any_of(rests.begin(), rests.end(), [](const TorqueRest& r) { return r.steps_in; });
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
      ", which may lift the foot off; `hold: stance` holds each row's torque, and through a "
      "flight that of the stances around it"};
}

}  // namespace hoplab
