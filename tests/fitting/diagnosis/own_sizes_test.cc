#include "fitting/diagnosis/own_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "fitting/diagnosis/believe.h"
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
std::optional<OwnSizes> FirstOf(const std::vector<OwnSizes>& found) {
  return found.empty() ? std::nullopt : std::optional(found.front());
}
std::optional<OwnSizes> Found(const NullFit& fit) {
  const std::vector<Candidate> candidates = testing::CandidatesOf(testing::kSixEffects);
  return FirstOf(BestOwnSizes(fit.Linearised(fit.null, candidates), candidates, fit.train));
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

// A larger cause acts in all trials: beside it the angles are seen. (Of more trials they are
// named.)
TEST(OwnSizes, AreLookedForBesideTheLargestCauseToo) {
  const EffectSpec drag = EffectOfSize("air_drag", 0.15);
  Dataset d = DatasetOf({.effects = {drag}, .train = 4});
  const double off[] = {0.03, -0.025, 0.02, -0.03};
  for (std::size_t i = 0; i < std::size(off); ++i)
    d.trials[i] =
        DatasetOf({.effects = {drag, EffectOfSize("touchdown_angle_bias", off[i])}, .train = 4})
            .trials[i];
  const Diagnosis found =
      Diagnose(d, testing::OptionsWith({"air_drag", "touchdown_angle_bias", "touchdown_loss"}));
  EXPECT_TRUE(std::any_of(found.notes.begin(), found.notes.end(), [](const std::string& note) {
    return note.starts_with(
        "air_drag in all trials and touchdown_angle_bias of another size in each trial would "
        "explain ");
  })) << found.reason;
}

// What they have in common is the modulus.
TEST(OwnSizes, OfLegsThatDifferAreAboutNone) {
  Dataset d = DatasetOf({.train = 4});
  const double loss[] = {0.06, -0.05, 0.04, -0.05};
  for (std::size_t i = 0; i < std::size(loss); ++i)
    d.trials[i] =
        DatasetOf({.effects = {EffectOfSize("leg_stiffness", loss[i])}, .train = 4}).trials[i];
  const NullFit fit(d);
  const std::vector<Candidate> candidates =
      testing::CandidatesOf({"body_mass_scale", "leg_stiffness", "air_drag"});
  const std::optional<OwnSizes> own =
      FirstOf(BestOwnSizes(fit.Linearised(fit.null, candidates), candidates, fit.train));
  ASSERT_TRUE(own);
  EXPECT_EQ(own->cause.Name(), "leg_stiffness");
  double mean = 0.0;
  for (const double size : own->sizes) mean += size / 4.0;
  EXPECT_NEAR(mean, 0.0, 0.02);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(own->sizes[i] - mean, loss[i], 0.02) << i;
}

// Four trials of ten rows in which one cause alone acts, of these sizes.
std::optional<OwnSizes> FoundWhere(const std::string& cause, std::span<const double> sizes) {
  constexpr int kRows = 10;
  const std::vector<Candidate> candidates = testing::CandidatesOf({cause});
  const int rows = kRows * static_cast<int>(sizes.size());
  Linearisation at;
  at.columns.resize(rows, 1);
  at.r.resize(rows);
  for (int row = 0; row < rows; ++row) {
    RowLabel label;
    label.trial = row / kRows;
    at.labels.push_back(label);
    at.columns(row, 0) = 1000.0 * (1 + row % 3);
    at.r[row] = -at.columns(row, 0) * sizes[static_cast<std::size_t>(label.trial)];
  }
  at.length = at.columns.colwise().norm().transpose();
  at.fitted_basis.resize(rows, 0);
  at.along_fitted.resize(0, 1);
  at.row_count = at.samples = rows;
  return FirstOf(BestOwnSizes(at, candidates, std::vector<TrialProblem>(sizes.size())));
}

// A loss gives nothing back.
TEST(OwnSizes, AreThoseThatACauseCanHave) {
  constexpr double kLosses[] = {0.03, 0.001, 0.02, 0.0};
  EXPECT_TRUE(FoundWhere("touchdown_angle_bias", kOff));
  EXPECT_FALSE(FoundWhere("touchdown_loss", kOff));
  const std::optional<OwnSizes> losses = FoundWhere("touchdown_loss", kLosses);
  ASSERT_TRUE(losses);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(losses->sizes[i], kLosses[i], 1e-12);
}

// Of so many rows they differ for certain, and one size for all explains them all the same.
TEST(OwnSizes, AreNotToldWhereTheyAreAllButEqual) {
  constexpr double kAllButEqual[] = {0.0300, 0.0270, 0.0320, 0.0295};
  EXPECT_FALSE(FoundWhere("touchdown_angle_bias", kAllButEqual));
}

TEST(OwnSizes, AreToldByADiagnosisThatExplainsLess) {
  const Diagnosis d = Diagnose(HopsOffBy(kOff), testing::OptionsWith(testing::kSixEffects));
  ASSERT_EQ(d.verdict, Verdict::kUnexplained);
  EXPECT_EQ(std::count_if(d.notes.begin(), d.notes.end(),
                          [](const std::string& note) {
                            return note.starts_with("touchdown_angle_bias of another size in each");
                          }),
            1);
}

TEST(OwnSizes, AreToldOnceOfADiagnosisThatIsJudgedAnew) {
  const DiagnosisOptions options = testing::OptionsWith(testing::kSixEffects);
  const Diagnosis d = Diagnose(HopsOffBy(kOff), options);
  ASSERT_TRUE(d.extension && d.extension->causes.size() > 1);
  const auto told = [](const std::vector<std::string>& notes) {
    return std::count_if(notes.begin(), notes.end(), [](const std::string& note) {
      return note.find("of another size in each trial") != std::string::npos;
    });
  };
  ASSERT_EQ(told(d.notes), 1);
  const SetAside out = AsSetAside(d.extension->causes.back(), *d.extension, d.naming);
  const Diagnosis without = DiagnosedWithout(d, {out}, options);
  EXPECT_EQ(without.extension->causes.size() + 1, d.extension->causes.size());
  EXPECT_EQ(told(without.notes), 1);
}

TEST(OwnSizes, AreNotWhatOneSizeForAllExplains) {
  const std::vector<double> same(4, 0.03);
  EXPECT_FALSE(Found(NullFit(HopsOffBy(same))));
  EXPECT_FALSE(Found(NullFit(DatasetOf({.train = 4}))));
}

}  // namespace
}  // namespace hoplab
