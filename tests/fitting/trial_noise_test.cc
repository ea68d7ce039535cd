#include "fitting/trial_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "datasets/read_dataset.h"
#include "fitting/diagnosis/gate.h"
#include "fitting/discrepancy/restricted_likelihood.h"
#include "fitting/trial_evaluator.h"
#include "fitting/uncertainty.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::DatasetOf;

constexpr double kQuiet = 1e-3;  // m

// Hops whose trial `louder` scatters by `factor` times what the others do.
Dataset HopsWithALouderTrial(std::uint64_t seed, std::size_t louder, double factor) {
  Dataset d = DatasetOf({.train = 6, .seed = seed, .sigma_m = kQuiet, .rate_hz = 200.0});
  RandomStream random(seed, 77);
  const double more = kQuiet * std::sqrt(factor * factor - 1.0);
  for (TraceColumn& column : d.trials[louder].trace.columns)
    for (double& value : column.values) value += more * random.Normal();
  return d;
}
void Estimate(Dataset& d) {
  for (ChannelSpec& c : d.channels) c.sigma.reset();
}
bool AnyFactor(const FitProblem& problem) {
  return std::any_of(problem.trials.begin(), problem.trials.end(),
                     [](const TrialProblem& t) { return !t.noise_factors.empty(); });
}

TEST(TrialNoise, IsThatOfTheChannelWhereTrialsAreAlike) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    Dataset d = DatasetOf({.train = 6, .seed = seed, .sigma_m = kQuiet, .rate_hz = 200.0});
    Estimate(d);
    EXPECT_FALSE(AnyFactor(MakeProblem(d, {}))) << seed;
  }
  for (const char* name : {"rig-drops", "rig-controlled", "rig-drops-undamped", "robot-drops",
                           "robot-pronk", "robot-walk"}) {
    Dataset d = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/" + name);
    Estimate(d);
    EXPECT_FALSE(AnyFactor(MakeProblem(d, {}))) << name;
  }
}

TEST(TrialNoise, ATrialThatScattersMoreCountsByItsOwn) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    Dataset d = HopsWithALouderTrial(seed, 2, 2.5);
    Estimate(d);
    const FitProblem problem = MakeProblem(d, {});
    for (std::size_t i = 0; i < problem.trials.size(); ++i) {
      for (std::size_t c = 0; c < problem.channels.size(); ++c) {
        const double factor = SigmaIn(problem, problem.trials[i], c) / problem.channels[c].sigma;
        if (i == 2)
          EXPECT_NEAR(factor, 2.5, 0.75) << seed << ' ' << c;
        else
          EXPECT_EQ(factor, 1.0) << seed << ' ' << i << ' ' << c;
      }
    }
    EXPECT_NE(std::find_if(problem.notes.begin(), problem.notes.end(),
                           [&](const std::string& note) {
                             return note.find(problem.trials[2].file) != std::string::npos &&
                                    note.find("counts by its own noise") != std::string::npos;
                           }),
              problem.notes.end());
  }
}

TEST(TrialNoise, OfAStatedSigmaADiagnosisTakesWhatIsMore) {
  FitProblem louder = MakeProblem(HopsWithALouderTrial(3, 1, 2.5), {});
  EXPECT_FALSE(AnyFactor(louder));
  EXPECT_EQ(CorrectNoise(louder).size(), louder.channels.size());
  EXPECT_GT(SigmaIn(louder, louder.trials[1], 0), 2.0 * kQuiet);
  Dataset quiet = HopsWithALouderTrial(3, 1, 1.0);
  for (ChannelSpec& c : quiet.channels) c.sigma = 2.0 * kQuiet;
  FitProblem stated = MakeProblem(quiet, {});
  EXPECT_TRUE(CorrectNoise(stated).empty());
  EXPECT_FALSE(AnyFactor(stated));
}

TEST(TrialNoise, ResidualsAreInUnitsOfIt) {
  FitProblem problem = MakeProblem(HopsWithALouderTrial(3, 1, 2.5), {});
  const auto residuals = [&] {
    TrialEvaluation e;
    TrialEvaluator(problem, problem.trials[1])
        .Evaluate({InitialShared(problem), problem.trials[1].start, false}, e);
    return Eigen::VectorXd(e.residuals.head(e.data_residuals));
  };
  const Eigen::VectorXd before = residuals();
  problem.trials[1].noise_factors.assign(problem.channels.size(), 2.0);
  EXPECT_LT((residuals() - 0.5 * before).norm(), 1e-12 * before.norm());
}

// What a model lacks is as large in a trial that scatters more: over its noise it is smaller.
TEST(TrialNoise, ADiscrepancyIsThatOfTheChannel) {
  constexpr double kFactor = 3.0, kAmplitude = 6.0, kTimeScale_s = 0.1;
  FitProblem of_trial = MakeProblem(HopsWithALouderTrial(3, 1, 2.5), {}), of_channel = of_trial;
  const std::size_t channels = of_trial.channels.size();
  of_trial.noise = {std::vector<double>(channels, kAmplitude), kTimeScale_s};
  for (TrialProblem& t : of_trial.trials) t.noise_factors.assign(channels, kFactor);
  of_channel.noise = {std::vector<double>(channels, kAmplitude / kFactor), kTimeScale_s};
  for (ChannelProblem& c : of_channel.channels) c.sigma *= kFactor;

  const Eigen::VectorXd shared = InitialShared(of_trial);
  std::vector<OwnValues> start;
  for (const TrialProblem& t : of_trial.trials) start.push_back(t.start);
  const auto evaluated = [&](const FitProblem& problem) {
    TrialEvaluation e;
    TrialEvaluator(problem, problem.trials[0]).Evaluate({shared, start[0], false}, e);
    return e;
  };
  const TrialEvaluation a = evaluated(of_trial), b = evaluated(of_channel);
  EXPECT_LT((a.residuals - b.residuals).norm(), 1e-9 * b.residuals.norm());
  EXPECT_NEAR(a.half_log_determinant, b.half_log_determinant, 1e-9 * b.half_log_determinant);

  const auto likelihood = [&](const FitProblem& problem) {
    return RestrictedLikelihood(problem, problem.trials, shared, start, 1);
  };
  const double at = likelihood(of_channel).At(of_channel.noise);
  EXPECT_NEAR(likelihood(of_trial).At(of_trial.noise), at, 1e-9 * std::abs(at));
  EXPECT_NEAR(likelihood(of_trial).RootMeanSquare(0),
              kFactor * likelihood(of_channel).RootMeanSquare(0), 1e-9);

  const auto error = [&](const FitProblem& problem) {
    return AssessUncertainty(problem, problem.trials, shared, start, {}, 1)
        .parameters[0]
        .std_error.value();
  };
  EXPECT_NEAR(error(of_trial), error(of_channel), 1e-6 * error(of_channel));
}

}  // namespace
}  // namespace hoplab
