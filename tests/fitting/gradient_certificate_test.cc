#include "fitting/gradient_certificate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fitting/check.h"
#include "tests/support/fit_cases.h"
#include "tests/support/formulas.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using testing::NominalInitialStates;
using testing::SmallDataset;

struct Case {
  FitProblem problem = MakeProblem(SmallDataset(), {.with_effects = {"air_drag", "sensor_delay"}});
  std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  GradientCertificate Certify(const JacobianSource& source = nullptr) const {
    return CertifyGradients(problem, trials, InitialShared(problem), NominalInitialStates(trials),
                            1, source);
  }
};

TEST(GradientCertificate, PassesOnCorrectDerivatives) {
  const GradientCertificate c = Case().Certify();
  EXPECT_LT(c.max_relative_error, 1e-6);
  EXPECT_EQ(c.columns.size(), 4u + 2u * 4u);
  EXPECT_TRUE(c.flags.empty());
}

TEST(GradientCertificate, NamesAWrongDerivative) {
  const auto wrong = [](const TrialEvaluator& evaluator, const EvaluationRequest& request,
                        Trajectory& out) {
    evaluator.Simulate(request, {}, out);
    // The saltation forgotten in one place would look like this: one column off by 0.1 % after
    // the first hop.
    const std::size_t width = static_cast<std::size_t>(out.directions);
    for (std::size_t i = out.sensitivities.size() / 2; i < out.sensitivities.size(); i += width)
      out.sensitivities[i + 1] *= 1.001;
  };
  const GradientCertificate c = Case().Certify(wrong);
  EXPECT_EQ(c.worst_parameter, "d");
  EXPECT_GT(c.max_relative_error, 1e-4);
}

TEST(GradientCertificate, ATrialThatNeverTouchesSaysNothingOfTheLeg) {
  Dataset d = SmallDataset(1, 0);
  // Keep the first flight only.
  Trace& trace = d.trials[0].trace;
  trace.time_s.resize(10);
  for (TraceColumn& c : trace.columns) c.values.resize(10);
  const FitProblem p = MakeProblem(d, {});
  const CheckReport report = CheckDataset(d, p, 1);
  ASSERT_TRUE(report.uncertainty && report.certificate);
  EXPECT_EQ(report.uncertainty->identifiability.rank, 0);
  EXPECT_FALSE(report.uncertainty->parameters[0].std_error.has_value());
  EXPECT_FALSE(report.certificate->columns[0].relative_error.has_value());
  bool told = false;
  for (const std::string& w : report.warnings)
    told = told || w.find("never touches the ground") != std::string::npos;
  EXPECT_TRUE(told);
}

double ContactHeight() { return testing::BallRequest().parameters.radius; }

// A ball that is pushed up from a place on.
struct PushedBall {
  FitProblem problem;
  std::vector<TrialProblem> trials;
  std::vector<OwnValues> initial_states;

  PushedBall(double force, double from, const Eigen::Vector4d& start) {
    const SimulationRequest ball = testing::BallRequest();
    problem.law = Law::kBall;
    problem.channels = {{Channel::kBodyX, 0.001, false}, {Channel::kBodyY, 0.001, false}};
    EffectSetting push = EffectSetting::Null(FormulaEffect(testing::Source(
        "body_force_y", "f * step(x - at)",
        {testing::Factor("f", "N", -10.0, 10.0, 0.1), testing::Shape("at", "m", from, -10.0, 10.0)},
        "push")));
    push.values[0] = force;
    problem.effects = {push};
    TrialProblem trial;
    trial.file = trial.recording = "train-1.csv";
    trial.parameters = ball.parameters;
    for (int i = 1; i < 90; ++i) trial.row_times.push_back(0.01 * i);
    trial.data.assign(2 * trial.row_times.size(), 0.0);
    trial.start = start;
    const char* names[] = {"x0", "y0", "vx0", "vy0"};
    for (int i = 0; i < 4; ++i)
      trial.own.push_back({.name = names[i],
                           .direction = SensitivityDirection::InitialState(i),
                           .scale = 0.01,
                           .prior_mean = trial.start[i],
                           .prior_sigma = 0.01});
    initial_states = {trial.start};
    trials = {trial};
  }
  GradientCertificate Certify() const {
    return CertifyGradients(problem, trials, Eigen::VectorXd(), initial_states, 1);
  }
  // The first two events that change the motion, x0 moved by `by`.
  std::vector<EventKind> FirstEvents(double by) const {
    OwnValues start = initial_states[0];
    start[0] += by;
    Trajectory run;
    TrialEvaluator(problem, trials[0])
        .Simulate({Eigen::VectorXd(), start, false}, problem.integrator, run);
    std::vector<EventKind> kinds;
    for (const Event& e : run.events) {
      if (e.kind != EventKind::kApex && kinds.size() < 2) kinds.push_back(e.kind);
    }
    return kinds;
  }
};

// A ball that is pushed up from x = 1 m on and bounces first at that place, but for `beside`:
// before it the push has the sign that the bounce turns over, after it not, so that the slope of
// the motion by every value is another one on either side.
PushedBall PushedWhereItBounces(double beside) {
  const double g = testing::BallRequest().parameters.g;
  const double fall = std::sqrt(2.0 * (0.45 - ContactHeight()) / g);
  return {0.5, 1.0, Eigen::Vector4d(1.0 + beside - 1.5 * fall, 0.45, 1.5, 0.0)};
}

TEST(GradientCertificate, ADifferenceDoesNotStraddleAnotherOrderOfEvents) {
  const PushedBall beside = PushedWhereItBounces(2e-6);
  ASSERT_EQ(beside.FirstEvents(0.0), (std::vector{EventKind::kCorner, EventKind::kBounce}));
  ASSERT_EQ(beside.FirstEvents(-1e-5), (std::vector{EventKind::kBounce, EventKind::kCorner}));
  const GradientCertificate c = beside.Certify();
  EXPECT_LT(c.max_relative_error, 1e-6) << c.worst_parameter;
  EXPECT_EQ(c.columns.size(), 4u);
  EXPECT_TRUE(c.flags.empty());
}

TEST(GradientCertificate, RightBesideAnotherOrderOfEventsDifferencesAreOfOneSide) {
  for (const double beside : {2e-9, -2e-9}) {
    const GradientCertificate c = PushedWhereItBounces(beside).Certify();
    EXPECT_LT(c.max_relative_error, 1e-4) << c.worst_parameter;
    bool told = false;
    for (const CertificateFlag& f : c.flags)
      told = told || f.text.find("right beside this x0") != std::string::npos;
    EXPECT_TRUE(told);
  }
}

// A ball let go 30 um above the ground, which it meets at the root of that: over the step of a
// difference, 10 um of it, no straight line and no parabola is the motion. It is pushed up again
// before it comes to rest.
TEST(GradientCertificate, ADifferenceIsShorterBesideAGraze) {
  const PushedBall ball(8.0, 0.006, Eigen::Vector4d(0.0, ContactHeight() + 3e-5, 1.5, 0.0));
  ASSERT_EQ(ball.FirstEvents(0.0), (std::vector{EventKind::kBounce, EventKind::kCorner}));
  const GradientCertificate c = ball.Certify();
  EXPECT_LT(c.max_relative_error, 1e-6) << c.worst_parameter;
  EXPECT_TRUE(std::isnan(c.max_error_without_flags) ||
              c.max_error_without_flags == c.max_relative_error);
}

// A held force that jumps at the very instant of a bounce: a bounce before it goes on with the old
// force, one after it does not begin with it.
TEST(GradientCertificate, WhereAnEventFallsOnAJumpOfAHeldInputDifferencesAreOfOneSide) {
  PushedBall ball(0.0, 1.0, Eigen::Vector4d(0.0, 0.45, 1.5, 0.0));
  const double fall =
      std::sqrt(2.0 * (0.45 - ContactHeight()) / testing::BallRequest().parameters.g);
  DrivenColumn force{InputKind::kBodyForceX};
  force.held = true;
  force.times = {0.0, fall, 2.0};
  force.values = {0.0, 3.0, 3.0};
  ball.trials[0].inputs = {force};
  const auto wrong = [](double by) {
    return
        [by](const TrialEvaluator& evaluator, const EvaluationRequest& request, Trajectory& out) {
          evaluator.Simulate(request, {}, out);
          for (double& s : out.sensitivities) s *= by;
        };
  };
  const GradientCertificate right = CertifyGradients(ball.problem, ball.trials, Eigen::VectorXd(),
                                                     ball.initial_states, 1, wrong(1.0));
  EXPECT_LT(right.max_relative_error, 1e-5) << right.worst_parameter;
  const GradientCertificate off = CertifyGradients(ball.problem, ball.trials, Eigen::VectorXd(),
                                                   ball.initial_states, 1, wrong(1.001));
  EXPECT_GT(off.max_relative_error, 9e-4);
}

TEST(GradientCertificate, AColumnThatIsZeroButForRoundingIsNone) {
  // No height depends on the place along the ground.
  Dataset d = SmallDataset();
  std::erase_if(d.channels, [](const ChannelSpec& c) { return c.id != Channel::kBodyY; });
  const FitProblem p = MakeProblem(d, {});
  const std::vector<TrialProblem> trials = TrialsOf(p, TrialRole::kTrain);
  for (const double x : {0.0, 0.1, 1.0 / 3.0}) {
    std::vector<OwnValues> starts = NominalInitialStates(trials);
    for (OwnValues& start : starts) start[0] = x;
    const GradientCertificate c = CertifyGradients(p, trials, InitialShared(p), starts, 1);
    EXPECT_LT(c.max_relative_error, 1e-6) << c.worst_parameter;
    EXPECT_EQ(c.columns.size(), 2u + 2u * 3u) << "x0 is in none";
  }
}

}  // namespace
}  // namespace hoplab
