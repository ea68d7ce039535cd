#include "fitting/diagnosis/candidate.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "fitting/model_of_spec.h"
#include "fitting/smoothed_traces.h"

namespace hoplab {
namespace {

const Effect& Applicable(const FitProblem& problem, const std::string& name,
                         const std::string& place) {
  const Effect& effect = ResolveEffect(name, place, problem.formulas);
  CheckApplies(effect, problem.law, problem.leg_mass(), place, problem.inputs(),
               problem.robot_legs());
  return effect;
}

// What `--effects` names is to be tried, which means nothing of what the law has in itself.
const Effect& ToTry(const FitProblem& problem, const std::string& name) {
  const Effect& effect = Applicable(problem, name, "--effects");
  if (IsPartOf(problem.law, effect)) {
    throw InputError(
        {"--effects", name,
         "is part of the law " + std::string(NameOf(problem.law)) + ", which cannot lack it",
         "Leave it out; --with " + name + " fits its share."});
  }
  problem.known.CheckOpen(effect, "--effects");
  return effect;
}

bool Simulates(const FitProblem& problem, const Effect& effect) {
  return std::any_of(problem.effects.begin(), problem.effects.end(),
                     [&](const EffectSetting& e) { return e.effect == &effect; });
}

// Whether a delay or scale that the effect would change is fitted by its own name already.
bool IsFitted(const FitProblem& problem, const Effect& effect) {
  const std::string_view name = effect.info.name;
  const bool delays = name.ends_with("_input_delay");
  const InputSet of = effect.info.scales | effect.info.needs_inputs;
  return std::any_of(problem.shared.begin(), problem.shared.end(), [&](const SharedParameter& s) {
    return s.direction.of == SensitivityDirection::Of::kInput &&
           (BitOf(static_cast<InputKind>(s.direction.index)) & of) != 0 &&
           (s.direction.component == 0) == delays;
  });
}

// Beside no other channel, a pose that is late is a recording that is late.
bool IsDelayOfAll(const FitProblem& problem, const Effect& effect) {
  return effect.hooks0.change_pose_time != nullptr && !problem.uses_contact &&
         std::all_of(problem.channels.begin(), problem.channels.end(),
                     [](const ChannelProblem& c) { return IsPose(c.channel); });
}

// Motors without a limit, locked ones, and those that are told a recorded torque have none to lose.
bool HasTorqueLimit(const TrialProblem& trial) {
  const RobotParameters<double>& robot = *trial.parameters.robot;
  const bool told =
      std::any_of(trial.inputs.begin(), trial.inputs.end(), [](const DrivenColumn& column) {
        return (BitOf(column.kind) & BitsOfFamily(InputKind::kHipTorque)) != 0;
      });
  return std::isfinite(robot.torque_limit) && robot.control != MotorControl::kLocked && !told;
}

bool Compares(const FitProblem& problem, Channel channel) {
  return std::any_of(problem.channels.begin(), problem.channels.end(),
                     [&](const ChannelProblem& c) { return c.channel == channel; });
}

bool HasPart(const FitProblem& problem, const TrialProblem& trial, MachinePart part) {
  switch (part) {
    case MachinePart::kNone:
      return true;
    case MachinePart::kGuideOfBall:
      return problem.law != Law::kBall || trial.parameters.on_guide;
    case MachinePart::kClock:
      return trial.parameters.robot && trial.parameters.robot->control == MotorControl::kClock;
    case MachinePart::kTorqueLimit:
      return trial.parameters.robot && HasTorqueLimit(trial);
    case MachinePart::kTwoAxes:
      return !trial.parameters.on_guide && Compares(problem, Channel::kBodyX) &&
             Compares(problem, Channel::kBodyY);
  }
  return true;
}

// No trial has what the effect is about.
bool HasNothingOf(const FitProblem& problem, const Effect& effect) {
  const MachinePart part = effect.info.about;
  return part != MachinePart::kNone &&
         std::none_of(problem.trials.begin(), problem.trials.end(),
                      [&](const TrialProblem& t) { return HasPart(problem, t, part); });
}

// On one leg what is of that leg alone is what is of all of them.
bool IsOfAllLegs(const FitProblem& problem, const Effect& effect) {
  const EffectInfo& info = effect.info;
  return problem.robot_legs().count == 1 && info.robot_leg == 1 && info.name.ends_with("_1") &&
         FindEffect(info.name.substr(0, info.name.size() - 2)) != nullptr;
}

}  // namespace

std::string Candidate::Name() const {
  const std::string name(effect->info.name);
  if (each_trial) return name + " of each trial's own size";
  return in_all() ? name : name + " in " + Listed(only_recordings);
}

namespace {

// At first it is tried only where the noise tells of it: it rounds corners, and so could stand in
// for much.
bool IsUnseenFilter(const Effect& effect, const std::vector<RecordFilter>& seen) {
  const RecordFilter filter = effect.info.filter;
  return filter != RecordFilter::kNone && std::find(seen.begin(), seen.end(), filter) == seen.end();
}

struct Collection {
  std::vector<Candidate> tried, unseen_filters;
};
Collection Collected(const FitProblem& problem, const CandidateOptions& options) {
  std::vector<const Effect*> without, only;
  for (const std::string& name : options.without)
    without.push_back(&Applicable(problem, name, "--without"));
  for (const std::string& name : options.only) only.push_back(&ToTry(problem, name));
  const auto holds = [](const std::vector<const Effect*>& list, const Effect* effect) {
    return std::find(list.begin(), list.end(), effect) != list.end();
  };
  const std::vector<RecordFilter> filters = FiltersSeen(problem);
  Collection all;
  std::vector<const Effect*> tried(AllEffects().begin(), AllEffects().end());
  const auto add = [&](const Effect* effect) {
    if (!holds(tried, effect)) tried.push_back(effect);
  };
  std::for_each(problem.formulas.begin(), problem.formulas.end(), add);
  std::for_each(only.begin(), only.end(), add);  // named by their files
  for (const Effect* effect : tried) {
    if (!AppliesTo(*effect, problem.law, problem.leg_mass(), problem.inputs(),
                   problem.robot_legs()) ||
        IsPartOf(problem.law, *effect) || IsFitted(problem, *effect) || Simulates(problem, *effect))
      continue;
    if (only.empty() && (HasNothingOf(problem, *effect) || IsOfAllLegs(problem, *effect) ||
                         IsDelayOfAll(problem, *effect)))
      continue;
    if (holds(without, effect) || (!only.empty() && !holds(only, effect)) ||
        problem.known.RulesOut(*effect))
      continue;
    const bool unseen = only.empty() && IsUnseenFilter(*effect, filters);
    std::vector<Candidate>& of = unseen ? all.unseen_filters : all.tried;
    of.push_back({effect, {}, problem.known});
    if (unseen) of.back().price = kUnseenFilter;
  }
  return all;
}

}  // namespace

std::vector<Candidate> CandidatesOf(const FitProblem& problem, const CandidateOptions& options) {
  return Collected(problem, options).tried;
}

std::vector<Candidate> UnseenFilters(const FitProblem& problem, const CandidateOptions& options) {
  return Collected(problem, options).unseen_filters;
}

FitProblem Extend(const FitProblem& problem, std::span<const Candidate> candidates) {
  FitProblem extended = problem;
  for (const Candidate& c : candidates) {
    const int index = static_cast<int>(extended.effects.size());
    extended.effects.push_back(EffectSetting::Null(*c.effect));
    const std::string suffix = c.in_all() ? "" : "@" + Join(c.only_recordings, "+");
    for (int i = 0; i < c.parameter_count(); ++i) {
      const EffectParameter& p = c.Parameter(i);
      const int place = c.parameters[static_cast<std::size_t>(i)].place;
      extended.shared.push_back(
          {std::string(c.effect->info.name) + "." + std::string(p.name) + suffix,
           std::string(p.unit), SensitivityDirection::EffectParameter(index, place), p.lower,
           p.upper, p.null, std::abs(p.typical), c.only_recordings, c.effect->info.has_threshold,
           c.mean_held});
    }
  }
  return extended;
}

Eigen::VectorXd NullValues(std::span<const Candidate> candidates) {
  Eigen::VectorXd values(ParameterCount(candidates));
  int next = 0;
  for (const Candidate& c : candidates) {
    for (const OpenParameter& p : c.parameters) values[next++] = p.info.null;
  }
  return values;
}

int ParameterCount(std::span<const Candidate> candidates) {
  int count = 0;
  for (const Candidate& c : candidates) count += c.parameter_count();
  return count;
}

}  // namespace hoplab
