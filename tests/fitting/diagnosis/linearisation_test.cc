#include "fitting/diagnosis/linearisation.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <numbers>

#include "tests/support/diagnosed_hops.h"
#include "tests/support/richardson.h"
#include "tests/support/tolerances.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::NullFit;

// Rounding of a projection done twice: a few roundings a row.
constexpr double kOrthogonal = 1e-11;

// All columns at once, without the code under test: fitted values and each trial's start.
struct Dense {
  Eigen::MatrixXd S;  // scaled to length one
  Eigen::VectorXd r;

  Dense(const NullFit& fit, const std::vector<int>& fitted) {
    const int n = fit.problem.shared_count();
    std::vector<TrialEvaluation> parts(fit.train.size());
    Eigen::Index rows = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      TrialEvaluator(fit.problem, fit.train[i])
          .Evaluate({fit.null.shared, fit.null.initial_states[i], true}, parts[i]);
      rows += parts[i].residuals.size();
    }
    const auto shared = static_cast<Eigen::Index>(fitted.size());
    S = Eigen::MatrixXd::Zero(rows, shared + 4 * static_cast<Eigen::Index>(parts.size()));
    r.resize(rows);
    Eigen::Index at = 0, column = shared;
    for (const TrialEvaluation& e : parts) {
      const Eigen::Index m = e.residuals.size();
      r.segment(at, m) = e.residuals;
      for (Eigen::Index k = 0; k < shared; ++k)
        S.block(at, k, m, 1) = e.jacobian.col(fitted[static_cast<std::size_t>(k)]);
      S.block(at, column, m, 4) = e.jacobian.middleCols(n, 4);
      at += m;
      column += 4;
    }
    S.colwise().normalize();
  }
  // What an explicit singular value decomposition leaves of a vector.
  Eigen::VectorXd Projected(const Eigen::VectorXd& v) const {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(S, Eigen::ComputeThinU);
    return v - svd.matrixU() * (svd.matrixU().transpose() * v);
  }
};

const std::vector<Candidate> kTested = {CandidateOf("air_drag"), CandidateOf("gravity_scale"),
                                        CandidateOf("leg_material_damping")};

TEST(Linearisation, IsOrthogonalToFittedValuesAndInitialStates) {
  const NullFit fit{testing::World{}};
  const Linearisation at = fit.With(kTested);
  const Dense dense(fit, {0, 1});
  EXPECT_LT((dense.S.transpose() * at.r).norm(), kOrthogonal * at.r.norm());
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT((dense.S.transpose() * at.columns.col(k)).norm(), kOrthogonal * at.length[k]) << k;
  }
}

TEST(Linearisation, ProjectsAsAnExplicitDecompositionDoes) {
  const NullFit fit{testing::World{}};
  const Linearisation at = fit.With(kTested);
  const Dense dense(fit, {0, 1});
  // More sensitivities, other steps: equal to the solver's tolerance, not to the bit.
  EXPECT_LT((at.raw - dense.r).norm(), 1e-5 * dense.r.norm());
  EXPECT_LT((at.r - dense.Projected(at.raw)).norm(), 1e-9 * at.r.norm());
}

TEST(Linearisation, ProjectingTwiceChangesNothing) {
  const NullFit fit{testing::World{}};
  const Linearisation at = fit.With(kTested);
  const Dense dense(fit, {0, 1});
  EXPECT_LT((dense.Projected(at.r) - at.r).norm(), kOrthogonal * at.r.norm());
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT((dense.Projected(at.columns.col(k)) - at.columns.col(k)).norm(),
              kOrthogonal * at.length[k])
        << k;
  }
}

TEST(Linearisation, ColumnsAreProjectedDifferencesOfTheResiduals) {
  NullFit fit{testing::World{}};
  fit.problem.integrator.relative_tolerance = testing::kOracleRelative;
  fit.problem.integrator.absolute_tolerance = testing::kOracleAbsolute;
  fit.null.problem = fit.problem;
  const Linearisation at = fit.With(kTested);
  const FitProblem extended = Extend(fit.problem, kTested);
  const Dense dense(fit, {0, 1});
  for (int k = 0; k < 3; ++k) {
    const auto residuals = [&](double value) {
      Eigen::VectorXd shared(extended.shared_count());
      shared << fit.null.shared, NullValues(kTested);
      shared[2 + k] = value;
      std::vector<double> all;
      for (std::size_t i = 0; i < fit.train.size(); ++i) {
        TrialEvaluation e;
        TrialEvaluator(extended, fit.train[i])
            .Evaluate({shared, fit.null.initial_states[i], false}, e);
        all.insert(all.end(), e.residuals.begin(), e.residuals.end());
      }
      return all;
    };
    const testing::DifferenceColumn d =
        testing::RichardsonDerivative(residuals, 0.0, 0.01 * extended.shared[2 + k].scale);
    ASSERT_EQ(static_cast<Eigen::Index>(d.value.size()), at.raw.size());
    const Eigen::Map<const Eigen::VectorXd> raw(d.value.data(), at.raw.size());
    ASSERT_LT(d.error_norm, testing::kGradientOracle * raw.norm()) << k;
    EXPECT_NEAR(at.length[k], raw.norm(), testing::kGradient * raw.norm()) << k;
    EXPECT_LT((at.columns.col(k) - dense.Projected(raw)).norm(), testing::kGradient * raw.norm())
        << k;
  }
}

TEST(Linearisation, CountsTheDimensionsItTakesOut) {
  const NullFit fit{testing::World{}};
  const Linearisation at = fit.With(kTested);
  EXPECT_EQ(at.fitted_rank, 2 + 4 * 3);
  EXPECT_EQ(at.degrees_of_freedom(), at.rows() - 14);
  EXPECT_NEAR(at.leverage.sum(), 14.0, 1e-9);
  EXPECT_EQ(at.rows(), at.samples + 4 * 3);  // priors on the initial states
}

TEST(Linearisation, AValueOnItsBoundIsTakenAsGiven) {
  NullFit fit{testing::World{}};
  ASSERT_EQ(fit.problem.shared[1].name, "d");
  fit.null.shared[1] = fit.problem.shared[1].lower;
  const Linearisation at = fit.With(kTested);
  EXPECT_EQ(at.fitted_rank, 1 + 4 * 3);
  const Dense without_d(fit, {0});
  EXPECT_LT((at.r - without_d.Projected(at.raw)).norm(), 1e-9 * at.r.norm());
}

TEST(Linearisation, LeavesOutATrialThatFalls) {
  NullFit fit{testing::World{}};
  fit.train[1].parameters.theta_td = 80.0 * std::numbers::pi / 180.0;
  const Linearisation at = fit.With(kTested);
  EXPECT_EQ(at.samples, fit.train[0].sample_count + fit.train[2].sample_count);
  for (const RowLabel& label : at.labels) EXPECT_NE(label.trial, 1);
  EXPECT_TRUE(at.columns.allFinite());
}

TEST(Linearisation, DoesNotDependOnTheNumberOfJobs) {
  const NullFit fit{testing::World{}};
  const FitProblem extended = Extend(fit.problem, kTested);
  Eigen::VectorXd shared(extended.shared_count());
  shared << fit.null.shared, NullValues(kTested);
  const Linearisation one = Linearise(extended, 2, fit.train, shared, fit.null.initial_states, 1);
  const Linearisation four = Linearise(extended, 2, fit.train, shared, fit.null.initial_states, 4);
  EXPECT_EQ(one.r, four.r);
  EXPECT_EQ(one.columns, four.columns);
}

// Labels against the events of the run.
struct Labelled {
  NullFit fit;
  Linearisation at;
  std::vector<Trajectory> runs;
  explicit Labelled(const Dataset& d) : fit(d), at(fit.With(kTested)) {
    for (std::size_t i = 0; i < fit.train.size(); ++i) {
      TrialEvaluation e;
      TrialEvaluator(fit.problem, fit.train[i])
          .Evaluate({fit.null.shared, fit.null.initial_states[i], false}, e);
      runs.push_back(e.trajectory);
    }
  }
  // Touch-downs (or lift-offs) of a trial up to a time.
  int Count(int trial, EventKind kind, double until) const {
    int count = 0;
    for (const Event& e : runs[static_cast<std::size_t>(trial)].events)
      count += e.kind == kind && e.time <= until;
    return count;
  }
};

TEST(RowLabels, SayModeAndHopAsTheEventsDo) {
  const Labelled l(testing::DatasetOf({}));
  int stance_rows = 0, later_hops = 0;
  for (const RowLabel& row : l.at.labels) {
    if (row.of != RowLabel::Of::kSample) continue;
    const int down = l.Count(row.trial, EventKind::kTouchdown, row.time);
    const int up = l.Count(row.trial, EventKind::kLiftoff, row.time);
    EXPECT_EQ(row.mode != Mode::kFlight, down > up) << row.trial << " at " << row.time;
    EXPECT_EQ(row.hop, up) << row.trial << " at " << row.time;
    stance_rows += down > up;
    later_hops += up > 0;
  }
  EXPECT_GT(stance_rows, 10);
  EXPECT_GT(later_hops, 10);
}

TEST(RowLabels, SayHowMuchOfItsModeHasGoneBy) {
  const Labelled l(testing::DatasetOf({}));
  for (const RowLabel& row : l.at.labels) {
    if (row.of != RowLabel::Of::kSample) continue;
    const Trajectory& run = l.runs[static_cast<std::size_t>(row.trial)];
    double begin = 0.0, end = run.end_time;
    for (const Event& e : run.events) {
      if (e.kind == EventKind::kApex) continue;
      if (e.time <= row.time) begin = e.time;
      if (e.time > row.time) {
        end = e.time;
        break;
      }
    }
    EXPECT_NEAR(row.phase, (row.time - begin) / (end - begin), 1e-9)
        << row.trial << " at " << row.time;
  }
}

TEST(RowLabels, TellSamplesContactTimesAndPriorsApart) {
  Dataset d = testing::DatasetOf({});
  d.channels.push_back({Channel::kContact, std::nullopt});
  for (Trial& t : d.trials) {
    // A contact column that switches where the body is low.
    std::vector<double> contact;
    for (double y : *t.trace.Find(Channel::kBodyY)) contact.push_back(y < 0.16 ? 1.0 : 0.0);
    t.trace.columns.push_back({ChannelName(Channel::kContact), contact});
  }
  const NullFit fit(d);
  const Linearisation at = fit.With(kTested);
  long samples = 0, contacts = 0, priors = 0, switches = 0;
  for (const RowLabel& row : at.labels) {
    samples += row.of == RowLabel::Of::kSample;
    contacts += row.of == RowLabel::Of::kContactTime;
    priors += row.of == RowLabel::Of::kPrior;
    EXPECT_EQ(row.channel >= 0, row.of == RowLabel::Of::kSample);
  }
  for (const TrialProblem& t : fit.train)
    switches += static_cast<long>(t.contact.touchdown_s.size() + t.contact.liftoff_s.size());
  EXPECT_GT(switches, 0);
  EXPECT_EQ(contacts, switches);
  EXPECT_EQ(samples + contacts, at.samples);
  EXPECT_EQ(priors, 4 * static_cast<long>(fit.train.size()));
}

// A camera's clock, known to 3 ms, that is 1.3 of them off: nothing else is wrong.
TEST(Linearisation, KnowsTheClocksOfTheChannels) {
  Dataset hops = testing::DatasetOf({});
  hops.clocks = {{"camera", 0.004, 0.003}};
  hops.channels[1].clock = "camera";
  DiagnosisOptions options;
  options.fit.jobs = 1;
  options.candidates.only = {"air_drag", "sensor_delay"};
  const Diagnosis d = Diagnose(hops, options);
  EXPECT_EQ(d.refusal, "");
  EXPECT_EQ(d.verdict, Verdict::kAdequate) << d.reason;
}

}  // namespace
}  // namespace hoplab
