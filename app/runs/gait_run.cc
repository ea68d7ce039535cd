#include "app/runs/gait_run.h"

#include <cmath>

#include "app/runs/sensitivity_direction.h"
#include "app/terminal/usage_error.h"
#include "base/input_error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "experiments/scenario_hopper.h"
#include "fitting/model_of_spec.h"
#include "fitting/stated_range.h"

namespace hoplab {
namespace {

// What a robot's gait is differentiated by.
std::vector<std::string> RobotParameterNames(const RobotParameters<double>& robot) {
  std::vector<std::string> names = {"clock_period", "clock_duty", "clock_sweep", "clock_offset"};
  for (int leg = 2; leg <= robot.legs; ++leg) names.push_back("clock_phase_" + std::to_string(leg));
  if (robot.straight_legs) {
    names.insert(names.end(), {"k", "k_lateral"});
  } else if (robot.own_moduli) {
    for (int leg = 1; leg <= robot.legs; ++leg) names.push_back("E_" + std::to_string(leg));
  } else {
    names.emplace_back("E");
  }
  for (const char* name : {"leg_damping", "motor_kp", "motor_kd", "pitch_inertia", "com_x"})
    names.emplace_back(name);
  return names;
}

std::vector<std::string> ParameterNames(const Hopper& hopper) {
  if (const auto& robot = hopper.request.parameters.robot) return RobotParameterNames(*robot);
  std::vector<std::string> names;
  for (const ParameterId id : ParametersOf(MechanismOf(hopper.request.law)))
    names.emplace_back(InfoOf(id).name);
  for (const EffectSetting& setting : hopper.effects) {
    for (const EffectParameter& p : setting.effect->info.parameters)
      names.push_back(std::string(setting.effect->info.name) + "." + std::string(p.name));
  }
  return names;
}

// A parameter of the clock, as "clock_period" or like the scenario's key "clock.period_s".
std::optional<ParameterId> ClockParameter(std::string name) {
  if (name.starts_with("clock.")) {
    name[5] = '_';
    for (const std::string unit : {"_s", "_rad"})
      if (name.ends_with(unit)) name.resize(name.size() - unit.size());
  }
  for (const ParameterId id : ClockParameters())
    if (InfoOf(id).name == name) return id;
  return std::nullopt;
}

// Of the phase of a leg that a robot of so many legs does not have.
bool IsOfAbsentLeg(ParameterId id, int legs) {
  const std::string_view name = InfoOf(id).name;
  return name.starts_with("clock_phase_") && name.back() - '0' > legs;
}

}  // namespace

SensitivityDirection GaitDirection(const Hopper& hopper, const std::string& name) {
  if (HasStrides(hopper)) {
    const std::optional<ParameterId> clock = ClockParameter(name);
    if (clock && !IsOfAbsentLeg(*clock, hopper.request.parameters.robot->legs))
      return SensitivityDirection::Parameter(*clock);
    if (clock)
      throw InputError({"--along", name, "is of a leg that this robot does not have",
                        "Name the phase of one of its " +
                            std::to_string(hopper.request.parameters.robot->legs) + " legs."});
    if (name.starts_with("clock"))
      throw InputError(
          {"--along", name, "is no value of a clock",
           DidYouMean(name, {"clock.period_s", "clock.duty", "clock.sweep_rad", "clock.offset_rad",
                             "clock.phase_1", "clock.phase_2", "clock.phase_3", "clock.phase_4"})});
    if (name.starts_with("ground_slope"))
      throw InputError({"--along", name, "is not followed: the section turns with the ground",
                        "Give the slope in the scenario."});
  }
  return ResolveDirection(name, hopper.request, LegMass::kNone, hopper.effects, "--along");
}

AlongRange ParseAlong(const std::string& text) {
  const std::size_t equals = text.find('='), colon = text.find(':', equals);
  if (equals != text.npos && colon != text.npos) {
    const auto low = ParseDouble(Trim(text.substr(equals + 1, colon - equals - 1)));
    const auto high = ParseDouble(Trim(text.substr(colon + 1)));
    if (equals > 0 && low && high && std::isfinite(*low) && std::isfinite(*high) && *low < *high)
      return {std::string(Trim(text.substr(0, equals))), *low, *high};
  }
  throw UsageError("--along: " + Printable(text) +
                   "; must be name=low:high in SI units, low below high, as kp=0.5:12");
}

std::string GaitRun::Failure() const {
  if (interrupted && branch.points.empty())
    return "interrupted; what was not computed yet is left out";
  if (interrupted) return "interrupted; the branch ends where it was stopped";
  if (!HasStrides(hopper) && point.status == FixedPointStatus::kHopFails)
    return "no hop can be made from the start: it " + std::string(SentenceOf(point.hop.outcome));
  if (HasStrides(hopper) && !map)
    return "the robot makes too few strides from its start: it " +
           std::string(SentenceOf(own_outcome)) +
           "; search its clock with `hoplab optimize`, or try another initial state";
  if (HasStrides(hopper) && !point.found())
    return "no steady stride was found near the robot's run; search its clock with `hoplab "
           "optimize`, or try another initial state";
  if (!point.found())
    return "no fixed point was found near the start; try another initial state or --set "
           "controller.kp_N_s";
  return "";
}

namespace {

SectionState AsSection(const ApexState& state) { return state; }

void FindHop(GaitRun& run) {
  run.map = std::make_shared<ApexMap>(run.hopper);
  run.start = AsSection(StartApex(run.hopper));
  run.point = SearchFixedPoint(*run.map, run.start);
  const Trajectory own = Simulate(RequestOf(run.hopper));
  run.apexes = ApexSpeeds(own);
  if (IsComplete(own.outcome)) run.counted = ConvergenceTimeOf(run.apexes);
  if (run.point.found()) run.prediction = PredictHops(run.point, run.start);
}

void FindStride(GaitRun& run) {
  SteadyStride steady = FindSteadyStride(run.hopper);
  run.own_outcome = steady.start.outcome;
  run.own_strides = steady.start.strides;
  run.point = steady.point;
  if (!steady.start.map) return;
  run.start = steady.start.state;
  if (steady.point.found()) run.stride = MeasureStride(*steady.start.map, steady.point.state);
  run.map = std::make_shared<StrideMap>(std::move(*steady.start.map));
}

// Both ends are what a scenario may state of what is followed.
void CheckEnds(const Hopper& hopper, const AlongRange& along,
               const SensitivityDirection& direction) {
  for (const double end : {along.low, along.high}) {
    if (direction.of == SensitivityDirection::Of::kEffect) {
      const Effect& effect = *hopper.effects[static_cast<std::size_t>(direction.index)].effect;
      CheckEffectValue(effect, direction.component, end, along.name, "--along");
    } else {
      CheckStatedValue(direction.parameter, end, MechanismOf(hopper.request.law),
                       hopper.request.parameters, along.name, "--along");
    }
  }
}

// What is followed must lie in its range.
std::optional<SensitivityDirection> DirectionAlong(const Hopper& hopper,
                                                   const std::optional<AlongRange>& along) {
  if (!along) return std::nullopt;
  const SensitivityDirection direction = GaitDirection(hopper, along->name);
  if (direction.of == SensitivityDirection::Of::kInitialState)
    throw InputError({"--along", along->name,
                      "is where a run starts, which a steady hop does not know of",
                      "Follow a parameter, as E or kp."});
  CheckEnds(hopper, *along, direction);
  const double here = ValueOf(hopper, direction);
  if (here < along->low || here > along->high) {
    throw InputError({"--along", along->name + " = " + FormatDouble(here),
                      "must be a parameter whose value in the scenario lies in the range",
                      "Widen the range."});
  }
  return direction;
}

}  // namespace

GaitRun RunGait(const Hopper& hopper, const GaitOptions& options) {
  GaitRun run;
  run.hopper = hopper;
  run.along = options.along;
  run.parameters = ParameterNames(hopper);
  const std::optional<SensitivityDirection> along = DirectionAlong(hopper, options.along);
  const auto stage = [&](const std::string& text) {
    if (options.stage) options.stage(text);
  };
  const bool strides = HasStrides(hopper);
  stage("searching the fixed point");
  if (strides)
    FindStride(run);
  else
    FindHop(run);
  if (run.map) run.components = run.map->Components(run.start);
  if (!run.point.found()) return run;
  stage("differentiating the spectral radius");
  // A stride takes longer than a hop, and three levels tell six digits.
  const int levels = strides ? 3 : kRadiusLevels;
  run.rates.resize(run.parameters.size());
  run.computed.resize(run.parameters.size());
  ParallelFor(static_cast<int>(run.parameters.size()), options.jobs, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    if (options.stop && *options.stop) return;
    run.rates[at] = DifferentiateSpectralRadius(*run.map, run.point,
                                                GaitDirection(hopper, run.parameters[at]), levels);
    run.computed[at] = 1;
  });
  if (along) {
    stage("following the fixed point along " + options.along->name);
    ContinuationOptions continuation{.low = options.along->low, .high = options.along->high};
    if (strides) continuation.fixed_point.tolerance = kStrideResidual;
    continuation.stop = options.stop;
    run.branch = FollowFixedPoint(*run.map, run.point, *along, continuation);
  }
  run.interrupted = options.stop && *options.stop;
  return run;
}

}  // namespace hoplab
