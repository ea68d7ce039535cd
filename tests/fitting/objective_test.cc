#include "fitting/objective.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/fit_cases.h"
#include "tests/support/richardson.h"

namespace hoplab {
namespace {

using testing::NominalInitialStates;
using testing::SmallDataset;

struct ObjectiveCase {
  ObjectiveCase() {
    ProblemOptions options;
    options.integrator.relative_tolerance = 1e-12;
    options.integrator.absolute_tolerance = 1e-13;
    problem = MakeProblem(SmallDataset(), options);
    trials = TrialsOf(problem, TrialRole::kTrain);
    initial_states = NominalInitialStates(trials);
  }
  // The cost where one column (shared values, then initial states) has moved by `by`.
  double CostAfter(int column, double by) const {
    Eigen::VectorXd values = shared;
    std::vector<OwnValues> moved = initial_states;
    if (column < 2)
      values[column] += by;
    else
      moved[(column - 2) / 4][(column - 2) % 4] += by;
    return EvaluateObjective(problem, trials, values, moved).cost;
  }
  FitProblem problem;
  std::vector<TrialProblem> trials;
  std::vector<OwnValues> initial_states;
  Eigen::VectorXd shared = Eigen::Vector2d(21e9, 2.0);
};

TEST(Objective, ItsGradientIsThatOfRichardsonDifferencesOfTheCost) {
  const ObjectiveCase c;
  const Objective at = EvaluateObjective(c.problem, c.trials, c.shared, c.initial_states);
  ASSERT_TRUE(at.complete);
  ASSERT_EQ(at.gradient.size(), 2 + 4 * 2);
  for (int column = 0; column < at.gradient.size(); ++column) {
    const double size = column < 2 ? c.problem.shared[column].scale : 0.1;
    const testing::DifferenceColumn difference = testing::RichardsonTable(
        [&](double h) -> std::optional<std::vector<double>> {
          return std::vector<double>{(c.CostAfter(column, h) - c.CostAfter(column, -h)) / (2 * h)};
        },
        1e-3 * size, 4.0);
    EXPECT_NEAR(at.gradient[column] / difference.value.at(0), 1.0, 1e-6) << column;
  }
}

TEST(Objective, DoesNotDependOnTheNumberOfJobs) {
  const ObjectiveCase c;
  const Objective one = EvaluateObjective(c.problem, c.trials, c.shared, c.initial_states, {}, 1);
  const Objective two = EvaluateObjective(c.problem, c.trials, c.shared, c.initial_states, {}, 2);
  EXPECT_EQ(one.cost, two.cost);
  EXPECT_EQ(one.gradient, two.gradient);
}

TEST(Objective, AStartMovesTheResidualsOfItsOwnTrialOnly) {
  const ObjectiveCase c;
  const Objective at = EvaluateObjective(c.problem, c.trials, c.shared, c.initial_states);
  const long first = TrialEvaluator(c.problem, c.trials[0]).residual_count();
  EXPECT_EQ(at.jacobian.block(0, 6, first, 4).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(at.jacobian.block(0, 2, first, 4).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(at.jacobian.block(first, 2, at.jacobian.rows() - first, 4).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Objective, HasNoNumbersWhereASimulationFalls) {
  const ObjectiveCase c;
  const Objective at =
      EvaluateObjective(c.problem, c.trials, Eigen::Vector2d(1e8, 1.0), c.initial_states);
  EXPECT_FALSE(at.complete);
  EXPECT_TRUE(std::isnan(at.cost));
  EXPECT_EQ(at.gradient.size(), 0);
  ASSERT_EQ(at.outcomes.size(), 2u);
  EXPECT_FALSE(IsComplete(at.outcomes[0]));
}

}  // namespace
}  // namespace hoplab
