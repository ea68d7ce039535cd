#include "fitting/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/read_dataset.h"
#include "fitting/apex_segments.h"
#include "fitting/fit_dataset.h"
#include "fitting/profile.h"
#include "fitting/trial_errors.h"
#include "fitting/uncertainty.h"
#include "tests/support/fit_cases.h"

namespace hoplab {
namespace {

using testing::SmallDataset;

TEST(ApexSegments, CutsATraceIntoItsHops) {
  const FitProblem p = MakeProblem(testing::HopDataset(3, 1), {});
  const std::vector<TrialProblem> pieces = CutAtApexes(p, p.trials[0]);
  ASSERT_EQ(pieces.size(), 3u);  // the run stops at its third apex
  long rows = 0;
  for (const TrialProblem& piece : pieces) {
    EXPECT_EQ(piece.row_times.front(), 0.0);
    rows += static_cast<long>(piece.row_times.size());
  }
  EXPECT_EQ(rows, static_cast<long>(p.trials[0].row_times.size()));
  EXPECT_NEAR(pieces[1].start[3], 0.0, 0.05);  // vy at an apex, one row off at most
}

TEST(ApexSegments, AreNoneWithoutHeights) {
  Dataset d = SmallDataset();
  d.channels.pop_back();  // body_y_m
  const FitProblem p = MakeProblem(d, {});
  EXPECT_TRUE(CutAtApexes(p, p.trials[0]).empty());
}

TEST(Fit, FromFarOffReachesTheOptimum) {
  const FitProblem p = MakeProblem(SmallDataset(), {});
  const FitResult near = Fit(p, {});
  ASSERT_TRUE(near.ok);
  const StartRecord far =
      FitFrom(p, TrialsOf(p, TrialRole::kTrain), Eigen::Vector2d(44e9, 0.1), {}, 0, nullptr);
  EXPECT_NEAR(far.cost, near.cost, 1e-6 * near.cost);
}

TEST(Fit, SeveralRestartsAgreeAndAreRecorded) {
  const FitProblem p = MakeProblem(SmallDataset(), {});
  const FitResult fit = Fit(p, {.restarts = 4, .seed = 9});
  ASSERT_EQ(fit.records.size(), 4u);
  for (const StartRecord& r : fit.records) EXPECT_NEAR(r.cost, fit.cost, 1e-6 * fit.cost);
  EXPECT_NE(fit.records[1].from, fit.records[2].from);
}

TEST(Fit, WorksWithoutHeightsByRawTime) {
  Dataset d = SmallDataset();
  d.channels.pop_back();  // body_y_m: no apexes to be seen
  const FitResult fit = Fit(MakeProblem(d, {}), {});
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.shared[0] / 22e9, 1.0, 0.05);
}

TEST(Fit, AnInterruptedFitSaysSoOfTheStartItCutShort) {
  std::atomic<bool> stop{true};
  FitOptions options;
  options.restarts = 3;
  options.stop = &stop;
  const FitResult fit = Fit(MakeProblem(SmallDataset(), {}), options);
  EXPECT_TRUE(fit.interrupted);
  ASSERT_EQ(fit.records.size(), 1u);  // the others were not begun
  EXPECT_EQ(fit.records[0].status, SolveStatus::kInterrupted);
}

TEST(Fit, SurvivesMissingSamples) {
  Dataset d = SmallDataset();
  for (Trial& t : d.trials) {
    for (TraceColumn& column : t.trace.columns) {
      for (std::size_t i = 3; i < column.values.size(); i += 4) column.values[i] = std::nan("");
    }
  }
  const FitResult fit = Fit(MakeProblem(d, {}), {});
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.shared[0] / 22e9, 1.0, 0.02);
}

TEST(Fit, ContactTimesAloneDetermineTheModulus) {
  Scenario s = testing::HopScenario(3);
  s.dataset->sample_rate_hz = 2000.0;
  s.dataset->channels = {{Channel::kContact, 1.0}};
  GenerateOptions options;
  Dataset d = GenerateDataset(s, options).dataset;
  for (Trial& t : d.trials) t.mechanism.c_leg.E_Pa = 21e9;
  const FitProblem p = MakeProblem(d, {});
  const FitResult fit = Fit(p, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_NEAR(fit.shared[0] / 22e9, 1.0, 0.01);
}

TEST(FitDataset, FitsWholeTracesWhereTheyCanBeSimulated) {
  const DatasetFit fit = FitDataset(SmallDataset(), {}, {});
  EXPECT_TRUE(fit.result.ok);
  EXPECT_FALSE(fit.by_hop);
  EXPECT_EQ(fit.problem.trials.size(), 3u);
}

TEST(FitDataset, FallsBackToSingleHopsAndSaysSo) {
  // `thesis` loses so much energy in these drops that no modulus carries all of them to the end.
  const Dataset d = ReadDataset(std::filesystem::path(HOPLAB_SOURCE_DIR) / "datasets/rig-drops");
  const DatasetFit fit = FitDataset(d, {.law = "thesis"}, {});
  ASSERT_TRUE(fit.result.ok) << fit.result.message;
  EXPECT_TRUE(fit.by_hop);
  EXPECT_NE(fit.note.find("hop by hop"), std::string::npos);
  EXPECT_GT(fit.problem.trials.size(), d.trials.size());
}

TEST(FitDataset, SaysWhenWholeTracesAndSingleHopsDisagree) {
  const Dataset d = ReadDataset(std::filesystem::path(HOPLAB_SOURCE_DIR) / "datasets/rig-drops");
  const DatasetFit fit = FitDataset(d, {.law = "no_slip"}, {}, Segmentation::kWhole);
  ASSERT_TRUE(fit.result.ok) << fit.result.message;
  EXPECT_NE(fit.note.find("hops that start at the apexes of the traces say E"), std::string::npos)
      << fit.note;
}

TEST(FitDataset, TellsOfSingleHopsWhatItsOwnFitOfThemSays) {
  const Dataset d = ReadDataset(std::filesystem::path(HOPLAB_SOURCE_DIR) / "datasets/rig-drops");
  const DatasetFit fit = FitDataset(d, {.law = "no_slip"}, {});
  ASSERT_TRUE(fit.by_hop) << fit.note;
  char told[60];
  std::snprintf(told, sizeof told, "single hops alone say E = %.3g Pa", fit.result.shared[0]);
  EXPECT_NE(fit.note.find(told), std::string::npos) << fit.note;
}

// Only E over m and d over m are seen of hops: none of the three is known, and the law is right.
TEST(FitDataset, DoesNotBlameALawForValuesThatItDoesNotKnow) {
  const DatasetFit fit = FitDataset(testing::HopDataset(3, 2), {.free = {"E", "d", "m", "g"}}, {});
  ASSERT_TRUE(fit.result.ok) << fit.result.message;
  EXPECT_GT(std::abs(fit.result.shared[0] / 22e9 - 1.0), 0.25) << "a case that shows nothing";
  EXPECT_EQ(fit.note.find("does not carry"), std::string::npos) << fit.note;
}

TEST(FitDataset, HopByHopFindsTheSameModulus) {
  const Dataset d = testing::HopDataset(3, 1);
  const DatasetFit hops = FitDataset(d, {}, {}, Segmentation::kHops);
  ASSERT_TRUE(hops.result.ok);
  EXPECT_TRUE(hops.by_hop);
  EXPECT_NEAR(hops.result.shared[0] / 22e9, 1.0, 0.005);
}

// The quick part of recovery_statistics_test.cc.
TEST(Fit, RecoversGeneratedValuesWithinItsIntervals) {
  double E_mean = 0;
  int covered = 0;
  constexpr int kSeeds = 6;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const FitProblem p = MakeProblem(testing::HopDataset(3, seed), {});
    const FitResult fit = Fit(p, {});
    ASSERT_TRUE(fit.ok);
    const Uncertainty u =
        AssessUncertainty(p, TrialsOf(p, TrialRole::kTrain), fit.shared, fit.initial_states, {}, 1);
    E_mean += fit.shared[0] / kSeeds;
    const double truth[] = {22e9, 3.0};
    for (int k = 0; k < 2; ++k)
      covered += std::abs(fit.shared[k] - truth[k]) < 3.0 * *u.parameters[k].std_error;
    EXPECT_NEAR(u.chi2_per_dof, 1.0, 0.1);
  }
  EXPECT_NEAR(E_mean / 22e9, 1.0, 0.002);
  EXPECT_EQ(covered, 2 * kSeeds);  // three standard errors: 99.7 % each
}

// What the model lacks it lacks in every trial: the same trials once more bring the white part of a
// variance down, not the discrepancy's.
TEST(Uncertainty, ADiscrepancyIsNotAveragedOutByMoreTrials) {
  FitProblem p = MakeProblem(SmallDataset(), {});
  const FitResult fit = Fit(p, {});
  p.noise.amplitude.assign(p.channels.size(), 2.0);
  p.noise.time_scale = 0.05;
  std::vector<TrialProblem> trials = TrialsOf(p, TrialRole::kTrain);
  std::vector<OwnValues> initial_states = fit.initial_states;
  const Uncertainty once = AssessUncertainty(p, trials, fit.shared, initial_states, {}, 1);
  const std::size_t n = trials.size();
  for (std::size_t i = 0; i < 3 * n; ++i) {
    trials.push_back(trials[i]);
    initial_states.push_back(initial_states[i]);
  }
  const Uncertainty four = AssessUncertainty(p, trials, fit.shared, initial_states, {}, 1);
  for (int k = 0; k < 2; ++k) {
    const ParameterUncertainty &a = once.parameters[k], &b = four.parameters[k];
    const auto white = [](const ParameterUncertainty& u) {
      return *u.std_error * *u.std_error / u.inflation;
    };
    const double smooth = *a.std_error * *a.std_error - white(a);
    EXPECT_GT(smooth, white(a));
    EXPECT_NEAR(white(b) / white(a), 0.25, 1e-6);
    EXPECT_NEAR((*b.std_error * *b.std_error - white(b)) / smooth, 1.0, 1e-6);
  }
}

TEST(Uncertainty, AgreesWithTheProfile) {
  const FitProblem p = MakeProblem(SmallDataset(), {});
  const FitResult fit = Fit(p, {});
  const Uncertainty u =
      AssessUncertainty(p, TrialsOf(p, TrialRole::kTrain), fit.shared, fit.initial_states, {}, 1);
  for (int k = 0; k < 2; ++k) {
    const Profile profile = ComputeProfile(p, fit, {}, k, *u.parameters[k].std_error);
    ASSERT_TRUE(profile.lower95 && profile.upper95);
    const double width = u.parameters[k].ci95->second - u.parameters[k].ci95->first;
    EXPECT_NEAR(*profile.lower95, u.parameters[k].ci95->first, 0.05 * width);
    EXPECT_NEAR(*profile.upper95, u.parameters[k].ci95->second, 0.05 * width);
  }
}

TEST(Uncertainty, ACombinationTheDataCannotSeeHasNoInterval) {
  // Without torque, mass, modulus (both) and damping only occur as ratios.
  const FitProblem p = MakeProblem(SmallDataset(), {.free = {"E", "G", "d", "m"}});
  const std::vector<TrialProblem> trials = TrialsOf(p, TrialRole::kTrain);
  const Uncertainty u =
      AssessUncertainty(p, trials, InitialShared(p), testing::NominalInitialStates(trials), {}, 1);
  EXPECT_EQ(u.identifiability.rank, 3);
  EXPECT_TRUE(std::isinf(u.identifiability.condition_number));
  ASSERT_FALSE(u.identifiability.weak_directions.empty());
  const WeakDirection& unseen = u.identifiability.weak_directions.front();
  EXPECT_EQ(unseen.eigenvalue, 0.0);
  // Moving all four in proportion: loadings in units of the scales, which are the values for all
  // but d.
  const double d_ratio = InitialShared(p)[2] / p.shared[2].scale;
  const double length = std::sqrt(3.0 + d_ratio * d_ratio);
  EXPECT_NEAR(unseen.loadings[0], 1.0 / length, 1e-4);
  EXPECT_NEAR(unseen.loadings[1], 1.0 / length, 1e-4);
  EXPECT_NEAR(unseen.loadings[2], d_ratio / length, 1e-4);
  EXPECT_NEAR(unseen.loadings[3], 1.0 / length, 1e-4);
  for (const ParameterUncertainty& q : u.parameters) EXPECT_FALSE(q.std_error.has_value());
}

TEST(Uncertainty, AValueOnItsBoundIsSaidToBeThere) {
  Dataset d = SmallDataset();
  const FitProblem p = MakeProblem(d, {});
  const std::vector<TrialProblem> trials = TrialsOf(p, TrialRole::kTrain);
  const Uncertainty u = AssessUncertainty(p, trials, Eigen::Vector2d(22e9, 0.0),
                                          testing::NominalInitialStates(trials), {}, 1);
  EXPECT_TRUE(u.parameters[1].at_bound);
  EXPECT_FALSE(u.parameters[1].std_error.has_value());
  EXPECT_TRUE(u.parameters[0].std_error.has_value());
}

TEST(Uncertainty, AWrongModelIsNoticed) {
  const FitProblem p = MakeProblem(SmallDataset(4, 0), {.law = "no_slip"});
  const FitResult fit = Fit(p, {});
  ASSERT_TRUE(fit.ok);
  const Uncertainty u =
      AssessUncertainty(p, TrialsOf(p, TrialRole::kTrain), fit.shared, fit.initial_states, {}, 1);
  EXPECT_TRUE(u.misfit);
  EXPECT_GT(*u.parameters[0].std_error_between_trials, *u.parameters[0].std_error);
}

TEST(TrialErrors, ATestTrialGetsItsOwnStart) {
  const FitProblem p = MakeProblem(SmallDataset(), {});
  const FitResult fit = Fit(p, {});
  const std::vector<TrialErrors> errors = AssessTrials(p, fit, {});
  ASSERT_EQ(errors.size(), 3u);
  EXPECT_EQ(errors[2].role, TrialRole::kTest);
  EXPECT_NE(errors[2].start, p.trials[2].start);
  for (double rmse : errors[2].rmse) EXPECT_NEAR(rmse, 0.001, 0.0003);  // 1 mm noise
}

TEST(TrialErrors, ATrialThatFallsHasNoNumbers) {
  const FitProblem p = MakeProblem(SmallDataset(), {});
  FitResult fit = Fit(p, {});
  fit.shared[0] = 1e8;
  const std::vector<TrialErrors> errors = AssessTrials(p, fit, {});
  for (const TrialErrors& e : errors) {
    EXPECT_FALSE(e.complete);
    EXPECT_TRUE(std::isnan(e.rmse[0]));
    EXPECT_TRUE(std::isnan(e.nll_per_sample));
  }
  const RoleErrors train = Summarise(p, errors, TrialRole::kTrain);
  EXPECT_EQ(train.incomplete, 2);
  EXPECT_TRUE(std::isnan(train.rmse[0]));
}

TEST(TrialErrors, HopsAddUpToTheTrial) {
  const FitProblem p = MakeProblem(SmallDataset(), {});
  const FitResult fit = Fit(p, {});
  const TrialErrors e = AssessTrials(p, fit, {})[0];
  ASSERT_EQ(e.hops.size(), 2u);
  EXPECT_EQ(e.hops[0].begin, 0.0);
  for (const HopErrors& hop : e.hops) EXPECT_NEAR(hop.rmse[1], 0.001, 0.0004);
}

TEST(ParameterUncertainty, TheWiderIntervalIsOfNoiseOrOfTrials) {
  ParameterUncertainty p;
  EXPECT_FALSE(p.Wider());
  p.ci95_between_trials = {1.0, 3.0};
  EXPECT_EQ(p.Wider(), p.ci95_between_trials);
  p.ci95 = {1.5, 3.0};
  EXPECT_EQ(p.Wider(), p.ci95_between_trials);
  p.ci95 = {0.5, 3.0};
  EXPECT_EQ(p.Wider(), p.ci95);
}

// Only what the data tell of values takes from what noise leaves; a prior is a row more.
TEST(Uncertainty, CountsTheDegreesOfFreedomThatNoiseHas) {
  const FitProblem seen = MakeProblem(SmallDataset(), {.free = {"E", "G", "d"}});
  const std::vector<TrialProblem> trials = TrialsOf(seen, TrialRole::kTrain);
  const Eigen::VectorXd at = InitialShared(seen);
  const std::vector<OwnValues> start = testing::NominalInitialStates(trials);
  const double chi2_per_dof = AssessUncertainty(seen, trials, at, start, {}, 1).chi2_per_dof;

  // Mass, modulus (both) and damping only occur as ratios.
  const FitProblem more = MakeProblem(SmallDataset(), {.free = {"E", "G", "d", "m"}});
  const Uncertainty undetermined =
      AssessUncertainty(more, trials, InitialShared(more), start, {}, 1);
  ASSERT_EQ(undetermined.identifiability.rank, 3);
  EXPECT_NEAR(undetermined.chi2_per_dof, chi2_per_dof, 1e-6 * chi2_per_dof);

  // A prior that is met adds a row and no square.
  std::vector<TrialProblem> known = trials;
  known[0].shared_priors.push_back({0, at[0], at[0]});
  double rows = 0.0;
  for (const TrialProblem& t : trials) rows += static_cast<double>(t.sample_count);
  const double with = AssessUncertainty(seen, known, at, start, {}, 1).chi2_per_dof;
  EXPECT_NEAR(chi2_per_dof / with - 1.0, 1.0 / rows, 0.2 / rows);
}

}  // namespace
}  // namespace hoplab
