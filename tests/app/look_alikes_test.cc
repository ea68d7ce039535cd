// What `hoplab explain` says of look-alikes, measured: columns of effects at the null fit of four
// hops under the speed controller, fitted values and initial states projected out.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "app/reports/effect_advice.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

TEST(LookAlikes, AreThoseWhoseColumnsNearlyCoincide) {
  const testing::NullFit null(testing::HopDataset(4, 5));
  std::vector<Candidate> candidates;
  std::vector<std::string> owner;  // of each column
  for (const Effect* effect : AllEffects()) {
    // One that nobody has written about need not be in the table: adding it means adding one file.
    if (!AppliesTo(*effect, Law::kElastica) || !AdviceOn(effect->info.name)) continue;
    // No column at null; and of what the law has in itself, null is another model.
    if (effect->info.has_threshold || IsPartOf(Law::kElastica, *effect)) continue;
    candidates.push_back({effect});
    owner.insert(owner.end(), effect->info.parameters.size(), std::string(effect->info.name));
  }
  const Linearisation at = null.With(candidates);
  // What a fitted value stands for has no column of its own.
  std::vector<Eigen::Index> seen;
  for (Eigen::Index k = 0; k < at.columns.cols(); ++k)
    if (Information(at, static_cast<int>(k)) > 0.0) seen.push_back(k);
  Eigen::MatrixXd columns = at.columns(Eigen::all, seen);
  columns.colwise().normalize();
  const Eigen::MatrixXd cosines = columns.transpose() * columns;
  ASSERT_TRUE(cosines.allFinite());

  std::map<std::string, std::map<std::string, double>> alike;
  for (Eigen::Index i = 0; i < cosines.rows(); ++i) {
    for (Eigen::Index j = 0; j < cosines.cols(); ++j) {
      const auto owner_of = [&](Eigen::Index k) -> const std::string& {
        return owner[static_cast<std::size_t>(seen[static_cast<std::size_t>(k)])];
      };
      const std::string &a = owner_of(i), &b = owner_of(j);
      const double size = std::abs(cosines(i, j));
      if (a != b && size > kAlikeCosine) alike[a][b] = std::max(alike[a][b], size);
    }
  }
  for (const std::string& effect : std::set<std::string>(owner.begin(), owner.end())) {
    std::vector<std::pair<double, std::string>> nearest;
    for (const auto& [other, size] : alike[effect]) nearest.emplace_back(-size, other);
    std::sort(nearest.begin(), nearest.end());
    std::string expected;
    for (const auto& [size, other] : nearest) expected += (expected.empty() ? "" : ", ") + other;
    EXPECT_EQ(AdviceOn(effect)->look_alikes, expected) << effect;
  }
}

}  // namespace
}  // namespace hoplab
