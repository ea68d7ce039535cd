// What first parts of a robot's trials named, fitted to the whole trials.
#include "fitting/diagnosis/carry_on.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fitting/diagnosis/null_fit.h"
#include "fitting/followed_part.h"
#include "tests/support/diagnosed_hops.h"
#include "tests/support/robot_pronks.h"

namespace hoplab {
namespace {

// Half a second with the mass 8 mm ahead, and the first 0.35 s of it.
struct Pronks {
  static constexpr double kUntil = 0.35;
  DiagnosisOptions options;
  FitProblem whole;

  Pronks(const std::vector<std::string>& candidates, const std::string& effects)
      : options(testing::OptionsWith(candidates)) {
    options.fit.jobs = 2;
    whole = MakeProblem(testing::RobotPronks(0.008, 0.5, effects), WithLegsAlike(options.problem));
  }
  Diagnosis ByFirstPart() const {
    DatasetFit null = FitPlain(FirstPart(whole, kUntil), options, Segmentation::kWhole);
    null.until = kUntil;
    return DiagnoseFitted(std::move(null), options);
  }
};

// A force that first parts are made to know as twice what it is.
TEST(WithWholeTrials, LeavesOutWhatTheyKnowInAnotherSize) {
  const Pronks pronks({"com_offset", "constant_force"}, "{constant_force: {force_x: 0.3}}");
  Diagnosis first = pronks.ByFirstPart();
  ASSERT_TRUE(first.extension && first.extension->causes.size() == 2u);

  const Diagnosis right = WithWholeTrials(first, pronks.whole, pronks.options);
  EXPECT_TRUE(right.set_aside.empty());
  ASSERT_TRUE(right.carried_on);
  EXPECT_EQ(right.carried_on->model.members.size(), 2u);

  const auto is_force = [](const Candidate& c) { return c.Name() == "constant_force"; };
  const std::vector<Candidate>& members = first.naming.best.members;
  const auto force = std::find_if(members.begin(), members.end(), is_force);
  const int place = first.naming.best.PlaceOf(static_cast<int>(force - members.begin()));
  first.naming.best.shared[place] *= 2.0;
  const Diagnosis d = WithWholeTrials(first, pronks.whole, pronks.options);
  ASSERT_EQ(d.set_aside.size(), 1u);
  EXPECT_EQ(d.set_aside[0].cause.Name(), "constant_force");
  ASSERT_TRUE(d.set_aside[0].by_whole_trials);
  EXPECT_NEAR((*d.set_aside[0].by_whole_trials)[0], 0.3, 0.03);
  ASSERT_EQ(d.extension->causes.size(), 1u);
  EXPECT_EQ(d.extension->causes[0].cause.Name(), "com_offset");
  ASSERT_TRUE(d.carried_on && d.carried_on->stop.IsMinimum());
  EXPECT_EQ(d.carried_on->model.members.size(), 1u);
  EXPECT_EQ(d.carried_on->uncertainty.parameters.size(),
            d.extension->uncertainty.parameters.size());
  EXPECT_EQ(d.carried_on->errors.test.rmse.size(), right.carried_on->errors.test.rmse.size());

  // Where nobody waits for that, what was there stays.
  std::atomic<bool> stop = false;
  DiagnosisOptions options = pronks.options;
  options.fit.stop = &stop;
  options.stage = [&](std::string_view stage) { stop = stop || stage.starts_with("taking out"); };
  const Diagnosis stopped = WithWholeTrials(first, pronks.whole, options);
  EXPECT_TRUE(stop);
  EXPECT_FALSE(stopped.interrupted);
  EXPECT_TRUE(stopped.set_aside.empty());
  EXPECT_EQ(stopped.extension->causes.size(), 2u);
  ASSERT_TRUE(stopped.carried_on);
  EXPECT_EQ(stopped.carried_on->model.members.size(), 2u);
  EXPECT_TRUE(stopped.cut_short);
  EXPECT_EQ(stopped.notes.back(),
            "stopped: what the whole trials do not confirm was not taken out");
}

// Of a model that is right the whole trials know more; one whose error shows knows no more by them
// than by first parts. A scale of x that is not asked for is such an error.
TEST(WithWholeTrials, HoldWhatFirstPartsSaidWhereASmoothErrorIsLeft) {
  for (const bool right : {true, false}) {
    const Pronks pronks({"com_offset"}, right ? "{}" : "{sensor_scale_x: {gain: 0.01}}");
    const Diagnosis d = WithWholeTrials(pronks.ByFirstPart(), pronks.whole, pronks.options);
    ASSERT_TRUE(d.extension && d.carried_on && d.carried_on->stop.IsMinimum());
    EXPECT_EQ(d.carried_on->model.problem.noise.IsWhite(), right);
    const ParameterUncertainty& first = d.extension->uncertainty.parameters.at(0);
    const ParameterUncertainty& all = d.carried_on->uncertainty.parameters.at(0);
    ASSERT_TRUE(first.ci95 && all.ci95 && all.ci95_given_model);
    const auto holds = [&](const std::pair<double, double>& of) {
      return all.ci95->first <= of.first && all.ci95->second >= of.second;
    };
    EXPECT_EQ(holds(*first.ci95), !right);
    EXPECT_TRUE(holds(*all.ci95_given_model));
  }
}

}  // namespace
}  // namespace hoplab
