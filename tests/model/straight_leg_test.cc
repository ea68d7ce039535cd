#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>

#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

TEST(StraightLeg, KnownSteadyHopComesBackToItself) {
  const Trajectory run = Simulate(SteadyStraightLeg());
  ASSERT_EQ(run.outcome, Outcome::kHopLimit);
  EXPECT_EQ(EventNames(run), "touchdown liftoff apex");
  EXPECT_NEAR(run.final_state[2], 0.513806075894484, 1e-10);
  EXPECT_NEAR(run.final_state[1], 1.238312718076982, 1e-10);
}

// d(vx, y at the apex)/d(vx, y at the apex before): the sensitivities belong to a fixed time, so
// along the section they gain f dt_e/dp.
Eigen::Matrix2d ReturnMap(SimulationRequest q) {
  const std::array directions = {D::InitialState(2), D::InitialState(1)};
  q.directions = directions;
  const Trajectory run = Simulate(q);
  const std::vector<double>& f = run.final_rate;
  const double* dt = &run.event_time_sensitivities[(run.events.size() - 1) * 2];
  Eigen::Matrix4Xd along(4, 2);
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 2; ++k) along(i, k) = run.final_sensitivities[i * 2 + k] + f[i] * dt[k];
  }
  // On the section vy stays zero.
  EXPECT_NEAR(along(3, 0), 0.0, 1e-10);
  EXPECT_NEAR(along(3, 1), 0.0, 1e-10);
  Eigen::Matrix2d map;
  map << along(2, 0), along(2, 1), along(1, 0), along(1, 1);
  return map;
}

TEST(StraightLeg, MultipliersOfTheKnownSteadyHopAreAsPublished) {
  const Eigen::EigenSolver<Eigen::Matrix2d> solver(ReturnMap(SteadyStraightLeg()));
  std::array<double, 2> multipliers = {solver.eigenvalues()[0].real(),
                                       solver.eigenvalues()[1].real()};
  std::sort(multipliers.begin(), multipliers.end());
  EXPECT_NEAR(solver.eigenvalues()[0].imag(), 0.0, 1e-12);
  EXPECT_NEAR(multipliers[0], 1.0, 1e-6);  // energy is conserved
  EXPECT_NEAR(multipliers[1], 4.180741, 1e-6);
}

}  // namespace
}  // namespace hoplab
