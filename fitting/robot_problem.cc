#include "fitting/robot_problem.h"

#include <algorithm>
#include <limits>

#include "fitting/driven_trial.h"
#include "fitting/trial_start.h"
#include "model/simulate.h"

namespace hoplab {
namespace {

// How far the foot of a loaded leg leans, in halves of a leg: the deflection of legs that walk is
// 4 to 12 % of their height.
constexpr double kLean = 0.1;
// How far a loaded motor is off its reference [rad].
constexpr double kTurned = 0.1;
constexpr double kNoTime_s = 1e-9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

// The feet that the ground carries where the trial begins, at the nominal values.
std::vector<bool> StandingFeet(const FitProblem& problem, const TrialProblem& trial) {
  TrialRequest nominal;
  FillTrialRequest(problem, trial, InitialShared(problem), trial.start, nominal);
  nominal.request.integrator = problem.integrator;
  nominal.request.horizon = kNoTime_s;
  std::vector<bool> stands;
  for (const Foot& foot : Simulate(nominal.request).final_feet)
    stands.push_back(foot.stance != Foot::Stance::kFlight);
  return stands;
}

// The leg's foot or motor at the start, M119; `place` among those after the pitch and its rate.
void AddLean(const char* name, int leg, int place, double size, bool free, TrialProblem& t) {
  const int own = t.own_count();
  t.start.conservativeResize(own + 1);
  t.start[own] = 0.0;
  t.own.push_back({.name = name + std::to_string(leg + 1),
                   .direction = SensitivityDirection::InitialState(6 + place),
                   .scale = size,
                   .prior_sigma = free ? size : kInfinity,
                   .free = free});
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

std::vector<std::string> AddStandingFeet(FitProblem& problem) {
  std::vector<std::string> files;
  if (problem.robot_legs().count == 0) return files;
  for (TrialProblem& t : problem.trials) {
    const std::vector<bool> stands = StandingFeet(problem, t);
    if (std::find(stands.begin(), stands.end(), true) == stands.end()) continue;
    files.push_back(t.file);
    t.parameters.robot->starts_leaning = true;
    const int legs = static_cast<int>(stands.size());
    const double lean =
        kLean * (problem.robot_legs().straight ? 0.5 * t.parameters.l0 : t.parameters.r);
    for (int leg = 0; leg < legs; ++leg)
      AddLean("foot_ahead_", leg, leg, lean, stands[static_cast<std::size_t>(leg)], t);
    const bool turns = t.parameters.robot->control != MotorControl::kLocked &&
                       !t.parameters.robot->starts_at_angles;
    for (int leg = 0; leg < legs; ++leg)
      AddLean("motor_ahead_", leg, legs + leg, kTurned,
              turns && stands[static_cast<std::size_t>(leg)], t);
  }
  return files;
}

}  // namespace hoplab
