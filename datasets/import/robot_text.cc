#include "datasets/import/robot_text.h"

#include <algorithm>
#include <cstdio>

#include "datasets/blank_values.h"
#include "datasets/yaml_fields.h"

namespace hoplab {
namespace {

// "; the log begins at [0.618, 0.430]"
std::string FirstAngles(const RobotTrial& trial) {
  std::string text;
  for (const double angle : trial.angles_rad) {
    char number[32];
    std::snprintf(number, sizeof number, "%.3f", angle);
    text += (text.empty() ? "; the log begins at [" : ", ") + std::string(number);
  }
  return text.empty() ? "" : text + "]";
}

// "[0, 0]"
std::string Zeros(int legs) {
  std::string text = "[0";
  for (int leg = 1; leg < legs; ++leg) text += ", 0";
  return text + "]";
}

}  // namespace

void AddRobotValues(const DatasetText& dataset, std::vector<WaitingValue>* values) {
  for (int leg = 0; leg < dataset.legs; ++leg)
    values->push_back(
        {"mechanism.legs." + std::to_string(leg) + ".hip_m",
         std::string(leg == 0 ? "the hindmost leg" : "the next leg") + ": " + kHipHint, "[1, 1]"});
  const bool recorded = !dataset.inputs.empty();
  const bool told = std::any_of(dataset.inputs.begin(), dataset.inputs.end(), [](InputKind input) {
    return FamilyOf(input) == InputKind::kHipTorque;
  });
  const std::string zeros = Zeros(dataset.legs);
  const std::string locked = "{type: locked, angles_rad: " + zeros + "}";
  if (!recorded) values->push_back({"controller", kMotorsHint, locked});
  for (std::size_t i = 0; i < dataset.trials.size(); ++i) {
    const RobotTrial& trial = dataset.trials[i].robot;
    const std::string path = "trials." + std::to_string(i) + ".";
    if (!recorded)
      values->push_back({path + "controller", kMotorsHint + FirstAngles(trial), locked});
    if (told)
      values->push_back(
          {path + "controller.angles_rad", kMotorAnglesHint + FirstAngles(trial), zeros});
    if (!trial.initial)
      values->push_back({path + "initial", kRobotStartHint,
                         "{x_m: 0, y_m: 1, vx_m_per_s: 0, vy_m_per_s: 0, pitch_rad: 0, "
                         "pitch_rate_rad_per_s: 0}"});
  }
}

std::string StartText(const RobotTrial& trial, bool given) {
  if (!trial.initial || given) return "";
  return "    # Read from the first 40 ms:\n    initial: " + Flow(StateFields(*trial.initial)) +
         "\n    initial_sigma: " + Flow(StateFields(*trial.initial_sigma)) + "\n";
}

}  // namespace hoplab
