#include "fitting/robot_problem.h"

#include <algorithm>

#include "fitting/trial_start.h"

namespace hoplab {
namespace {

// Sizes of a change of pitch and its rate that matter where no prior tells one: [rad], [rad/s].
constexpr double kPitchScale = 0.05, kPitchRateScale = 0.5;

const RobotParameters<double>& RobotOf(const FitProblem& problem) {
  return *problem.trials.front().parameters.robot;
}

void AddStart(const char* name, int place, double scale, double value,
              const std::optional<double>& sigma, TrialProblem& t) {
  OwnParameter own{.name = name,
                   .direction = SensitivityDirection::InitialState(place),
                   .scale = scale,
                   .prior_mean = value};
  if (sigma) own.prior_sigma = std::max(*sigma, kTightestPrior);
  own.scale = std::min(own.scale, own.prior_sigma);
  t.start.conservativeResize(place + 1);
  t.start[place] = value;
  t.own.push_back(own);
}

}  // namespace

void ChooseModuli(const ProblemOptions& options, FitProblem& problem) {
  if (problem.robot_legs().count == 0 || problem.robot_legs().straight) return;
  const auto is_own = [](const std::string& name) { return name.starts_with("E_"); };
  const bool shared =
      options.legs_alike || RobotOf(problem).legs == 1 ||
      std::find(options.free.begin(), options.free.end(), "E") != options.free.end() ||
      options.fix.count("E") != 0;
  bool own = options.free.empty() && !shared;
  own = own || std::any_of(options.free.begin(), options.free.end(), is_own);
  for (const auto& [name, value] : options.fix) own = own || is_own(name);
  for (const TrialProblem& t : problem.trials) own = own || t.parameters.robot->own_moduli;
  for (TrialProblem& t : problem.trials) t.parameters.robot->own_moduli = own;
}

bool IsOfRobot(ParameterId id, const FitProblem& problem) {
  if (problem.robot_legs().count == 0) return true;
  if (!IsOfLegs(id, problem.trials.front().parameters)) return false;
  if (id == ParameterId::kE) return !RobotOf(problem).own_moduli;
  if (id < ParameterId::kE1 || id > ParameterId::kE4) return true;
  return static_cast<int>(id) - static_cast<int>(ParameterId::kE1) < RobotOf(problem).legs;
}

std::vector<std::string> FreeNames(const FitProblem& problem) {
  std::vector<std::string> names;
  if (problem.robot_legs().straight) return {"k", "leg_damping"};
  for (ParameterId id : FreeByDefault(MechanismOf(problem.law))) {
    if (id == ParameterId::kE && !IsOfRobot(id, problem)) {
      for (int leg = 1; leg <= RobotOf(problem).legs; ++leg)
        names.push_back("E_" + std::to_string(leg));
    } else {
      names.emplace_back(InfoOf(id).name);
    }
  }
  return names;
}

void AddPitch(const Trial& trial, TrialProblem& t) {
  const StateSpec& state = *trial.initial;
  const StateSpec known = trial.initial_sigma.value_or(StateSpec{});
  AddStart("pitch0", 4, kPitchScale, state.pitch_rad.value_or(0.0), known.pitch_rad, t);
  AddStart("pitch_rate0", 5, kPitchRateScale, state.pitch_rate_rad_per_s.value_or(0.0),
           known.pitch_rate_rad_per_s, t);
}

}  // namespace hoplab
