#include "model/laws/local_statics.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/random.h"
#include "tests/support/requests.h"

// The statics in few directions, brought to many by the chain rule, against the statics evaluated
// in all of them.

namespace hoplab {
namespace {

using namespace testing;
using T = Jet<5>;

T Moving(double value, RandomStream& random) {
  T x(value);
  for (int k = 0; k < 5; ++k) x.v[k] = value * random.Normal();
  return x;
}

// Every parameter of the leg that is not zero moves in every direction, also those that its law
// does not read.
Parameters<T> MovingParameters(Law law, RandomStream& random) {
  Parameters<T> p = ConvertParameters<T>(ThickLegRequest(law).parameters);
  p.kappa = T(1.2);
  p.k = T(4000.0);
  p.l0 = T(0.2);
  LawTerms<T>& terms = p.law_terms;
  terms.active = terms.torque_active = terms.second_order_active = terms.higher_order_active = true;
  terms.hardening = terms.second_order = terms.higher_order = T(0.1);
  terms.tip = T(0.4);
  for (const ParameterInfo& info : AllParameters()) {
    if (info.id >= ParameterId::kPitchInertia) break;
    T& x = Field(p, info.id);
    x = Moving(x.a, random);
  }
  for (T* x :
       {&terms.hardening, &terms.rolling, &terms.tip, &terms.torque_bending, &terms.stiffness_drift,
        &terms.ground_compliance, &terms.second_order, &terms.foot_slip, &terms.leg_mass,
        &terms.foot_friction, &terms.material_damping, &terms.higher_order})
    *x = Moving(x->a, random);
  return p;
}

void ExpectSame(const T& local, const T& direct, const char* what) {
  EXPECT_NEAR(local.a, direct.a, 1e-12 * (1.0 + std::abs(direct.a))) << what;
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(local.v[k], direct.v[k], 1e-11 * (1.0 + direct.v.norm())) << what << ' ' << k;
}

class LocalStaticsOf : public ::testing::TestWithParam<Law> {
 protected:
  LocalStaticsOf() : p_(MovingParameters(GetParam(), random_)), local_(p_, GetParam()) {}

  RandomStream random_{7, 0};
  Parameters<T> p_;
  LocalStatics<T> local_;
  // A leg pressed by a twentieth.
  StaticsInputs<T> at_{Moving(2.4, random_), Moving(0.95 * 2.0 * p_.r.a * std::sin(1.2), random_),
                       Moving(0.5, random_), Moving(1.1, random_)};
  StaticsInputs<double> values_{at_.phi.a, at_.l.a, at_.torque.a, at_.softer.a};
};

TEST_P(LocalStaticsOf, EveryQuantityIsTheOneInAllDirections) {
  const Statics<T> direct =
      StaticsAt<T, T>(p_, GetParam(), at_.torque, {at_.phi, at_.l, at_.softer});
  ASSERT_GT(direct.F.a, 1.0);
  const Statics<T> local = local_.Whole(at_);
  ExpectSame(local.sin, direct.sin, "sin");
  ExpectSame(local.cos, direct.cos, "cos");
  ExpectSame(local.delta, direct.delta, "delta");
  ExpectSame(local.C, direct.C, "C");
  ExpectSame(local.A2, direct.A2, "A2");
  ExpectSame(local.F, direct.F, "F");
  ExpectSame(local.soft_F, direct.soft_F, "soft_F");
  ExpectSame(local.tip_turn, direct.tip_turn, "tip_turn");
  ExpectSame(local.beyond, direct.beyond, "beyond");
}

TEST_P(LocalStaticsOf, RatesAlongArcAndChordAreTheOnesInAllDirections) {
  using S = Tangent<T>;
  const T one(1.0), zero(0.0);
  const Statics<S> direct = StaticsAt<S, T>(
      p_, GetParam(), at_.torque, {S(at_.phi, one, zero), S(at_.l, zero, one), S(at_.softer)});
  const LegForceAlong<T> local = local_.ForceAlong(local_.Along(values_), at_);
  ExpectSame(local.sin, direct.sin.value, "sin");
  ExpectSame(local.cos, direct.cos.value, "cos");
  ExpectSame(local.F.value, direct.F.value, "F");
  ExpectSame(local.tip_turn.value, direct.tip_turn.value, "tip_turn");
  for (std::size_t k = 0; k < 2; ++k) {
    ExpectSame(local.F.rate[k], direct.F.rate[k], "F'");
    ExpectSame(local.tip_turn.rate[k], direct.tip_turn.rate[k], "tip_turn'");
  }
}

TEST_P(LocalStaticsOf, RatesAlongTheSoftnessAreTheOnesInAllDirections) {
  using S = Tangent<T>;
  const Statics<S> direct = StaticsAt<S, T>(p_, GetParam(), at_.torque,
                                            {S(at_.phi), S(at_.l), S(at_.softer, T(1.0), T(0.0))});
  const LegForce<T> local = local_.ForceBySoftness(at_);
  ExpectSame(local.F, direct.F.rate[0], "F");
  ExpectSame(local.tip_turn, direct.tip_turn.rate[0], "tip_turn");
}

// A force that is known near by is where the search for it begins, and not what it finds.
TEST_P(LocalStaticsOf, AForceNearByChangesNothing) {
  StaticsInputs<double> near = values_;
  const LegForce<T> alone = local_.Force(local_.At(values_), at_);
  near.F_near = 1.01 * alone.F.a;
  const LegForce<T> begun = local_.Force(local_.At(near), at_);
  ExpectSame(begun.F, alone.F, "F");
  ExpectSame(begun.tip_turn, alone.tip_turn, "tip_turn");
}

// The place of a root is polished by rounding after the statics were evaluated there.
TEST_P(LocalStaticsOf, AStepOfRoundingIsTaken) {
  const auto leg = local_.At(values_);
  StaticsInputs<T> beside = at_;
  beside.l.a += 1e-9;
  const double change = local_.Force(leg, beside).F.a - local_.Force(leg, at_).F.a;
  const double slope = local_.ForceAlong(local_.Along(values_), at_).F.rate[1].a;
  EXPECT_NEAR(change, 1e-9 * slope, 1e-6 * 1e-9 * std::abs(slope));
}

INSTANTIATE_TEST_SUITE_P(, LocalStaticsOf,
                         ::testing::Values(Law::kElastica, Law::kLargeDeflection, Law::kConsistent,
                                           Law::kThesis, Law::kStraightLeg),
                         [](const auto& info) { return std::string(NameOf(info.param)); });

}  // namespace
}  // namespace hoplab
