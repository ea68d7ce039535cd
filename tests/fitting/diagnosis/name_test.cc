#include "fitting/diagnosis/name.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fitting/diagnosis/pool.h"
#include "fitting/diagnosis/refits.h"
#include "fitting/generate.h"
#include "tests/support/naming.h"
#include "tests/support/robot_drops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::EffectOfSize;
using testing::GroupNames;
using testing::MembersOf;
using testing::NameIn;
using testing::NameSix;
using testing::NullFit;
using testing::ResultOf;

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::count(names.begin(), names.end(), name) > 0;
}

TEST(NameCauses, NamesAClearEffectAndItsSize) {
  const Naming n = NameSix(NullFit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}}));
  EXPECT_EQ(GroupNames(n), std::vector<std::string>{"touchdown_angle_bias"});
  ASSERT_EQ(n.best.members.size(), 1u);
  EXPECT_NEAR(n.best.ValuesOf(0)[0], 0.03, 0.003);
  EXPECT_EQ(ResultOf(n, "touchdown_angle_bias").status, CandidateStatus::kSupported);
}

TEST(NameCauses, FindsNothingInCleanData) {
  const Naming n = NameSix(NullFit{testing::World{}});
  EXPECT_TRUE(n.best.members.empty());
  EXPECT_TRUE(n.groups.empty());
  for (const CandidateResult& c : n.candidates) {
    EXPECT_TRUE(c.status == CandidateStatus::kExcluded || c.status == CandidateStatus::kNotTested)
        << c.candidate.Name();
  }
}

TEST(NameCauses, FindsTwoEffectsAtOnce) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03),
                                 EffectOfSize("sensor_delay", 0.006)}});
  const Naming n = NameSix(fit);
  ASSERT_EQ(n.groups.size(), 2u);
  const std::vector<std::string> first = GroupNames(n, 0), second = GroupNames(n, 1);
  EXPECT_TRUE(Has(first, "touchdown_angle_bias") || Has(second, "touchdown_angle_bias"));
  EXPECT_TRUE(Has(first, "sensor_delay") || Has(second, "sensor_delay"));
}

// From what was found elsewhere it finds the same, without every cause tried alone.
TEST(NameCauses, BeginsWithWhatIsGiven) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03),
                                 EffectOfSize("sensor_delay", 0.006)}});
  const Naming from_nothing = NameSix(fit);
  ASSERT_EQ(from_nothing.best.members.size(), 2u);
  NamingOptions options;
  options.begin = {&from_nothing.best, 1};
  const Naming again = NameSix(fit, options);
  EXPECT_EQ(again.best_set, from_nothing.best_set);
  EXPECT_NEAR(again.best.cost, from_nothing.best.cost, 0.1);
  EXPECT_LT(again.refits, from_nothing.refits);

  const std::vector<Candidate> others = testing::CandidatesOf({"sensor_delay", "air_drag"});
  EXPECT_EQ(MembersOf(NameIn(fit, others, options)), MembersOf(NameIn(fit, others)));
}

// What was as good elsewhere is weighed beside it, in whatever order they are given.
TEST(NameCauses, WeighsTheRivalsOfWhatIsGiven) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}});
  std::vector<FittedModel> given;
  for (const char* name : {"sensor_delay", "touchdown_angle_bias"})
    given.push_back(Refit(fit.null, testing::CandidatesOf({name}),
                          Eigen::VectorXd::Constant(1, std::nan("")), fit.Settings()));
  NamingOptions options;
  options.begin = given;
  const Naming both = NameSix(fit, options);
  EXPECT_EQ(MembersOf(both), std::vector<std::string>{"touchdown_angle_bias"});
  EXPECT_TRUE(ResultOf(both, "sensor_delay").alone.settled);
  EXPECT_TRUE(ResultOf(both, "touchdown_angle_bias").alone.settled);
  options.begin = {&given[1], 1};
  EXPECT_FALSE(ResultOf(NameSix(fit, options), "sensor_delay").alone.ok());
}

// What is given and acts nowhere does not stay.
TEST(NameCauses, DropsWhatIsGivenAndDoesNotPay) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}});
  const std::vector<Candidate> given = testing::CandidatesOf({"air_drag", "touchdown_angle_bias"});
  const FittedModel both =
      Refit(fit.null, given, Eigen::VectorXd::Constant(2, std::nan("")), fit.Settings());
  ASSERT_TRUE(both.ok());
  NamingOptions options;
  options.begin = {&both, 1};
  EXPECT_EQ(MembersOf(NameSix(fit, options)), std::vector<std::string>{"touchdown_angle_bias"});
}

// Play in a gear is slow to look for. Where shorter parts of the trials had no need of it, it is
// not sought again, and told as not needed.
TEST(NameCauses, SeeksSlowCausesUnlessTheyAreKnownNotToBeNeeded) {
  const Scenario drops = testing::RobotDrops({{"effects", "{backlash_2: {play: 0.02}}"}});
  const NullFit fit(GenerateDataset(drops, {}).dataset, WithLegsAlike({}));
  const std::vector<Candidate> candidates = testing::CandidatesOf({"backlash_2"});
  const Naming sought = NameIn(fit, candidates);
  ASSERT_EQ(MembersOf(sought), std::vector<std::string>{"backlash_2"});
  EXPECT_NEAR(sought.best.ValuesOf(0)[0], 0.02, 0.002);
  NamingOptions options;
  options.slow_ones_only_beside = true;
  const Naming known = NameIn(fit, candidates, options);
  EXPECT_TRUE(known.best.members.empty());
  EXPECT_EQ(known.refits, 0);
  EXPECT_EQ(known.candidates.at(0).status, CandidateStatus::kNotNeeded);
}

// A cause with a threshold is tried beside what was found before, and not alone.
TEST(NameCauses, SaysThatACauseTriedBesideAnotherWasTested) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}});
  const FittedModel given = fit.RefittedWith(CandidateOf("touchdown_angle_bias"));
  NamingOptions options;
  options.begin = {&given, 1};
  const Naming n = NameIn(
      fit, testing::CandidatesOf({"touchdown_angle_bias", "foot_coulomb_friction"}), options);
  ASSERT_EQ(MembersOf(n), std::vector<std::string>{"touchdown_angle_bias"});
  EXPECT_FALSE(ResultOf(n, "foot_coulomb_friction").alone.ok());
  EXPECT_EQ(ResultOf(n, "foot_coulomb_friction").status, CandidateStatus::kNotNeeded);
}

TEST(NameCauses, KeepsNoMemberThatDoesNotPay) {
  for (std::uint64_t seed : {1, 2, 3}) {
    const NullFit fit(
        {.effects = {EffectOfSize("touchdown_angle_bias", 0.02), EffectOfSize("air_drag", 0.05)},
         .seed = seed});
    const Naming n = NameSix(fit);
    ASSERT_FALSE(n.best.members.empty());
    for (int i = 0; i < static_cast<int>(n.best.members.size()); ++i) {
      FittedModel less = RefitWithout(n.best, i, fit.problem, fit.Settings());
      Settle(less, fit.Settings());
      EXPECT_GT(n.best.evidence.log_z() - less.evidence.log_z(), n.log_odds - 0.01)
          << n.best.members[i].Name() << ", seed " << seed;
    }
  }
}

// What touch-down bias and a delay do together, as one effect: it fits best alone where both act,
// and is not needed once both are named.
struct BiasAndDelay {
  static constexpr std::array kParameters = {EffectParameter{"size", "-", 0.0, -10.0, 10.0, 0.5}};
  static constexpr EffectInfo kInfo = {.name = "bias_and_delay",
                                       .kind = EffectKind::kGuard,
                                       .equation = "dtheta = 0.03 size, tau = 0.004 size",
                                       .sentence = "a test's own",
                                       .for_legs = true,
                                       .for_ball = false,
                                       .dissipative = false,
                                       .parameters = kParameters};
  template <class T>
  static void ChangeTouchdownAngle(const T* p, const T&, T& theta_td) {
    theta_td += 0.03 * p[0];
  }
  template <class T>
  static void ChangeObservationTime(const T* p, T& t) {
    t -= 0.004 * p[0];
  }
};
const Effect kBiasAndDelay = MakeEffect<BiasAndDelay>();

TEST(NameCauses, ASuperfluousThirdIsDroppedAgain) {
  // Not in the proportion of the mixed effect, so that two are needed; any two of the three do.
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03),
                                 EffectOfSize("sensor_delay", 0.008)}});
  const Naming n = NameIn(
      fit, {CandidateOf("touchdown_angle_bias"), CandidateOf("sensor_delay"), {&kBiasAndDelay}});
  EXPECT_EQ(n.best.members.size(), 2u);
}

TEST(NameCauses, TwinsLandInOneGroup) {
  const testing::Twin twin("touchdown_angle_bias", "twin_of_bias");
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}});
  const Naming n =
      NameIn(fit, {CandidateOf("air_drag"), CandidateOf("touchdown_angle_bias"), twin.candidate()});
  EXPECT_EQ(GroupNames(n), (std::vector<std::string>{"touchdown_angle_bias", "twin_of_bias"}));
  EXPECT_EQ(ResultOf(n, "touchdown_angle_bias").status, CandidateStatus::kIndistinguishable);
  EXPECT_EQ(ResultOf(n, "twin_of_bias").status, CandidateStatus::kIndistinguishable);
  ASSERT_EQ(n.rivals.size(), 1u);
  ASSERT_EQ(n.rivals[0].size(), 2u);
  EXPECT_NEAR(n.rivals[0][0].cost, n.rivals[0][1].cost, 1e-6);
}

// The same with a size that is known to be smaller than the data want: it does nearly as well, and
// would be in the group.
TEST(NameCauses, ACauseThatEndsAtItsBoundGivesWayToOneThatDoesNot) {
  const testing::Twin twin("touchdown_angle_bias", "twin_of_bias");
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}, .sigma_m = 0.003});
  const auto group_within = [&](double at_most) {
    Candidate bounded = CandidateOf("touchdown_angle_bias");
    bounded = {bounded.effect, {}, KnownCauses({{"touchdown_angle_bias", "", at_most}})};
    return GroupNames(NameIn(fit, {bounded, twin.candidate()}));
  };
  const double free = fit.RefittedWith(CandidateOf("touchdown_angle_bias")).ValuesOf(0)[0];
  EXPECT_EQ(group_within(1.001 * free).size(), 2u);
  EXPECT_EQ(group_within(0.999 * free), std::vector<std::string>{"twin_of_bias"});
}

TEST(NameCauses, AddsNoMoreEffectsThanAllowed) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03),
                                 EffectOfSize("sensor_delay", 0.006)}});
  EXPECT_EQ(NameSix(fit, {.max_effects = 1}).best.members.size(), 1u);
  const Naming none = NameSix(fit, {.max_effects = 0});
  EXPECT_TRUE(none.best.members.empty());
  EXPECT_EQ(none.refits, 0);
  EXPECT_EQ(none.best.cost, fit.settled.cost);
}

// What has a threshold is tried beside what is found, whatever came of it alone.
TEST(NameCauses, AddsNoMoreEffectsWithAThresholdThanAllowed) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03),
                                 EffectOfSize("sensor_delay", 0.006)}});
  Effect late = *FindEffect("sensor_delay");
  late.info.has_threshold = true;
  const std::vector<Candidate> both = {CandidateOf("touchdown_angle_bias"), {&late}};
  EXPECT_EQ(NameIn(fit, both).best.members.size(), 2u);
  const Naming one = NameIn(fit, both, {.max_effects = 1});
  EXPECT_EQ(one.best.members.size(), 1u);
  for (const auto& [set, weight] : one.posterior) EXPECT_LE(set.size(), 1u);
}

// A search passes through sets with more causes than are asked for; they have no say.
TEST(NameCauses, WeighsNoMoreEffectsThanAllowed) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03),
                                 EffectOfSize("sensor_delay", 0.006)}});
  const std::vector<Candidate> both =
      testing::CandidatesOf({"touchdown_angle_bias", "sensor_delay"});
  for (const int most : {1, 2}) {
    const NamingOptions options{.max_effects = most};
    Naming naming;
    FillPool(naming, both, fit.Linearised(fit.settled, both), fit.train, options);
    Refits refits(fit.null, fit.settled, fit.train, options, naming);
    refits.Try({{0}, {0, 1}});
    refits.SettleAll({{0}, {0, 1}});
    ASSERT_TRUE(refits.Settled({0, 1}));
    EXPECT_EQ(refits.Visited().size(), most == 1 ? 2u : 3u);
    EXPECT_EQ(refits.Better({}, {{0}, {0, 1}}, 2).size(), static_cast<std::size_t>(most));
  }
}

TEST(NameCauses, OfAllThatCanBeTestedOneIsExpectedBeforehand) {
  const NullFit fit{testing::World{}};
  const Naming six = NameSix(fit);
  EXPECT_NEAR(six.log_odds, std::log(5.0), 1e-12);
  EXPECT_EQ(six.recordings, 3);
}

TEST(NameCauses, ProbabilitiesAreThoseOfTheModelsVisited) {
  const Naming n = NameSix(NullFit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}}));
  EXPECT_GT(ResultOf(n, "touchdown_angle_bias").probability, 0.99);
  double sum = 0.0;
  for (const auto& [set, weight] : n.posterior) sum += weight;
  EXPECT_NEAR(sum, 1.0, 1e-3);
  for (const CandidateResult& c : n.candidates) {
    EXPECT_GE(c.probability, 0.0);
    EXPECT_LE(c.probability, 1.0 + 1e-12);
  }
}

TEST(NameCauses, BoundsWhatItExcludes) {
  const Naming n = NameSix(NullFit{testing::World{}});
  for (const CandidateResult& c : n.candidates) {
    if (!c.separable) continue;
    EXPECT_GT(c.bound95[0], 0.0) << c.candidate.Name();
    // Two standard deviations at least, whatever the estimate.
    const double V = c.power / std::pow(c.candidate.effect->info.parameters[0].typical, 2);
    EXPECT_GE(c.bound95[0], 1.96 / std::sqrt(V) * (1.0 - 1e-6)) << c.candidate.Name();
  }
}

TEST(NameCauses, SaysOfAnEffectTooSmallToShowThatItWasNotTested) {
  // Ten times the noise leaves typical sizes in the dark.
  const Naming n = NameSix(NullFit({.sigma_m = 0.02}));
  int not_tested = 0;
  for (const CandidateResult& c : n.candidates) {
    EXPECT_EQ(c.status == CandidateStatus::kNotTested, c.power < kTestable) << c.candidate.Name();
    not_tested += c.status == CandidateStatus::kNotTested;
  }
  EXPECT_GT(not_tested, 0);
}

// What stands out hides causes that could have shown, until it is named.
TEST(NameCauses, SaysWhatCouldHaveShownBesideWhatIsNamed) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.1)}, .hops = 3});
  const Naming n = NameSix(fit);
  ASSERT_EQ(MembersOf(n), std::vector<std::string>{"touchdown_angle_bias"});
  int hidden = 0;
  for (const CandidateResult& c : n.candidates) {
    if (c.status == CandidateStatus::kSupported || !c.separable) continue;
    ASSERT_NE(c.status, CandidateStatus::kIndistinguishable) << c.candidate.Name();
    const std::vector<Candidate> one = {c.candidate};
    const auto power_at = [&](const FittedModel& model) {
      return PowerOf(fit.Linearised(model, one), c.candidate, HypothesesOf(one)[0]);
    };
    EXPECT_NEAR(c.power, power_at(n.best), 1e-3 * c.power) << c.candidate.Name();
    EXPECT_EQ(c.status == CandidateStatus::kNotTested, c.power < kTestable) << c.candidate.Name();
    hidden += power_at(fit.settled) < kTestable && c.power >= kTestable;
  }
  EXPECT_GT(hidden, 0);
}

TEST(NameCauses, StopsWhenAsked) {
  const NullFit fit({.effects = {EffectOfSize("air_drag", 0.08)}});
  std::atomic<bool> stop{true};
  const Naming n = NameSix(fit, {.stop = &stop});
  EXPECT_TRUE(n.interrupted);
}

}  // namespace
}  // namespace hoplab
