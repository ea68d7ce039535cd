#include "experiments/scenario_search.h"

#include <algorithm>
#include <array>
#include <memory>

#include "base/input_error.h"
#include "base/range.h"
#include "base/text.h"
#include "experiments/scenario_hopper.h"

namespace hoplab {
namespace {

struct Alias {
  const char* name;
  const char* key;
};
constexpr std::array<Alias, 7> kAliases = {{{"theta_td", "touchdown_angle_deg"},
                                            {"kp", "controller.kp_N_s"},
                                            {"v_des", "controller.v_des_m_per_s"},
                                            {"E", "mechanism.leg.E_Pa"},
                                            {"d", "mechanism.leg.damping_N_s_per_m"},
                                            {"k", "mechanism.leg.stiffness_N_per_m"},
                                            {"m", "mechanism.body_mass_kg"}}};

std::string KeyOf(const std::string& name) {
  for (const Alias& alias : kAliases) {
    if (name == alias.name) return alias.key;
  }
  return name;
}

SearchVariable VariableOf(const OverOption& option, const ScenarioDocument& document,
                          const std::vector<KeyRange>& ranges) {
  const std::string key = KeyOf(option.name);
  if (key == option.name && key.find('.') == key.npos && !document.NumberAt(key)) {
    std::vector<std::string> names;
    for (const Alias& alias : kAliases) names.emplace_back(alias.name);
    throw InputError({"--over", Printable(key), "is no number of the scenario",
                      DidYouMean(key, names) + " Or a dotted key, as initial.y_m."});
  }
  if (option.low) {
    document.ReadAt({{key, *option.low}}, "--over");
    document.ReadAt({{key, *option.high}}, "--over");
    return {key, *option.low, *option.high};
  }
  std::vector<std::string> known;
  for (const KeyRange& range : ranges) {
    if (range.key == key) return {key, range.low, range.high};
    known.push_back(range.key);
  }
  throw InputError({"--over", Printable(option.name), "has no range in search.over",
                    DidYouMean(key, known) + " Or give one, as " + option.name + "=0.5:12."});
}

// The constraints by their names in a scenario.
struct ConstraintName {
  const char* name;
  std::optional<double> SearchConstraints::*field;
  bool of_strides, of_hops;
};
constexpr ConstraintName kConstraints[] = {
    {"min_speed_m_per_s", &SearchConstraints::min_speed, true, true},
    {"max_torque_N_m", &SearchConstraints::max_torque, true, true},
    {"min_clearance_m", &SearchConstraints::min_clearance, false, true},
    {"max_flexure", &SearchConstraints::max_deflection_ratio, false, true},
    {"max_legs_apart", &SearchConstraints::max_legs_apart, true, false},
    {"min_legs_apart", &SearchConstraints::min_legs_apart, true, false},
    {"min_flight_share", &SearchConstraints::min_flight_share, true, false}};

SearchConstraints ConstraintsOf(const std::vector<NamedNumber>& numbers, bool robot, Law law) {
  SearchConstraints constraints;
  for (const NamedNumber& number : numbers) {
    const auto known = std::find_if(
        std::begin(kConstraints), std::end(kConstraints),
        [&](const ConstraintName& constraint) { return number.name == constraint.name; });
    const auto refuse = [&](const char* rule, const std::string& remedy) {
      throw InputError(
          {number.origin.place, "search.constraints." + Printable(number.name), rule, remedy});
    };
    if (known == std::end(kConstraints)) {
      std::vector<std::string> names;
      for (const ConstraintName& constraint : kConstraints) names.emplace_back(constraint.name);
      refuse("is no constraint", DidYouMean(number.name, names));
    }
    if (robot && !known->of_strides) refuse("is that of a hopper's hops", "Leave it out.");
    if (!robot && !known->of_hops) refuse("is that of a robot's stride", "Leave it out.");
    if (known->field == &SearchConstraints::max_deflection_ratio && law != Law::kLargeDeflection)
      refuse("bounds the expansion of law large_deflection; others have none",
             "Leave it out, or say law: large_deflection.");
    constexpr Range kBound = NonNegative(1e9, "");
    if (!kBound.Contains(number.value))
      throw InputError({number.origin.place,
                        "search.constraints." + number.name + " = " + FormatDouble(number.value),
                        "must be in " + kBound.Text(), RangeRemedy(number.value, kBound)});
    constraints.*known->field = number.value;
  }
  return constraints;
}

// An objective that the mechanism has.
void CheckProblem(const SearchProblem& problem, const Scenario& scenario) {
  const bool robot = scenario.mechanism.type == MechanismKind::kRobot;
  const auto refuse = [&](const std::string& key, const char* rule, const char* remedy) {
    throw InputError({scenario.search->origin.place, key, rule, remedy});
  };
  const std::string objective = "objective: " + std::string(NameOf(problem.objective));
  if (robot && !IsOfStrides(problem.objective))
    refuse(objective, "is counted in hops, which a robot does not make",
           "Use spectral_radius, speed, cost_of_transport or peak_torque.");
  if (!robot && !IsOfHops(problem.objective))
    refuse(objective, "is that of a robot's stride",
           "Use convergence_time, spectral_radius or weighted.");
}

}  // namespace

SearchProblem SearchProblemOfScenario(const ScenarioDocument& document, const Scenario& scenario,
                                      const std::vector<OverOption>& over,
                                      const IntegratorOptions& integrator) {
  if (!scenario.search) {
    throw InputError({scenario.origin.place, "search", "is absent: what is to be searched?",
                      "Add search: {over: {controller.kp_N_s: [0.5, 12]}, objective: "
                      "convergence_time}."});
  }
  SearchProblem problem;
  problem.objective = scenario.search->objective;
  problem.constraints =
      ConstraintsOf(scenario.search->constraints, scenario.mechanism.type == MechanismKind::kRobot,
                    HopperOfScenario(scenario, integrator).request.law);
  CheckProblem(problem, scenario);
  std::vector<OverOption> wanted = over;
  if (wanted.empty()) {
    for (const KeyRange& range : scenario.search->over) wanted.push_back({range.key, {}, {}});
  }
  for (const OverOption& option : wanted) {
    problem.variables.push_back(VariableOf(option, document, scenario.search->over));
    const std::string& key = problem.variables.back().name;
    const auto same = [&](const SearchVariable& v) { return v.name == key; };
    if (std::count_if(problem.variables.begin(), problem.variables.end(), same) > 1)
      throw InputError({"--over", Printable(key), "is given twice", "Remove one of the two."});
  }
  problem.hopper_at = [document = std::make_shared<ScenarioDocument>(document), integrator,
                       variables = problem.variables](std::span<const double> x) {
    std::vector<std::pair<std::string, double>> values;
    for (std::size_t i = 0; i < variables.size(); ++i) values.emplace_back(variables[i].name, x[i]);
    return LeggedHopperOfScenario(document->ReadAt(values, "search"), integrator);
  };
  return problem;
}

}  // namespace hoplab
