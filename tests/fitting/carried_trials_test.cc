// What stays of a problem whose trials cannot all be simulated.

#include "fitting/carried_trials.h"

#include <gtest/gtest.h>

#include "base/nan.h"
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

TEST(CarriedTrials, APriorOfATrialThatIsLeftOutStays) {
  FitProblem problem = WithATrialThatNothingCarries();
  const std::vector<SharedPrior> priors = problem.trials[0].shared_priors;
  ASSERT_EQ(priors.size(), 1u);
  std::vector<std::string> left_out;
  const FitResult fit = FitCarriedTrials(problem, {}, 2, left_out);
  ASSERT_EQ(left_out.size(), 1u);
  ASSERT_EQ(problem.trials[0].shared_priors.size(), 1u);
  EXPECT_EQ(problem.trials[0].shared_priors[0].shared, priors[0].shared);
  EXPECT_EQ(problem.trials[0].shared_priors[0].sigma, 0.002);
  EXPECT_TRUE(problem.trials[1].shared_priors.empty());
}

// It lifts off within the first row and is at its apex after six, fewer than a piece may have.
TEST(CarriedTrials, APriorOfAFirstPieceThatIsLeftOutStays) {
  FitProblem problem = WithATrialThatNothingCarries();
  TrialProblem& trial = problem.trials[0];
  constexpr double kStep = 0.0255, kSpeed = 1.5, kGround = 0.18, kInStance = 0.12;
  constexpr int kRows = 60, kHop = 18, kFlight = 12;
  const std::size_t width = problem.channels.size();
  trial.row_times.clear();
  trial.data.assign(kRows * width, 0.0);
  for (int row = 0; row < kRows; ++row) {
    const double u = kStep * (row % kHop);
    trial.row_times.push_back(kStep * row);
    trial.data[static_cast<std::size_t>(row) * width + 1] =
        row % kHop == 0 || row % kHop > kFlight ? kInStance
                                                : kGround + kSpeed * u - 0.5 * 9.81 * u * u;
  }
  trial.contact = {};
  const std::vector<TrialProblem> pieces = CutAtApexes(problem, trial);
  ASSERT_GE(pieces.size(), 2u);
  EXPECT_GT(pieces[0].begin_s, trial.begin_s);
  EXPECT_EQ(pieces[0].shared_priors.size(), 1u);
  EXPECT_TRUE(pieces[1].shared_priors.empty());
}

// A sensor that begins a few rows after the others.
TEST(CarriedTrials, AFirstFlightIsTheStartsWhereItsFirstHeightsAreBlank) {
  FitProblem problem = MakeProblem(testing::HopDataset(3, 1), {});
  TrialProblem& trial = problem.trials[0];
  const std::vector<TrialProblem> whole = CutAtApexes(problem, trial);
  for (std::size_t row = 0; row < 3; ++row) trial.data[row * problem.channels.size() + 1] = kNaN;
  const std::vector<TrialProblem> blank = CutAtApexes(problem, trial);
  ASSERT_EQ(blank.size(), whole.size());
  EXPECT_EQ(blank[0].begin_s, trial.begin_s);
  EXPECT_EQ(blank[0].row_times, whole[0].row_times);
}

}  // namespace
}  // namespace hoplab
