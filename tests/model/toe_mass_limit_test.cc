#include <gtest/gtest.h>

#include <array>
#include <complex>

#include "tests/support/matrix_near.h"
#include "tests/support/toe_mass.h"

namespace hoplab {
namespace {

using namespace testing;

// ---- toe mass to zero --------------------------------------------------------------------

struct ToeMassLimit : ::testing::TestWithParam<Law> {};

// Event times, and place and speed at the last apex.
std::vector<double> Summary(const Trajectory& run) {
  std::vector<double> values;
  for (const Event& e : run.events) values.push_back(e.time);
  for (int i = 0; i < 3; ++i) values.push_back(run.final_state[i]);
  return values;
}

TEST_P(ToeMassLimit, IsTheMasslessLegApproachedInProportionToTheMass) {
  SimulationRequest q = ToeMassRequest(GetParam());
  q.parameters.m_toe = 0.0;
  q.max_hops = 2;
  const Trajectory massless = Simulate(q);
  ASSERT_EQ(massless.outcome, Outcome::kHopLimit);
  const std::vector<double> limit = Summary(massless);
  std::vector<double> errors;
  std::printf("%s: toe mass | off the massless leg | order\n", NameOf(GetParam()).data());
  for (const double mass : {1e-2, 1e-3, 1e-4, 1e-5}) {
    // Placed to e^-60 between lift-off and touch-down; the rest is the mass itself.
    const Trajectory run = Simulate(WithToeMass(q, mass, 300.0));
    ASSERT_EQ(EventNames(run), EventNames(massless)) << mass;
    const std::vector<double> values = Summary(run);
    double worst = 0.0;
    for (std::size_t i = 0; i < limit.size(); ++i)
      worst = std::max(worst, std::abs(values[i] - limit[i]));
    const double order = errors.empty() ? std::nan("") : std::log10(errors.back() / worst);
    errors.push_back(worst);
    std::printf("  %.0e kg | %.3e | %.3f\n", mass, worst, order);
    if (errors.size() > 2) {
      EXPECT_NEAR(order, 1.0, 0.1) << mass;
    }
  }
  EXPECT_LT(errors.back(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, ToeMassLimit, ::testing::ValuesIn(kLegLaws),
                         [](const auto& info) { return std::string(NameOf(info.param)); });

// ---- closed forms ------------------------------------------------------------------------

// x'' + 2 b x' + w2 x = 0 from (x0, v0), damped below or above the critical rate.
std::array<double, 2> Oscillator(double b, double w2, double x0, double v0, double t) {
  using C = std::complex<double>;
  const C root = std::sqrt(C(b * b - w2)), fast = -b - root, slow = w2 / fast;
  const C a = (v0 - fast * x0) / (slow - fast), c = x0 - a;
  return {(a * std::exp(slow * t) + c * std::exp(fast * t)).real(),
          (a * slow * std::exp(slow * t) + c * fast * std::exp(fast * t)).real()};
}

// A straight leg hopping in place: hip and toe stay above each other, all is linear.
SimulationRequest InPlace(double toe_mass, double damping) {
  SimulationRequest q = ToeMassRequest(Law::kStraightLeg);
  q.parameters.theta_td = 0.0;
  q.parameters.m_toe = toe_mass;
  q.parameters.d = damping;
  q.initial = {0.0, 0.25, 0.0, 0.0};
  return q;
}

// Chord and its rate `seconds` after the first lift-off, from the closed form of stance and
// flight: a hip on a spring and damper; two bodies on the same, off when the toe is lifted.
std::array<double, 2> ChordInPlace(const SimulationRequest& q, double seconds) {
  const auto& p = q.parameters;
  const double sag = p.m * p.g / p.k;
  const double landing = -std::sqrt(2.0 * p.g * (q.initial[1] - p.l0));
  const auto stance = [&](double t) {  // stretch of the leg and its rate
    auto s = Oscillator(0.5 * p.d / p.m, p.k / p.m, sag, landing, t);
    s[0] -= sag;
    return s;
  };
  const auto pull = [&](double t) {
    const auto [stretch, rate] = stance(t);
    return p.k * stretch + p.d * rate - p.m_toe * p.g;
  };
  double low = M_PI_2 * std::sqrt(p.m / p.k), high = 2.6 * low;
  EXPECT_LT(pull(low), 0.0);
  EXPECT_GT(pull(high), 0.0);
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (pull(middle) < 0.0 ? low : high) = middle;
  }
  const auto [stretch, rate] = stance(low);
  const double reduced = p.m * p.m_toe / (p.m + p.m_toe);
  auto chord = Oscillator(0.5 * p.d / reduced, p.k / reduced, stretch, rate, seconds);
  chord[0] += p.l0;
  return chord;
}

std::array<double, 2> Chord(const Trajectory& run) {
  const auto& z = run.final_state;
  return {z[1] - z[5], z[3] - z[7]};
}

TEST(ToeMassClosedForm, HopInPlaceVibratesAsTwoBodiesOnASpring) {
  for (const double damping : {0.0, 3.0, 12.0}) {
    const SimulationRequest q = InPlace(0.02, damping);
    for (const double after : {0.002, 0.01, 0.03}) {
      const Trajectory run = Simulate(EndedAfter(q, EventKind::kLiftoff, after));
      ASSERT_EQ(run.final_mode, Mode::kFlight);
      EXPECT_TRUE(MatrixNear(Chord(run), ChordInPlace(q, after), 1e-10)) << damping << ' ' << after;
    }
  }
}

TEST(ToeMassClosedForm, PlacementTorqueTurnsTheToeAsALinearPendulum) {
  // A hip too heavy to feel it, no gravity, a small constant torque from rest: m_t l^2 theta'' =
  // -T - kd theta' - kp theta, but for the stretch of order theta'^2.
  SimulationRequest q = ToeMassRequest(Law::kStraightLeg);
  q.parameters.m = 1e6;
  q.parameters.g = 0.0;
  q.initial = {0.0, 1.0, 0.0, 1.0};
  const double torque = 1e-7, inertia = 0.02 * 0.18 * 0.18;
  const std::array effects = {EffectSetting{FindEffect("torque_bias"), {torque}}};
  q.effects = effects;
  const std::array channels = {Channel::kLegAngle};
  q.channels = channels;
  for (const double damping : {0.2, 0.7, 3.0}) {  // of the critical
    q.parameters.kd_place = 2.0 * damping * inertia * 100.0;
    const double kp = q.parameters.kp_place, turned = torque / kp;
    for (const double t : {0.005, 0.02, 0.06}) {
      const std::array times = {t};
      q.row_times = times;
      q.horizon = t;
      const double theta = Simulate(q).samples[0] - q.parameters.theta_td;
      const auto away =
          Oscillator(0.5 * q.parameters.kd_place / inertia, kp / inertia, turned, 0.0, t);
      EXPECT_NEAR(theta / turned, away[0] / turned - 1.0, 1e-6) << damping << ' ' << t;
    }
  }
}

// ---- solvers -----------------------------------------------------------------------------

Trajectory RunWithSolver(SimulationRequest q, IntegratorKind kind, double tolerance) {
  q.integrator = {kind, tolerance, 0.1 * tolerance};
  return Simulate(q);
}

TEST(ToeMassSolvers, AgreeOnTwoHops) {
  for (const Law law : kLegLaws) {
    SimulationRequest q = ToeMassRequest(law);
    q.max_hops = 2;
    const Trajectory reference = RunWithSolver(q, IntegratorKind::kDop853, kOracleRelative);
    ASSERT_EQ(reference.outcome, Outcome::kHopLimit) << NameOf(law);
    for (const auto& [kind, factor] :
         {std::pair{IntegratorKind::kErkStep, 1e3}, std::pair{IntegratorKind::kCvodes, 1e5}}) {
      const Trajectory run = RunWithSolver(q, kind, 1e-10);
      ASSERT_EQ(EventNames(run), EventNames(reference)) << NameOf(law) << ' ' << NameOf(kind);
      EXPECT_TRUE(MatrixNear(run.final_state, reference.final_state, factor * 1e-10))
          << NameOf(law) << ' ' << NameOf(kind);
    }
  }
}

TEST(ToeMassSolvers, AgreeOnWhatAForceDoesToALegThatIsStillRelaxed) {
  for (const char* name : {"constant_force", "air_drag", "torque_bias"}) {
    SimulationRequest q = ToeMassRequest(Law::kLargeDeflection);
    const std::array effects = {EffectSetting::Null(*FindEffect(name))};
    const std::array directions = {SensitivityDirection::EffectParameter(0, 0)};
    q.effects = effects;
    q.directions = directions;
    const Trajectory reference = RunWithSolver(q, IntegratorKind::kDop853, 1e-11);
    for (const auto& [kind, tolerance] :
         {std::pair{IntegratorKind::kDop853, 1e-7}, std::pair{IntegratorKind::kErkStep, 1e-7},
          std::pair{IntegratorKind::kCvodes, 1e-6}}) {
      const Trajectory run = RunWithSolver(q, kind, 1e-9);
      EXPECT_TRUE(MatrixNear(run.final_sensitivities, reference.final_sensitivities, tolerance))
          << name << ' ' << NameOf(kind);
    }
  }
}

TEST(StiffToe, CvodesKeepsToTheClosedFormWhereAnExplicitSolverIsSlow) {
  // d/m_t = 1.2e7 1/s: the toe follows the damper within 0.1 us, the leg relaxes within 6 ms.
  const SimulationRequest q = EndedAfter(InPlace(1e-6, 12.0), EventKind::kLiftoff, 0.01);
  const Trajectory stiff = RunWithSolver(q, IntegratorKind::kCvodes, 1e-10);
  ASSERT_EQ(stiff.final_mode, Mode::kFlight);
  EXPECT_TRUE(MatrixNear(Chord(stiff), ChordInPlace(q, 0.01), 1e-6));
  const Trajectory slow = RunWithSolver(q, IntegratorKind::kDop853, 1e-10);
  EXPECT_TRUE(MatrixNear(Chord(slow), ChordInPlace(q, 0.01), 1e-6));
  std::printf("stiff toe: cvodes %ld steps, dop853 %ld steps (x 12)\n", stiff.steps, slow.steps);
  EXPECT_LT(20 * stiff.steps, slow.steps);
}

TEST(StiffToe, BeyondTheStepsOfAnExplicitSolverIsSaidAndLeftToCvodes) {
  SimulationRequest q = InPlace(1e-6, 12.0);
  q.parameters.kp_place = q.parameters.kd_place = 0.0;
  q.integrator.max_steps = 20000;
  EXPECT_EQ(Simulate(q).outcome, Outcome::kStepLimit);
  q.integrator.kind = IntegratorKind::kCvodes;
  q.integrator.relative_tolerance = 1e-10;
  q.integrator.absolute_tolerance = 1e-11;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kHopLimit);
  EXPECT_LT(run.steps, 5000);
}

}  // namespace
}  // namespace hoplab
