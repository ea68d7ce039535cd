// The terms that a discovery tries, and the shapes it frees.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/random.h"
#include "datasets/read_scenario.h"
#include "fitting/discovery/discover.h"
#include "fitting/discovery/promising.h"
#include "fitting/discovery/stability.h"
#include "fitting/generate.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab {
namespace {

using namespace testing;

Dataset HopDataset() { return GenerateDataset(HopScenario(2), {.seed = 2}).dataset; }

std::string ShapeText(const FormulaSource& source) {
  std::string text;
  for (const FormulaParameter& p : source.parameters)
    if (p.value) text += " " + p.name + "=" + std::to_string(*p.value);
  return text;
}

TEST(TermLibrary, HasEachFormulaOnceAndItsCoefficientInFront) {
  const FitProblem problem = MakeProblem(HopDataset(), {});
  const std::vector<Term> terms = TermLibrary(problem, ScalesOf(problem));
  EXPECT_GT(terms.size(), 80u);
  EXPECT_LT(terms.size(), 400u);
  std::set<std::string> seen;
  std::set<std::string> places;
  for (const Term& t : terms) {
    const FormulaSource& source = *SourceOf(*t.effect);
    EXPECT_TRUE(seen.insert(source.acts_as + source.formula + ShapeText(source)).second)
        << source.formula;
    EXPECT_EQ(source.formula.substr(0, 1), "c");
    const std::size_t held = t.shape ? t.shape->steps.size() : 0;
    EXPECT_EQ(source.parameters.size(), 1 + held);
    EXPECT_EQ(t.effect->info.parameters.front().null, 0.0);
    places.insert(source.acts_as);
    if (t.power) {
      EXPECT_NO_THROW(FormulaEffect(WithFreeExponent(t))) << source.formula;
    }
  }
  EXPECT_TRUE(places.contains("chord_force") && places.contains("body_force_along") &&
              places.contains("reading_y") && places.contains("touchdown_angle"));
  EXPECT_FALSE(places.contains("restitution")) << "that is of a ball";
}

std::vector<const Term*> OfFamily(const std::vector<Term>& terms, const std::string& part) {
  std::vector<const Term*> found;
  for (const Term& t : terms)
    if (t.shape && t.shape->family.find(part) != std::string::npos) found.push_back(&t);
  return found;
}

TEST(TermLibrary, AShapeIsFreedNearItsPlaceOnTheGrid) {
  const FitProblem problem = MakeProblem(HopDataset(), {});
  const NaturalScales scales = ScalesOf(problem);
  const std::vector<Term> terms = TermLibrary(problem, scales);
  const std::vector<const Term*> limits = OfFamily(terms, "body_force_x max(x - limit, 0)");
  ASSERT_GE(limits.size(), 3u);
  for (const Term* t : limits) {
    const FormulaParameter& held = SourceOf(*t->effect)->parameters.at(1);
    const double step = t->shape->steps.at(0);
    EXPECT_GT(*held.value, scales.x.least);
    EXPECT_LT(*held.value, scales.x.most);
    const FormulaSource source = WithFreeShape(*t);
    const FormulaParameter& freed = source.parameters.at(1);
    EXPECT_EQ(freed.null, held.value);
    EXPECT_FALSE(freed.value);
    EXPECT_GE(freed.lower, *held.value - 1.5 * step);
    EXPECT_LE(freed.upper, *held.value + 1.5 * step);
    EXPECT_FALSE(FormulaEffect(source).info.parameters[1].is_shape);
  }
  EXPECT_TRUE(AreNeighbours(*limits[0], *limits[1], 1.01));
  EXPECT_FALSE(AreNeighbours(*limits[0], *limits[1], 0.99));
  EXPECT_FALSE(AreNeighbours(*limits[0], *OfFamily(terms, "max(limit - x, 0)").at(0), 9.0));
  // A shape stays within its bounds.
  const double far = 1e3;
  const Term moved = AtShape(*limits[0], {&far, 1});
  const FormulaParameter& at = SourceOf(*moved.effect)->parameters[1];
  EXPECT_EQ(*at.value, at.upper);
  // A family has the chance of one term.
  const auto members = static_cast<double>(limits.size());
  EXPECT_NEAR(PriceOf(*limits[0], terms), std::log(members), 1e-12);
  EXPECT_EQ(PriceOf(terms.front(), terms), 0.0);
}

// With its exponent where it was, a term with a free one is the same term.
TEST(TermLibrary, AFreeExponentBeginsAtTheTerm) {
  const FitProblem problem = MakeProblem(HopDataset(), {});
  for (const Term& t : TermLibrary(problem, ScalesOf(problem))) {
    if (!t.power) continue;
    const FormulaSource freed = WithFreeExponent(t);
    const Formula whole(*SourceOf(*t.effect)), broken(freed);
    std::array<double, kFormulaVariables> values;
    values.fill(0.8);
    values[static_cast<std::size_t>(FormulaVariable::kVy)] = -0.6;
    values[static_cast<std::size_t>(FormulaVariable::kChordRate)] = -0.3;
    FormulaView<double> view{};
    for (std::size_t i = 0; i < values.size(); ++i) view[i] = &values[i];
    CornerSides sides;
    sides.fill(kFreeSide);
    const std::array<double, kMaxEffectParameters> one = {1.0};
    const std::array<double, kMaxEffectParameters> three = {
        std::pow(t.power->scale, t.power->exponent), t.power->exponent, t.power->scale};
    EXPECT_NEAR(whole.Evaluate(one.data(), view, sides), broken.Evaluate(three.data(), view, sides),
                1e-12)
        << freed.formula;
  }
}

}  // namespace
}  // namespace hoplab
