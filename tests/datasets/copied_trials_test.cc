#include "datasets/copied_trials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hoplab {
namespace {

// Three trials of one channel that rises, each by its own step.
Dataset Three() {
  Dataset dataset;
  dataset.channels = {{Channel::kBodyY, 0.001, {"hops/dataset.yaml:3"}}};
  for (int i = 0; i < 3; ++i) {
    Trial trial;
    trial.file = "trial-" + std::to_string(i) + ".csv";
    trial.role = i < 2 ? TrialRole::kTrain : TrialRole::kTest;
    trial.origin.place = "hops/dataset.yaml:" + std::to_string(10 + i);
    trial.trace.columns = {{"body_y_m", {}}};
    for (int k = 0; k < 40; ++k) {
      trial.trace.time_s.push_back(0.01 * k);
      trial.trace.columns[0].values.push_back(0.3 + (i + 1) * std::sin(k));
    }
    dataset.trials.push_back(trial);
  }
  return dataset;
}

TEST(CopiedTrials, NothingIsSaidOfTrialsThatDiffer) {
  Dataset dataset = Three();
  EXPECT_TRUE(CopiedTrials(dataset).empty());
  dataset.trials[2].trace = dataset.trials[0].trace;
  dataset.trials[2].trace.columns[0].values[39] += 1e-9;
  EXPECT_TRUE(CopiedTrials(dataset).empty());
}

TEST(CopiedTrials, AHeldOutCopyConfirmsNothing) {
  Dataset dataset = Three();
  dataset.trials[2].trace = dataset.trials[0].trace;
  const std::vector<std::string> said = CopiedTrials(dataset);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0],
            "hops/dataset.yaml:12: trial-2.csv holds the samples of trial-0.csv; a held-out copy "
            "of what is fitted confirms nothing. Leave one of them out");
}

// Missing samples are alike, and another time base does not make the samples others.
TEST(CopiedTrials, ACopyCountsTwice) {
  Dataset dataset = Three();
  dataset.trials[0].trace.columns[0].values[5] = std::numeric_limits<double>::quiet_NaN();
  dataset.trials[1].trace = dataset.trials[0].trace;
  for (double& time : dataset.trials[1].trace.time_s) time += 0.1;
  const std::vector<std::string> said = CopiedTrials(dataset);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("trial-1.csv holds the samples of trial-0.csv"), std::string::npos);
  EXPECT_NE(said[0].find("counted twice"), std::string::npos);
}

TEST(CopiedTrials, RestAndContactsAreNoCopy) {
  Dataset rest = Three(), contact = Three();
  for (Trial& trial : rest.trials) {
    for (double& value : trial.trace.columns[0].values) value = 0.3;
    trial.trace.columns[0].values[0] = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_TRUE(CopiedTrials(rest).empty());
  contact.channels[0].id = Channel::kContact;
  for (Trial& trial : contact.trials) {
    trial.trace.columns[0].name = "contact";
    for (std::size_t k = 0; k < 40; ++k) trial.trace.columns[0].values[k] = k / 10 % 2;
  }
  EXPECT_TRUE(CopiedTrials(contact).empty());
}

}  // namespace
}  // namespace hoplab
