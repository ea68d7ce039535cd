#include "fitting/discovery/free_curve.h"

#include "fitting/diagnosis/linearise_at.h"

namespace hoplab {
namespace {

constexpr int kHats = 9;
constexpr double kFar = 1e6;  // no physical bound

// The factor that a term acts in a phase by; empty: always.
std::string PhaseOf(const Term& term) {
  const std::string& formula = SourceOf(*term.effect)->formula;
  for (const char* phase : {"(1 - in_stance)", "in_stance", "(1 - loading)", "loading"})
    if (!term.phase.empty() && formula.find(phase) != std::string::npos) return phase;
  return "";
}

bool FollowsAFrequency(const Term& term) { return term.shape && term.variables.front() == "t"; }

const VariableInfo* VariableOf(const PlaceInfo& place, const std::string& name) {
  for (const VariableInfo& v : place.variables)
    if (v.name == name) return &v;
  return nullptr;
}

// One hat: 1 at its centre, 0 from the neighbours' centres on.
const Effect& Hat(const Term& term, const PlaceInfo& place, const VariableInfo& v, double centre,
                  double width, int number) {
  FormulaSource source;
  source.name = "hat_" + std::to_string(number);
  source.acts_as = place.name;
  const std::string name(v.name), phase = PhaseOf(term);
  source.formula =
      "c * max(1 - abs(" + name + " - centre)/width, 0)" + (phase.empty() ? "" : " * " + phase);
  const std::string unit(v.unit == "-" ? "1" : v.unit);
  source.parameters = {
      {"c", std::string(place.unit == "-" ? "1" : place.unit), 0.0, std::nullopt, -kFar, kFar, 1.0},
      {"centre", unit, std::nullopt, centre, -kFar, kFar, std::nullopt},
      {"width", unit, std::nullopt, width, 0.0, kFar, std::nullopt}};
  source.sentence = "a hat over " + name;
  return FormulaEffect(source);
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

std::optional<ReconstructedForce> FreeCurve(const Term& term, const Extension& base,
                                            const std::vector<TrialProblem>& train,
                                            const NaturalScales& scales, int jobs,
                                            std::uint64_t seed) {
  if (term.variables.size() != 1 || FollowsAFrequency(term)) return std::nullopt;
  const PlaceInfo& place = InfoOf(term.effect->formula->place());
  const VariableInfo* v = VariableOf(place, term.variables.front());
  if (v == nullptr) return std::nullopt;
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
  basis.hypotheses.push_back(
      {0, kHats, Eigen::VectorXd::Constant(kHats, -kFar), Eigen::VectorXd::Constant(kHats, kFar)});
  basis.groups.push_back(std::move(group));
  FreeForces free = Reconstruct(LineariseAt(base, basis.probes, train, jobs), basis, seed);
  if (free.forces.empty()) return std::nullopt;
  return std::move(free.forces.front());
}

}  // namespace hoplab
