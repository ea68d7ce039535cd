// Edges: where a foot lands otherwise on either side, the derivatives of a fit jump.
#include "fitting/edges.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "datasets/read_dataset.h"
#include "fitting/fit.h"
#include "fitting/solve.h"
#include "fitting/stop_check.h"

namespace hoplab {
namespace {

// The second foot to land holds at the one 1/mu, and at the other slides on and turns back first.
constexpr double kHolds = 0.80, kSlides = 0.83;

// A driven leg on a slippery floor, one trial of it, and where in 1/mu its events change.
class OnAnEdge : public ::testing::Test {
 protected:
  static FitProblem Problem() {
    ProblemOptions options;
    options.with_effects = {"leg_mass", "leg_material_damping", "foot_coulomb_friction"};
    options.fix["d"] = 0.0;
    const std::filesystem::path root(HOPLAB_SOURCE_DIR);
    return MakeProblem(ReadDataset(root / "datasets/rig-controlled"), options);
  }

  OnAnEdge() {
    trials_ = TrialsOf(problem_, TrialRole::kTrain);
    trials_ = {trials_[1]};
    own_ = {trials_.front().start};
    shared_ = InitialShared(problem_);
    shared_[0] = 22e9;
    shared_[1] = 0.01;
    shared_[2] = 400e-6;
    Move(kHolds);
  }
  void Move(double inverse_mu) { shared_[3] = inverse_mu; }

  std::vector<EventKind> Events() {
    const TrialEvaluator evaluator(problem_, trials_.front());
    TrialEvaluation e;
    evaluator.Evaluate({shared_, own_.front(), false}, e);
    std::vector<EventKind> kinds;
    for (const Event& event : e.trajectory.events) kinds.push_back(event.kind);
    return kinds;
  }
  // The largest 1/mu, to rounding, up to which the events are those of `low`.
  double LastLike(double low, double high) {
    Move(low);
    const std::vector<EventKind> before = Events();
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      Move(middle);
      (Events() == before ? low : high) = middle;
    }
    return low;
  }
  EdgeCheck Check() const { return CheckEdges({problem_, trials_, shared_, own_, {}}); }

  FitProblem problem_ = Problem();
  std::vector<TrialProblem> trials_;
  std::vector<OwnValues> own_;
  Eigen::VectorXd shared_;
};

TEST_F(OnAnEdge, IsFoundWhereTheEventsChangeAndNotBesideIt) {
  Move(kHolds);
  const std::vector<EventKind> low = Events();
  Move(kSlides);
  ASSERT_NE(Events(), low) << "no edge between";
  const double edge = LastLike(kHolds, kSlides);
  Move(edge);
  const EdgeCheck on = Check();
  ASSERT_FALSE(on.edges.empty());
  for (const Edge& e : on.edges) {
    EXPECT_EQ(e.trial, 0);
    EXPECT_NEAR(e.normal.norm(), 1.0, 1e-12);
    EXPECT_GT(e.slope, 0.0);
  }
  Move(edge - 0.01);
  EXPECT_TRUE(Check().edges.empty());
}

// Data for which both sides of the edge want to cross it: their residuals at a point on it fall
// along the normal on the one side and against it on the other. A search stays where it meets the
// edge; one that follows it gains, until no step along it promises more.
TEST_F(OnAnEdge, ASearchGoesOnAlongIt) {
  Move(LastLike(kHolds, kSlides));
  const EdgeCheck check = Check();
  ASSERT_EQ(check.edges.size(), 1u);
  TrialProblem& trial = trials_.front();
  const TrialEvaluator evaluator(problem_, trial);
  const int n = problem_.shared_count();
  Eigen::VectorXd scale(check.edges.front().normal.size());
  for (int k = 0; k < scale.size(); ++k)
    scale[k] = k < n ? problem_.shared[static_cast<std::size_t>(k)].scale
                     : trial.own[static_cast<std::size_t>(k - n)].scale;
  const Eigen::VectorXd normal = check.edges.front().normal.cwiseProduct(scale);
  const auto at = [&](double way) {
    TrialEvaluation e;
    evaluator.Evaluate(
        {shared_ + way * normal.head(n), own_.front() + way * normal.tail(normal.size() - n), true},
        e);
    return e;
  };
  const TrialEvaluation here = at(-1e-6);
  const Eigen::VectorXd before = here.jacobian * normal, after = at(1e-6).jacobian * normal;
  // No part of them falls or rises along the edge: they have none along its columns.
  Eigen::MatrixXd along = here.jacobian * scale.asDiagonal();
  const Eigen::VectorXd unit = check.edges.front().normal;
  along -= along * unit * unit.transpose();
  const Eigen::MatrixXd Q = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(along).householderQ() *
                            Eigen::MatrixXd::Identity(along.rows(), along.cols() - 1);
  const auto clear = [&](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(x - Q * (Q.transpose() * x));
  };
  const Eigen::VectorXd one = clear(before), other = clear(after);
  Eigen::Matrix2d products;
  products << one.dot(one), one.dot(other), other.dot(one), other.dot(other);
  const Eigen::Vector2d parts = products.inverse() * Eigen::Vector2d(-1.0, 1.0);
  Eigen::VectorXd wanted = parts[0] * one + parts[1] * other;
  wanted *= 20.0 / wanted.norm();
  const std::size_t channels = problem_.channels.size();
  for (std::size_t c = 0; c < channels; ++c) {
    const std::vector<int>& rows = evaluator.channel_rows()[c].rows;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      double& datum = trial.data[k * channels + c];
      datum += problem_.channels[c].sigma * (here.residuals[rows[k]] - wanted[rows[k]]);
    }
  }
  SolveRequest request;
  request.problem = &problem_;
  request.trials = &trials_;
  request.shared = shared_;
  request.shared[0] *= 1.001;
  request.initial_states = own_;
  const SolveResult stays = Solve(request);
  request.follow_edges = true;
  const SolveResult goes = Solve(request);
  std::printf("  on the edge %.3f, along it %.3f\n", stays.cost, goes.cost);
  EXPECT_LT(goes.cost, stays.cost - 0.05);
  const StopCheck stop =
      CheckStop(problem_, trials_, goes.shared, goes.initial_states, {}, /*jobs=*/1);
  EXPECT_TRUE(stop.IsMinimum()) << stop.promised_nats;
  EXPECT_EQ(stop.on_edges_of, std::vector<std::string>{trial.file});
}

// Across the normal the surface goes on: where the edge is in 1/mu for other moduli says so.
TEST_F(OnAnEdge, TheNormalIsThatOfTheSurface) {
  constexpr double kStep = 1e-4;  // of the modulus
  const double E = shared_[0];
  std::array<double, 2> places;
  for (const int side : {0, 1}) {
    shared_[0] = E * (1.0 + (side == 0 ? -kStep : kStep));
    places[static_cast<std::size_t>(side)] = LastLike(kHolds, kSlides);
  }
  shared_[0] = E;
  Move(LastLike(kHolds, kSlides));
  const EdgeCheck check = Check();
  ASSERT_EQ(check.edges.size(), 1u);
  const Eigen::VectorXd& normal = check.edges.front().normal;
  const double by_E = normal[0] / problem_.shared[0].scale;
  const double by_mu = normal[3] / problem_.shared[3].scale;
  const double slope = (places[1] - places[0]) / (2.0 * kStep * E);
  EXPECT_NEAR(slope, -by_E / by_mu, 0.02 * std::abs(slope));
}

}  // namespace
}  // namespace hoplab
