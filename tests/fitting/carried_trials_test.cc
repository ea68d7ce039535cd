// What stays of a problem whose trials cannot all be simulated.

#include "fitting/carried_trials.h"

#include <gtest/gtest.h>

#include "fitting/apex_segments.h"
#include "tests/support/fit_cases.h"

namespace hoplab {
namespace {

using testing::SmallDataset;

// Three train trials; the contact of the first one says that it lands at every other row.
FitProblem WithATrialThatNothingCarries() {
  Dataset d = SmallDataset(3, 0);
  d.clocks = {{"camera", 0.0, 0.002}};
  d.channels[1].clock = "camera";
  d.channels.push_back({Channel::kContact, 1.0});
  for (Trial& t : d.trials) {
    TraceColumn contact{"contact", {}};
    for (std::size_t row = 0; row < t.trace.time_s.size(); ++row)
      contact.values.push_back(&t == &d.trials[0] && row % 2 == 1 ? 1.0 : 0.0);
    t.trace.columns.push_back(contact);
  }
  return MakeProblem(d, {});
}

TEST(CarriedTrials, TheLastFitIsOfTheTrialsThatAreLeft) {
  for (const int rounds : {1, 2}) {
    FitProblem problem = WithATrialThatNothingCarries();
    std::vector<std::string> left_out;
    const FitResult fit = FitCarriedTrials(problem, {}, rounds, left_out);
    EXPECT_TRUE(fit.ok) << fit.message;
    EXPECT_EQ(fit.stop.complete, rounds == 2);
    EXPECT_EQ(left_out.size(), rounds == 2 ? 1u : 0u);
    EXPECT_EQ(problem.trials.size(), 3 - left_out.size());
    EXPECT_EQ(fit.initial_states.size(), problem.trials.size());
  }
}

}  // namespace
}  // namespace hoplab
