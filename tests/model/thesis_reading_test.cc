#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "base/random.h"
#include "model/laws/half_circle.h"
#include "model/leg_compliance.h"
#include "tests/support/effect_requests.h"
#include "tests/support/gradient_check.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// Every reading that differs from the default in one word, and one that differs in all.
struct NamedReading {
  std::string name;
  ThesisReading reading;
};
void PrintTo(const NamedReading& v, std::ostream* out) { *out << v.name; }

std::vector<NamedReading> Readings() {
  std::vector<NamedReading> readings;
  NamedReading all{"all", {}};
  for (const ReadingKey& key : ReadingKeys()) {
    for (int word = 1; word < static_cast<int>(key.words.size()); ++word) {
      NamedReading one{std::string(key.key) + "_" + std::string(key.words[word]), {}};
      key.set(one.reading, word);
      key.set(all.reading, word);
      readings.push_back(one);
    }
  }
  readings.push_back(all);
  return readings;
}

class EachReading : public ::testing::TestWithParam<NamedReading> {
 protected:
  // A controlled hop that rolls onto its toe: every word has something to do.
  SimulationRequest Request() const {
    SimulationRequest q = ThickLegRequest(Law::kThesis);
    q.parameters.reading = GetParam().reading;
    q.parameters.theta_td = Degrees(12.0);
    q.parameters.kp = 0.6;
    q.parameters.v_des = 1.6;
    return q;
  }
};

TEST_P(EachReading, DerivativesMatchDifferences) {
  SimulationRequest q = Request();
  const Trajectory run = Simulate(q);
  ASSERT_TRUE(IsComplete(run.outcome)) << NameOf(run.outcome);
  const std::vector<double> times = TimesClearOfEvents(run);
  std::vector<D> directions;
  for (ParameterId id : ParametersOf(MechanismKind::kCLeg)) directions.push_back(D::Parameter(id));
  for (int i = 0; i < 4; ++i) directions.push_back(D::InitialState(i));
  q.row_times = times;
  q.channels = ChannelsOf(q.law);
  q.directions = directions;
  const auto checks = CheckGradient(q);
  ASSERT_FALSE(checks.empty());
  for (const ColumnCheck& check : checks) EXPECT_EQ(Complaint(check), "");
}

// With its terms null the extended leg is the plain one: two implementations of each reading.
TEST_P(EachReading, IsTheSameInTheLegThatTakesEffects) {
  SimulationRequest q = Request();
  const Trajectory plain = Simulate(q);
  const std::array effects = {EffectSetting::Null(*FindEffect("leg_hardening"))};
  const std::array directions = {D::EffectParameter(0, 0)};
  q.effects = effects;
  q.directions = directions;
  const Trajectory extended = Simulate(q);
  ASSERT_EQ(EventNames(plain), EventNames(extended));
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(plain.final_state[i], extended.final_state[i], 1e-9) << i;
}

TEST_P(EachReading, ChangesTheMotion) {
  SimulationRequest q = Request();
  const Trajectory changed = Simulate(q);
  q.parameters.reading = {};
  const Trajectory plain = Simulate(q);
  EXPECT_GT(std::abs(changed.final_state[kX] - plain.final_state[kX]), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(OneWordAndAll, EachReading, ::testing::ValuesIn(Readings()),
                         [](const auto& info) { return info.param.name; });

// A state of rolling stance and the law's load there.
struct Rolling {
  Parameters<double> p;
  std::array<double, 5> z;
  double u, y, l, alpha;

  Rolling(const ThesisReading& reading, RandomStream& random)
      : p(ThickLegRequest(Law::kThesis).parameters) {
    p.reading = reading;
    alpha = random.Uniform(0.05, 0.4);
    l = 2.0 * p.r * std::cos(alpha) * random.Uniform(0.75, 0.99);
    u = l * std::sin(alpha);
    y = l * std::cos(alpha);
    z = {0.2, y, random.Uniform(0.3, 1.5), random.Uniform(-1.5, 1.5), 0.2 + u};
  }
  LegLoad<double> Load() const { return ThesisLaw<double>(p).Rolling(z.data()); }
  // dalpha/dt when the contact moves at `rate`.
  double Turn(double rate) const { return ((rate - z[kVx]) * y - u * z[kVy]) / (l * l); }
};

TEST(ThesisReadingLaw, RollsAsEachReadingOfM7Says) {
  RandomStream random(5, 1);
  for (int i = 0; i < 200; ++i) {
    ThesisReading v;
    v.rolling = i & 1 ? ThesisReading::Rolling::kExplicit : ThesisReading::Rolling::kImplicit;
    v.angle_rate = i & 2 ? ThesisReading::AngleRate::kVirtualLeg : ThesisReading::AngleRate::kTheta;
    v.rolling_radius =
        i & 4 ? ThesisReading::RollingRadius::kRest : ThesisReading::RollingRadius::kDeformed;
    const Rolling state(v, random);
    const double rate = state.Load().contact_rate;
    const double radius = i & 4 ? state.p.r : state.l / (2.0 * std::cos(state.alpha));
    const double turn = state.Turn(i & 1 ? 0.0 : rate);
    const double expected =
        -radius * std::sin(2.0 * state.alpha) * (i & 2 ? 1.0 : 2.0) * turn;  // M31, M32, M33
    EXPECT_NEAR(rate, expected, 1e-12) << i;
  }
}

TEST(ThesisReadingLaw, DampsTheRateEachReadingNames) {
  RandomStream random(5, 2);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 60; ++i) {
    for (const auto word : {ThesisReading::DampingRate::kChord, ThesisReading::DampingRate::kHip,
                            ThesisReading::DampingRate::kDeflection}) {
      RandomStream same = random;
      ThesisReading v;
      v.damping_rate = word;
      const Rolling state(v, same);
      const LegLoad<double> load = state.Load();
      // The quantity whose rate is damped, a little later and a little earlier.
      const auto length = [&](double t) {
        const double contact = word == ThesisReading::DampingRate::kHip ? 0.0 : load.contact_rate;
        const double u = state.u + t * (contact - state.z[kVx]);
        const double y = state.y + t * state.z[kVy];
        const double l = std::hypot(u, y);
        return word == ThesisReading::DampingRate::kDeflection ? l - 2.0 * state.p.r * y / l : l;
      };
      EXPECT_NEAR(load.damping_rate, (length(kStep) - length(-kStep)) / (2.0 * kStep), 1e-8);
    }
    random.Uniform(0.0, 1.0);
  }
}

TEST(ThesisReadingLaw, IsAsStiffAsEachReadingSays) {
  RandomStream random(5, 3);
  for (int i = 0; i < 100; ++i) {
    ThesisReading v;
    if (i & 1) v.stiffness_radius = ThesisReading::StiffnessRadius::kRest;
    if (i & 2) v.stiffness_angle = ThesisReading::StiffnessAngle::kVirtualLeg;
    const Rolling state(v, random);
    const Parameters<double>& p = state.p;
    // M1 and M2 written out.
    const double phi = std::numbers::pi - (i & 2 ? 1.0 : 2.0) * state.alpha;
    const double radius = i & 1 ? p.r : state.l / (2.0 * std::cos(state.alpha));
    const double bending = 2.0 * phi - 3.0 * std::sin(phi) + phi * std::cos(phi);
    const double compliance = 0.5 * (std::pow(radius, 3) * bending / (p.E * p.I) +
                                     radius * (3.0 * std::sin(phi) - phi) / (p.E * p.A) +
                                     p.kappa * radius * (phi - std::sin(phi)) / (p.G * p.A));
    const double force = (2.0 * p.r * std::cos(state.alpha) - state.l) / compliance;
    EXPECT_NEAR(state.Load().elastic_force / force, 1.0, 1e-10) << i;
  }
}

TEST(ThesisReadingLaw, ThePrintedSignTurnsTheTorquesVerticalForceOver) {
  for (const Law law : {Law::kThesis, Law::kStraightLeg}) {
    for (const bool printed : {false, true}) {
      SimulationRequest q = ExcitedRequest(law);
      if (printed) q.parameters.reading.torque_sign = ThesisReading::TorqueSign::kPrinted;
      const Trajectory run = Simulate(q);
      const std::vector<double> times = TimesClearOfEvents(run);
      constexpr std::array kSeen = {Channel::kLegAngle, Channel::kLegLength, Channel::kGroundForceX,
                                    Channel::kGroundForceY, Channel::kHipTorque};
      q.row_times = times;
      q.channels = kSeen;
      const Trajectory rows = Simulate(q);
      int stance_rows = 0;
      for (std::size_t i = 0; i < times.size(); ++i) {
        const double* row = &rows.samples[i * kSeen.size()];
        if (row[4] == 0.0) continue;
        ++stance_rows;
        const double alpha = law == Law::kThesis ? 0.5 * row[0] : row[0];
        // What is left of the force across the leg once the chord force is taken away.
        const double across = row[2] * std::cos(alpha) + row[3] * std::sin(alpha);
        const double share = printed ? std::cos(2.0 * alpha) : 1.0;
        EXPECT_NEAR(across, row[4] / row[1] * share, 1e-9 * std::abs(row[4] / row[1]));
      }
      EXPECT_GT(stance_rows, 3);
    }
  }
}

TEST(ThesisReadingLaw, TheStraightLegAndOtherLawsKnowNothingElse) {
  for (const Law law : {Law::kNoSlip, Law::kConsistent, Law::kStraightLeg}) {
    SimulationRequest q = ExcitedRequest(law);
    const Trajectory plain = Simulate(q);
    q.parameters.reading = Readings().back().reading;
    q.parameters.reading.torque_sign = ThesisReading::TorqueSign::kNormal;
    const Trajectory same = Simulate(q);
    EXPECT_EQ(plain.final_state, same.final_state) << NameOf(law);
  }
}

}  // namespace
}  // namespace hoplab
