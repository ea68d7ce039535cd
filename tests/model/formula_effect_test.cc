#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/effect_requests.h"
#include "tests/support/formulas.h"
#include "tests/support/gradient_check.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// ---- an effect of the catalogue, written as a formula ------------------------------------------

struct Written {
  WrittenEffect of;
  Law law;
};
void PrintTo(const Written& c, std::ostream* out) { *out << NameOf(c.law) << c.of.catalogue; }

double WeightUnder(Law law) {
  const SimulationRequest q = ExcitedRequest(law);
  return q.parameters.m * q.parameters.g;
}

std::vector<Written> AllWritten() {
  std::vector<Written> all;
  for (const Law law : kAllLaws) {
    for (WrittenEffect& e : WrittenEffects(WeightUnder(law))) {
      if (AppliesTo(*FindEffect(e.catalogue), law) && IsWrittenUnder(e.catalogue, law))
        all.push_back({std::move(e), law});
    }
  }
  return all;
}

class WrittenAsFormula : public ::testing::TestWithParam<Written> {
 protected:
  // Samples and final state, with their derivatives by the effect, its size and the start.
  struct Told {
    std::vector<double> values, slopes;
  };
  Told Run(const Effect& effect, double value) {
    SimulationRequest q = ExcitedRequest(GetParam().law);
    // Where one of the two is in closed form, or stops at a corner, their steps are not the same.
    q.integrator.relative_tolerance = 1e-13;
    q.integrator.absolute_tolerance = 1e-14;
    std::array effects = {EffectSetting::Null(effect)};
    effects[0].values[0] = value;
    q.effects = effects;
    const std::array directions = {D::EffectParameter(0, 0), D::InitialState(2)};
    q.directions = directions;
    const std::vector<double> times = EvenTimes(q.horizon, 40);
    q.row_times = times;
    q.channels = ChannelsOf(q.law);
    const Trajectory run = Simulate(q);
    Told told{run.samples, run.sensitivities};
    told.values.insert(told.values.end(), run.final_state.begin(), run.final_state.begin() + 4);
    return told;
  }
};

// Largest difference against the largest value.
double Apart(const std::vector<double>& a, const std::vector<double>& b) {
  double apart = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) {
      if (std::isnan(a[i]) != std::isnan(b[i])) return INFINITY;
      continue;
    }
    apart = std::max(apart, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  return apart / size;
}

// Effects whose compiled form takes other steps: in closed form in flight, or across a corner that
// the formula stops at; or that the formula reaches by another rounding (a direction times a size).
// There both are as good as the solver.
bool TakesOtherSteps(const std::string& effect) {
  return effect == "gravity_scale" || effect == "magnus_lift" ||
         effect == "leg_quadratic_damping" || effect == "leg_material_damping" ||
         effect == "stiffness_drift" || effect == "leg_hardening";
}

TEST_P(WrittenAsFormula, MovesAsTheCatalogueHasIt) {
  const Effect& compiled = *FindEffect(GetParam().of.catalogue);
  const Effect& written = FormulaEffect(GetParam().of.formula);
  const double size = compiled.info.parameters[0].typical;
  const double bound = TakesOtherSteps(GetParam().of.catalogue) ? 2e-10 : 1e-12;
  for (const double value : {0.0, size}) {
    const Told a = Run(written, value), b = Run(compiled, value);
    ASSERT_EQ(a.values.size(), b.values.size());
    EXPECT_LT(Apart(a.values, b.values), bound) << value;
    EXPECT_LT(Apart(a.slopes, b.slopes), 10.0 * bound) << value;
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, WrittenAsFormula, ::testing::ValuesIn(AllWritten()),
                         [](const auto& info) {
                           return info.param.of.catalogue + "_" +
                                  std::string(NameOf(info.param.law));
                         });

// ---- derivatives through corners, against Richardson differences -------------------------------

struct Cornered {
  std::string name;
  Law law;
  FormulaSource source;
  bool watched = true;  // the solver stops there
};
void PrintTo(const Cornered& c, std::ostream* out) { *out << c.name; }

std::vector<Cornered> CorneredFormulas() {
  const auto c = Factor("c", "N s/m", -10.0, 10.0, 0.05);
  const auto f = Factor("f", "N", -10.0, 10.0, 0.05);
  const auto x0 = Shape("x0", "m", 0.06, -1.0, 1.0);
  std::vector<Cornered> all;
  for (const Law law : {Law::kLargeDeflection, Law::kStraightLeg, Law::kThesis}) {
    const std::string of = "_" + std::string(NameOf(law));
    const auto add = [&](const char* name, const FormulaSource& source) {
      all.push_back({name + of, law, source});
    };
    add("cable",
        Source("body_force_x", "-k * max(x - x0, 0)", {Factor("k", "N/m", 0.0, 200.0, 2.0), x0}));
    add("coulomb", Source("body_force_y", "-f * sign(vy)", {f}));
    add("step_in_time",
        Source("body_force_x", "f * step(t - t0)", {f, Shape("t0", "s", 0.11, 0.0, 1.0)}));
    add("step_in_place", Source("body_force_x", "f * step(x - x0)", {f, x0}));
    add("power", Source("body_force_y", "-f * sign(vy) * (abs(vy)/v0)^p",
                        {f, Shape("v0", "m/s", 1.0, 0.1, 10.0), Shape("p", "1", 1.5, 0.5, 3.0)}));
    add("loading", Source("chord_force", "f * loading * s", {Factor("f", "N", -50.0, 50.0, 1.0)}));
    add("rate", Source("chord_force", "-f * sign(rate) * s", {Factor("f", "N", -50., 50., 1.0)}));
    add("quadratic", Source("chord_force", "-d2 * abs(rate) * rate",
                            {Factor("d2", "N s^2/m^2", 0.0, 1e5, 2.0)}));
    add("cutoff", Source("chord_force", "-k * max(s - s0, 0)",
                         {Factor("k", "N", 0.0, 1e4, 10.0), Shape("s0", "1", 0.01, 0.0, 0.5)}));
    add("torque", Source("hip_torque", "f * max(s - s0, 0)",
                         {Factor("f", "N m", -10.0, 10.0, 0.5), Shape("s0", "1", 0.01, 0., 0.5)}));
    add("in_stance", Source("body_force_x", "f * in_stance", {f}));
  }
  all.push_back(
      {"ball_quadratic", Law::kBall,
       Source("body_force_y", "-c * abs(vy) * vy", {Factor("c", "N s^2/m^2", 0.0, 10.0, 0.02)})});
  all.push_back({"ball_sign", Law::kBall, Source("body_force_y", "-f * sign(vy)", {f})});
  all.push_back({"ball_wall", Law::kBall,
                 Source("body_force_x", "-k * max(x - x0, 0)",
                        {Factor("k", "N/m", 0.0, 200.0, 2.0), Shape("x0", "m", 0.4, -1.0, 1.0)})});
  return all;
}

class ThroughCorners : public ::testing::TestWithParam<Cornered> {};

TEST_P(ThroughCorners, DerivativesMatchDifferences) {
  const Effect& effect = FormulaEffect(GetParam().source);
  SimulationRequest q = ExcitedRequest(GetParam().law);
  std::array effects = {EffectSetting::Null(effect)};
  for (std::size_t i = 0; i < effect.info.parameters.size(); ++i) {
    const EffectParameter& p = effect.info.parameters[i];
    if (!p.is_shape) effects[0].values[i] += p.typical;
  }
  q.effects = effects;
  const Trajectory run = Simulate(q);
  ASSERT_TRUE(IsComplete(run.outcome)) << NameOf(run.outcome);
  const std::vector<double> times = TimesClearOfEvents(run);
  q.row_times = times;
  q.channels = ChannelsOf(q.law).first(4);
  std::vector<D> directions = {D::InitialState(2), D::InitialState(3),
                               D::Parameter(ParameterId::kM)};
  for (std::size_t i = 0; i < effect.info.parameters.size(); ++i)
    directions.push_back(D::EffectParameter(0, static_cast<int>(i)));
  q.directions = directions;
  for (const ColumnCheck& check : CheckGradient(q)) {
    EXPECT_EQ(Complaint(check), "");
    if (!check.nothing_to_see) {
      EXPECT_LT(check.error, 1e-6) << check.what;
    }
  }
  const bool stops = !effect.formula->corners().empty();
  const auto corners = std::count_if(run.events.begin(), run.events.end(),
                                     [](const Event& e) { return e.kind == EventKind::kCorner; });
  EXPECT_EQ(corners > 0, stops);
}

INSTANTIATE_TEST_SUITE_P(Formulas, ThroughCorners, ::testing::ValuesIn(CorneredFormulas()),
                         [](const auto& info) { return info.param.name; });

// ---- closed forms ------------------------------------------------------------------------------

SimulationRequest FallingBall(std::span<const EffectSetting> effects) {
  SimulationRequest q = BallRequest();
  q.integrator.relative_tolerance = 1e-12;
  q.integrator.absolute_tolerance = 1e-13;
  q.effects = effects;
  q.initial = {0.0, 3.0, 2.0, 1.0};
  q.horizon = 0.5;
  return q;
}

// A force that begins at t0 pushes along a parabola from there on.
TEST(FormulaCorner, AForceThatBeginsAtAnInstant) {
  const double force = 0.3, begin = 0.2;
  std::array effects = {EffectSetting::Null(
      FormulaEffect(Source("body_force_x", "f * step(t - t0)",
                           {Factor("f", "N", -10., 10., 0.1), Shape("t0", "s", begin, 0., 1.)})))};
  effects[0].values[0] = force;
  const SimulationRequest q = FallingBall(effects);
  const std::array directions = {D::EffectParameter(0, 0), D::EffectParameter(0, 1)};
  SimulationRequest with = q;
  with.directions = directions;
  const Trajectory run = Simulate(with);
  const double m = q.parameters.m, since = q.horizon - begin;
  EXPECT_NEAR(run.final_state[0], 2.0 * q.horizon + 0.5 * force / m * since * since, 1e-11);
  // By the force, and by its instant.
  EXPECT_NEAR(run.final_sensitivities[0], 0.5 / m * since * since, 1e-10);
  EXPECT_NEAR(run.final_sensitivities[1], -force / m * since, 1e-10);
}

// A spring behind a wall: a quarter of a sine, then free.
TEST(FormulaCorner, ASpringBehindAWall) {
  const double k = 50.0, wall = 0.1;
  std::array effects = {EffectSetting::Null(
      FormulaEffect(Source("body_force_x", "-k * max(x - w, 0)",
                           {Factor("k", "N/m", 0., 200., 2.), Shape("w", "m", wall, -1., 1.)})))};
  effects[0].values[0] = k;
  SimulationRequest q = FallingBall(effects);
  const double omega = std::sqrt(k / q.parameters.m), enters = wall / 2.0;
  ASSERT_LT(enters + M_PI / omega, q.horizon);
  const double left = q.horizon - enters - M_PI / omega;
  EXPECT_NEAR(Simulate(q).final_state[0], wall - 2.0 * left, 1e-10);
}

// Dry friction of a guide that stops a fall at its top: lost energy = friction times way.
TEST(FormulaCorner, SignOfTheSpeedLosesForceTimesWay) {
  const double friction = 0.05;
  std::array effects = {EffectSetting::Null(
      FormulaEffect(Source("body_force_y", "-f * sign(vy)", {Factor("f", "N", 0.0, 10.0, 0.1)})))};
  effects[0].values[0] = friction;
  SimulationRequest q = FallingBall(effects);
  const double m = q.parameters.m, g = q.parameters.g, up = g + friction / m;
  const double rise = 0.5 / up, to_top = 1.0 / up, down = q.horizon - to_top;
  EXPECT_NEAR(Simulate(q).final_state[1], 3.0 + rise - 0.5 * (g - friction / m) * down * down,
              1e-11);
}

// A body that begins on a corner takes the side it leaves to; one that stays there feels none.
TEST(FormulaCorner, AStartOnTheCorner) {
  const double friction = 0.05;
  const Effect& sign =
      FormulaEffect(Source("body_force_y", "-f * sign(vy)", {Factor("f", "N", 0.0, 10.0, 0.1)}));
  std::array effects = {EffectSetting::Null(sign)};
  effects[0].values[0] = friction;
  SimulationRequest q = FallingBall(effects);
  q.initial[3] = 0.0;
  EXPECT_NEAR(Simulate(q).final_state[1],
              3.0 - 0.5 * (q.parameters.g - friction / q.parameters.m) * q.horizon * q.horizon,
              1e-9);
  const Effect& across =
      FormulaEffect(Source("body_force_x", "-f * sign(vx)", {Factor("f", "N", 0.0, 10.0, 0.1)}));
  effects[0] = EffectSetting::Null(across);
  effects[0].values[0] = friction;
  q.initial[2] = 0.0;
  EXPECT_EQ(Simulate(q).final_state[0], 0.0);
}

// Friction stronger than the weight: the ball cannot leave the top, which is no motion at all.
TEST(FormulaCorner, FrictionThatHoldsHasANamedEnd) {
  std::array effects = {EffectSetting::Null(FormulaEffect(
      Source("body_force_y", "-f * sign(vy)", {Factor("f", "N", 0.0, 1000.0, 0.1)})))};
  SimulationRequest q = FallingBall(effects);
  effects[0].values[0] = 3.0 * q.parameters.m * q.parameters.g;
  EXPECT_EQ(Simulate(q).outcome, Outcome::kChattering);
}

// A kink that is touched and not crossed ends nothing: the force is continuous there.
TEST(FormulaCorner, GrazingAKinkIsNoEnd) {
  SimulationRequest plain = FallingBall({});
  const double top = 3.0 + 0.5 / plain.parameters.g;
  std::array effects = {EffectSetting::Null(
      FormulaEffect(Source("body_force_y", "-k * max(y - h, 0)",
                           {Factor("k", "N/m", 0., 200., 2.), Shape("h", "m", top, -1., 5.)})))};
  effects[0].values[0] = 10.0;
  const Trajectory run = Simulate(FallingBall(effects));
  EXPECT_TRUE(IsComplete(run.outcome)) << NameOf(run.outcome);
  EXPECT_NEAR(run.final_state[1], Simulate(plain).final_state[1], 1e-9);
}

}  // namespace
}  // namespace hoplab
