// A found term with its exponent or its limit free begins where the term is.
#include <gtest/gtest.h>

#include <cmath>

#include "fitting/discovery/freed.h"
#include "fitting/discovery/library.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab::testing {
namespace {

// Of a library the term at a place with this formula.
const Term& TermOf(const std::vector<Term>& library, const std::string& place,
                   const std::string& formula) {
  for (const Term& t : library)
    if (SourceOf(*t.effect)->acts_as == place && SourceOf(*t.effect)->formula == formula) return t;
  throw std::logic_error("no term " + formula);
}

class FreedTerm : public ::testing::Test {
 protected:
  const NullFit fit_{World{.effects = {EffectOfSize("air_drag", 0.02)}}};
  const std::vector<Term> library_ = TermLibrary(fit_.problem, ScalesOf(fit_.problem));
  const Term& drag_ = TermOf(library_, "body_force_x", "c * vx");
  const Term& limit_ = TermOf(library_, "body_force_x", "c * max(x - limit, 0)");

  FittedModel With(const Term& first, const Term& second) const {
    const FittedModel one = fit_.RefittedWith(Candidate(first.effect));
    const Candidate added(second.effect);
    return Refit(one, std::array{added}, Eigen::VectorXd::Zero(1), fit_.Settings());
  }
  FittedModel FreedOf(const FittedModel& best, std::size_t m, const FormulaSource& freer, double c,
                      int iterations) const {
    RefitSettings settings = fit_.Settings();
    settings.max_iterations = iterations;
    return Freed(best, m, Candidate(&FormulaEffect(freer)), c, fit_.problem, settings);
  }
  double ExponentCoefficient(const FittedModel& best, std::size_t m) const {
    return best.ValuesOf(static_cast<int>(m))[0] *
           std::pow(drag_.power->scale, drag_.power->exponent);
  }
};

TEST_F(FreedTerm, AnExponentBeginsAtTheBestModelBesideAnotherTerm) {
  for (const std::size_t m : {std::size_t{0}, std::size_t{1}}) {
    const FittedModel best = m == 0 ? With(drag_, limit_) : With(limit_, drag_);
    const FittedModel begin =
        FreedOf(best, m, WithFreeExponent(drag_), ExponentCoefficient(best, m), 0);
    EXPECT_NEAR(begin.cost, best.cost, 1e-6 * best.cost) << m;
    const FittedModel freed =
        FreedOf(best, m, WithFreeExponent(drag_), ExponentCoefficient(best, m), 40);
    ASSERT_TRUE(freed.ok());
    EXPECT_LE(freed.cost, best.cost + 1e-6) << m;
  }
}

TEST_F(FreedTerm, ALimitBeginsAtTheBestModel) {
  const FittedModel best = With(drag_, limit_);
  const double c = best.ValuesOf(1)[0];
  EXPECT_NEAR(FreedOf(best, 1, WithFreeShape(limit_), c, 0).cost, best.cost, 1e-6 * best.cost);
}

}  // namespace
}  // namespace hoplab::testing
