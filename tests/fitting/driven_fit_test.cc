// What a log brings along, in a fit: whose values are whose, derivatives of the residuals, cut
// pieces.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fitting/driven_trial.h"
#include "fitting/fit.h"
#include "fitting/trial_evaluator.h"
#include "tests/support/driven_hops.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::DrivenDataset;
using testing::DrivenHops;
using testing::InputErrorOf;

const Dataset& Driven() {
  static const Dataset kDataset = DrivenDataset({}, 3);
  return kDataset;
}

// Every column of a trial's Jacobian against central differences of its residuals.
void ExpectJacobian(const FitProblem& problem, const TrialProblem& trial) {
  const TrialEvaluator evaluator(problem, trial);
  const Eigen::VectorXd shared = InitialShared(problem);
  TrialEvaluation at, up, down;
  evaluator.Evaluate({shared, trial.start, true}, at);
  ASSERT_TRUE(at.complete);
  ASSERT_EQ(at.residuals.size(), evaluator.residual_count());
  for (int k = 0; k < evaluator.column_count(); ++k) {
    const bool is_shared = k < problem.shared_count();
    const int own = k - problem.shared_count();
    const double scale = is_shared ? problem.shared[k].scale : trial.own[own].scale;
    const double h = 1e-4 * scale;
    const auto evaluate = [&](double step, TrialEvaluation& out) {
      Eigen::VectorXd s = shared, o = trial.start;
      (is_shared ? s[k] : o[own]) += step;
      evaluator.Evaluate({s, o}, out);
    };
    evaluate(h, up);
    evaluate(-h, down);
    ASSERT_TRUE(up.complete && down.complete);
    const Eigen::VectorXd difference = (up.residuals - down.residuals) / (2.0 * h);
    const double norm = difference.norm();
    EXPECT_LT((difference - at.jacobian.col(k)).norm(), 2e-5 * norm + 1e-9 / scale)
        << (is_shared ? problem.shared[k].name : trial.own[own].name);
  }
}

TEST(DrivenFit, AngleOfEachTouchdownIsATrialsOwnValueWithItsPrior) {
  const FitProblem p = MakeProblem(Driven(), {});
  const TrialProblem& t = p.trials[0];
  ASSERT_EQ(t.own_count(), 7);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(t.own[4 + i].name, "touchdown_angle." + std::to_string(i + 1));
    EXPECT_EQ(t.own[4 + i].prior_sigma, 0.003);
    EXPECT_EQ(t.start[4 + i], Driven().trials[0].touchdown_angles_rad[i]);
  }
}

TEST(DrivenFit, DelayAndScaleAreFreedByNameAndTheirDerivativesAreThoseOfTheResiduals) {
  const FitProblem p = MakeProblem(
      Driven(), {.free = {"E", "d", "input.hip_torque.delay", "input.hip_torque.scale"}});
  EXPECT_EQ(p.shared_names(), (std::vector<std::string>{"E", "d", "input.hip_torque.delay",
                                                        "input.hip_torque.scale"}));
  EXPECT_EQ(p.shared[2].initial, 0.0);
  EXPECT_EQ(p.shared[3].initial, 1.0);
  // Off the rows, where a knot and a row do not coincide.
  FitProblem off = p;
  off.shared[2].initial = 0.0013;
  for (TrialProblem& t : off.trials) t.inputs[0].delay = 0.0013;
  ExpectJacobian(off, off.trials[0]);
}

TEST(DrivenFit, ADelayWithASigmaIsFreeWithItsPriorCountedOnce) {
  Dataset dataset = Driven();
  for (Trial& t : dataset.trials) {
    t.inputs[0].delay_s = 0.0013;
    t.inputs[0].delay_sigma_s = 0.002;
  }
  const FitProblem p = MakeProblem(dataset, {});
  EXPECT_EQ(p.shared_names(), (std::vector<std::string>{"E", "d", "input.hip_torque.delay"}));
  ASSERT_EQ(p.trials[0].shared_priors.size(), 1u);
  EXPECT_EQ(p.trials[0].shared_priors[0].mean, 0.0013);
  EXPECT_TRUE(p.trials[1].shared_priors.empty());
  ExpectJacobian(p, p.trials[0]);
  const FitProblem fixed = MakeProblem(dataset, {.fix = {{"input.hip_torque.delay", 0.004}}});
  EXPECT_EQ(fixed.shared_names(), (std::vector<std::string>{"E", "d"}));
  EXPECT_EQ(fixed.trials[2].inputs[0].delay, 0.004);
  EXPECT_TRUE(fixed.trials[0].shared_priors.empty());
}

TEST(DrivenFit, APriorOfADelayActsInATrialWithoutThatInput) {
  Dataset dataset = Driven();
  for (Trial& t : dataset.trials) t.inputs[0].delay_sigma_s = 0.002;
  dataset.trials[0].inputs.clear();
  const FitProblem p = MakeProblem(dataset, {});
  ASSERT_EQ(p.trials[0].shared_priors.size(), 1u);
  ExpectJacobian(p, p.trials[0]);
}

TEST(DrivenFit, ADelayThatDiffersBetweenTheTrialsCannotBeShared) {
  Dataset dataset = Driven();
  dataset.trials[1].inputs[0].delay_s = 0.003;
  EXPECT_EQ(MakeProblem(dataset, {}).trials[1].inputs[0].delay, 0.003);
  const std::string rule =
      "input.hip_torque.delay; differs between the trials of this dataset, so it cannot be one "
      "shared value";
  const std::string freed = InputErrorOf([&] {
    MakeProblem(dataset, {.free = {"E", "input.hip_torque.delay"}});
  });
  EXPECT_NE(freed.find("--free: " + rule), std::string::npos) << freed;
  for (Trial& t : dataset.trials) t.inputs[0].delay_sigma_s = 0.002;
  const std::string uncertain = InputErrorOf([&] { MakeProblem(dataset, {}); });
  EXPECT_NE(uncertain.find(rule), std::string::npos) << uncertain;
  const FitProblem fixed = MakeProblem(dataset, {.fix = {{"input.hip_torque.delay", 0.004}}});
  EXPECT_EQ(fixed.trials[1].inputs[0].delay, 0.004);
}

TEST(DrivenFit, AScalesSigmaThatDiffersBetweenTheTrialsIsRefused) {
  Dataset dataset = Driven();
  dataset.trials[1].inputs[0].scale_sigma = 0.02;
  const std::string rule = "scale_sigma; differs between the trials of this dataset";
  const std::string absent = InputErrorOf([&] { MakeProblem(dataset, {}); });
  EXPECT_NE(absent.find(rule), std::string::npos) << absent;
  for (Trial& t : dataset.trials) t.inputs[0].scale_sigma = &t == &dataset.trials[2] ? 0.03 : 0.02;
  const std::string other = InputErrorOf([&] { MakeProblem(dataset, {}); });
  EXPECT_NE(other.find(rule), std::string::npos) << other;
  EXPECT_EQ(InputErrorOf([&] {
              MakeProblem(dataset, {.fix = {{"input.hip_torque.scale", 1.1}}});
            }),
            "(no error)");
}

TEST(DrivenFit, AClockIsSharedOrATrialsOwn) {
  Dataset dataset = Driven();
  dataset.clocks = {{"camera", 0.0013, 0.002}};
  dataset.channels[1].clock = "camera";
  const FitProblem shared = MakeProblem(dataset, {});
  EXPECT_EQ(shared.shared_names(), (std::vector<std::string>{"E", "d", "clock.camera.offset"}));
  EXPECT_EQ(shared.channels[1].clock, 0);
  ExpectJacobian(shared, shared.trials[0]);
  dataset.clocks[0].per_trial = true;
  const FitProblem own = MakeProblem(dataset, {});
  EXPECT_EQ(own.shared_names(), (std::vector<std::string>{"E", "d"}));
  EXPECT_EQ(own.trials[3].own.back().name, "clock.camera.offset");
  EXPECT_EQ(own.trials[3].own.back().prior_sigma, 0.002);
  ExpectJacobian(own, own.trials[0]);
}

// Hops whose switch is read 5 ms late, by a clock that stamps 4 ms too early.
Dataset WithASwitch() {
  Scenario s = testing::HopScenario(3);
  s.dataset->sample_rate_hz = 2000.0;
  s.dataset->channels = {{Channel::kContact, 1.0}};
  EffectSpec delay;
  delay.name = "sensor_delay";
  delay.parameters = {{"tau", 0.005}};
  s.effects = {delay};
  Dataset dataset = GenerateDataset(s, {}).dataset;
  constexpr std::ptrdiff_t kRows = 8;
  for (Trial& t : dataset.trials) {
    std::vector<double>& contact = t.trace.columns[0].values;
    contact.erase(contact.begin(), contact.begin() + kRows);
    contact.insert(contact.end(), kRows, contact.back());
  }
  dataset.clocks = {{"switch", 0.004, 0.002}};
  dataset.channels[0].clock = "switch";
  return dataset;
}

// The events lie within the rows between which the column turns.
TEST(DrivenFit, ContactTimesAreReadAsOtherChannelsAre) {
  const Dataset dataset = WithASwitch();
  const FitProblem p =
      MakeProblem(dataset, {.fix = {{"sensor_delay.tau", 0.005}, {"clock.switch.offset", 0.004}}});
  const TrialProblem& trial = p.trials[0];
  ASSERT_GE(trial.contact.liftoff_s.size(), 2u);
  const Eigen::Vector2d truth(22e9, 3.0);
  OwnValues start = trial.start;
  const StateSpec& at = *testing::HopScenario(3).dataset->trials[0].initial;
  start.head<4>() << at.x_m, at.y_m, at.vx_m_per_s, at.vy_m_per_s;
  TrialEvaluation e;
  TrialEvaluator(p, trial).Evaluate({truth, start}, e);
  ASSERT_TRUE(e.complete);
  EXPECT_LT(e.residuals.head(e.data_residuals).cwiseAbs().maxCoeff(), 1.01 * std::sqrt(3.0));
}

TEST(DrivenFit, ContactTimesMoveWithTheirClockAndDelay) {
  Dataset dataset = WithASwitch();
  const std::vector<std::string> names = {"E", "d", "sensor_delay.tau", "clock_scale.gamma_t"};
  const FitProblem shared = MakeProblem(dataset, {.free = names});
  ASSERT_EQ(shared.shared_names().back(), "clock.switch.offset");
  ExpectJacobian(shared, shared.trials[0]);
  dataset.clocks[0].per_trial = true;
  const FitProblem own = MakeProblem(dataset, {.free = names});
  ExpectJacobian(own, own.trials[0]);
}

TEST(DrivenFit, APieceKeepsTheAnglesOfItsOwnTouchdowns) {
  const FitProblem p = MakeProblem(Driven(), {});
  const TrialProblem& t = p.trials[0];
  ASSERT_EQ(t.touchdown_times.size(), 3u);
  const int rows = static_cast<int>(t.row_times.size());
  int first = 0;
  while (t.row_times[first] < t.touchdown_times[0] + 0.1) ++first;
  const TrialProblem piece = CutTrial(p, t, first, rows);
  EXPECT_EQ(piece.touchdown_angles,
            (std::vector<double>{t.touchdown_angles[1], t.touchdown_angles[2]}));
  ASSERT_EQ(piece.own_count(), 6);
  EXPECT_EQ(piece.own[4].name, "touchdown_angle.2");
  EXPECT_EQ(piece.own[4].direction.index, 0);
  EXPECT_EQ(piece.start[4], t.start[5]);
  EXPECT_NEAR(piece.inputs[0].times[0], -t.row_times[first], 1e-12);
  const TrialProblem begin = CutTrial(p, t, 0, first);
  EXPECT_EQ(begin.touchdown_angles, (std::vector<double>{t.touchdown_angles[0]}));
  EXPECT_EQ(begin.own_count(), 5);
}

TEST(DrivenFit, FindsTheModulusAndTheDelayOfALogThatIsLate) {
  DrivenHops hops;
  hops.torque_delay_s = 0.006;
  const FitProblem p =
      MakeProblem(DrivenDataset(hops, 5), {.free = {"E", "d", "input.hip_torque.delay"}});
  const FitResult fit = Fit(p, {});
  EXPECT_EQ(fit.records[0].status, SolveStatus::kConverged);
  EXPECT_NEAR(fit.shared[0] / hops.truth.E_Pa, 1.0, 0.01);
  EXPECT_NEAR(fit.shared[2], -0.006, 0.0015);
}

TEST(DrivenFit, ARecordThatBeginsInStanceIsFitted) {
  Dataset dataset = testing::HopDataset(3, 4);
  for (Trial& t : dataset.trials) {
    t.mechanism.c_leg.E_Pa = 20e9;
    t.mechanism.c_leg.damping_N_s_per_m = 1.0;
  }
  dataset.channels.push_back({Channel::kBodyVx, 0.05});
  dataset.channels.push_back({Channel::kBodyVy, 0.05});
  // Each trial cut to begin well within its first stance: the true state there.
  for (Trial& t : dataset.trials) {
    SimulationRequest q;
    const testing::HopTruth truth;
    MechanismSpec m = t.mechanism;
    m.c_leg.E_Pa = truth.E_Pa;
    m.c_leg.damping_N_s_per_m = truth.damping_N_s_per_m;
    q.parameters = ParametersOfSpec(m, t.controller, t.touchdown_angle_rad);
    q.initial = InitialOf(*t.initial);
    q.horizon = t.trace.time_s.back();
    q.row_times = t.trace.time_s;
    const std::vector<Channel> channels = {Channel::kBodyX,  Channel::kBodyY,    Channel::kBodyVx,
                                           Channel::kBodyVy, Channel::kContactX, Channel::kContact};
    q.channels = channels;
    const Trajectory run = Simulate(q);
    std::size_t row = 0;
    while (run.samples[6 * row + 5] == 0.0) ++row;
    row += 4;
    const double* s = &run.samples[6 * row];
    t.initial = StateSpec{s[0], s[1], s[2], s[3], s[4], StartMode::kStance};
    t.initial_sigma = StateSpec{0.005, 0.005, 0.05, 0.05, 0.005};
    t.trace.time_s.erase(t.trace.time_s.begin(), t.trace.time_s.begin() + static_cast<long>(row));
    for (TraceColumn& c : t.trace.columns)
      c.values.erase(c.values.begin(), c.values.begin() + static_cast<long>(row));
  }
  dataset.channels.resize(2);
  const FitProblem p = MakeProblem(dataset, {});
  EXPECT_EQ(p.trials[0].own[4].name, "contact0");
  EXPECT_EQ(p.trials[0].start_mode, Mode::kStance);
  const FitResult fit = Fit(p, {});
  EXPECT_NEAR(fit.shared[0] / 22e9, 1.0, 0.01);
  EXPECT_NEAR(fit.shared[1] / 3.0, 1.0, 0.1);
}

TEST(DrivenFit, WhatIsNotThereIsRefusedWithWhatIs) {
  const auto error = [](const std::string& name) {
    return InputErrorOf([&] { MakeProblem(Driven(), {.free = {"E", name}}); });
  };
  EXPECT_EQ(error("input.hip_torque.lag"),
            "--free: input.hip_torque.lag; is no input here. Did you mean input.hip_torque.delay?");
  EXPECT_EQ(error("input.leg_angle.delay"),
            "--free: input.leg_angle.delay; is no input here. Known: input.hip_torque.delay, "
            "input.hip_torque.scale.");
  EXPECT_EQ(error("clock.motor.offset"),
            "--free: clock.motor.offset; this dataset has no clocks. Name it under `clocks` of the "
            "dataset.");
  EXPECT_EQ(error("theta_td"),
            "--free: theta_td; is each touch-down's own in this dataset. Say "
            "touchdown_angle_sigma_deg, or try the effect touchdown_angle_bias.");
}

}  // namespace
}  // namespace hoplab
