#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/diagnosed_hops.h"

// What does not change the physics must not change the diagnosis.

namespace hoplab {
namespace {

using testing::DatasetOf;
using testing::EffectOfSize;
using testing::GroupNames;
using testing::OptionsWith;
using testing::World;

// One cause that stands alone, and one with a look-alike.
World Named() { return {.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}}; }
World Confounded() { return {.effects = {EffectOfSize("touchdown_loss", 0.02)}, .seed = 7}; }

const std::vector<std::string> kPool = {"gravity_scale", "leg_material_damping",
                                        "touchdown_angle_bias", "touchdown_loss"};

Diagnosis DiagnosisOf(const Dataset& d, int jobs = 1) {
  DiagnosisOptions options = OptionsWith(kPool);
  options.fit.jobs = jobs;
  return Diagnose(d, options);
}

std::string CauseOf(const Diagnosis& d) {
  const std::optional<int> cause = d.Cause();
  return cause ? d.naming.candidates[static_cast<std::size_t>(*cause)].candidate.Name() : "none";
}

// Nats to which two searches for the same optimum agree.
constexpr double kSameGain = 0.05;

void ExpectSame(const Diagnosis& changed, const Diagnosis& plain) {
  ASSERT_EQ(plain.refusal, "");
  ASSERT_EQ(changed.refusal, "");
  EXPECT_EQ(changed.verdict, plain.verdict) << changed.reason << "; was: " << plain.reason;
  EXPECT_EQ(CauseOf(changed), CauseOf(plain));
  ASSERT_EQ(changed.naming.groups.size(), plain.naming.groups.size());
  for (std::size_t g = 0; g < plain.naming.groups.size(); ++g)
    EXPECT_EQ(GroupNames(changed.naming, g), GroupNames(plain.naming, g));
  EXPECT_NEAR(changed.naming.best.GainOver(changed.null), plain.naming.best.GainOver(plain.null),
              kSameGain);
}

// Runs `change` on the data of both worlds and compares.
template <class Change>
void ExpectUnmoved(const Change& change) {
  for (const World& world : {Named(), Confounded()}) {
    Dataset d = DatasetOf(world);
    const Diagnosis plain = DiagnosisOf(d);
    EXPECT_NE(plain.verdict, Verdict::kAdequate);
    change(d);
    ExpectSame(DiagnosisOf(d), plain);
  }
}

// Another unit for length, time and mass: every number that carries them changes.
struct Units {
  double length = 1.0, time = 1.0, mass = 1.0;

  void ChangeState(StateSpec& s) const {
    s.x_m *= length;
    s.y_m *= length;
    s.vx_m_per_s *= length / time;
    s.vy_m_per_s *= length / time;
  }
  void ChangeMechanism(MechanismSpec& m) const {
    const double pressure = mass / (length * time * time);
    m.body_mass_kg *= mass;
    m.gravity_m_per_s2 *= length / (time * time);
    if (m.fall_height_m) *m.fall_height_m *= length;
    m.c_leg.rest_radius_m *= length;
    m.c_leg.E_Pa *= pressure;
    m.c_leg.G_Pa *= pressure;
    m.c_leg.second_moment_m4 *= std::pow(length, 4);
    m.c_leg.area_m2 *= length * length;
    m.c_leg.damping_N_s_per_m *= mass / time;
  }
  void operator()(Dataset& d) const {
    ChangeMechanism(d.mechanism);
    for (ChannelSpec& c : d.channels) *c.sigma *= length;  // coordinates
    for (Trial& t : d.trials) {
      ChangeMechanism(t.mechanism);
      ChangeState(*t.initial);
      ChangeState(*t.initial_sigma);
      for (double& s : t.trace.time_s) s *= time;
      for (TraceColumn& c : t.trace.columns) {
        for (double& v : c.values) v *= length;
      }
    }
  }
};

TEST(Metamorphic, AnotherUnitOfLengthChangesNothing) { ExpectUnmoved(Units{.length = 2.0}); }
TEST(Metamorphic, AnotherUnitOfTimeChangesNothing) { ExpectUnmoved(Units{.time = 1.5}); }
TEST(Metamorphic, AnotherUnitOfMassChangesNothing) { ExpectUnmoved(Units{.mass = 3.0}); }

TEST(Metamorphic, AClockStartedEarlierChangesNothing) {
  ExpectUnmoved([](Dataset& d) {
    for (Trial& t : d.trials) {
      for (double& s : t.trace.time_s) s += 7.25;
    }
  });
}

TEST(Metamorphic, AnOriginElsewhereAlongTheGroundChangesNothing) {
  ExpectUnmoved([](Dataset& d) {
    for (Trial& t : d.trials) {
      t.initial->x_m += 2.5;
      for (double& x : t.trace.columns[0].values) x += 2.5;
    }
  });
}

TEST(Metamorphic, TrialsInAnotherOrderChangeNothing) {
  ExpectUnmoved([](Dataset& d) { std::reverse(d.trials.begin(), d.trials.end()); });
}

TEST(Metamorphic, EffectsNamedInAnotherOrderChangeNoBit) {
  const Dataset d = DatasetOf(Confounded());
  std::vector<std::string> turned = kPool;
  std::reverse(turned.begin(), turned.end());
  const Diagnosis one = Diagnose(d, OptionsWith(kPool)), two = Diagnose(d, OptionsWith(turned));
  ExpectSame(two, one);
  EXPECT_EQ(one.naming.best.shared, two.naming.best.shared);
  EXPECT_EQ(one.detection.p_value, two.detection.p_value);
}

TEST(Metamorphic, MoreJobsChangeNoBit) {
  for (const World& world : {Named(), Confounded()}) {
    const Dataset d = DatasetOf(world);
    const Diagnosis one = DiagnosisOf(d, 1);
    for (int jobs : {2, 4}) {
      const Diagnosis more = DiagnosisOf(d, jobs);
      ExpectSame(more, one);
      EXPECT_EQ(more.null.shared, one.null.shared);
      EXPECT_EQ(more.detection.p_value, one.detection.p_value);
      EXPECT_EQ(more.naming.best.shared, one.naming.best.shared);
      EXPECT_EQ(more.naming.best.cost, one.naming.best.cost);
      EXPECT_EQ(more.naming.refits, one.naming.refits);
      ASSERT_EQ(more.extension.has_value(), one.extension.has_value());
      if (!one.extension) continue;
      EXPECT_EQ(more.extension->gain.nats_per_sample, one.extension->gain.nats_per_sample);
      EXPECT_EQ(more.extension->remainder.p_value, one.extension->remainder.p_value);
      ASSERT_EQ(more.experiment.has_value(), one.experiment.has_value());
      if (one.experiment) {
        EXPECT_EQ(more.experiment->expected_nats, one.experiment->expected_nats);
      }
    }
  }
}

}  // namespace
}  // namespace hoplab
