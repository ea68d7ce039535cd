#include "fitting/shared_parameters.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "fitting/driven_trial.h"
#include "fitting/model_of_spec.h"
#include "fitting/robot_problem.h"
#include "fitting/stated_range.h"
#include "model/leg_compliance.h"

namespace hoplab {
namespace {

std::vector<ParameterId> ParametersOf(const FitProblem& problem) {
  const auto of = hoplab::ParametersOf(MechanismOf(problem.law));
  std::vector<ParameterId> ids(of.begin(), of.end());
  if (problem.leg_mass() == LegMass::kAtToe) {
    const auto toe = ToeParameters();
    ids.insert(ids.end(), toe.begin(), toe.end());
  }
  return ids;
}

// Damping at which a leg of this stiffness loses a few percent of its energy: the size of a change
// of d that matters when its nominal value is zero.
double TypicalDamping(const Parameters<double>& p, MechanismKind mechanism) {
  const double stiffness =
      mechanism == MechanismKind::kStraightLeg ? p.k : 1.0 / LegCompliance<double>(p).Chord(2.5);
  return 0.04 * std::sqrt(stiffness * p.m);
}

struct ParameterName {
  std::string whole, effect, parameter;  // effect empty for a parameter of the mechanism
};
ParameterName SplitName(const std::string& name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return {name, "", name};
  return {name, name.substr(0, dot), name.substr(dot + 1)};
}

class SharedBuilder {
 public:
  SharedBuilder(const Dataset& dataset, const ProblemOptions& options, FitProblem& problem)
      : dataset_(dataset),
        options_(options),
        mechanism_(MechanismOf(problem.law)),
        problem_(problem) {}

  // --fix name=value: a parameter of the mechanism in every trial, or an effect at that value.
  void FixValues() {
    for (const auto& [name, value] : options_.fix) {
      if (FixDriven(name, value, problem_)) continue;
      const ParameterName split = SplitName(name);
      if (split.effect.empty()) {
        const ParameterId id = KnownParameter(name, "--fix");
        for (TrialProblem& t : problem_.trials) {
          CheckStatedValue(id, value, mechanism_, t.parameters, name, "--fix");
          Field(t.parameters, id) = value;
        }
      } else {
        const auto [index, component] = EffectParameterOf(split, "--fix");
        const EffectParameter& info = problem_.effects[index].effect->info.parameters[component];
        const std::optional<EffectParameter> open =
            problem_.known.Open(*problem_.effects[index].effect, component);
        CheckRange(name, value, std::min(info.lower, open ? open->lower : info.lower), info.upper,
                   info.unit, "--fix");
        problem_.known.CheckValue(*problem_.effects[index].effect, component, value, "--fix");
        problem_.effects[index].values[component] = value;
      }
    }
  }

  void AddShared() {
    std::vector<std::string> names = options_.free;
    const std::string place = names.empty() ? "fit" : "--free";
    if (names.empty()) names = FreeNames(problem_);
    for (const std::string& name : names) {
      // A default parameter that is fixed is simply not free.
      if (options_.free.empty() && options_.fix.count(name)) continue;
      if (options_.fix.count(name))
        throw InputError({"--free", name, "is also given to --fix", "Name it in one of the two."});
      AddSharedNamed(name, place);
    }
    for (const std::string& name : options_.with_effects) {
      const Effect& effect = ResolveEffect(name, "--with", problem_.formulas);
      problem_.known.CheckOpen(effect, "--with");
      for (const OpenParameter& p : problem_.known.OpenParameters(effect)) {
        const std::string whole = std::string(effect.info.name) + "." + std::string(p.info.name);
        if (!options_.fix.count(whole)) AddSharedNamed(whole, "--with");
      }
    }
    FreeWhatIsUncertain(dataset_, options_.fix, problem_);
    if (problem_.shared.empty())
      throw InputError({"--fix", "", "leaves nothing to fit", "Free at least one parameter."});
  }

 private:
  static void CheckRange(const std::string& name, double value, double lower, double upper,
                         std::string_view unit, const std::string& place) {
    if (value >= lower && value <= upper) return;
    throw InputError({place, name + " = " + FormatDouble(value),
                      "must be in [" + FormatDouble(lower) + ", " + FormatDouble(upper) + "] " +
                          std::string(unit),
                      "Values are in SI units."});
  }

  InputError OfOtherLegs(const std::string& name, const std::string& place) const {
    if (problem_.robot_legs().straight)
      return InputError({place, name, "is of a half circle, and this robot's legs are straight",
                         "Straight legs have k, k_lateral, l0 and leg_damping."});
    return InputError({place, name, "is of a straight leg, and this robot's are half circles",
                       "Half circles have E, r, I, clamp and leg_damping."});
  }

  ParameterId KnownParameter(const std::string& name, const std::string& place) const {
    const std::optional<ParameterId> id = FindParameter(name);
    const std::vector<ParameterId> of = ParametersOf(problem_);
    if (id && std::find(of.begin(), of.end(), *id) != of.end()) {
      if (IsOfRobot(*id, problem_)) return *id;
      if (!IsOfLegs(*id, problem_.trials.front().parameters)) throw OfOtherLegs(name, place);
      throw InputError({place, name,
                        *id == ParameterId::kE ? "is told of each leg by itself here"
                                               : "is of a leg this robot does not have",
                        *id == ParameterId::kE ? "Name E_1, E_2, ... or E alone."
                                               : "Legs are counted from the hindmost, 1."});
    }
    const auto toe = ToeParameters();
    if (id && mechanism_ != MechanismKind::kBall &&
        std::find(toe.begin(), toe.end(), *id) != toe.end()) {
      throw InputError({place, name, "belongs to a leg with a toe mass, and this one has none",
                        "Add toe_mass_kg to the mechanism."});
    }
    std::vector<std::string> names;
    for (ParameterId own : of)
      if (IsOfLegs(own, problem_.trials.front().parameters)) names.emplace_back(InfoOf(own).name);
    throw InputError({place, Printable(name),
                      "is not a parameter of the mechanism " + std::string(NameOf(mechanism_)),
                      DidYouMean(name, names)});
  }

  // Place of an effect's parameter, the effect joining the problem if it is new.
  std::pair<int, int> EffectParameterOf(const ParameterName& name, const std::string& place) {
    const Effect& effect = ResolveEffect(name.effect, place, problem_.formulas);
    const std::optional<int> component = effect.FindParameter(name.parameter);
    if (!component) {
      std::vector<std::string> known;
      for (const EffectParameter& p : effect.info.parameters)
        known.push_back(name.effect + "." + std::string(p.name));
      throw InputError({place, Printable(name.whole), "is not a parameter of this effect",
                        DidYouMean(name.whole, known)});
    }
    return {EffectIndex(effect, place), *component};
  }

  int EffectIndex(const Effect& effect, const std::string& place) {
    CheckApplies(effect, problem_.law, problem_.leg_mass(), place, problem_.inputs(),
                 problem_.robot_legs());
    for (std::size_t i = 0; i < problem_.effects.size(); ++i) {
      if (problem_.effects[i].effect == &effect) return static_cast<int>(i);
    }
    problem_.effects.push_back(EffectSetting::Null(effect));
    return static_cast<int>(problem_.effects.size()) - 1;
  }

  void AddSharedNamed(const std::string& name, const std::string& place) {
    for (const SharedParameter& s : problem_.shared) {
      if (s.name == name) throw InputError({place, name, "is named twice", ""});
    }
    if (const auto driven = DrivenParameter(problem_, name, place)) {
      problem_.shared.push_back(*driven);
      return;
    }
    const ParameterName split = SplitName(name);
    if (split.effect.empty())
      AddOfMechanism(name, place);
    else
      AddOfEffect(split, place);
  }

  void AddOfEffect(const ParameterName& name, const std::string& place) {
    const auto [index, component] = EffectParameterOf(name, place);
    const Effect& effect = *problem_.effects[index].effect;
    const std::optional<EffectParameter> info = problem_.known.Open(effect, component);
    if (!info)
      throw InputError({place, name.whole,
                        "is known to be null: known of the set-up is " + problem_.known.Text(),
                        "Remove the line under `known` if it may be present after all."});
    problem_.shared.push_back({name.whole,
                               std::string(info->unit),
                               SensitivityDirection::EffectParameter(index, component),
                               info->lower,
                               info->upper,
                               problem_.effects[index].values[component],
                               std::abs(info->typical),
                               {},
                               effect.info.has_threshold});
  }

  void AddOfMechanism(const std::string& name, const std::string& place) {
    const ParameterId id = KnownParameter(name, place);
    const bool own_angles = std::any_of(
        problem_.trials.begin(), problem_.trials.end(),
        [](const TrialProblem& t) { return !t.touchdown_angles.empty() || !t.inputs.empty(); });
    if (id == ParameterId::kThetaTd && own_angles)
      throw InputError({place, name, "is each touch-down's own in this dataset",
                        "Say touchdown_angle_sigma_deg, or try the effect touchdown_angle_bias."});
    const Parameters<double>& p = problem_.trials.front().parameters;
    const double nominal = Field(p, id);
    for (const TrialProblem& t : problem_.trials) {
      if (Field(t.parameters, id) != nominal) {
        throw InputError({place, name,
                          "differs between the trials of this dataset, so it cannot be one shared "
                          "value",
                          "Fix it, or split the dataset."});
      }
    }
    const ParameterInfo& info = InfoOf(id);
    problem_.shared.push_back({name, std::string(info.unit), SensitivityDirection::Parameter(id),
                               info.lower, info.upper, nominal, ScaleOf(id, p)});
  }

  // One typical size of a parameter: its value, and where that may be zero what matters of it.
  double ScaleOf(ParameterId id, const Parameters<double>& p) const {
    double scale = std::abs(Field(p, id));
    if (id == ParameterId::kD) scale = std::max(scale, TypicalDamping(p, mechanism_));
    if (id == ParameterId::kLegDamping) scale = std::max(scale, 1e-4);
    if (id == ParameterId::kLegMass) scale = std::max(scale, 0.01);
    if (id == ParameterId::kComX || id == ParameterId::kComY) scale = std::max(scale, 0.01);
    if (id == ParameterId::kRestitution || id == ParameterId::kTangentialLoss)
      scale = std::max(scale, 0.1);
    return scale == 0.0 ? 1.0 : scale;
  }

  const Dataset& dataset_;
  const ProblemOptions& options_;
  MechanismKind mechanism_;
  FitProblem& problem_;
};

}  // namespace

void AddSharedParameters(const Dataset& dataset, const ProblemOptions& options,
                         FitProblem& problem) {
  SharedBuilder builder(dataset, options, problem);
  builder.FixValues();
  builder.AddShared();
}

}  // namespace hoplab
