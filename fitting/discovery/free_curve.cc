#include "fitting/discovery/free_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fitting/diagnosis/linearise_at.h"

namespace hoplab {
namespace {

constexpr int kHats = 9;
constexpr double kNoBound = 1e6;  // no physical bound

// The factor by which a formula of the library acts in one phase; empty: always.
std::string PhaseOf(const Formula& formula) {
  for (const char* phase : {"(1 - in_stance)", "in_stance", "(1 - loading)", "loading"})
    if (formula.source().formula.find(phase) != std::string::npos) return phase;
  return "";
}

bool FollowsAFrequency(const Term& term) { return term.shape && term.variables.front() == "t"; }

// A reading is no part of the flow: nothing would stop at the corners of hats in time.
bool IsReadOverTime(const Effect& effect, const VariableInfo& v) {
  return effect.info.kind == EffectKind::kObservation && v.variable == FormulaVariable::kTime;
}

// One hat: 1 at its centre, 0 from the neighbours' centres on.
const Effect& Hat(const Term& term, const PlaceInfo& place, const VariableInfo& v, double centre,
                  double width, int number) {
  FormulaSource source;
  source.name = "hat_" + std::to_string(number);
  source.acts_as = place.name;
  const std::string name(v.name), phase = PhaseOf(*term.effect->formula);
  source.formula =
      "c * max(1 - abs(" + name + " - centre)/width, 0)" + (phase.empty() ? "" : " * " + phase);
  const std::string unit(v.unit == "-" ? "1" : v.unit);
  source.parameters = {{"c", std::string(place.unit == "-" ? "1" : place.unit), 0.0, std::nullopt,
                        -kNoBound, kNoBound, 1.0},
                       {"centre", unit, std::nullopt, centre, -kNoBound, kNoBound, std::nullopt},
                       {"width", unit, std::nullopt, width, 0.0, kNoBound, std::nullopt}};
  source.sentence = "a hat over " + name;
  return FormulaEffect(source);
}

// The model with the term's coefficient held where it is, and that value.
std::pair<FittedModel, double> Held(const FittedModel& best, const Effect& effect) {
  std::pair<FittedModel, double> out{best, 0.0};
  FittedModel& held = out.first;
  for (std::size_t e = 0; e < held.problem.effects.size(); ++e) {
    if (held.problem.effects[e].effect != &effect) continue;
    std::vector<SharedParameter>& shared = held.problem.shared;
    const auto place = std::find_if(shared.begin(), shared.end(), [&](const SharedParameter& s) {
      const SensitivityDirection& d = s.direction;
      return d.of == SensitivityDirection::Of::kEffect && d.index == static_cast<int>(e) &&
             d.component == 0;
    });
    if (place == shared.end()) continue;
    const auto i = static_cast<Eigen::Index>(place - shared.begin()), n = held.shared.size() - 1;
    out.second = held.problem.effects[e].values[0] = held.shared[i];
    held.shared.segment(i, n - i) = best.shared.tail(n - i);
    held.shared.conservativeResize(n);
    shared.erase(place);
  }
  return out;
}

}  // namespace

double NaturalSize(const VariableInfo& v, const NaturalScales& scales) {
  if (v.unit == "m/s") return scales.speed;
  if (v.unit == "m") return scales.length;
  if (v.unit == "s") return scales.time;
  if (v.unit == "N") return 2.0 * scales.force;
  return v.usual;
}

Extent DrawnOver(const VariableInfo& v, const NaturalScales& scales) {
  if (v.variable == FormulaVariable::kX && !scales.x.empty()) return scales.x;
  if (v.variable == FormulaVariable::kY && !scales.y.empty()) return scales.y;
  const double size = NaturalSize(v, scales);
  return {v.never_negative ? 0.0 : -size, size};
}

double FormulaAt(const Effect& effect, std::string_view variable, double at, double c,
                 const NaturalScales& scales) {
  const Formula& formula = *effect.formula;
  std::array<double, kFormulaVariables> values{};
  FormulaView<double> view{};
  for (const VariableInfo& v : InfoOf(formula.place()).variables) {
    const auto k = static_cast<std::size_t>(v.variable);
    values[k] = v.name == variable ? at : NaturalSize(v, scales);
    view[k] = &values[k];
  }
  const std::string phase = PhaseOf(formula);
  if (phase == "(1 - in_stance)")
    values[static_cast<std::size_t>(FormulaVariable::kInStance)] = 0.0;
  // A leg that is loaded shortens.
  double& rate = values[static_cast<std::size_t>(FormulaVariable::kChordRate)];
  if (phase == "loading") rate = -std::abs(rate);
  std::array<double, kMaxEffectParameters> p{};
  for (std::size_t k = 0; k < effect.info.parameters.size(); ++k)
    p[k] = effect.info.parameters[k].null;
  p[0] = c;
  CornerSides sides;
  sides.fill(kFreeSide);
  return formula.Evaluate(p.data(), view, sides);
}

std::optional<ReconstructedForce> FreeCurve(const Term& term, const FittedModel& best,
                                            const std::vector<TrialProblem>& train,
                                            const NaturalScales& scales, int jobs,
                                            std::uint64_t seed) {
  if (term.variables.size() != 1 || FollowsAFrequency(term)) return std::nullopt;
  const PlaceInfo& place = InfoOf(term.effect->formula->place());
  const VariableInfo* v = FindVariable(place, term.variables.front());
  if (v == nullptr || IsReadOverTime(*term.effect, *v)) return std::nullopt;
  const Extent over = DrawnOver(*v, scales);
  const double width = (over.most - over.least) / (kHats - 1);
  ProbeBasis basis;
  ProbeGroup group{std::string(place.meaning),
                   std::string(v->name) + " [" + std::string(v->unit) + "]",
                   std::string(place.unit),
                   {},
                   0,
                   kHats};
  for (int k = 0; k < kHats; ++k) {
    group.centres.push_back(over.least + k * width);
    basis.probes.emplace_back(&Hat(term, place, *v, group.centres.back(), width, k + 1));
  }
  basis.hypotheses.push_back({0, kHats, Eigen::VectorXd::Constant(kHats, -kNoBound),
                              Eigen::VectorXd::Constant(kHats, kNoBound)});
  basis.groups.push_back(std::move(group));
  const auto [held, c] = Held(best, *term.effect);
  FreeForces free = Reconstruct(LineariseAt(held, basis.probes, train, jobs), basis, seed);
  if (free.forces.empty()) return std::nullopt;
  ReconstructedForce& curve = free.forces.front();
  for (ForcePoint& p : curve.points) p.value += FormulaAt(*term.effect, v->name, p.at, c, scales);
  curve.terms.clear();  // of the hats alone
  return std::move(curve);
}

}  // namespace hoplab
