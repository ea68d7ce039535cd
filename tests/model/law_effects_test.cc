#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <numbers>

#include "model/effects/effect.h"
#include "model/laws/extended_leg.h"
#include "model/leg_compliance.h"
#include "tests/support/requests.h"

// Effects that act inside the leg laws: blends between laws, M24-M29.

namespace hoplab {
namespace {

using namespace testing;

EffectSetting Set(const char* name, double value) {
  EffectSetting setting = EffectSetting::Null(*FindEffect(name));
  setting.values[0] = value;
  return setting;
}

// The event sequences of a C-leg, by touch-down angle and start.
struct Sequence {
  const char* name;
  double theta_deg;
  std::array<double, 4> initial;
  const char* events;
};
constexpr std::array kSequences = {
    Sequence{"rolling", 30.0, {0.0, 0.25, 1.0, -0.1}, "touchdown liftoff apex"},
    Sequence{"to_toe", 8.0, {0.0, 0.25, 0.7, -0.1}, "touchdown rolling_to_toe liftoff apex"},
    Sequence{"toe", -10.0, {0.0, 0.25, 0.3, -0.1}, "touchdown liftoff apex"},
    Sequence{"to_rolling", -2.0, {0.0, 0.25, -0.5, -0.1}, "touchdown toe_to_rolling liftoff apex"}};

SimulationRequest RequestOf(Law law, const Sequence& s) {
  SimulationRequest q = ThickLegRequest(law);
  q.parameters.theta_td = Degrees(s.theta_deg);
  q.initial.assign(s.initial.begin(), s.initial.end());
  return q;
}

// ---- with every term null ---------------------------------------------------------------------

TEST(ExtendedLeg, WithEveryTermNullIsThePlainLaw) {
  // A derivative asked for at the null makes the term active there.
  for (Law law : kCLegLaws) {
    for (const Sequence& s : kSequences) {
      SimulationRequest q = RequestOf(law, s);
      q.parameters.kp = 0.6;
      q.parameters.v_des = s.initial[2];
      const Trajectory plain = Simulate(q);
      ASSERT_EQ(EventNames(plain), s.events) << NameOf(law);
      const std::array effects = {Set("foot_slip", 0.0), Set("rolling_law", 0.0)};
      const std::array directions = {SensitivityDirection::EffectParameter(0, 0),
                                     SensitivityDirection::EffectParameter(1, 0)};
      q.effects = effects;
      q.directions = directions;
      const Trajectory extended = Simulate(q);
      ASSERT_EQ(EventNames(extended), s.events) << NameOf(law);
      for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(extended.final_state[i], plain.final_state[i], 1e-11)
            << NameOf(law) << ' ' << s.name;
    }
  }
  SimulationRequest q = SteadyStraightLeg();
  const Trajectory plain = Simulate(q);
  const std::array effects = {Set("foot_slip", 0.0)};
  const std::array directions = {SensitivityDirection::EffectParameter(0, 0)};
  q.effects = effects;
  q.directions = directions;
  const Trajectory extended = Simulate(q);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(extended.final_state[i], plain.final_state[i], 1e-11);
}

// ---- blends ----------------------------------------------------------------------------------

// Largest difference of the final states of two runs through the same events.
double Distance(const SimulationRequest& a, const SimulationRequest& b, const char* events) {
  const Trajectory one = Simulate(a), other = Simulate(b);
  EXPECT_EQ(EventNames(one), events);
  EXPECT_EQ(EventNames(other), events);
  double worst = std::abs(one.end_time - other.end_time);
  for (int i = 0; i < 4; ++i)
    worst = std::max(worst, std::abs(one.final_state[i] - other.final_state[i]));
  return worst;
}

TEST(Blends, ThesisWithBothAtOneIsConsistent) {
  const std::array effects = {Set("rolling_law", 1.0), Set("tip_rotation", 1.0)};
  for (const Sequence& s : kSequences) {
    SimulationRequest thesis = RequestOf(Law::kThesis, s);
    thesis.effects = effects;
    const double distance = Distance(thesis, RequestOf(Law::kConsistent, s), s.events);
    std::printf("%-10s thesis with both blends, consistent: %.1e\n", s.name, distance);
    EXPECT_LT(distance, 1e-10) << s.name;  // a dozen steps at 1e-13, magnified by the force's slope
  }
}

TEST(Blends, NoSlipWithTipRotationAtOneIsConsistent) {
  const std::array effects = {Set("tip_rotation", 1.0)};
  for (const Sequence& s : kSequences) {
    SimulationRequest no_slip = RequestOf(Law::kNoSlip, s);
    no_slip.effects = effects;
    EXPECT_LT(Distance(no_slip, RequestOf(Law::kConsistent, s), s.events), 1e-10) << s.name;
  }
}

TEST(Blends, SecondOrderBendingAtOneTurnsTheOtherLawsIntoLargeDeflection) {
  const std::array from_thesis = {Set("rolling_law", 1.0), Set("tip_rotation", 1.0),
                                  Set("second_order_bending", 1.0)};
  const std::array from_no_slip = {Set("tip_rotation", 1.0), Set("second_order_bending", 1.0)};
  const std::array from_consistent = {Set("second_order_bending", 1.0)};
  for (const Sequence& s : kSequences) {
    const SimulationRequest whole = RequestOf(Law::kLargeDeflection, s);
    SimulationRequest q = RequestOf(Law::kThesis, s);
    q.effects = from_thesis;
    EXPECT_LT(Distance(q, whole, s.events), 1e-10) << s.name;
    q.law = Law::kNoSlip;
    q.effects = from_no_slip;
    EXPECT_LT(Distance(q, whole, s.events), 1e-10) << s.name;
    q.law = Law::kConsistent;
    q.effects = from_consistent;
    EXPECT_LT(Distance(q, whole, s.events), 1e-10) << s.name;
  }
}

// What leg_hardening's one constant has to stand for: beta r/C^2 of M26 against C2 of M2b.
TEST(Blends, NoOneHardeningConstantIsSecondOrderBending) {
  Parameters<double> slender = ThickLegRequest(Law::kConsistent).parameters;
  slender.A *= 1e6;  // bending alone
  const LegCompliance<double> leg(slender);
  const double r = slender.r;
  const auto ratio = [&](double phi) {
    return r * leg.SecondOrder(phi) / (leg.Chord(phi) * leg.Chord(phi));
  };
  std::printf("C2 r/C^2 at phi = 2, 2.5, pi: %.3f %.3f %.3f\n", ratio(2.0), ratio(2.5),
              ratio(std::numbers::pi));
  EXPECT_NEAR(ratio(2.0), 2.06, 0.01);
  EXPECT_NEAR(ratio(std::numbers::pi), 0.41, 0.01);
}

TEST(Blends, RollingLawAtOneTurnsThesisAndNoSlipIntoEachOther) {
  const std::array effects = {Set("rolling_law", 1.0)};
  for (const Sequence& s : kSequences) {
    SimulationRequest q = RequestOf(Law::kNoSlip, s);
    q.effects = effects;
    EXPECT_LT(Distance(q, RequestOf(Law::kThesis, s), s.events), 1e-10) << s.name;
    q.law = Law::kThesis;
    EXPECT_LT(Distance(q, RequestOf(Law::kNoSlip, s), s.events), 1e-10) << s.name;
  }
}

TEST(Blends, RollingLawMovesTheFootOfAnElasticArcByWhatItDoesNotRollOff) {
  const std::array effects = {Set("rolling_law", 0.7)};
  constexpr std::array kSeen = {Channel::kContactArc, Channel::kLegLength};
  for (Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kElastica}) {
    SimulationRequest q = RequestOf(law, kSequences[0]);
    q.effects = effects;
    q.channels = kSeen;
    const auto events = Simulate(q).events;
    const double middle = 0.5 * (events[0].time + events[1].time), h = 1e-4;
    struct Foot {
      double X0, phi, l;
    };
    const auto at = [&](double t) {
      const std::array rows = {t - 1e-9};
      q.row_times = rows;
      q.horizon = t;
      const Trajectory run = Simulate(q);
      return Foot{run.final_state[4], run.samples[0], run.samples[1]};
    };
    const Foot before = at(middle - h), mid = at(middle), after = at(middle + h);
    const double advance = 0.7 * (mid.l * std::cos(0.5 * mid.phi) - q.parameters.r);  // M27
    const double expected = advance * (after.phi - before.phi);
    EXPECT_GT(std::abs(expected), 1e-5);
    EXPECT_NEAR((after.X0 - before.X0) / expected, 1.0, 1e-4) << NameOf(law);
  }
}

// ---- energy ----------------------------------------------------------------------------------

double Drift(const SimulationRequest& q) {
  const Trajectory run = Simulate(q);
  return Energy(q, run.final_mode, run.final_state) / Energy(q, Mode::kFlight, q.initial) - 1.0;
}

struct ConservativeTerm : ::testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(ConservativeTerm, KeepsTheEnergyOfAHopAndInsideAStance) {
  const std::array effects = {Set(std::get<0>(GetParam()), std::get<1>(GetParam()))};
  for (Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kElastica, Law::kStraightLeg}) {
    for (const Sequence& s : kSequences) {
      SimulationRequest q = law == Law::kStraightLeg ? SteadyStraightLeg() : RequestOf(law, s);
      q.parameters.d = 0.0;
      const Trajectory without = Simulate(q);
      q.effects = effects;
      const Trajectory hop = Simulate(q);
      ASSERT_EQ(EventNames(hop), EventNames(without)) << NameOf(law) << ' ' << s.name;
      EXPECT_GT(std::abs(hop.end_time - without.end_time), 1e-5);
      EXPECT_LT(std::abs(Drift(q)), kEnergyDrift) << NameOf(law) << ' ' << s.name;
      const double down = hop.events[0].time, up = hop.events[hop.events.size() - 2].time;
      for (double part : {0.2, 0.4, 0.6, 0.8}) {
        q.horizon = down + part * (up - down);
        EXPECT_LT(std::abs(Drift(q)), kEnergyDrift) << NameOf(law) << ' ' << s.name << ' ' << part;
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Laws, ConservativeTerm,
                         ::testing::Values(std::tuple{"leg_hardening", 0.3},
                                           std::tuple{"leg_hardening", -0.2},
                                           std::tuple{"ground_compliance", 2e-5}),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param)) +
                                  (std::get<1>(info.param) < 0.0 ? "_soft" : "");
                         });

TEST(FootSlip, LosesItsRateTimesTheSquareOfTheForce) {
  using Rule = boost::math::quadrature::gauss<double, 20>;
  constexpr std::array kForce = {Channel::kGroundForceX};
  const double c = 1e-3;
  const std::array effects = {Set("foot_slip", c)};
  for (Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kElastica, Law::kStraightLeg}) {
    SimulationRequest q =
        law == Law::kStraightLeg ? SteadyStraightLeg() : RequestOf(law, kSequences[1]);
    q.parameters.d = 0.0;
    q.effects = effects;
    const double before = Energy(q, Mode::kFlight, q.initial);
    const Trajectory run = Simulate(q);
    const double loss = before - Energy(q, run.final_mode, run.final_state);
    EXPECT_GT(loss, 1e-4 * before) << NameOf(law);
    std::vector<double> times, weights;
    for (const Segment& s : run.segments) {
      if (s.mode == Mode::kFlight) continue;
      constexpr int kPanels = 20;
      const double half = 0.5 * (s.end - s.begin) / kPanels;
      for (int panel = 0; panel < kPanels; ++panel) {
        const double middle = s.begin + (2 * panel + 1) * half;
        for (int i = static_cast<int>(Rule::abscissa().size()) - 1; i >= 0; --i) {
          times.push_back(middle - half * Rule::abscissa()[i]);
          weights.push_back(half * Rule::weights()[i]);
        }
        for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
          times.push_back(middle + half * Rule::abscissa()[i]);
          weights.push_back(half * Rule::weights()[i]);
        }
      }
    }
    q.row_times = times;
    q.channels = kForce;
    const Trajectory sampled = Simulate(q);
    double lost = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i)
      lost += weights[i] * c * sampled.samples[i] * sampled.samples[i];
    EXPECT_NEAR(lost / loss, 1.0, 1e-7) << NameOf(law);  // samples are a digit worse than steps
  }
}

// ---- closed forms ----------------------------------------------------------------------------

TEST(GroundCompliance, UnderAVerticalStraightLegIsASpringInSeries) {
  SimulationRequest q = SteadyStraightLeg();
  q.parameters.theta_td = 0.0;
  q.initial = {0.0, 1.3, 0.0, 0.0};
  SimulationRequest series = q;
  const double c = 2e-5;
  series.parameters.k = q.parameters.k / (1.0 + q.parameters.k * c);
  const std::array effects = {Set("ground_compliance", c)};
  q.effects = effects;
  EXPECT_LT(Distance(q, series, "touchdown liftoff apex"), 1e-10);
  // In the middle of a stance as well.
  q.horizon = series.horizon = 0.35;
  const Trajectory one = Simulate(q), other = Simulate(series);
  ASSERT_EQ(one.final_mode, Mode::kStance);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(one.final_state[i], other.final_state[i], 1e-11);
}

TEST(StiffnessDrift, FromALaterOriginIsThatModulusAndItsDrift) {
  const double gamma = 0.3, origin = 2.0;
  for (Law law :
       {Law::kThesis, Law::kNoSlip, Law::kConsistent, Law::kLargeDeflection, Law::kStraightLeg}) {
    SimulationRequest q =
        law == Law::kStraightLeg ? SteadyStraightLeg() : RequestOf(law, kSequences[1]);
    const double grown = 1.0 + gamma * origin;
    SimulationRequest later = q;
    later.parameters.time_origin = origin;
    q.parameters.E *= grown;
    q.parameters.k *= grown;
    const std::array effects = {Set("stiffness_drift", gamma / grown)};
    const std::array later_effects = {Set("stiffness_drift", gamma)};
    q.effects = effects;
    later.effects = later_effects;
    EXPECT_LT(Distance(q, later, EventNames(Simulate(q)).c_str()), 1e-10) << NameOf(law);
  }
}

TEST(StiffnessDrift, OverAShortStanceIsTheModulusOfThatMoment) {
  // A drift of 1 % a second changes E by 0.001 % in a stance: the rest is the time of the stance.
  SimulationRequest q = RequestOf(Law::kLargeDeflection, kSequences[0]);
  const Trajectory plain = Simulate(q);
  const double middle = 0.5 * (plain.events[0].time + plain.events[1].time);
  SimulationRequest moment = q;
  moment.parameters.E *= 1.0 + 0.01 * middle;
  const std::array effects = {Set("stiffness_drift", 0.01)};
  q.effects = effects;
  const double change =
      Distance(moment, RequestOf(Law::kLargeDeflection, kSequences[0]), kSequences[0].events);
  EXPECT_LT(Distance(q, moment, kSequences[0].events), 0.1 * change);
}

TEST(LegHardening, IsTheStatedForceOfASpring) {
  Parameters<double> p = SteadyStraightLeg().parameters;
  p.law_terms.active = true;
  p.law_terms.hardening = 0.4;
  const ExtendedLeg<double> leg(p, Law::kStraightLeg);
  const std::array<double, 5> z = {0.0, 0.9, 0.0, 0.0, 0.0};
  EXPECT_NEAR(leg.Load(Mode::kStance, z.data(), {0.0, 0.0}).elastic_force,
              p.k * 0.1 * (1.0 + 0.4 * 0.1 / p.l0), 1e-9);
}

}  // namespace
}  // namespace hoplab
