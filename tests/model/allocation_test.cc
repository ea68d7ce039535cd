#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/support/requests.h"
#include "tests/support/robot_requests.h"

namespace {
std::atomic<long> allocations{0};
}

// Counts every allocation of this program.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// Allocations of a run into a trajectory that has held such a run before.
long AllocationsOf(const SimulationRequest& q) {
  Trajectory out;
  Simulate(q, out);
  const long before = allocations;
  Simulate(q, out);
  return allocations - before;
}

TEST(Allocation, ARunIntoAUsedTrajectoryAllocatesNothing) {
  for (Law law : kCLegLaws) {
    SimulationRequest q = ThickLegRequest(law);
    q.parameters.theta_td = Degrees(24.0);
    q.max_hops = 3;
    EXPECT_EQ(AllocationsOf(q), 0) << NameOf(law);
  }
}

// A robot lands, slides and lifts off; its legs have mass or none. Its parameters are copied.
TEST(Allocation, ARobotAllocatesTheSameHoweverManySteps) {
  for (double leg_mass : {0.0, 0.02}) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->friction = 0.8;
    p.robot->damping = 3e-4;
    p.robot->leg_mass = leg_mass;
    SimulationRequest q = RobotDrop(p, {0.0, 0.22, 0.3, 0.0, 0.03, 0.2}, 0.4);
    const long fine = AllocationsOf(q);
    q.integrator.relative_tolerance = q.integrator.absolute_tolerance = 1e-6;
    EXPECT_EQ(AllocationsOf(q), fine) << leg_mass;
    q.horizon = 0.01;  // in the air
    EXPECT_EQ(AllocationsOf(q), fine) << leg_mass;
  }
}

TEST(Allocation, SensitivitiesCostTheirEventTimesOnlyHoweverManySteps) {
  const std::array directions = {D::InitialState(0), D::InitialState(1), D::InitialState(2),
                                 D::InitialState(3)};
  for (double tolerance : {1e-6, 1e-12}) {
    SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
    q.integrator.relative_tolerance = q.integrator.absolute_tolerance = tolerance;
    q.directions = directions;
    EXPECT_LE(AllocationsOf(q), 1) << tolerance;
  }
}

}  // namespace
}  // namespace hoplab
