#include "fitting/design/design_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::EffectOfSize;
using testing::NullFit;

struct Rivals {
  NullFit fit{testing::World{.effects = {EffectOfSize("touchdown_loss", 0.02)}}};
  std::vector<FittedModel> models = {fit.RefittedWith(CandidateOf("touchdown_loss")),
                                     fit.RefittedWith(CandidateOf("touchdown_angle_bias"))};
  std::vector<double> weights = {0.5, 0.5};

  DesignSearchRequest Request(int jobs = 1) const {
    DesignSearchRequest request;
    request.space = DefaultSpace(fit.problem, fit.train);
    request.budget = 120;
    request.jobs = jobs;
    return request;
  }
  DesignSearchResult Search(const DesignSearchRequest& request) const {
    return SearchSeparating(models, weights, fit.train, request);
  }
};

std::string FailureOf(const DesignTried& tried) {
  return tried.failure ? tried.failure->Name() : "";
}

TEST(SearchSeparating, LeavesLessDoubtThanARepetition) {
  const Rivals r;
  const DesignSearchResult found = r.Search(r.Request());
  ASSERT_FALSE(found.best.empty());
  const TrialProblem& like = found.best.empty() ? r.fit.train[0] : r.fit.train[1];
  TrialDesign again{like.file, like.parameters.theta_td, like.start[1], like.start[2], {}};
  const SeparationForecast repeated =
      ForecastByRefits(r.models, r.fit.train, TrialOf(again, like), 1);
  ASSERT_FALSE(repeated.failure);
  EXPECT_LT(found.best[0].log_left, LogExpectedEntropy(r.weights, repeated.nats));
  EXPECT_NEAR(found.best[0].worth, found.before - std::exp(found.best[0].log_left), 1e-12);
  EXPECT_TRUE(found.best[0].refitted);
}

TEST(SearchSeparating, TellsDesignsThatDifferTheBestFirst) {
  const Rivals r;
  const DesignSearchResult found = r.Search(r.Request());
  ASSERT_GE(found.best.size(), 2u);
  EXPECT_LE(found.best.size(), 5u);
  for (std::size_t i = 0; i < found.best.size(); ++i) {
    for (std::size_t j = i + 1; j < found.best.size(); ++j) {
      EXPECT_LE(found.best[i].log_left, found.best[j].log_left);
      double apart = 0.0;
      for (std::size_t k = 0; k < found.best[i].point.size(); ++k)
        apart = std::max(apart, std::abs(found.best[i].point[k] - found.best[j].point[k]));
      EXPECT_GE(apart, kAlikePlans);
    }
  }
}

TEST(SearchSeparating, DoesNotDependOnTheNumberOfJobs) {
  const Rivals r;
  DesignSearchRequest one = r.Request(1), three = r.Request(3);
  one.map_size = three.map_size = 3;
  const DesignSearchResult a = r.Search(one), b = r.Search(three);
  ASSERT_EQ(a.tried.size(), b.tried.size());
  for (std::size_t i = 0; i < a.tried.size(); ++i) EXPECT_EQ(a.tried[i].point, b.tried[i].point);
  ASSERT_EQ(a.best.size(), b.best.size());
  for (std::size_t i = 0; i < a.best.size(); ++i) {
    EXPECT_EQ(a.best[i].log_left, b.best[i].log_left);
    EXPECT_EQ(a.best[i].least_nats, b.best[i].least_nats);
  }
  ASSERT_EQ(a.map.size(), 27u) << "three pairs of settings";
  ASSERT_EQ(b.map.size(), 27u);
  for (std::size_t i = 0; i < a.map.size(); ++i)
    EXPECT_EQ(FailureOf(a.map[i].tried), FailureOf(b.map[i].tried));
}

TEST(SearchSeparating, ADesignThatCannotBeSimulatedIsWorthNothingAndSaysWhy) {
  const Rivals r;
  DesignSearchRequest request = r.Request();
  SetRanges(request.space, std::vector{DesignRange{DesignSetting::kHeight, 0.001, 0.01}}, "test");
  const DesignSearchResult found = r.Search(request);
  EXPECT_TRUE(found.best.empty());
  ASSERT_FALSE(found.tried.empty());
  for (const DesignTried& tried : found.tried) {
    EXPECT_TRUE(std::isnan(tried.worth));
    ASSERT_TRUE(tried.failure);
    EXPECT_EQ(tried.failure->under, "touchdown_loss");
  }
}

TEST(SearchSeparating, OneDesignIsEnoughWhereEverySettingIsHeld) {
  const Rivals r;
  DesignSearchRequest request = r.Request();
  for (DesignRange& range : request.space.ranges)
    range.low = range.high = 0.5 * (range.low + range.high);
  EXPECT_EQ(r.Search(request).tried.size(), 1u);
}

TEST(SearchSharpening, NarrowsTheIntervalMoreThanARepetition) {
  const NullFit fit{testing::World{}};
  DesignSearchRequest request;
  request.space = DefaultSpace(fit.problem, fit.train);
  request.budget = 120;
  const DesignSearchResult found = SearchSharpening(fit.null, 0, fit.train, request);
  ASSERT_FALSE(found.best.empty());
  const TrialProblem& like = fit.train[1];
  const TrialProblem again =
      TrialOf({like.file, like.parameters.theta_td, like.start[1], like.start[2], {}}, like);
  const SharpeningForecast repeated =
      ForecastInterval(fit.null, InformationOf(fit.null, fit.train), 0, &again);
  EXPECT_LT(found.best[0].half_width, repeated.half_width);
  EXPECT_LT(found.best[0].half_width, found.before);
  EXPECT_NEAR(found.best[0].worth, 1.0 - found.best[0].half_width / found.before, 1e-12);
}

TEST(WeightsOf, GoByTheEvidence) {
  std::vector<FittedModel> rivals(2);
  EXPECT_EQ(WeightsOf(rivals), (std::vector<double>{0.5, 0.5})) << "not settled";
  for (FittedModel& r : rivals) {
    r.settled = true;
    r.evidence.discrepancy = -std::numeric_limits<double>::infinity();
  }
  rivals[0].evidence.white = std::log(3.0);
  const std::vector<double> weights = WeightsOf(rivals);
  EXPECT_NEAR(weights[0], 0.75, 1e-12);
  EXPECT_NEAR(weights[1], 0.25, 1e-12);
}

}  // namespace
}  // namespace hoplab
