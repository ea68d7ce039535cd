// Filters of which the noise does not tell, since it came in after them.
#include "fitting/diagnosis/unseen_filters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.h"
#include "fitting/diagnosis/diagnosis.h"
#include "tests/support/butterworth.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

constexpr double kNoise_m = 5e-4;

// Hops whose sensor has no noise of its own, which comes in after `filter`.
Dataset NoisyAfter(Dataset (*filter)(const Dataset&)) {
  Dataset dataset = filter(testing::DatasetOf({.train = 6, .sigma_m = 1e-8, .rate_hz = 250.0}));
  RandomStream random(7, 0);
  for (Trial& trial : dataset.trials)
    for (TraceColumn& column : trial.trace.columns)
      for (double& value : column.values) value += kNoise_m * random.Normal();
  for (ChannelSpec& channel : dataset.channels) channel.sigma = kNoise_m;
  return dataset;
}

// With few causes beside the filters.
DiagnosisOptions AmongFew() {
  DiagnosisOptions options;
  options.fit.jobs = 2;
  for (const Effect* effect : AllEffects()) {
    const std::string name(effect->info.name);
    const bool tried = name == "air_drag" || name == "sensor_delay" ||
                       name == "touchdown_angle_bias" || effect->info.filter != RecordFilter::kNone;
    if (!tried && AppliesTo(*effect, Law::kElastica)) options.candidates.without.push_back(name);
  }
  return options;
}
std::vector<std::string> NamesOf(const FittedModel& model) {
  std::vector<std::string> names;
  for (const Candidate& member : model.members) names.push_back(member.Name());
  return names;
}

TEST(UnseenFilters, AreNamedWhereTheyExplainAll) {
  const auto means = [](const Dataset& d) { return testing::Averaged(d, 7); };
  const FittedModel best = Diagnose(NoisyAfter(means), AmongFew()).naming.best;
  EXPECT_EQ(NamesOf(best), std::vector<std::string>{"sensor_moving_average"});
  EXPECT_NEAR(best.shared[best.shared.size() - 1], 7.0 / 250.0, 2e-3);
}

// A misfit that is not a filter's is not told as one, though a filter would take some of it.
TEST(UnseenFilters, DoNotStandInForALoss) {
  const Dataset hops = testing::DatasetOf(
      {.effects = {testing::EffectOfSize("touchdown_loss", 0.2)}, .train = 6, .sigma_m = kNoise_m});
  DiagnosisOptions options = AmongFew();
  bool sought = false;
  options.stage = [&](std::string_view stage) { sought |= stage.find("filters of") != stage.npos; };
  const Diagnosis d = Diagnose(hops, options);
  EXPECT_TRUE(sought);
  EXPECT_LT(d.detection.p_value, kDetectionLevel);
  for (const Candidate& member : d.naming.best.members)
    EXPECT_EQ(member.effect->info.filter, RecordFilter::kNone) << member.Name();
}

TEST(UnseenFilters, AreToldAndThatTheNoiseDoesNotTellOfThem) {
  DiagnosisOptions options;
  options.fit.jobs = 2;
  const auto to_and_fro = [](const Dataset& d) { return testing::Smoothed(d, 15.0); };
  const Diagnosis d = Diagnose(NoisyAfter(to_and_fro), options);
  ASSERT_TRUE(d.extension.has_value());
  ASSERT_EQ(d.extension->MainCauses().size(), 1u);
  EXPECT_EQ(d.extension->MainCauses()[0]->cause.Name(), "sensor_low_pass");
  EXPECT_GT(d.extension->MainCauses()[0]->group_probability, kSure);
  const FittedModel& best = d.naming.best;
  EXPECT_NEAR(best.shared[best.shared.size() - 1], testing::FilterTime(15.0), 3e-4);
  EXPECT_TRUE(std::any_of(d.notes.begin(), d.notes.end(), [](const std::string& note) {
    return note.starts_with("the noise alone does not tell of sensor_low_pass");
  }));
}

}  // namespace
}  // namespace hoplab
