#include "fitting/diagnosis/own_sizes.h"

#include <gtest/gtest.h>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::DatasetOf;
using testing::EffectOfSize;
using testing::NullFit;

constexpr double kOff[] = {0.03, -0.025, 0.02, -0.03};  // rad

// Hops whose angles were set by hand, each off by another size.
Dataset HopsOffBy(std::span<const double> sizes) {
  Dataset all = DatasetOf({.train = 4});
  for (std::size_t i = 0; i < sizes.size(); ++i)
    all.trials[i] =
        DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", sizes[i])}, .train = 4})
            .trials[i];
  return all;
}
std::optional<OwnSizes> Found(const NullFit& fit) {
  const std::vector<Candidate> candidates = testing::CandidatesOf(testing::kSixEffects);
  return BestOwnSizes(fit.Linearised(fit.null, candidates), candidates, fit.train);
}

TEST(OwnSizes, OfAnglesSetByHandAreToldTrialByTrial) {
  const NullFit fit(HopsOffBy(kOff));
  const std::optional<OwnSizes> own = Found(fit);
  ASSERT_TRUE(own);
  EXPECT_EQ(own->cause.Name(), "touchdown_angle_bias");
  EXPECT_GT(own->explained, kLeastOwn);
  ASSERT_EQ(own->sizes.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(own->sizes[i], kOff[i], 0.015) << i;
  const std::string text = TextOf(*own, fit.train);
  EXPECT_EQ(text.rfind("touchdown_angle_bias of another size in each trial would explain ", 0), 0u)
      << text;
  EXPECT_NE(text.find("train-2.csv -0.0"), std::string::npos) << text;
  EXPECT_NE(text.find(" rad); where angles are set by hand, touchdown_angle_sigma_deg"),
            std::string::npos)
      << text;
}

TEST(OwnSizes, AreNotWhatOneSizeForAllExplains) {
  const std::vector<double> same(4, 0.03);
  EXPECT_FALSE(Found(NullFit(HopsOffBy(same))));
  EXPECT_FALSE(Found(NullFit(DatasetOf({.train = 4}))));
}

}  // namespace
}  // namespace hoplab
