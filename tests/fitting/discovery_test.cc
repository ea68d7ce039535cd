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

// Balls thrown up from 2 m and falling 25 m, with this drag.
Dataset Balls(double quadratic, std::uint64_t seed) {
  std::string yaml =
      "format: hoplab-scenario/1\nname: balls\n"
      "mechanism:\n  type: ball\n  body_mass_kg: 0.05\n  gravity_m_per_s2: 9.81\n"
      "  ball: {radius_m: 0.03, restitution: 0.7, tangential_loss: 0}\n"
      "initial: {x_m: 0, y_m: 26, vx_m_per_s: 0, vy_m_per_s: 0}\n"
      "stop: {time_s: 2.1}\n"
      "effects: {air_drag: {c_drag: " +
      std::to_string(quadratic) +
      "}}\n"
      "dataset:\n  sample_rate_hz: 50\n  channels: {body_y_m: {sigma: 0.01}}\n"
      "  initial_sigma: {x_m: 1.0e-9, y_m: 0.05, vx_m_per_s: 1.0e-9, vy_m_per_s: 0.1}\n  trials:\n";
  for (const char* start : {"25", "26", "27", "28"})
    yaml += std::string("    - {role: train, initial: {y_m: ") + start + "}}\n";
  for (const char* start : {"25.5", "26.5", "27.5"})
    yaml += std::string("    - {role: test, initial: {y_m: ") + start + "}}\n";
  return GenerateDataset(ScenarioDocument::FromText(yaml, "balls.yaml").Read(), {.seed = seed})
      .dataset;
}

TEST(Discover, DragOfABallWithItsExponent) {
  const double c = 0.0005;
  const Discovery d = Discover(Balls(c, 1), {});
  ASSERT_EQ(d.verdict, DiscoveryVerdict::kFound) << d.reason;
  ASSERT_EQ(d.found.size(), 1u);
  const FoundTerm& found = d.found.front();
  ASSERT_TRUE(found.exponent);
  EXPECT_NEAR(found.exponent->value.value, 2.0, 0.2);
  ASSERT_TRUE(found.exponent->value.ci95);
  EXPECT_LT(found.exponent->value.ci95->first, 2.0);
  EXPECT_GT(found.exponent->value.ci95->second, 2.0);
  EXPECT_NEAR(std::abs(found.values.front().value), c, 0.1 * c);
  EXPECT_GT(*found.selected_in, kStable);
  EXPECT_TRUE(d.gain.IsClaim());
  // A ball that falls straight down cannot tell along its way from down.
  EXPECT_FALSE(found.equal.empty());
  // What is written is an effect again, at the size found.
  const Effect& again = FormulaEffect(found.source);
  EXPECT_EQ(again.info.parameters[0].typical, found.values.front().value);
}

// Hops with an effect that no catalogue has, at its typical size, and this noise.
Dataset HopsWith(const std::string& acts_as, const std::string& formula,
                 const std::string& parameters, double sigma_m = 0.001) {
  Scenario s = HopScenario(2);
  for (ChannelSpec& channel : s.dataset->channels) channel.sigma = sigma_m;
  s.law = "large_deflection";
  EffectSpec spec;
  spec.formula = ParseEffectFile("format: hoplab-effect/1\nname: planted\nacts_as: " + acts_as +
                                     "\nformula: \"" + formula + "\"\nparameters:\n" + parameters,
                                 "planted.yaml");
  spec.name = "planted";
  spec.at_typical = true;
  s.effects = {spec};
  return GenerateDataset(s, {.seed = 3}).dataset;
}
DiagnosisOptions LargeDeflection() {
  DiagnosisOptions options;
  options.problem.law = "large_deflection";
  return options;
}
// Near the truth for its interval, and determined.
void ExpectValue(const FoundTerm& found, std::size_t i, const std::string& name, double truth) {
  ASSERT_LT(i, found.values.size());
  const FoundValue& v = found.values[i];
  EXPECT_EQ(v.name, name);
  ASSERT_TRUE(v.ci95) << name;
  const double half = 0.5 * (v.ci95->second - v.ci95->first);
  EXPECT_NEAR(v.value, truth, 2.0 * half) << name;
  EXPECT_LT(half, 0.25 * std::abs(truth)) << name << " is not determined";
}

// What acts free of its formula is told at three points at least to a third of `greatest`, at two
// for certain not nothing, and wherever it is told it is the truth.
template <class Force>
void ExpectFreeCurve(const FoundTerm& found, double greatest, const Force& truth) {
  ASSERT_TRUE(found.free_curve);
  int told = 0, seen = 0;
  for (const ForcePoint& p : found.free_curve->points) {
    if (!std::isfinite(p.band95)) continue;
    told += p.band95 < greatest / 3.0;
    seen += std::abs(p.value) > p.band95;
    EXPECT_NEAR(p.value, truth(p.at), 2.0 * p.band95) << p.at;
  }
  EXPECT_GE(told, 3);
  EXPECT_GE(seen, 2);
}

const char* const kCable =
    "  k: {unit: N/m, null: 0, lower: 0, upper: 200, typical: 0.6}\n"
    "  x_end: {unit: m, value: 0.4, lower: -10, upper: 10}\n";

TEST(Discover, ACableWithTheEndOfItsSlack) {
  const Discovery d =
      Discover(HopsWith("body_force_x", "-k * max(x - x_end, 0)", kCable), LargeDeflection());
  ASSERT_EQ(d.verdict, DiscoveryVerdict::kFound) << d.reason;
  ASSERT_EQ(d.found.size(), 1u);
  const FoundTerm& found = d.found.front();
  EXPECT_EQ(found.source.acts_as, "body_force_x");
  EXPECT_EQ(found.source.formula, "c * max(x - limit, 0)");
  ExpectValue(found, 0, "c", -0.6);
  ExpectValue(found, 1, "limit", 0.4);
  // The bodies go as far as 1.1 m.
  ExpectFreeCurve(found, 0.6 * (1.1 - 0.4), [](double x) { return -0.6 * std::max(x - 0.4, 0.0); });
  // What is written has them both.
  EXPECT_EQ(found.source.parameters[0].typical, found.values[0].value);
  EXPECT_EQ(found.source.parameters[1].value, found.values[1].value);
}

TEST(Discover, AnImbalanceWithItsFrequency) {
  const Discovery d =
      Discover(HopsWith("body_force_y", "a * sin(2 * pi * f * t)",
                        "  a: {unit: N, null: 0, lower: -10, upper: 10, typical: 0.5}\n"
                        "  f: {unit: Hz, value: 4.3, lower: 0, upper: 50}\n"),
               LargeDeflection());
  ASSERT_EQ(d.verdict, DiscoveryVerdict::kFound) << d.reason;
  const FoundTerm& found = d.found.front();
  EXPECT_EQ(found.source.acts_as, "body_force_y");
  ASSERT_EQ(found.values.size(), 3u);
  EXPECT_NEAR(std::abs(found.values[0].value), 0.5, 0.05);
  ExpectValue(found, 1, "frequency", 4.3);
}

TEST(Discover, ACameraThatShakes) {
  const Discovery d =
      Discover(HopsWith("reading_y", "a * sin(2 * pi * f * t + 0.4)",
                        "  a: {unit: m, null: 0, lower: -1, upper: 1, typical: 0.002}\n"
                        "  f: {unit: Hz, value: 7.1, lower: 0, upper: 50}\n"),
               LargeDeflection());
  ASSERT_EQ(d.verdict, DiscoveryVerdict::kFound) << d.reason;
  const FoundTerm& found = d.found.front();
  EXPECT_EQ(found.source.acts_as, "reading_y");
  ASSERT_EQ(found.values.size(), 3u);
  EXPECT_NEAR(std::abs(found.values[0].value), 0.002, 2e-4);
  ExpectValue(found, 1, "frequency", 7.1);
}

// No motor turns it: a spring at the hip of a leg that stands.
TEST(Discover, ASpringAtAPassiveHip) {
  const Discovery d =
      Discover(HopsWith("hip_torque", "-k * angle",
                        "  k: {unit: N m, null: 0, lower: 0, upper: 100, typical: 0.3}\n", 0.0002),
               LargeDeflection());
  ASSERT_EQ(d.verdict, DiscoveryVerdict::kFound) << d.reason;
  const FoundTerm& found = d.found.front();
  EXPECT_EQ(found.source.acts_as, "hip_torque");
  EXPECT_EQ(found.source.formula, "c * angle");
  ExpectValue(found, 0, "c", -0.3);
}

TEST(Discover, ACubicDamperWithItsExponentAndTheCurveFreeOfTheFormula) {
  const Discovery d =
      Discover(HopsWith("chord_force", "-c * rate^3",
                        "  c: {unit: N s^3/m^3, null: 0, lower: 0, upper: 100, typical: 2}\n",
                        /*sigma_m=*/0.0002),
               LargeDeflection());
  ASSERT_EQ(d.verdict, DiscoveryVerdict::kFound) << d.reason;
  const FoundTerm& found = d.found.front();
  EXPECT_EQ(found.source.formula, "c * rate^3");
  ExpectValue(found, 0, "c", -2.0);
  ASSERT_TRUE(found.exponent);
  ASSERT_TRUE(found.exponent->value.ci95) << found.exponent->value.value;
  EXPECT_LT(found.exponent->value.ci95->first, 3.0);
  EXPECT_GT(found.exponent->value.ci95->second, 3.0);
  EXPECT_LT(found.exponent->value.ci95->second - found.exponent->value.ci95->first, 1.0)
      << "square, cubic and fourth power are to be told apart";
  EXPECT_GE(found.exponent->gain, -1e-3);  // it begins at the whole number
  // The leg shortens and lengthens with up to 2 m/s.
  ExpectFreeCurve(found, 2.0 * 8.0, [](double rate) { return -2.0 * rate * rate * rate; });
}

// A corner in time is no part of a reading, so there are no hats over it.
TEST(Discover, AReadingThatDriftsIsFoundWithoutACurve) {
  const Discovery d =
      Discover(HopsWith("reading_x", "v * t",
                        "  v: {unit: m/s, null: 0, lower: -10, upper: 10, typical: 0.05}\n"),
               LargeDeflection());
  ASSERT_EQ(d.verdict, DiscoveryVerdict::kFound) << d.reason;
  const FoundTerm& found = d.found.front();
  EXPECT_EQ(found.source.acts_as, "reading_x");
  EXPECT_EQ(found.source.formula, "c * t");
  ExpectValue(found, 0, "c", 0.05);
  EXPECT_FALSE(found.free_curve);
}

// Causes that only stand in give their place to the formula.
TEST(Discover, BesideADiagnosisAndInPlaceOfItsCauses) {
  const Dataset dataset = HopsWith("body_force_x", "-k * max(x - x_end, 0)", kCable);
  DiagnosisOptions options = LargeDeflection();
  options.candidates.only = {"air_drag", "constant_force", "sensor_scale_x"};
  const Diagnosis diagnosis = Diagnose(dataset, options);
  ASSERT_TRUE(diagnosis.extension) << diagnosis.refusal;
  ASSERT_TRUE(diagnosis.CausesMayStandIn()) << diagnosis.reason;
  const Discovery d = DiscoverBeside(diagnosis, options);
  EXPECT_EQ(d.verdict, DiscoveryVerdict::kFound) << d.reason;
  EXPECT_TRUE(d.in_place_of_causes);
  ASSERT_FALSE(d.found.empty());
  EXPECT_EQ(d.found.front().source.formula, "c * max(x - limit, 0)");
}

// With one fitted trial only held-out trials can confirm a formula.
TEST(Discover, OneTrialAloneProvesNothing) {
  Dataset dataset = HopsWith("body_force_x", "-k * max(x - x_end, 0)", kCable);
  dataset.trials.resize(1);
  const Discovery d = Discover(dataset, LargeDeflection());
  EXPECT_FALSE(d.gain.IsClaim());
  EXPECT_NE(d.verdict, DiscoveryVerdict::kFound) << d.reason;
}

TEST(Discover, NothingWhereNothingIsMissing) {
  int needed = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    needed += Discover(Balls(0.0, seed), {}).verdict != DiscoveryVerdict::kNotNeeded;
  EXPECT_EQ(needed, 0);
}

}  // namespace
}  // namespace hoplab
