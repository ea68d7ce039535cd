// Edges: where a foot lands otherwise on either side, the derivatives of a fit jump.
#include "fitting/edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/random.h"
#include "datasets/read_dataset.h"
#include "fitting/fit.h"

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

// Along the normal the events change: a way beyond the surface by it has those of the other side.
TEST_F(OnAnEdge, TheNormalLeadsAcross) {
  const double edge = LastLike(kHolds, kSlides);
  Move(edge);
  const EdgeCheck check = Check();
  ASSERT_EQ(check.edges.size(), 1u);
  const Eigen::VectorXd& normal = check.edges.front().normal;
  const Eigen::VectorXd shared = shared_;
  const OwnValues own = own_.front();
  const int n = problem_.shared_count();
  std::vector<std::vector<EventKind>> sides;
  for (const double way : {-1e-4, 1e-4}) {
    for (int k = 0; k < n; ++k)
      shared_[k] = shared[k] + way * normal[k] * problem_.shared[static_cast<std::size_t>(k)].scale;
    for (Eigen::Index k = 0; k < own.size(); ++k)
      own_.front()[k] =
          own[k] + way * normal[n + k] * trials_.front().own[static_cast<std::size_t>(k)].scale;
    sides.push_back(Events());
  }
  EXPECT_NE(sides[0], sides[1]);
}

}  // namespace
}  // namespace hoplab
