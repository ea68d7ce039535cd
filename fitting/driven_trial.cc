#include "fitting/driven_trial.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/stance_torque.h"
#include "datasets/touchdowns.h"
#include "fitting/deviation.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

using Of = SensitivityDirection::Of;

// Sizes of a change that matter where no prior tells one: [s], [-], [rad].
constexpr double kTimeScale = 0.002, kGainScale = 0.05, kAngleScale = 0.005;
constexpr double kLongestDelay = 1.0;  // s
// An offset is searched this many sigmas about what is stated.
constexpr double kClockReach = 10.0;

std::string InputParameter(InputKind kind, bool delay) {
  return "input." + std::string(InfoOf(kind).name) + (delay ? ".delay" : ".scale");
}
std::string ClockParameter(const std::string& clock) { return "clock." + clock + ".offset"; }

int ClockIndex(const FitProblem& problem, const std::string& name) {
  for (std::size_t i = 0; i < problem.clocks.size(); ++i)
    if (problem.clocks[i].name == name) return static_cast<int>(i);
  return -1;
}

// The first trial that an input drives; null if none.
const DrivenColumn* FindColumn(const FitProblem& problem, InputKind kind) {
  for (const TrialProblem& t : problem.trials)
    for (const DrivenColumn& c : t.inputs)
      if (c.kind == kind) return &c;
  return nullptr;
}

DrivenColumn ColumnOf(const InputSpec& input, const Trace& trace, const FitProblem& problem) {
  DrivenColumn column{input.id};
  column.held = input.held;
  column.of_stance = input.of_stance;
  column.delay = input.delay_s;
  column.scale = input.scale;
  column.clock = ClockIndex(problem, input.clock);
  const std::vector<double>& values = *trace.Find(input.column);
  const std::vector<double>* contact = trace.Find(Channel::kContact);
  std::vector<double> in_contact;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (std::isnan(values[row])) continue;
    column.times.push_back(trace.time_s[row] - trace.time_s.front());
    column.values.push_back(values[row]);
    if (contact) in_contact.push_back((*contact)[row]);
  }
  if (input.of_stance) column.values = HeldThroughFlights(column.values, in_contact);
  return column;
}

void AddOwn(TrialProblem& t, OwnParameter own) {
  const Eigen::Index place = t.start.size();
  t.start.conservativeResize(place + 1);
  t.start[place] = own.prior_mean;
  t.own.push_back(std::move(own));
}

SharedParameter SharedOf(const std::string& name, const char* unit, SensitivityDirection direction,
                         double initial, double reach, double scale) {
  return {name, unit, direction, initial - reach, initial + reach, initial, scale};
}

// What every trial states of its own; as a shared value it would be the first one's.
void CheckIsAlike(const FitProblem& problem, const SharedParameter& s, const std::string& place) {
  if (s.direction.of != Of::kInput) return;
  for (const TrialProblem& t : problem.trials) {
    for (const DrivenColumn& c : t.inputs) {
      if (c.kind != static_cast<InputKind>(s.direction.index)) continue;
      if ((s.direction.component == 0 ? c.delay : c.scale) == s.initial) continue;
      throw InputError({place, s.name,
                        "differs between the trials of this dataset, so it cannot be one shared "
                        "value",
                        "Fix it, state one value for all trials, or split the dataset."});
    }
  }
}

using InputSigma = std::optional<double> InputSpec::*;

// How well all trials say an input's delay or scale is known.
std::optional<double> SigmaOf(const Dataset& dataset, InputKind kind, InputSigma sigma) {
  const InputSpec* first = nullptr;
  for (const Trial& trial : dataset.trials) {
    for (const InputSpec& input : trial.inputs) {
      if (input.id != kind) continue;
      if (first == nullptr) first = &input;
      if (input.*sigma == first->*sigma) continue;
      const bool delay = sigma == &InputSpec::delay_sigma_s;
      throw InputError({input.origin.place, delay ? "delay_sigma_s" : "scale_sigma",
                        "differs between the trials of this dataset, so it cannot be of one shared "
                        "value",
                        "State one for all trials, or split the dataset."});
    }
  }
  return first == nullptr ? std::nullopt : first->*sigma;
}

[[noreturn]] void NotThere(const std::string& place, const std::string& name,
                           const std::vector<std::string>& known, const std::string& what) {
  throw InputError(
      {place, Printable(name),
       known.empty() ? "this dataset has no " + what + "s" : "is no " + what + " here",
       known.empty() ? "Name it under `" + what + "s` of the dataset." : DidYouMean(name, known)});
}

std::optional<SharedParameter> FindDriven(const FitProblem& problem, const std::string& name,
                                          const std::string& place) {
  if (name.starts_with("input.")) {
    std::vector<std::string> known;
    for (int k = 0; k < kInputKinds; ++k) {
      const auto kind = static_cast<InputKind>(k);
      const DrivenColumn* column = FindColumn(problem, kind);
      if (column == nullptr) continue;
      for (const bool delay : {true, false}) {
        known.push_back(InputParameter(kind, delay));
        if (known.back() != name) continue;
        return delay ? SharedOf(name, "s", SensitivityDirection::InputDelay(k), column->delay,
                                kLongestDelay, kTimeScale)
                     : SharedOf(name, "-", SensitivityDirection::InputScale(k), column->scale,
                                std::max(10.0, 10.0 * std::abs(column->scale)), kGainScale);
      }
    }
    NotThere(place, name, known, "input");
  }
  if (name.starts_with("clock.")) {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < problem.clocks.size(); ++i) {
      const ClockProblem& clock = problem.clocks[i];
      known.push_back(ClockParameter(clock.name));
      if (known.back() != name) continue;
      if (clock.per_trial)
        throw InputError({place, name, "is each trial's own (per: trial), not one shared value",
                          "Leave it out: it is fitted with its sigma already."});
      const double reach = std::max(kClockReach * clock.sigma, 0.02);
      return SharedOf(name, "s", SensitivityDirection::ClockOffset(static_cast<int>(i)),
                      clock.offset, reach,
                      clock.sigma > 0 ? std::min(kTimeScale, clock.sigma) : kTimeScale);
    }
    NotThere(place, name, known, "clock");
  }
  return std::nullopt;
}

}  // namespace

std::vector<ClockProblem> ClocksOf(const Dataset& dataset) {
  std::vector<ClockProblem> clocks;
  for (const ClockSpec& c : dataset.clocks)
    clocks.push_back({c.name, c.offset_s, c.sigma_s.value_or(0.0), c.per_trial});
  return clocks;
}

void AddDriven(const Trial& trial, const FitProblem& problem, TrialProblem& t) {
  for (const InputSpec& input : trial.inputs)
    t.inputs.push_back(ColumnOf(input, trial.trace, problem));
  t.touchdown_angles = trial.touchdown_angles_rad;
  if (!t.touchdown_angles.empty()) {
    const std::vector<double>& angles = t.touchdown_angles;
    t.touchdown_times = TouchdownTimes(trial.trace, [&](std::size_t passed, std::size_t) {
      return TouchdownHeight(trial.mechanism, angles[std::min(passed, angles.size() - 1)]);
    });
    for (double& time : t.touchdown_times) time -= trial.trace.time_s.front();
  }
  if (trial.touchdown_angle_sigma_rad) {
    for (std::size_t i = 0; i < t.touchdown_angles.size(); ++i)
      AddOwn(t, {.name = "touchdown_angle." + std::to_string(i + 1),
                 .direction = SensitivityDirection::TouchdownAngle(static_cast<int>(i)),
                 .scale = std::min(kAngleScale, *trial.touchdown_angle_sigma_rad),
                 .prior_mean = t.touchdown_angles[i],
                 .prior_sigma = *trial.touchdown_angle_sigma_rad});
  }
  for (std::size_t i = 0; i < problem.clocks.size(); ++i) {
    const ClockProblem& clock = problem.clocks[i];
    if (!clock.per_trial) continue;
    AddOwn(t, {.name = ClockParameter(clock.name),
               .direction = SensitivityDirection::ClockOffset(static_cast<int>(i)),
               .scale = std::min(kTimeScale, clock.sigma),
               .prior_mean = clock.offset,
               .prior_sigma = clock.sigma});
  }
}

std::optional<SharedParameter> DrivenParameter(const FitProblem& problem, const std::string& name,
                                               const std::string& place) {
  std::optional<SharedParameter> driven = FindDriven(problem, name, place);
  if (driven) CheckIsAlike(problem, *driven, place);
  return driven;
}

void FreeWhatIsUncertain(const Dataset& dataset, const std::map<std::string, double>& fixed,
                         FitProblem& problem) {
  const auto train =
      std::find_if(problem.trials.begin(), problem.trials.end(),
                   [](const TrialProblem& t) { return t.role == TrialRole::kTrain; });
  if (train == problem.trials.end()) return;
  const auto free = [&](const std::string& name, double sigma) {
    if (fixed.count(name)) return;
    const auto at = std::find_if(problem.shared.begin(), problem.shared.end(),
                                 [&](const SharedParameter& s) { return s.name == name; });
    int index = static_cast<int>(at - problem.shared.begin());
    if (at == problem.shared.end())
      problem.shared.push_back(*DrivenParameter(problem, name, "dataset"));
    SharedParameter& s = problem.shared[static_cast<std::size_t>(index)];
    s.scale = std::min(s.scale, sigma);
    train->shared_priors.push_back({index, s.initial, sigma});
  };
  for (int k = 0; k < kInputKinds; ++k) {
    const auto kind = static_cast<InputKind>(k);
    for (const bool delay : {true, false}) {
      const std::string name = InputParameter(kind, delay);
      if (fixed.count(name)) continue;
      const InputSigma of = delay ? &InputSpec::delay_sigma_s : &InputSpec::scale_sigma;
      if (const auto sigma = SigmaOf(dataset, kind, of)) free(name, *sigma);
    }
  }
  for (const ClockProblem& clock : problem.clocks)
    if (!clock.per_trial && clock.sigma > 0.0) free(ClockParameter(clock.name), clock.sigma);
}

bool FixDriven(const std::string& name, double value, FitProblem& problem) {
  const std::optional<SharedParameter> s = FindDriven(problem, name, "--fix");
  if (!s) return false;
  if (s->direction.of == Of::kClock) {
    problem.clocks[static_cast<std::size_t>(s->direction.index)].offset = value;
    return true;
  }
  for (TrialProblem& t : problem.trials)
    for (DrivenColumn& c : t.inputs)
      if (c.kind == static_cast<InputKind>(s->direction.index))
        (s->direction.component == 0 ? c.delay : c.scale) = value;
  return true;
}

void FillTrialRequest(const FitProblem& problem, const TrialProblem& trial,
                      const Eigen::Ref<const Eigen::VectorXd>& shared,
                      const Eigen::Ref<const OwnValues>& own, TrialRequest& out) {
  SimulationRequest& q = out.request;
  q.law = problem.law;
  q.liftoff = trial.liftoff;
  q.parameters = trial.parameters;
  const Eigen::VectorXd acting = ActingShared(problem, trial, shared, own);
  ApplyShared(problem, trial, acting, q.parameters, out.effects);
  q.effects = out.effects;
  q.initial = InitialOf(trial, own);
  q.start_mode = trial.start_mode;
  out.touchdown_angles = trial.touchdown_angles;
  out.inputs.clear();
  for (const DrivenColumn& c : trial.inputs)
    out.inputs.push_back({c.kind, c.times, c.values, c.held, c.delay, c.scale, c.clock});
  out.clock_offsets.clear();
  for (const ClockProblem& clock : problem.clocks) out.clock_offsets.push_back(clock.offset);
  const auto apply = [&](const SensitivityDirection& d, double value) {
    if (d.of == Of::kTouchdownAngle)
      out.touchdown_angles[static_cast<std::size_t>(d.index)] = value;
    if (d.of == Of::kClock) out.clock_offsets[static_cast<std::size_t>(d.index)] = value;
    if (d.of != Of::kInput) return;
    for (DrivenInput& input : out.inputs)
      if (input.kind == static_cast<InputKind>(d.index))
        (d.component == 0 ? input.delay : input.scale) = value;
  };
  for (int i = 0; i < problem.shared_count(); ++i)
    if (ActsIn(problem.shared[i], trial)) apply(problem.shared[i].direction, acting[i]);
  for (int k = 0; k < trial.own_count(); ++k)
    if (trial.own[k].deviation_of < 0) apply(trial.own[k].direction, own[k]);
  out.channel_clocks.clear();
  for (const ChannelProblem& c : problem.channels) out.channel_clocks.push_back(c.clock);
  q.touchdown_angles = out.touchdown_angles;
  q.inputs = out.inputs;
  const bool stamped = std::any_of(out.channel_clocks.begin(), out.channel_clocks.end(),
                                   [](int clock) { return clock >= 0; });
  q.clock_offsets = out.clock_offsets;
  q.channel_clocks = stamped ? std::span<const int>(out.channel_clocks) : std::span<const int>{};
}

double LatestClock(const FitProblem& problem, const TrialProblem& trial) {
  double latest = 0.0;
  for (const ClockProblem& clock : problem.clocks)
    latest = std::max(latest, clock.offset + kClockReach * clock.sigma);
  for (const SharedParameter& s : problem.shared)
    if (s.direction.of == Of::kClock && ActsIn(s, trial)) latest = std::max(latest, s.upper);
  return latest;
}

void CutDriven(TrialProblem& trial, double origin, double end, bool first) {
  for (DrivenColumn& c : trial.inputs)
    for (double& t : c.times) t -= origin;
  const auto passed =
      static_cast<int>(std::count_if(trial.touchdown_times.begin(), trial.touchdown_times.end(),
                                     [&](double t) { return t < origin; }));
  const auto within =
      static_cast<int>(std::count_if(trial.touchdown_times.begin(), trial.touchdown_times.end(),
                                     [&](double t) { return t >= origin && t <= origin + end; }));
  const auto angles = static_cast<int>(trial.touchdown_angles.size());
  const int begin = std::min(passed, std::max(angles - 1, 0));
  const int stop = std::min(angles, std::max(begin + std::max(within, 1), 1));
  std::vector<OwnParameter> own;
  std::vector<double> start;
  for (int k = 0; k < trial.own_count(); ++k) {
    OwnParameter o = trial.own[static_cast<std::size_t>(k)];
    if (o.direction.of == Of::kInitialState && o.direction.index > 3 && !first) continue;
    if (o.direction.of == Of::kTouchdownAngle) {
      if (o.direction.index < begin || o.direction.index >= stop) continue;
      o.direction.index -= begin;
    }
    own.push_back(std::move(o));
    start.push_back(trial.start[k]);
  }
  trial.own = std::move(own);
  trial.start =
      Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
  if (angles > 0)
    trial.touchdown_angles = {trial.touchdown_angles.begin() + begin,
                              trial.touchdown_angles.begin() + stop};
  std::erase_if(trial.touchdown_times, [&](double t) { return t < origin || t > origin + end; });
  for (double& t : trial.touchdown_times) t -= origin;
  if (first) return;
  trial.start_mode = Mode::kFlight;
  trial.shared_priors.clear();
}

}  // namespace hoplab
