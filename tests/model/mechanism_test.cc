#include <gtest/gtest.h>

#include <array>

#include "base/random.h"
#include "model/laws/elastic_arc.h"
#include "model/laws/half_circle.h"
#include "model/mechanisms/c_leg.h"
#include "model/mechanisms/legged_body_inl.h"
#include "tests/support/matrix_near.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;

using ThesisBody = LeggedBody<double, CLeg<double, ThesisLaw>>;
using NoSlipBody = LeggedBody<double, CLeg<double, NoSlipLaw>>;
using ConsistentBody = LeggedBody<double, CLeg<double, ConsistentLaw>>;
using LargeDeflectionBody = LeggedBody<double, CLeg<double, LargeDeflectionLaw>>;

// Any leg's setup: the law is that of the type.
MechanismSetup<double> SetupOf(const Parameters<double>& p) { return {.parameters = p}; }

Parameters<double> Undamped() {
  Parameters<double> p = ThickLegRequest(Law::kConsistent).parameters;
  p.d = 0.0;
  return p;
}
// A flight state at touch-down height, coming down.
std::array<double, 5> AtTouchdown(const Parameters<double>& p) {
  return {0.3, p.r * (1.0 + std::cos(p.theta_td)), 0.9, -1.2, 0.0};
}

template <class LegT>
struct CLegWithLaw : ::testing::Test {};
using Legs = ::testing::Types<ThesisBody, NoSlipBody, ConsistentBody, LargeDeflectionBody>;
TYPED_TEST_SUITE(CLegWithLaw, Legs);

TYPED_TEST(CLegWithLaw, TouchesDownWithoutAForce) {
  for (double deg : {-15.0, 0.0, 1.0, 20.0, 45.0, 90.0}) {
    Parameters<double> p = Undamped();
    p.theta_td = Degrees(deg);
    TypeParam leg(SetupOf(p));
    auto z = AtTouchdown(p);
    if (deg <= 0.0) z[kY] = 2.0 * p.r * std::cos(p.theta_td);
    const ResetResult reset = leg.Reset(Mode::kFlight, 0, 0.0, z.data());
    EXPECT_EQ(reset.next, deg > 0.0 ? Mode::kRolling : Mode::kToe);
    double g[kMaxGuards];
    leg.Guards(reset.next, 0.0, z.data(), g);
    EXPECT_NEAR(g[0] / (p.m * p.g), 0.0, 1e-9) << deg;  // C r/(m g) of rounding in l0 - l
  }
}

TYPED_TEST(CLegWithLaw, AtTouchdownHasTheUnloadedGeometry) {
  for (double deg : {1.0, 20.0, 45.0, 90.0}) {
    Parameters<double> p = Undamped();
    p.theta_td = Degrees(deg);
    TypeParam leg(SetupOf(p));
    auto z = AtTouchdown(p);
    leg.Reset(Mode::kFlight, 0, 0.0, z.data());
    const auto seen = leg.Observe(Mode::kRolling, 0.0, z.data());
    EXPECT_NEAR(seen[Channel::kLegAngle], p.theta_td, kClosedForm);
    EXPECT_NEAR(seen[Channel::kLegLength], 2.0 * p.r * std::cos(0.5 * p.theta_td), kClosedForm);
    // u = r sin(theta) and alpha = theta/2.
    const double lead = std::sqrt(std::pow(seen[Channel::kLegLength], 2) - z[kY] * z[kY]);
    EXPECT_NEAR(lead, p.r * std::sin(p.theta_td), 1e-9 * p.r / std::sin(p.theta_td));
    EXPECT_NEAR(std::atan2(lead, z[kY]), 0.5 * p.theta_td, 1e-9 / std::sin(p.theta_td));
  }
}

TYPED_TEST(CLegWithLaw, GroundForceIsMassTimesAccelerationAndWeight) {
  Parameters<double> p = Undamped();
  p.d = 4.0;
  p.kp = 0.5;
  p.v_des = 1.7;
  TypeParam leg(SetupOf(p));
  auto z = AtTouchdown(p);
  leg.Reset(Mode::kFlight, 0, 0.0, z.data());
  z[kX] += 0.01;
  z[kY] -= 0.012;
  for (Mode mode : {Mode::kRolling, Mode::kToe}) {
    if (mode == Mode::kToe) {
      z[kContact] = z[kX] + 0.01;
      z[kY] = 0.17;
    }
    double dz[5];
    leg.Derivative(mode, 0.0, z.data(), dz);
    const auto seen = leg.Observe(mode, 0.0, z.data());
    EXPECT_NEAR(seen[Channel::kGroundForceX], p.m * dz[kVx], kClosedForm * 100.0);
    EXPECT_NEAR(seen[Channel::kGroundForceY], p.m * (dz[kVy] + p.g), kClosedForm * 100.0);
    EXPECT_EQ(seen[Channel::kHipTorque], p.kp * (p.v_des - z[kVx]));
    EXPECT_EQ(seen[Channel::kContact], 1.0);
    EXPECT_GT(seen[Channel::kGroundForceY], 0.0);
  }
}

TYPED_TEST(CLegWithLaw, ToeStanceShowsTheChordAsTheLeg) {
  const Parameters<double> p = Undamped();
  TypeParam leg(SetupOf(p));
  const std::array<double, 5> z = {0.2, 0.17, 1.0, -0.2, 0.23};
  const auto seen = leg.Observe(Mode::kToe, 0.0, z.data());
  EXPECT_NEAR(seen[Channel::kLegLength], std::hypot(0.03, 0.17), kClosedForm);
  EXPECT_NEAR(seen[Channel::kLegAngle], std::atan2(0.03, 0.17), kClosedForm);
}

TYPED_TEST(CLegWithLaw, InFlightTheSensorsSeeAWaitingLeg) {
  Parameters<double> p = Undamped();
  p.kp = 1.0;
  TypeParam leg(SetupOf(p));
  const std::array<double, 5> z = {0.2, 0.3, 1.0, -0.2, 0.0};
  const auto seen = leg.Observe(Mode::kFlight, 0.0, z.data());
  EXPECT_EQ(seen[Channel::kLegAngle], p.theta_td);
  EXPECT_EQ(seen[Channel::kContact], 0.0);
  EXPECT_EQ(seen[Channel::kGroundForceY], 0.0);
  EXPECT_EQ(seen[Channel::kHipTorque], 0.0);
}

class RollingToToe : public ::testing::TestWithParam<Law> {};

TEST_P(RollingToToe, IsContinuousInForceAndVelocity) {
  SimulationRequest q = ThickLegRequest(GetParam());
  q.parameters.theta_td = Degrees(8.0);
  q.initial[2] = 0.7;
  const Trajectory hop = Simulate(q);
  ASSERT_EQ(hop.events[1].kind, EventKind::kRollingToToe);
  constexpr double kAside = 1e-7;
  const std::array times = {hop.events[1].time - kAside, hop.events[1].time + kAside};
  const std::array channels = {Channel::kBodyVx, Channel::kBodyVy, Channel::kLegLength,
                               Channel::kGroundForceX, Channel::kGroundForceY};
  q.row_times = times;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  // Forces here change by some weights in a hundredth of a second.
  const double rate = 1e3 * q.parameters.m * q.parameters.g;
  for (int c = 0; c < 5; ++c)
    EXPECT_NEAR(run.samples[c], run.samples[5 + c], 2.0 * kAside * rate) << c;
}
INSTANTIATE_TEST_SUITE_P(EveryLaw, RollingToToe, ::testing::ValuesIn(kCLegLaws),
                         [](const auto& info) { return std::string(NameOf(info.param)); });

// d(theta)/dt along the flow by differences, theta = 2 atan2(x_c - x, y).
template <class LegT>
double ThetaRate(const LegT& leg, const std::array<double, 5>& z) {
  double dz[5];
  leg.Derivative(Mode::kRolling, 0.0, z.data(), dz);
  const auto theta = [&](double t) {
    return 2.0 *
           std::atan2(z[kContact] + t * dz[kContact] - z[kX] - t * dz[kX], z[kY] + t * dz[kY]);
  };
  constexpr double kStep = 1e-5;
  return (8.0 * (theta(kStep) - theta(-kStep)) - (theta(2 * kStep) - theta(-2 * kStep))) /
         (12.0 * kStep);
}

// Loaded rolling states of the half-circle laws.
std::vector<std::array<double, 5>> LoadedStates(double r) {
  RandomStream random(20240607, 1);
  std::vector<std::array<double, 5>> states;
  for (int i = 0; i < 200; ++i) {
    const double theta = random.Uniform(0.1, 1.5), shrink = random.Uniform(0.85, 0.999);
    const double l = shrink * 2.0 * r * std::cos(0.5 * theta), x = random.Uniform(-1.0, 1.0);
    states.push_back({x, l * std::cos(0.5 * theta), random.Uniform(-2.0, 2.0),
                      random.Uniform(-2.0, 2.0), x + l * std::sin(0.5 * theta)});
  }
  return states;
}

TEST(ThesisLaw, ContactMovesAsTheImplicitEquationM7Says) {
  const Parameters<double> p = Undamped();
  ThesisBody leg(SetupOf(p));
  for (const auto& z : LoadedStates(p.r)) {
    double dz[5];
    leg.Derivative(Mode::kRolling, 0.0, z.data(), dz);
    const double u = z[kContact] - z[kX], l = std::hypot(u, z[kY]);
    const double alpha = std::atan2(u, z[kY]), r_d = l / (2.0 * std::cos(alpha));
    EXPECT_NEAR(dz[kContact], -r_d * std::sin(2.0 * alpha) * ThetaRate(leg, z), 1e-9);
  }
}

TEST(NoSlipLaw, ContactMovesByTheArcLaidDownM8) {
  const Parameters<double> p = Undamped();
  NoSlipBody leg(SetupOf(p));
  for (const auto& z : LoadedStates(p.r)) {
    double dz[5];
    leg.Derivative(Mode::kRolling, 0.0, z.data(), dz);
    EXPECT_NEAR(dz[kContact], -p.r * ThetaRate(leg, z), 1e-9);
  }
}

TEST(ThesisLaw, ChordForceIsComplianceAtTheDeformedRadiusM6) {
  const Parameters<double> p = Undamped();
  const ThesisLaw<double> law(p);
  for (const auto& z : LoadedStates(p.r)) {
    const auto load = law.Rolling(z.data());
    const long double alpha = std::atan2(static_cast<long double>(z[kContact] - z[kX]), z[kY]);
    const long double phi = std::numbers::pi_v<long double> - 2.0L * alpha;
    const long double l = std::hypot(static_cast<long double>(z[kContact] - z[kX]), z[kY]);
    const long double r_d = l / (2.0L * std::cos(alpha));
    const long double C =
        0.5L *
        (r_d * r_d * r_d * (2.0L * phi - 3.0L * std::sin(phi) + phi * std::cos(phi)) / (p.E * p.I) +
         r_d * (3.0L * std::sin(phi) - phi) / (p.E * p.A) +
         p.kappa * r_d * (phi - std::sin(phi)) / (p.G * p.A));
    const long double F = (2.0L * p.r * std::cos(alpha) - l) / C;
    EXPECT_NEAR(load.elastic_force / F, 1.0L, 1e-11);  // l0 - l loses up to 3 digits
  }
}

// A state in equilibrium at (phi, F): from M9 and M10 (b) in long double, forward.
struct LoadedArc {
  double phi, F;
  std::array<double, 5> z;
};
std::vector<LoadedArc> LoadedArcs(const Parameters<double>& p, bool second_order) {
  using std::cos;
  using std::sin;
  RandomStream random(20240607, 2);
  std::vector<LoadedArc> arcs;
  const long double r = p.r, EI = static_cast<long double>(p.E) * p.I;
  const auto C = [&](long double phi) {
    return 0.5L * (r * r * r * (2.0L * phi - 3.0L * sin(phi) + phi * cos(phi)) / EI +
                   r * (3.0L * sin(phi) - phi) / (static_cast<long double>(p.E) * p.A) +
                   p.kappa * r * (phi - sin(phi)) / (static_cast<long double>(p.G) * p.A));
  };
  const auto C2 = [&](long double phi) {
    if (!second_order) return 0.0L;
    const long double S = sin(phi / 2), K = cos(phi / 2);
    return r * r * r * r * r / (EI * EI) *
           (0.75L * phi * phi * S * K * K + 4.5L * phi * K * K * K - 0.75L * phi * K -
            8.5L * S * K * K + S);
  };
  const auto d = [](const auto& f, long double at) {  // slope, order 4
    const long double h = 1e-4L;
    return (8.0L * (f(at + h) - f(at - h)) - (f(at + 2 * h) - f(at - 2 * h))) / (12.0L * h);
  };
  while (arcs.size() < 200) {
    const long double phi = random.Uniform(1.6, 3.1);
    const long double l0 = 2.0L * r * sin(phi / 2);
    const long double F = random.Uniform(0.0, 0.12) * l0 / C(phi);
    const long double l = l0 - F * C(phi) - F * F * C2(phi);
    const long double lead = cos(phi / 2) - F * d(C, phi) / r / 2 - F * F * d(C2, phi) / r / 3;
    const long double u = l * lead, x = random.Uniform(-1.0, 1.0);
    const long double y = std::sqrt(l * l - u * u);
    arcs.push_back({static_cast<double>(phi),
                    static_cast<double>(F),
                    {static_cast<double>(x), static_cast<double>(y), random.Uniform(-2.0, 2.0),
                     random.Uniform(-2.0, 2.0), static_cast<double>(x + u - r * phi)}});
  }
  return arcs;
}

template <template <class> class LawT>
void ExpectRecovers(bool second_order) {
  const Parameters<double> p = Undamped();
  for (const LoadedArc& arc : LoadedArcs(p, second_order)) {
    LawT<double> law(p);
    law.StartRootAt(arc.phi + 0.1);  // from aside
    const auto load = law.Rolling(arc.z.data());
    // Slopes of the forward oracle are good to 1e-13; phi and F follow from x, y to 1e-12 times
    // the stiffness of the arc (r k/F up to 100).
    EXPECT_NEAR(load.phi, arc.phi, kLawResidual);
    EXPECT_NEAR(load.elastic_force, arc.F,
                kLawResidual * p.r / LegCompliance<double>(p).Chord(arc.phi));
    const double w = (arc.z[kY] * arc.z[kVy] - load.u * arc.z[kVx]) / load.l;
    EXPECT_NEAR(load.damping_rate, w, kClosedForm);
    EXPECT_NEAR(load.l, std::hypot(load.u, arc.z[kY]), kClosedForm);
  }
}

TEST(ConsistentLaw, FindsTheEquilibriumOfM9AndM10) { ExpectRecovers<ConsistentLaw>(false); }
TEST(LargeDeflectionLaw, FindsTheEquilibriumOfM9bAndM10b) {
  ExpectRecovers<LargeDeflectionLaw>(true);
}

TEST(LargeDeflectionLaw, TendsToConsistentAsTheLoadFalls) {
  const Parameters<double> p = Undamped();
  double last = 1.0;
  for (double load : {1e-1, 1e-2, 1e-3, 1e-4}) {
    LargeDeflectionLaw<double> second(p);
    ConsistentLaw<double> first(p);
    // An arc of 2.7 rad pressed straight down.
    const double theta = std::numbers::pi - 2.7;
    const std::array<double, 5> z = {0.0, p.r * (1.0 + std::cos(theta)) * (1.0 - 0.3 * load), 0.0,
                                     0.0, p.r * std::sin(theta) - p.r * 2.7};
    second.StartRootAt(2.7);
    first.StartRootAt(2.7);
    const double ratio =
        second.Rolling(z.data()).elastic_force / first.Rolling(z.data()).elastic_force - 1.0;
    EXPECT_LT(std::abs(ratio), 0.2 * last) << load;  // first order in the load
    last = std::abs(ratio);
  }
  EXPECT_LT(last, 1e-4);
}

TEST(LargeDeflectionLaw, HasAStrainEnergyWhoseSlopeIsTheForce) {
  // dU/dy at fixed X0 and x is - F y/l on the hip, for every law derived from a potential.
  const Parameters<double> p = Undamped();
  for (const LoadedArc& arc : LoadedArcs(p, true)) {
    LargeDeflectionLaw<double> law(p);
    law.StartRootAt(arc.phi);
    const auto energy = [&](double y) {
      auto z = arc.z;
      z[kY] = y;
      return law.StrainEnergy(law.Rolling(z.data()));
    };
    const double y = arc.z[kY], h = 1e-4 * y;
    const double slope =
        (8.0 * (energy(y + h) - energy(y - h)) - (energy(y + 2 * h) - energy(y - 2 * h))) /
        (12.0 * h);
    const auto load = law.Rolling(arc.z.data());
    const double stiffness = 1.0 / LegCompliance<double>(p).Chord(arc.phi);
    EXPECT_NEAR(-slope, load.elastic_force * y / load.l, 1e-8 * stiffness * p.r);
  }
}

TEST(ElasticArc, OutsideItsDomainSaysNotANumber) {
  const Parameters<double> p = Undamped();
  LargeDeflectionLaw<double> law(p);
  law.StartRootAt(2.7);
  // Hip far above what any arc reaches and far from the contact.
  const std::array<double, 5> z = {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 0.0};
  EXPECT_TRUE(std::isnan(law.Rolling(z.data()).elastic_force));
}

}  // namespace
}  // namespace hoplab
